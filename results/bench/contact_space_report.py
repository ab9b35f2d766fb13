# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables, figure and README of results/contact-space, from the rows that
contact_space_benchmark wrote into the folder."""

import math
import re

from python_report import (Figure, parse_folder, read_dicts, read_measured,
                           read_table, rounded, setting, tables_and_figures,
                           verdict, write_report)
from step_figure import render

READING = """
## How to read this

Times are wall times on a machine that may do other work; ours are medians, a \
competitor's is one run. A time of ours includes checking both operands and the \
result (stages `check` and `report`), which the competitors do not do. They return \
the exact rational polyhedron, we the exact topology with vertices rounded to \
double, of operands rounded to a grid of 2⁻³⁸ of their size. Their triangle counts \
depend on how their polygons are triangulated. The worst case of any method is \
cubic in the product of the operands' sizes: what costs is the number of crossings \
between sheets that end up inside (column `arrangement`), not the size of the \
result.

"""


def tables_of(folder, threads, limit, pair_limit):
    """Those there are: title and note by file."""
    titles = {
        "builds.csv": (
            "Contact spaces",
            "Robot + obstacle with their triangles. Seconds: median (and slowest) of "
            "up to 5 builds with all threads, from meshes in memory to a checked "
            "mesh. Peak: of a process that does nothing else. Self-int.: pairs of "
            "triangles that meet after rounding to double."),
        "stages.csv": ("Seconds per stage", "Medians of the builds above."),
        "threads.csv": (
            f"One thread and {threads}",
            "The same builds with TBB limited to one thread. Same bytes: a hash of "
            "all coordinates and indices of the result."),
        "competitors.csv": (
            "Beside CGAL",
            "The same meshes in the same binary and run, one build each, one process "
            f"each, limit {limit} s. Nef: minkowski_sum_3. Hulls: convex parts (an "
            "operand convex up to 1e-9 is one part, else convex_decomposition_3), "
            "hulls of all pairs of parts, union by corefinement with exact "
            "constructions. Nef / ours: their time over our median (they use one "
            "thread, we use all). Volume: relative difference to ours."),
        "growth.csv": (
            "A convex robot on a smooth obstacle",
            "A turned brick or a ball of 80 triangles on a torus of 10⁴, 10⁵ and "
            "10⁶. Linear growth: the same microseconds and KiB a triangle in every "
            "row."),
        "random_pairs.csv": (
            "Random pairs",
            "Every pair is built four times (as it is, swapped, moved by up to 100 "
            "sizes, scaled by 1e-9 to 1e9) and checked: closed, manifold, no "
            "crossing deeper than the grid, volume counted on a lattice, the four "
            "results alike, and membership of 300 random points and 1200 points "
            "±1e-6 and ±1e-9 of the diagonal off the surface against FCL. Crevice: "
            "such a point lies behind another sheet. Undecided: closer to the "
            "surface, or in a gap thinner, than a few grid steps. Oracle wrong: FCL "
            "contradicts exact predicates. Rounded: pairs whose triangles meet after "
            "rounding to double. Slowest: of one build, one thread. Limit "
            f"{pair_limit} s a pair.")}
    return {file: read_table(folder, file, *said) for file, said in titles.items()
            if (folder / file).exists()}


def is_number(text):
    """Not "> 20", "crashed", "failed", "–"."""
    return re.fullmatch(r"[-+0-9.e]+", text) is not None


def target_lines(builds):
    columns = {"s": "median [s]", "MiB": "peak [MiB]", "triangles": "triangles"}
    for row in builds:
        for target in re.findall(r"≤ \S+ \w+ (?:met|missed)", row["target"]):
            asked, unit, met = re.match(r"(≤ \S+) (\w+) (\w+)", target).groups()
            yield (f"- {row['pair']}: asked {asked} {unit}, found "
                   f"{row[columns[unit]]} {unit}{verdict(met == 'met')}")


def thread_line(rows, threads):
    ratios = [float(row["speed-up"]) for row in rows if row["speed-up"] != "–"]
    same = sum(row["same bytes"] == "yes" for row in rows)
    return (f"- {threads} threads against one: {rounded(min(ratios))} to "
            f"{rounded(max(ratios))} times as fast; the same bytes in {same} of "
            f"{len(ratios)} pairs.\n")


def competitor_line(rows, name, column):
    rows = [row for row in rows if is_number(row["ours [s]"])]
    done = [row for row in rows if is_number(row[f"{column} [s]"])]
    stopped = sum(row[f"{column} [s]"].startswith(">") for row in rows)
    failed = len(rows) - len(done) - stopped
    ratios = [float(row[f"{column} / ours"]) for row in done]
    other = sum(abs(float(row[f"{column} volume"])) > 1e-6 for row in done)
    return (f"- {name} finished {len(done)} of {len(rows)} pairs, {stopped} hit the "
            "limit" + (f", {failed} failed" if failed else "")
            + (f"; slower than ours on {sum(r > 1 for r in ratios)} of those it "
               f"finished ({rounded(min(ratios))} to {rounded(max(ratios))} times "
               "our time)" if done else "")
            + (f"; {other} of its volumes differ from ours by more than 1e-6"
               if other else "") + ".\n")


def by_robot(rows):
    robots = {}
    for row in rows:
        robots.setdefault(row["robot"], []).append(row)
    return robots


def growth_lines(rows):
    for robot, sizes in by_robot(rows).items():
        done = [row for row in sizes if is_number(row["seconds"])]
        if len(done) < 2:
            yield f"- {robot} on a growing obstacle: not measured.\n"
            continue

        def exponent(column):
            return (math.log(float(done[-1][column]) / float(done[0][column]))
                    / math.log(int(done[-1]["obstacle"]) / int(done[0]["obstacle"])))

        yield (f"- {robot} on a smooth obstacle of {done[0]['obstacle']} to "
               f"{done[-1]['obstacle']} triangles: time grows with exponent "
               f"{rounded(exponent('seconds'))}, memory with "
               f"{rounded(exponent('peak [MiB]'))} (1 is linear).\n")
        if len(done) < len(sizes):
            yield (f"  **{len(sizes) - len(done)} larger sizes did not finish.**\n")


def growth_figure(rows):
    """Time and memory over the obstacle's size, log-log."""
    script, time, memory = "", "", ""
    for i, (robot, sizes) in enumerate(by_robot(rows).items()):
        script += f"$g{i} << EOD\n" + "".join(
            f"{row['obstacle']} {row['seconds']} {row['peak [MiB]']}\n"
            for row in sizes if is_number(row["seconds"])) + "EOD\n"
        style = f" w lp pt 7 lw 2 t '{robot}', "
        time += f"$g{i} u 1:2{style}"
        memory += f"$g{i} u 1:3{style}"
    script += (
        "set multiplot layout 1,2\nset logscale xy\nset grid\n"
        "set format '10^{%L}'\nset key top left\nset xrange [5e3:2e6]\n"
        "set xlabel 'obstacle [triangles]'\n"
        f"set ylabel 'median build [s]'\nplot {time}1e-5*x w l dt 2 lc 'grey' t '10 "
        f"µs a triangle'\nset ylabel 'peak [MiB]'\nplot {memory}x/1024 w l dt 2 lc "
        "'grey' t '1 KiB a triangle'\nunset multiplot\n")
    return Figure("growth.svg", "A convex robot on a smooth obstacle: time and memory "
                  "over its size", render(script, 1000, 420))


def pair_lines(folder, rows):
    total = rows[-1]  # "all"
    yield f"- {total['failed']} of {total['pairs']} random pairs failed a check.\n"
    for line in (folder / "failed_pairs.csv").read_text(
            encoding="utf-8").splitlines()[1:]:
        yield f"  - {line}\n"


def main():
    folder = parse_folder(__doc__)
    measured = read_measured(folder)
    rows = {name: read_dicts(folder / f"{name}.csv") for name in
            ("builds", "threads", "competitors", "growth", "random_pairs")
            if (folder / f"{name}.csv").exists()}
    found = "".join(target_lines(rows.get("builds", [])))
    threads = ""
    if "threads" in rows:
        threads = re.fullmatch(r"(\d+) \[s\]", list(rows["threads"][0])[2])[1]
        found += thread_line(rows["threads"], threads)
    if "competitors" in rows:
        found += competitor_line(rows["competitors"], "CGAL's minkowski_sum_3",
                                 "Nef")
        found += competitor_line(rows["competitors"], "The union of hulls", "hulls")
    elif "builds" in rows:
        found += "- The competitors were not built: scripts/bench.sh does.\n"
    figures = []
    if "growth" in rows:
        found += "".join(growth_lines(rows["growth"]))
        figures.append(growth_figure(rows["growth"]))
    if "random_pairs" in rows:
        found += "".join(pair_lines(folder, rows["random_pairs"]))
    tables = tables_of(folder, threads, setting(measured, "--limit", "60"),
                       setting(measured, "--pair-limit", "60")).values()
    write_report(
        folder, "# Contact spaces: time, memory, competitors, random pairs\n\n"
        "Written by the command below; do not edit it.\n\n"
        f"{measured}\n\n## What is won and lost\n\n{found}{READING}"
        f"{tables_and_figures(tables, figures)}", tables, figures)
    print(found, end="")


if __name__ == "__main__":
    main()
