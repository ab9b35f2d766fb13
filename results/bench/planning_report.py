# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables, figures and README of results/planning, from what planning_benchmark
wrote into the folder: exact.csv, runs.csv, multi_query.csv, motions.csv.  Quotes
voxel_worlds.txt, what the test of that name printed, where it is."""

import re

from python_report import (Figure, Table, line, parse_folder, read_dicts,
                           read_measured, read_table, rounded,
                           tables_and_figures, write_report)
from report_statistics import median, wilson
from step_figure import BASELINE, MAIN, Curve, step_figure

# PlanningOptions (planning_measure.h).
LIMIT, HOPELESS = 1.0, 5
INTRODUCTION = """\
# Planning through narrow passages

A cube, a peg or a hook translates; δ is the side of the free channel in a world
of size 2. Twins are the same scenes with the channel closed by 1e-4. "Turned"
scenes (`rotation_seed=1`) lose every alignment with the axes. Every path is
judged by exact segment tests, whatever a planner claims.

"""
PASSAGE = """
## Samples until the first node in the passage, median

All Phong branches against the nearest Euclidean projection, the same planner and \
the same care for both, and against random points of the contact space (no \
retraction at all). Never: most runs cross the passage by an edge, without a node \
in it; a gap has no channel.

| scene | all Phong | Euclid | random contact point | Euclid / Phong |
|---|---|---|---|---|
"""
PHONG, EUCLID = "retraction-forest phong", "retraction-forest euclidean"
CONTACT_POINT = "retraction-forest contact-point"
# The only planners on ever narrower passages.
NARROWING = {PHONG, "retraction-rrt phong"}
ROLES = {PHONG: MAIN, EUCLID: BASELINE}
# A straight passage, one with bends, and one that is turned: the others look like
# one of them.
SHOWN = {"hole:delta=0.001", "tunnel:delta=0.001,bends=3",
         "bugtrap:delta=0.001,rotation_seed=1"}
NEVER = 1e300


def delta(scene):
    return float(re.search(r"delta=([^,]+)", scene)[1])


class Runs:
    """Of one planner on one scene."""

    def __init__(self, scene, planner, rows):
        self.scene, self.planner, self.rows = scene, planner, rows
        self.solved_rows = [row for row in rows if row["solved"] == "1"]
        self.solved, self.runs = len(self.solved_rows), len(rows)

    def median(self, column):
        return median(float(row[column]) for row in self.rows)

    def solved_median(self, column):
        return median(float(row[column]) for row in self.solved_rows)

    def to_passage(self):
        """Runs that never got there count as more than any other; never, where
        half of them did not."""
        found = median(NEVER if float(row["samples_to_passage"]) < 0
                       else float(row["samples_to_passage"]) for row in self.rows)
        return NEVER if found >= NEVER / 4 else found

    def cells(self):
        samples = self.planner.startswith("retraction")
        low, high = wilson(self.solved, self.runs)

        def if_any(text, there):
            return text if there else "–"

        return [
            self.scene, self.planner, f"{self.solved}/{self.runs}",
            f"{rounded(100 * low, 2)}-{rounded(100 * high, 3)} %",
            rounded(self.median("seconds")),
            if_any(rounded(self.median("samples"), 4), samples),
            if_any(or_never(self.to_passage()), samples),
            rounded(self.median("segment_checks"), 4),
            if_any(rounded(self.median("retractions"), 4), samples),
            if_any(rounded(self.solved_median("length"), 4), self.solved),
            if_any(rounded(self.solved_median("clearance") / delta(self.scene)),
                   self.solved)]


def or_never(value):
    return "never" if value == NEVER else rounded(value, 4)


def read_runs(folder):
    """Those of the samplers, and those on ever narrower passages."""
    groups = {}
    for row in read_dicts(folder / "runs.csv"):
        groups.setdefault((row["scene"], row["planner"]), []).append(row)
    runs = [Runs(*of, rows) for of, rows in groups.items()]
    planners = {}
    for one in runs:
        planners.setdefault(one.scene, set()).add(one.planner)
    return ([one for one in runs if planners[one.scene] != NARROWING],
            [one for one in runs if planners[one.scene] == NARROWING])


def sampler_table(file, runs, title, note):
    return Table(file, title, note,
                 ["scene", "planner", "solved", "95 %", "median s", "samples",
                  "to passage", "segment checks", "retractions", "length",
                  "clearance/δ"], [one.cells() for one in runs])


def tables_of(folder, samplers, narrowing):
    return [
        read_table(
            folder, "exact.csv", "The contact-surface planner, every problem",
            "Clearance over δ: 0.5 is what a channel allows; wide problems reach "
            "their cap first. Ratio: length over the shortest path known, of any "
            "planner here or the scene's own way through, pulled tight by 2000 cuts "
            "without a wish for clearance. Milliseconds: median of five queries; "
            "what is built once (tables, contact space) apart."),
        sampler_table(
            "samplers.csv", samplers, "Sampling planners",
            f"Exactly free paths within {rounded(LIMIT)} s a run, the same exact "
            "motion validator for all; a planner that fails its first "
            f"{HOPELESS} runs on a scene is stopped there. Medians over all runs; "
            "lengths and clearances over the solved ones, not shortened. To "
            "passage: samples until the first node in the channel. Contact spaces "
            "are built before and not counted."),
        sampler_table("narrowing.csv", narrowing,
                      "Effort and the width of the passage",
                      "The same from wide to narrow."),
        read_table(
            folder, "multi_query.csv", "Many queries on one scene",
            "ContactSurfacePlanner beside ContactRoadmap on the same random pairs "
            "of free configurations that do not see each other; a query's time is "
            "the least of three. Build: the planner's tables, and what the roadmap "
            "needs on top. Lowered: edges that are free only nearer to the surface "
            "than their ends; asked: queries handed to the planner. Length and "
            "clearance over those of the planner: median, and the worst."),
        read_table(
            folder, "motions.csv", "Exact motion checks",
            "FreeSpace::IsFree(a, b), ends within 5 % of the diagonal of the "
            "surface, starts free.")]


def time_figure(scene, runs):
    """Share of runs solved within a time, one curve a planner."""
    curves = []
    for one in runs:
        # The limit is looked at between steps: what ends just after it counts.
        seconds = sorted(min(float(row["seconds"]), LIMIT)
                         for row in one.solved_rows)
        if seconds:
            curves.append(Curve(one.planner, ROLES.get(one.planner),
                                [(at, (i + 1) / one.runs)
                                 for i, at in enumerate(seconds)]))
    if not curves:
        return None
    return Figure(
        "time-" + re.sub("[:,=]", "-", scene) + ".svg",
        f"The share of runs solved within a time: {scene}.",
        step_figure(curves, f"{scene}; higher and further left is better",
                    "seconds", "share of runs solved", 1e-5, LIMIT),
        scene not in SHOWN)


def figures_of(samplers):
    scenes = {}
    for one in samplers:
        scenes.setdefault(one.scene, []).append(one)
    return [figure for figure in map(time_figure, scenes, scenes.values())
            if figure is not None]


def exact_targets(rows):
    solved = [row for row in rows if row["answer"] == "solved"]
    right = sum(row["right"] == "yes" for row in rows)
    twins = sum("twin=1" in row["scene"] for row in rows)
    times = [float(row["query ms"]) + float(row["tables ms"]) for row in rows]
    slow = sum(time > 25 for time in times)
    # Half the channel is possible.
    shares = [2 * float(row["clearance/δ"]) for row in solved
              if delta(row["scene"]) <= 1e-3]
    near = sum(share < 0.4 for share in shares)
    ratios = [float(row["ratio"]) for row in solved]
    longer = sum(ratio > 1.3 for ratio in ratios)
    yield line("contact-surface: every problem solved, every twin proved "
               "infeasible", f"{right} of {len(rows)} right, {twins} of them twins",
               right == len(rows))
    yield line("contact-surface: ≤ 25 ms with its tables, contact space apart",
               f"slowest {rounded(max(times))} ms, {slow} above", not slow)
    yield line("contact-surface: clearance in a passage (δ ≤ 1e-3) ≥ 0.4 of what "
               "is possible", f"least {rounded(min(shares))}, {near} below",
               not near)
    yield line("contact-surface: length ≤ 1.3 × the shortest known",
               f"worst {rounded(max(ratios), 4)}, {longer} of {len(solved)} above",
               not longer)


def other_targets(queries, samplers, motions):
    wrong = sum(int(row["wrong"]) for row in queries)
    asked = sum(int(row["solved"]) + int(row["proved"]) for row in queries)
    yield line("roadmap: statuses of the contact-surface planner, paths exactly "
               "free", f"{wrong} of {asked} wrong", not wrong)
    for one in samplers:
        if one.planner == PHONG and 25 * one.solved < 24 * one.runs:
            yield line(f"retraction-forest, all branches, {one.scene}: ≥ 48 of 50 "
                       "within the limit", f"{one.solved} of {one.runs}", False)
    claims = sum(int(row["false_claim"]) for one in samplers for row in one.rows)
    yield line("samplers: no path claimed that is not free", claims, not claims)
    for row in motions:
        time = row["median µs"]
        yield line(f"motion check, {row['scene']} ({row['triangles']} triangles): "
                   "median ≤ 5 µs", f"{time} µs", float(time) <= 5)


def passage_lines(samplers):
    scenes = {}
    for one in samplers:
        scenes.setdefault(one.scene, {})[one.planner] = one.to_passage()
    for scene, of in scenes.items():
        phong, euclid = of[PHONG], of[EUCLID]
        ratio = ("–" if phong in (0, NEVER) else "> all" if euclid == NEVER
                 else rounded(euclid / phong))
        yield (f"| {scene} | {or_never(phong)} | {or_never(euclid)} | "
               f"{or_never(of[CONTACT_POINT])} | {ratio} |\n")


def main():
    folder = parse_folder(__doc__)
    samplers, narrowing = read_runs(folder)
    targets = "".join([
        *exact_targets(read_dicts(folder / "exact.csv")),
        *other_targets(read_dicts(folder / "multi_query.csv"), samplers,
                       read_dicts(folder / "motions.csv"))])
    worlds = folder / "voxel_worlds.txt"
    text = (f"Random voxel worlds against flood fill: "
            f"{worlds.read_text(encoding='utf-8').strip()}.\n\n"
            if worlds.exists() else "")
    tables, figures = tables_of(folder, samplers, narrowing), figures_of(samplers)
    write_report(
        folder, f"{INTRODUCTION}## Targets\n\n{targets}{PASSAGE}"
        f"{''.join(passage_lines(samplers))}\n{text}"
        "Every run of the samplers: [runs.csv](runs.csv). Retraction against "
        "baselines of equal strength: [baselines.md](baselines.md). How narrow a "
        "passage each planner takes in 1, 10 and 60 s: [widths.md](widths.md).\n\n"
        f"{tables_and_figures(tables, figures)}\n{read_measured(folder)}\n",
        tables, figures)
    print(targets, end="")


if __name__ == "__main__":
    main()
