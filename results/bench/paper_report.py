# SPDX-License-Identifier: GPL-3.0-or-later
"""README, tables and figures of results/paper, from the rows that paper_benchmark
wrote into the folder; --page makes index.html, everything on one page, instead."""

import html
import math
import re

from paper_figures import moment_figure, motion_page
from python_report import (Figure, Table, parser_of, read_dicts, read_measured, read_table,
                           rounded, setting, tables_and_figures, write_report)

# What the rows call them, and people.
LABELS = {"euclidean": "Euclidean PD", "phong@0": "PhongPD, ℓ = 0",
          "phong@0.1": "PhongPD, ℓ = 0.1"}
# Three curves that lie upon each other show nothing.
NOT_DRAWN = {"ball_cone_across"}
ABOUT = ("PhongPD (ℓ = 0 is the paper's field, ℓ = 0.1 the field smoothed over a "
         "tenth of the contact space's diagonal) beside Euclidean PD on the same "
         "contact spaces.")
STYLE = """\
:root{color-scheme:light dark;--line:#8886;--code:#8882}
body{font:16px/1.5 system-ui,sans-serif;max-width:70em;margin:2em auto;padding:0 1em}
table{border-collapse:collapse;font-size:14px;display:block;overflow-x:auto}
th,td{border-bottom:1px solid var(--line);padding:.25em .6em;text-align:right}
th:first-child,td:first-child{text-align:left}
figure{margin:2em 0}figure svg{max-width:100%;height:auto;background:#fff;\
border-radius:8px}
code{background:var(--code);padding:0 .2em;overflow-wrap:anywhere}
"""


def tables_of(folder, measured):
    def of(flag, default):
        return setting(measured, flag, default)

    return [
        read_table(
            folder, "contact_spaces.csv", "Contact spaces",
            "The paper's meshes are unpublished. Of ours, cone (78 triangles) and "
            "wrench (772) have exactly its sizes, the ball (1008) is its \"about "
            "1K\", and the axes are a closed solid of 60 triangles (35, as printed, "
            "cannot close). Seconds: median of all builds, one process; memory: peak "
            "of the process up to there, so later rows include earlier ones."),
        read_table(
            folder, "random_motions.csv",
            "Continuity and depth along random motions",
            f"{of('--motions', '100')} straight motions of {of('--frames', '400')} "
            "frames between random interior points of each benchmark. Jump: PD "
            "changes by more than 5 % of the diagonal between two frames. Flagged: "
            "the frame's status says so, because the branch folded or the robot left "
            "the obstacle on another side than its branch led to; steep: no jump "
            "when the step is divided by 1000; silent: none of these. Ratio: depth "
            "over Euclidean depth, with the branch carried along, and asked cold at "
            "every frame; it grows without bound towards an exit on another side, "
            "where the Euclidean depth goes to 0."),
        read_table(
            folder, "query_times.csv", "Query times",
            "Per interior frame of the same random motions, single thread, all in "
            "one run, each query timed alone (the clock's own cost included). Warm: "
            "with the previous frame's branch; Euclidean PD has none. Last column: "
            "Euclidean time over warm time."),
        read_table(
            folder, "coverage.csv", "Interior points without a Phong projection",
            f"Share of {of('--points', '10000')} random interior points at which a "
            "cold query finds no projection, by fifths of the depth of the deepest "
            "point (shallow to deep; points per fifth in brackets).")]


def by_benchmark(rows):
    groups = {}
    for row in rows:
        groups.setdefault(row["benchmark"], []).append(row)
    return groups


def findings(motions):
    """What the numbers say; Euclidean PD is the first of each benchmark."""
    for benchmark, (euclid, *fields) in by_benchmark(motions).items():
        text = f"- {benchmark}: Euclidean PD jumps {euclid['jumps']} times."
        for row in fields:
            apart = int(row["jumps"]) - int(euclid["jumps"])
            text += (
                f" {row['metric']} jumps {row['jumps']} times ("
                f"{'a win' if apart < 0 else 'a loss' if apart > 0 else 'a draw'}), "
                f"{row['silent']} of them silently, and pays with depths "
                f"{rounded(float(row['ratio mean']))} times the Euclidean on "
                f"average, {rounded(float(row['ratio 99 %']))} or more at 1 % of the "
                "frames.")
        yield text + "\n"


def speed(times):
    """How many (benchmark, ℓ) pairs answer faster than Euclidean PD."""
    warm, cold = [], []
    for euclid, *fields in by_benchmark(times).values():
        least = float(euclid["cold median [µs]"])
        warm += [float(row["warm median [µs]"]) < least for row in fields]
        cold += [float(row["cold median [µs]"]) < least for row in fields]
    return ("Depth is lost everywhere: PhongPD is never less than Euclidean PD. "
            "Time: the median warm query is faster than a Euclidean one in "
            f"{sum(warm)} of {len(warm)} cases, the median cold one in {sum(cold)} "
            f"of {len(cold)} cases.")


def traces_of(folder, name):
    """Of each metric by its label: status and PD of every frame."""
    traces = {}
    for row in read_dicts(folder / f"{name}.csv"):
        traces.setdefault(LABELS[row["metric"]], []).append(
            tuple(float(row[f"pd_{axis}"]) for axis in "xyz"))
    return traces


def seen(traces, jump):
    """What to see in a figure of traces, in one sentence."""
    return (f". Jumps by more than {rounded(jump)} from frame to frame, greatest "
            "depth in brackets: " + "; ".join(
                f"{label}: {sum(math.dist(a, b) > jump for a, b in zip(pd, pd[1:]))}"
                f" ({rounded(max(map(math.hypot, *zip(*pd))))})"
                for label, pd in traces.items()))


def figures_of(folder):
    for row in read_dicts(folder / "motions.csv"):
        name, caption = row["motion"], row["summary"]
        if name in NOT_DRAWN:
            continue
        traces = traces_of(folder, name)
        svg = (moment_figure(read_dicts(folder / "moment_cut.csv"), traces)
               if name == "moment" else motion_page(traces, caption))
        yield Figure(f"{name}.svg", caption + seen(traces, float(row["jump"])), svg)


def short_table(folder):
    """The few columns a terminal has room for."""
    jumps = by_benchmark(read_dicts(folder / "random_motions.csv"))
    times = by_benchmark(read_dicts(folder / "query_times.csv"))
    rows = [["benchmark", "triangles", "paper", "build [s]", "jumps Eucl.", "ℓ = 0",
             "ℓ = 0.1", "warm [µs]", "Eucl. [µs]"]]
    rows += [[row["benchmark"], row["triangles"], row["paper"], row["build [s]"],
              *(one["jumps"] for one in jumps[row["benchmark"]]),
              times[row["benchmark"]][1]["warm median [µs]"],
              times[row["benchmark"]][0]["cold median [µs]"]]
             for row in read_dicts(folder / "contact_spaces.csv")]
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "The paper's three benchmarks\n" + "".join(
        "  " + "  ".join([row[0].ljust(widths[0]),
                          *(cell.rjust(width) for cell, width
                            in zip(row[1:], widths[1:]))]) + "\n" for row in rows)


def html_table(table: Table):
    def line(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>"
                                for cell in cells) + "</tr>\n"

    return (f"<h2>{html.escape(table.title)}</h2>\n<p>{html.escape(table.note)}</p>\n"
            f"<table>\n{line(table.header, 'th')}"
            f"{''.join(line(row, 'td') for row in table.rows)}</table>\n")


def page(tables, figures, measured):
    """One self-contained page with all tables and figures."""
    # Without the XML prologue a picture is valid inside HTML.
    pictures = "".join(
        f"<figure><figcaption>{html.escape(figure.caption)}</figcaption>\n"
        f"{figure.svg[figure.svg.index('<svg'):]}</figure>\n" for figure in figures)
    title = "PhongPD: the paper's three benchmarks"
    said = re.sub("`(.*?)`", r"<code>\1</code>", html.escape(measured))
    return (
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n"
        f"<title>{title}</title>\n<style>\n{STYLE}</style></head><body>\n"
        f"<h1>{title}</h1>\n<p>{ABOUT}</p>\n<p>{said}</p>\n"
        f"{''.join(map(html_table, tables))}<h2>Figures</h2>\n{pictures}"
        "</body></html>\n")


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--page", action="store_true", help="Write index.html, too")
    flags = parser.parse_args()
    folder, measured = flags.output, read_measured(flags.output)
    tables, figures = tables_of(folder, measured), list(figures_of(folder))
    found = "".join(findings(read_dicts(folder / "random_motions.csv")))
    write_report(
        folder, f"# The paper's three benchmarks\n\n{ABOUT} This file is written by "
        f"the command below; do not edit it.\n\n{measured}\n\n## What is won and "
        f"lost\n\n{found}\nA PD that is defined on all of a solid cannot be "
        "continuous everywhere: a Phong branch ends where its field folds, or leads "
        "to another side than the one the robot leaves by. The status "
        "`branch_ended` says both. "
        f"{speed(read_dicts(folder / 'query_times.csv'))}\n\n"
        f"{tables_and_figures(tables, figures)}", tables, figures)
    if flags.page:
        (folder / "index.html").write_text(page(tables, figures, measured),
                                           encoding="utf-8")
    print(short_table(folder), end="")


if __name__ == "__main__":
    main()
