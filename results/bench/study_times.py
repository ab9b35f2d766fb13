# SPDX-License-Identifier: GPL-3.0-or-later
"""What a metric costs with everything in it: contact space, field and solves of the
first 1, 10 and 100 problems of a scene, in one world that begins with nothing.

    build/venv/bin/python -B results/bench/study_times.py results/study \\
        --scenes SCENE... --seed 70001 --commit "$(git rev-parse --short HEAD)"

writes times.csv and times.md there.  A problem is the study's of one seed, from the
straight line.  Of each scene the metrics take turns, so that a machine that slows down
slows them all; times are of the processor, on all cores."""
import argparse
import math
import pathlib
import time
from collections import defaultdict
from statistics import fmean, median

import phongpd

from python_report import machine, read_dicts, versions, write_csv
from study_statistics import interval

METRICS = ("euclidean", "phong@0.2", "smoothed@0.2", "smoothed-foot@0.2")
COUNTS = (1, 10, 100)
HEADER = ("scene", "metric", "problems", "seconds", "before", "free")


class Series:
    """Problems of a scene solved one after the other with one metric."""

    def __init__(self, scene, metric):
        began = time.process_time()
        self.metric = metric
        self.world = phongpd.World.load(scene)
        self.seconds = time.process_time() - began
        self.before = self.solved = self.free = 0

    def solve(self, ends):
        first = self._timed(ends)
        if self.solved == 0:
            # The same again has its contact space and field.
            self.before = self.seconds + first - self._timed(ends)
        self.seconds += first
        self.solved += 1
        self.free += self.is_free

    def _timed(self, ends):
        began = time.process_time()
        answer = self.world.optimize(*ends, metric=self.metric, model="full",
                                     straight=True, limits="none")
        self.is_free = answer.free
        return time.process_time() - began


def measure(scenes, seed, counts):
    rows = []
    ends = phongpd.World.load(scenes[0], seed=seed)
    Series(scenes[0], METRICS[1]).solve((ends.start, ends.goal))  # threads start
    for turn, scene in enumerate(scenes):
        first = turn % len(METRICS)
        worlds = [Series(scene, metric)
                  for metric in METRICS[first:] + METRICS[:first]]
        for number in range(1, max(counts) + 1):
            of = phongpd.World.load(scene, seed=seed + number - 1)
            for one in worlds:
                one.solve((of.start, of.goal))
                if number in counts:
                    rows.append((scene, one.metric, number, one.seconds,
                                 max(one.before, 0.0), one.free))
        print(f"{scene} done", flush=True)
    return rows


def logs_of(rows, metric, problems):
    """Logarithms of a scene's seconds, the mean of each family."""
    families = defaultdict(list)
    for row in sorted(rows, key=lambda r: r["scene"]):
        if row["metric"] == metric and int(row["problems"]) == problems:
            families[row["scene"].split(":")[0]].append(
                math.log(float(row["seconds"])))
    return [fmean(of) for of in families.values()]


def ratios(rows, metric, problems):
    """The same of seconds over Euclid's."""
    return [own - euclid for own, euclid in zip(
        logs_of(rows, metric, problems), logs_of(rows, METRICS[0], problems))]


def table(rows):
    counts = sorted({int(r["problems"]) for r in rows})
    lines = ["| metric | " + " | ".join(f"{n}: s | times Euclid's (95 %)"
                                        for n in counts) +
             " | before the first: share of 1, of " + str(counts[-1]) + " |",
             "|---" * (2 * len(counts) + 2) + "|"]
    for metric in METRICS:
        cells = []
        for n in counts:
            cells.append(f"{math.exp(fmean(logs_of(rows, metric, n))):.3g}")
            logs = ratios(rows, metric, n)
            low, high = interval(logs, 0.95)
            cells.append("1" if metric == METRICS[0] else
                         f"{math.exp(fmean(logs)):.2f} ({math.exp(low):.2f} … "
                         f"{math.exp(high):.2f})")
        shares = [median(float(r["before"]) / float(r["seconds"]) for r in rows
                         if r["metric"] == metric and int(r["problems"]) == n)
                  for n in (counts[0], counts[-1])]
        cells.append(f"{shares[0]:.2g}, {shares[1]:.2g}")
        lines.append(f"| `{metric}` | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def page(rows, how):
    scenes = len({r["scene"] for r in rows})
    families = len({r["scene"].split(":")[0] for r in rows})
    most = max(int(r["problems"]) for r in rows)
    return f"""# What a metric costs with everything in it

Processor seconds of the first 1, 10 and {most} problems of a scene, in one world that
begins with nothing: contact space, field and all solves, from the straight line, as
`optimize` has them by default. Geometric means in a family, then over {families} families,
of {scenes} scenes; intervals by the bootstrap over families. The last column: what is
made before a solver begins, the median over scenes.

{table(rows)}

All rows, and how many paths are exactly free: [times.csv](times.csv). Whether a metric
helps a solver is another question: [the study](README.md).

{how}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scenes", nargs="+", required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--commit", required=True)
    parser.add_argument("--problems", type=int, nargs="+", default=COUNTS)
    arguments = parser.parse_args()
    rows = measure(arguments.scenes, arguments.seed, arguments.problems)
    write_csv(arguments.folder / "times.csv", HEADER, rows)
    (arguments.folder / "times.md").write_text(page(
        read_dicts(arguments.folder / "times.csv"),
        f"Command: `scripts/bench.sh study-times`. Commit: {arguments.commit}. "
        f"Seeds: {arguments.seed} and the {max(arguments.problems) - 1} after it. "
        f"Machine: {machine()}, shared. Versions: PhongPD "
        f"{phongpd.__version__}, {versions('numpy')}."))


if __name__ == "__main__":
    main()
