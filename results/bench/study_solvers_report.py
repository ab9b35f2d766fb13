# SPDX-License-Identifier: GPL-3.0-or-later
"""results/study/solvers.md of solvers.csv, and solvers.csv of what study_solvers.py
wrote: python3 -B study_solvers_report.py FOLDER [--rows rows.jsonl ...] [--how TEXT],
which is kept in solvers_measured.txt."""
import argparse
import csv
import json
import pathlib
import statistics
from collections import defaultdict

from report_statistics import holm
from study_report import by_family, percent
from study_statistics import interval, p_of_flips, verdict

SOLVERS = ("ipopt-3.14", "ipopt-3.11", "snopt", "kto", "sqp", "chomp")
METRICS = ("euclidean", "phong@0.2", "smoothed@0.2", "placebo@0.2")
EXACT = "phong@0.2/exact"
COLUMNS = ("scene", "seed", "solver", "metric", "says", "free", "end", "objective",
           "evaluations", "least_gap")
# Name, and the two cells of (solver, metric) that are compared.
HYPOTHESES = tuple(
    (name, (solver, metric), (solver, "euclidean"))
    for name, metric in (("S1", "smoothed@0.2"), ("S2", "phong@0.2"),
                         ("S3", "placebo@0.2"))
    for solver in SOLVERS) + tuple(
    ("S4", ("ipopt-3.14", metric), ("ipopt-3.11", metric)) for metric in METRICS)
SECONDARY = tuple(("", (solver, EXACT), (solver, "phong@0.2")) for solver in SOLVERS)


def write_csv(folder, files):
    """All rows of the files, in whole blocks: a seed that lacks a run is left out,
    and told."""
    rows = {}
    for name in files:
        for line in pathlib.Path(name).read_text().splitlines():
            row = json.loads(line)
            rows[row["scene"], row["seed"], row["solver"], row["metric"]] = row
    asked = {key[0] for key in rows}, {key[2] for key in rows}, {
        key[3] for key in rows}
    whole = len(asked[0]) * len(asked[1]) * len(asked[2])
    counts = defaultdict(int)
    for key in rows:
        counts[key[1]] += 1
    for seed in sorted(counts):
        if counts[seed] < whole:
            print(f"seed {seed} is left out: {counts[seed]} of {whole} runs")
    with open(folder / "solvers.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for key in sorted(rows):
            if counts[key[1]] == whole:
                writer.writerow([text_of(rows[key][column]) for column in COLUMNS])


def text_of(value):
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.6g}" if isinstance(value, float) else value


def read_csv(folder):
    with open(folder / "solvers.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row["family"] = row["scene"].split(":")[0]
        row["cell"] = row["solver"], row["metric"]
        row["problem"] = row["scene"], row["seed"]
        row["says"], row["free"] = row["says"] == "true", row["free"] == "true"
        row["both"] = row["says"] and row["free"]
        row["objective"] = float(row["objective"])
        row["evaluations"] = int(row["evaluations"])
    return rows


def share_difference(a, b):
    return float(a["both"]) - float(b["both"])


def compare(rows, a, b):
    """The families' differences of the share of *both*, cell a less cell b."""
    own = {cell: {row["problem"]: row for row in rows if row["cell"] == cell}
           for cell in (a, b)}
    if own[a].keys() != own[b].keys():
        raise SystemExit(f"solvers.csv: expected {a} and {b} on the same problems")
    pairs = {key: (own[a][key], own[b][key]) for key in own[a]}
    return by_family(pairs, share_difference)


def hypotheses(rows, asked=HYPOTHESES):
    """A dictionary for each comparison whose solver is there, corrected together."""
    there = {row["cell"] for row in rows}
    found = []
    for name, a, b in asked:
        if a not in there or b not in there:
            continue
        differences = compare(rows, a, b)
        found.append({"name": name, "a": a, "b": b, "differences": differences,
                      "difference": statistics.mean(differences),
                      "interval": interval(differences, 0.95),
                      "p": p_of_flips(differences)})
    for one, corrected in zip(found, holm([one["p"] for one in found])):
        one["corrected"] = corrected
        one["verdict"] = verdict(one["differences"], corrected)
    return found


def best_objectives(rows):
    """Of each problem, of any free path."""
    best = {}
    for row in rows:
        if row["free"]:
            key = row["problem"]
            best[key] = min(best.get(key, float("inf")), row["objective"])
    return best


def solvers_there(rows):
    return [name for name in SOLVERS if any(row["solver"] == name for row in rows)]


def counts_table(rows):
    best = best_objectives(rows)
    lines = ["| solver | metric | says | free | both | of | objective over the best | "
             "evaluations | ended by the limits |",
             "|---|---|---:|---:|---:|---:|---:|---:|---:|"]
    for solver in solvers_there(rows):
        for metric in (*METRICS, EXACT):
            own = [row for row in rows if row["cell"] == (solver, metric)]
            both = [row for row in own if row["both"]]
            ratio = evaluations = "–"
            if both:
                ratio = "{:.3f}".format(statistics.median(
                    row["objective"] / best[row["problem"]] for row in both))
                evaluations = "{:.0f}".format(statistics.median(
                    row["evaluations"] for row in both))
            lines.append("| " + " | ".join(map(str, (
                solver, f"`{metric}`", sum(row["says"] for row in own),
                sum(row["free"] for row in own), len(both), len(own), ratio,
                evaluations, sum(row["end"] == "capped" for row in own)))) + " |")
    return lines


def cell_name(cell, beside):
    solver, metric = cell
    return f"`{metric}`" if solver == beside[0] else f"`{solver}`"


def where(one):
    """The solver in which, or the metric with which, two are compared."""
    a, b = one["a"], one["b"]
    return a[0] if a[0] == b[0] else f"`{a[1]}`"


def subject(one):
    a, b = one["a"], one["b"]
    return f"{cell_name(a, b)} against {cell_name(b, a)}"


def points(one):
    low, high = one["interval"]
    return f"{percent(one['difference'])} ({percent(low)} … {percent(high)})"


def hypotheses_table(found):
    lines = ["| | in | both, points (95 %) | p, corrected | |",
             "|---|---|---|---|---|"]
    for one in found:
        word = one["verdict"]
        shown = f"**{word}**" if word in ("win", "loss") else word
        lines.append(f"| {one['name']}: {subject(one)} | {where(one)} | {points(one)} "
                     f"| {one['corrected']:.3f} | {shown} |")
    return lines


def secondary_table(found):
    lines = ["| | in | both, points (95 %) |", "|---|---|---|"]
    return lines + [f"| {subject(one)} | {where(one)} | {points(one)} |"
                    for one in found]


def study_rows(folder, problems):
    """Converged of the study's straight-monotone on these problems, by metric, and how
    many of them it has."""
    with open(folder / "rows.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file)
                if row["protocol"] == "straight-monotone"
                and (row["scene"], row["seed"]) in problems]
    return {metric: [row["status_class"] == "solved"
                     and row["collision_free"] == "true"
                     for row in rows if row["method"] == metric]
            for metric in METRICS}


def study_table(folder, rows):
    """Beside the rows of the study, which has up to four rounds."""
    problems = {row["problem"] for row in rows}
    published = study_rows(folder, problems)
    lines = ["| | " + " | ".join(f"`{metric}`" for metric in METRICS) + " |",
             "|---|" + "---:|" * len(METRICS),
             "| the study, up to four rounds | " + " | ".join(
                 f"{sum(published[metric])} of {len(published[metric])}"
                 for metric in METRICS) + " |"]
    for solver in ("ipopt-3.11", "ipopt-3.14"):
        cells = []
        for metric in METRICS:
            own = [row for row in rows if row["cell"] == (solver, metric)]
            cells.append(f"{sum(row['both'] for row in own)} of {len(own)}")
        lines.append(f"| {solver} here | " + " | ".join(cells) + " |")
    return lines


def scenes_table(rows):
    solvers = solvers_there(rows)
    lines = ["| scene | " + " | ".join(solvers) + " |",
             "|---|" + "---:|" * len(solvers)]
    for scene in sorted({row["scene"] for row in rows}):
        cells = []
        for solver in solvers:
            own = [row for row in rows if row["scene"] == scene
                   and row["solver"] == solver and row["metric"] in METRICS]
            cells.append(f"{sum(row['both'] for row in own)} of {len(own)}")
        lines.append(f"| {scene} | " + " | ".join(cells) + " |")
    return lines


def verdicts(found):
    """The wins and losses, a line each."""
    told = []
    for word in ("win", "loss"):
        for one in found:
            if one["verdict"] == word:
                told.append(f"- {word}: {one['name']}, {subject(one)} in {where(one)}, "
                            f"{points(one)} points")
    return told


def report(folder):
    rows = read_csv(folder)
    found = hypotheses(rows)
    seeds = sorted({int(row["seed"]) for row in rows})
    problems = {row["problem"] for row in rows}
    counted = ", ".join(f"{sum(one['verdict'] == word for one in found)} {name}"
                        for word, name in (
                            ("win", "are wins"), ("loss", "losses"),
                            ("tie", "ties within ±3 points"), ("open", "open")))
    missing = [name for name in SOLVERS if name not in solvers_there(rows)]
    text = [
        "# Which direction helps solvers of others", "",
        f"{len(problems)} problems: {len({row['scene'] for row in rows})} scenes of "
        f"{len({row['family'] for row in rows})} families, "
        + (f"seeds {seeds[0]} to {seeds[-1]}" if len(seeds) > 1 else
           f"seed {seeds[0]} alone, as no more was made yet")
        + f"; {len(rows)} runs.",
        "The question, the solvers with their settings and where these are published, "
        "and what",
        "is compared were written down before: "
        "[solvers_protocol.md](solvers_protocol.md).",
        "All rows: [solvers.csv](solvers.csv).", "",
        *([f"Not there: {', '.join(missing)}.", ""] if missing else []),
        f"Of {len(found)} comparisons {counted}.", "", *verdicts(found),
        *([""] if verdicts(found) else []),
        "## What each solver says, and what is free", "",
        "*Both*: it says solved, and the whole path is exactly free. Objective and "
        "evaluations:",
        "medians of these; the best is of any free path of the problem.", "",
        *counts_table(rows), "",
        f"## The {len(found)} comparisons", "",
        "Points of the share of *both*, as the mean over families; *win* and *loss* "
        "by p < 0.05",
        f"after the correction for all {len(found)}, *tie* only where the 90 % "
        "interval lies within",
        "±3 points, else *open*. Where all families' differences are 0 the interval "
        "has no width",
        "and the word is *tie* by the rule, which of so many problems proves only "
        "that the two",
        f"differ in few: in up to {100 * (1 - 0.05 ** (1 / len(problems))):.0f} %, "
        "with 95 % confidence, were the problems drawn",
        "one by one.", "", *hypotheses_table(found), "",
        "## Beside them, without claims", "",
        "The slope of PhongPD's depth against its direction:", "",
        *secondary_table(hypotheses(rows, SECONDARY)), "",
        "Ipopt here beside the study's published rows (straight-monotone) of the same "
        "problems;",
        "the study solves up to four rounds, with more samples where the path "
        "collides:", "",
        *study_table(folder, rows), "",
        "## Both, scene by scene, over four metrics", "", *scenes_table(rows), "",
        (folder / "solvers_measured.txt").read_text().strip(), ""]
    (folder / "solvers.md").write_text("\n".join(text))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rows", nargs="+", default=[])
    parser.add_argument("--how", default="")
    arguments = parser.parse_args()
    if arguments.rows:
        write_csv(arguments.folder, arguments.rows)
    if arguments.how:
        (arguments.folder / "solvers_measured.txt").write_text(arguments.how + "\n")
    report(arguments.folder)


if __name__ == "__main__":
    main()
