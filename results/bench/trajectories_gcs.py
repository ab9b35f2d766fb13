# SPDX-License-Identifier: GPL-3.0-or-later
"""PhongPD beside Drake's graphs of convex sets (GcsTrajectoryOptimization), which
are given the boxes of free space; both with limits of velocity by axis alone, the
only ones that graph's relaxation knows.  Rows of gcs.jsonl."""
import functools
import time
from typing import NamedTuple

import numpy as np
import trajectories_boxes as boxes
import trajectories_judge as judge
import trajectories_worlds as worlds
from python_report import cell, told
from trajectories_beside import WITHIN
from trajectories_best import is_valid
from trajectories_duels import TIE, spread
from trajectories_peers import MARGIN
from trajectories_statistics import median_interval

MAZE_PAIRS, BUILDINGS = 5, 100
NO_LIMIT = 1e300  # as PhongPD's MotionLimits::kNone
OWN, TIGHT, PEER = "PhongPD", "PhongPD, tight", "Drake GCS"
HEADER = ["scene", "pair", "boxes", "by", "says solved", "duration", "free",
          "in limits", "duration / PhongPD", "CPU s", "error"]
SUMMARY_HEADER = ["scene", "by", "pairs", "says solved", "free and in limits",
                  "duration / PhongPD, median", "low", "high", "least", "most",
                  "PhongPD faster", "as fast", "peer faster", "CPU s, median"]


class Kind(NamedTuple):
    """As it was published: degree of a region's curve, how often the path can be
    derived, the limit."""
    degree: int
    smooth: int
    velocity: float


KINDS = {"maze50": Kind(6, 2, 1.0), "building": Kind(7, 4, 10.0)}


class Instance(NamedTuple):
    scene: str
    pair: int  # of the maze; the building's seed

    @property
    def key(self):
        return f"{self.scene}|{self.pair}|velocity"


def instances(mazes=MAZE_PAIRS, buildings=BUILDINGS):
    return ([Instance("building", seed) for seed in range(buildings)]
            + [Instance("maze50", pair) for pair in range(mazes)])


@functools.lru_cache(1)
def _maze():
    return boxes.maze()


def _problem(instance):
    if instance.scene == "building":
        return boxes.building(instance.pair), *boxes.building_ends()
    start, goal = worlds.maze_pairs(worlds.CELLS, MAZE_PAIRS, seed=1)[instance.pair]
    return _maze(), np.array(start), np.array(goal)


def _own(world, start, goal, velocity, preset):
    begin = time.process_time()
    motion = world.optimize(start, goal, limits=(velocity, NO_LIMIT, NO_LIMIT),
                            margin=MARGIN, preset=preset)
    cpu = time.process_time() - begin
    return {"says": motion.certified, "duration": motion.duration,
            "free": motion.certified, "within": motion.certified, "cpu": cpu}


def _graph(known, start, goal, kind):
    """Axes in which all boxes are alike and both ends agree are left out: nothing
    is to be done along them."""
    from pydrake.geometry.optimization import GraphOfConvexSetsOptions, \
        HPolyhedron, Point
    from pydrake.planning import GcsTrajectoryOptimization
    from pydrake.solvers import ClarabelSolver
    axes = [k for k in range(3) if start[k] != goal[k]
            or np.ptp(known.low[:, k]) > 0 or np.ptp(known.high[:, k]) > 0]
    size = len(axes)
    graph = GcsTrajectoryOptimization(size)
    links = known.links()
    longest = 10.0 * float((known.high - known.low).max()) / kind.velocity
    rooms = graph.AddRegions(
        [HPolyhedron.MakeBox(a[axes], b[axes])
         for a, b in zip(known.low, known.high)],
        links + [(j, i) for i, j in links], kind.degree, 0.0, longest)
    ends = [graph.AddRegions([Point(end[axes])], 0, 0.0, 0.0)
            for end in (start, goal)]
    graph.AddEdges(ends[0], rooms)
    graph.AddEdges(rooms, ends[1])
    graph.AddTimeCost()
    one = np.ones(size)
    graph.AddVelocityBounds(-kind.velocity * one, kind.velocity * one)
    rooms.AddPathContinuityConstraints(kind.smooth)
    options = GraphOfConvexSetsOptions()
    options.convex_relaxation = True
    options.preprocessing = False
    options.max_rounded_paths = 5
    options.max_rounding_trials = 100
    options.solver = ClarabelSolver()
    found, result = graph.SolvePath(ends[0], ends[1], options)
    if not result.is_success():
        raise ValueError(f"gcs: {result.get_solution_result()}")
    begin = found.start_time()

    def at(times):
        points = np.tile(start, (len(times), 1))
        points[:, axes] = found.vector_values(begin + times).T
        return points
    slope = found.MakeDerivative(1)
    return (float(found.end_time() - begin), at,
            lambda times: slope.vector_values(begin + times).T)


def _gcs(known, start, goal, kind):
    """In boxes that keep the margin, as a curve that touches is not free."""
    begin = time.process_time()
    margin = MARGIN * known.world.length
    duration, at, slope = _graph(
        known._replace(low=known.low + margin, high=known.high - margin), start,
        goal, kind)
    cpu = time.process_time() - begin
    times = np.linspace(0.0, duration, judge.FINE + 1)
    points = at(times)
    used = float(np.abs(slope(times)).max() / kind.velocity)
    ends = max(np.abs(points[0] - start).max(), np.abs(points[-1] - goal).max())
    return {"says": True, "duration": duration, "cpu": cpu, "used": used,
            "free": judge.is_polyline_free(known.world, points),
            "within": used <= WITHIN and float(ends) <= 1e-5 * known.world.length}


def measure(instance):
    """The contact space is apart (cpu_build), as the boxes are, which the graph is
    given."""
    known, start, goal = _problem(instance)
    kind = KINDS[instance.scene]
    row = {"key": instance.key, "scene": instance.scene, "pair": instance.pair,
           "velocity": kind.velocity, "boxes": len(known.low), "answers": {}}
    begin = time.process_time()
    known.world.contact_spaces()
    row["cpu_build"] = time.process_time() - begin
    for name, solve in (
            (OWN, lambda: _own(known.world, start, goal, kind.velocity,
                               "balanced")),
            (TIGHT, lambda: _own(known.world, start, goal, kind.velocity,
                                 "tight")),
            (PEER, lambda: _gcs(known, start, goal, kind))):
        try:
            row["answers"][name] = solve()
        except Exception as error:
            row["answers"][name] = {"error": told(error, 200)}
    return row


def _ratio(row, answer):
    mine = row["answers"][OWN]
    return answer["duration"] / mine["duration"] if is_valid(mine) else None


def table(rows):
    for row in rows:
        if "error" in row:
            yield (row["scene"], row["pair"], "-", OWN, *["-"] * 6, row["error"])
        for name, a in row.get("answers", {}).items():
            begin = (row["scene"], row["pair"], row["boxes"], name)
            yield (*begin, *["-"] * 6, a["error"]) if "error" in a else (
                *begin, a["says"], a["duration"], a["free"], a["within"],
                _ratio(row, a), a["cpu"], "")


def summary(rows):
    """A line for each kind of world and solver; ratios where both are free and
    in limits."""
    rows = [row for row in rows if "answers" in row]
    for scene in dict.fromkeys(row["scene"] for row in rows):
        of = [row for row in rows if row["scene"] == scene]
        for name in (OWN, TIGHT, PEER):
            answers = [row["answers"][name] for row in of]
            ratios = [_ratio(row, a) for row, a in zip(of, answers)
                      if is_valid(a) and is_valid(row["answers"][OWN])]
            faster = sum(r > 1 + TIE for r in ratios)
            slower = sum(r < 1 - TIE for r in ratios)
            middle = ((float(np.median(ratios)),
                       *median_interval(ratios, [scene] * len(ratios)),
                       min(ratios), max(ratios)) if ratios else ["-"] * 5)
            cpus = [a["cpu"] for a in answers if "cpu" in a]
            yield (scene, name, len(of), sum(bool(a.get("says")) for a in answers),
                   sum(is_valid(a) for a in answers), *middle, faster,
                   len(ratios) - faster - slower, slower,
                   float(np.median(cpus)) if cpus else "-")


def page(rows):
    """The section of README.md."""
    yield "## Beside graphs of convex sets"
    yield ""
    seen = [row for row in rows if "answers" in row]
    if not seen:
        yield "Not run."
        return
    builds = {scene: np.median([r["cpu_build"] for r in seen
                                if r["scene"] == scene and r["cpu_build"] > 0.01]
                               or [0.0])
              for scene in KINDS}
    yield (f"{sum(r['scene'] == 'building' for r in seen)} buildings of 3 × 3 rooms "
           f"of 5 m, one for each seed from 0, and "
           f"{sum(r['scene'] == 'maze50' for r in seen)} pairs in the maze of "
           "50 × 50 cells. Limits of velocity by axis alone (10 m/s, 1), as the "
           "graph's relaxation knows no others. Drake (GcsTrajectoryOptimization, "
           "Clarabel, 5 rounded paths; degree 7 with four continuous derivatives "
           "of the path, in the maze 6 and two) is given free space as boxes; "
           f"PhongPD has meshes alone. Both keep a margin of {MARGIN:g} D. Free: "
           f"Drake's at {judge.FINE + 1:,} samples joined by segments, as its "
           "pieces meet no better than its solver ends; PhongPD's for all t. "
           "PhongPD's "
           "contact space, once a world, takes "
           f"{cell(builds['building'])} s of processors in a building and "
           f"{cell(builds['maze50'])} s in the maze, which are not in the table.")
    yield ""
    yield ("| world | | pairs | says solved | free and in limits | duration / "
           "PhongPD: median (95 %), range | PhongPD faster, as fast, slower | CPU s |")
    yield "|---|---|---:|---:|---:|---|---|---:|"
    for line in summary(rows):
        v = dict(zip(SUMMARY_HEADER, line))
        yield (f"| {v['scene']} | {v['by']} | {v['pairs']} | {v['says solved']} | "
               f"{v['free and in limits']} | {spread(v)} | {v['PhongPD faster']}, "
               f"{v['as fast']}, {v['peer faster']} | {cell(v['CPU s, median'])} |")
    yield ""
    yield "Each motion: [gcs.csv](gcs.csv)."
