# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the default trajectory pipeline: its time before and after a
change, and what it does with each metric (scripts/compare_pipeline.sh)."""

import argparse
import csv
import json
import math
import statistics
from pathlib import Path

from python_report import machine, markdown, write_csv
from report_statistics import holm, sign_test

# corridor.h, kToleratedMissing: paths are compared with those as clear.
TOLERATED_MISSING = 0.1
SAME = 0.01  # of the objective
DEFAULT = "phong@0.2"

TIME = ["scene", "runs", "before, ms", "after, ms", "ratio", "quartiles",
        "iterations before", "after", "converged before", "after",
        "Ipopt's own before", "after", "longer by 1 %", "shorter by 1 %",
        "largest ratio of objectives"]
PIPELINE = ["scene", "exactly free", "converged", "mean ratio", "within 2 %",
            "median iterations", "median ms", "callbacks", "least clearance"]
METRICS = ["scene", "metric", "exactly free", "converged",
           "median iterations", "median ms", "mean ratio", "shorter than "
           "Euclid by 1 %", "longer"]


def read(path):
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def problem(row):
    return row["scene"], row["seed"]


def by_scene(rows):
    scenes = {}
    for row in rows:
        scenes.setdefault(row["scene"], []).append(row)
    return scenes


def converged(row):
    return row["collision_free"] and row["status_class"] in ("solved",
                                                            "polished")


def of_ipopt(row):
    return row["collision_free"] and row["status_class"] == "solved"


def milliseconds(row):
    return 1e3 * row["seconds"]["total"]


class Rivals:
    """The free paths by problem: of these rows and of published ones."""

    def __init__(self, rows, published):
        self._paths = {}
        for row in rows:
            if row["collision_free"]:
                self._add(problem(row), row)
        with open(published, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if row["collision_free"] == "true":
                    self._add((row["scene"], int(row["seed"])), row)

    def _add(self, key, row):
        self._paths.setdefault(key, []).append(
            (float(row["objective"]), float(row["missing_clearance"])))

    def ratio(self, row):
        """Of the row's objective to the least that keeps as clear."""
        allowed = max(row["missing_clearance"], TOLERATED_MISSING)
        least = min([row["objective"],
                     *(objective for objective, missing
                       in self._paths[problem(row)] if missing <= allowed)])
        return row["objective"] / least if least > 0.0 else 1.0


def time_rows(before, after):
    told = []
    paired = {problem(row): row for row in after}
    for scene, rows in by_scene(before).items():
        pairs = [(row, paired[problem(row)]) for row in rows]
        ratios = [milliseconds(b) / milliseconds(a) for a, b in pairs]
        low, middle, high = statistics.quantiles(ratios, n=4)
        lengths = [b["objective"] / a["objective"] for a, b in pairs
                   if a["collision_free"] and b["collision_free"]]
        told.append((
            scene, len(pairs), statistics.median(map(milliseconds, rows)),
            statistics.median(milliseconds(b) for _, b in pairs), middle,
            f"{low:.3g} – {high:.3g}",
            statistics.median(a["iterations"] for a, _ in pairs),
            statistics.median(b["iterations"] for _, b in pairs),
            sum(converged(a) for a, _ in pairs),
            sum(converged(b) for _, b in pairs),
            sum(of_ipopt(a) for a, _ in pairs),
            sum(of_ipopt(b) for _, b in pairs),
            sum(x > 1.0 + SAME for x in lengths),
            sum(x < 1.0 - SAME for x in lengths),
            f"{max(lengths):.4f}"))
    return told


def pipeline_rows(rows, rivals):
    told = []
    for scene, of_scene in by_scene(rows).items():
        ratios = [rivals.ratio(row) for row in of_scene if converged(row)]
        total = sum(row["seconds"]["total"] for row in of_scene)
        callbacks = sum(row["seconds"]["callbacks"] for row in of_scene)
        told.append((
            scene,
            f"{sum(r['collision_free'] for r in of_scene)}/{len(of_scene)}",
            sum(map(converged, of_scene)),
            f"{statistics.mean(ratios):.4f}" if ratios else None,
            sum(ratio <= 1.02 for ratio in ratios),
            statistics.median(row["iterations"] for row in of_scene),
            statistics.median(map(milliseconds, of_scene)),
            f"{100.0 * callbacks / total:.2g} %",
            min((row["lengths"]["clearance"]["share"] for row in of_scene
                 if converged(row)), default=None)))
    return told


def metric_rows(rows, rivals):
    told = []
    euclid = {problem(r): r for r in rows if r["method"] == "euclidean"}
    for scene, of_scene in by_scene(rows).items():
        for metric in ("euclidean", "phong@0", DEFAULT):
            own = [row for row in of_scene if row["method"] == metric]
            ratios = [rivals.ratio(row) for row in own if converged(row)]
            beside = [row["objective"] / euclid[problem(row)]["objective"]
                      for row in own
                      if row["collision_free"]
                      and euclid[problem(row)]["collision_free"]]
            told.append((
                scene, metric,
                f"{sum(row['collision_free'] for row in own)}/{len(own)}",
                sum(map(converged, own)),
                statistics.median(row["iterations"] for row in own),
                statistics.median(map(milliseconds, own)),
                f"{statistics.mean(ratios):.4f}" if ratios else None,
                sum(x < 1.0 - SAME for x in beside),
                sum(x > 1.0 + SAME for x in beside)))
    return told


def findings(times, metrics, all_ratios):
    def total(column, rows):
        return sum(row[column] for row in rows)

    runs = total(1, times)
    ratios = [row[4] for row in times]
    mean = math.exp(statistics.mean(map(math.log, ratios)))
    lines = [
        f"- Time, after over before: median of all {runs} pairs "
        f"{statistics.median(all_ratios):.3g}; medians of the scenes "
        f"{min(ratios):.3g} to {max(ratios):.3g}, their geometric mean "
        f"{mean:.3g} (aim: a third; "
        f"{sum(r <= 1 / 3 for r in ratios)} of {len(ratios)} scenes reach it).",
        f"- Converged before {total(8, times)}, after {total(9, times)} of "
        f"{runs}; of them by Ipopt itself {total(10, times)} and "
        f"{total(11, times)}, by the corridor the rest. Objectives longer by "
        f"more than 1 %: {total(12, times)}, shorter: {total(13, times)}.",
    ]
    beside = {}
    for metric in ("euclidean", "phong@0", DEFAULT):
        own = [row for row in metrics if row[1] == metric]
        free = sum(int(row[2].partition("/")[0]) for row in own)
        lines.append(f"- {metric}: {free} of {runs} exactly free, "
                     f"{total(3, own)} converged")
        beside[metric] = total(7, own), total(8, own)
    raw = {m: sign_test(*beside[m]) for m in ("phong@0", DEFAULT)}
    for at, (metric, p) in enumerate(zip(raw, holm(list(raw.values()))), 1):
        wins, losses = beside[metric]
        lines[-3 + at] += (
            f"; shorter than Euclid's by more than 1 % in {wins}, longer in "
            f"{losses} (sign test, p = {p:.2g} by Holm)")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("before", "after", "metrics", "rivals", "output", "how"):
        parser.add_argument(f"--{name}", required=True)
    flags = parser.parse_args()
    before, after = read(flags.before), read(flags.after)
    others = read(flags.metrics)
    everything = [row for row in after if row["method"] == DEFAULT] + others
    rivals = Rivals(before + after + others, flags.rivals)
    times = time_rows(before, after)
    pipeline = pipeline_rows(after, rivals)
    metrics = metric_rows(everything, rivals)
    paired = {problem(row): row for row in after}
    all_ratios = [milliseconds(paired[problem(row)]) / milliseconds(row)
                  for row in before]
    seeds = [row["seed"] for row in before]
    out = Path(flags.output)
    out.mkdir(parents=True, exist_ok=True)
    for name, header, rows in (("pipeline-time", TIME, times),
                               ("pipeline", PIPELINE, pipeline),
                               ("pipeline-metrics", METRICS, metrics)):
        write_csv(out / f"{name}.csv", header, rows)
    text = [
        "# The default pipeline: its time, and each metric in it", "",
        "Repair, Ipopt, exact judge, corridor where needed; what `optimize` "
        "does by default, on the scenes of the [convergence study]"
        "(README.md). Repair and corridor know no metric, and every metric "
        "is Euclidean distance outside: what the pipeline solves says nothing "
        "about PhongPD. Times are those of a machine busy with other jobs: "
        "read their ratios.", "",
        *findings(times, metrics, all_ratios), "",
        markdown("Time before and after", "Two builds in turn, five seeds "
                 "each, the same seeds. Ratio: median of the paired ratios, "
                 "and their quartiles. Ipopt's own: converged without the "
                 "corridor. The last columns compare the objectives of paired "
                 "paths, after over before.", TIME, times,
                 "pipeline-time.csv"),
        markdown("The pipeline now", "Ratio: objective over the best of these "
                 "runs and of all published ones on that seed that keep as "
                 "clear. Callbacks: share of the time.", PIPELINE, pipeline,
                 "pipeline.csv"),
        markdown("With each metric", "Only what happens inside obstacles "
                 "differs.", METRICS, metrics, "pipeline-metrics.csv"),
        f"Command: {flags.how}. Seeds: {min(seeds)} to {max(seeds)}. Machine: "
        f"{machine()}. Versions: " + ", ".join(
            f"{k} {v}" for k, v in after[0]["versions"].items()), ""]
    (out / "pipeline.md").write_text("\n".join(text), encoding="utf-8")
    print("\n".join(findings(times, metrics, all_ratios)))


if __name__ == "__main__":
    main()
