# SPDX-License-Identifier: GPL-3.0-or-later
"""One pair of ends: PhongPD with next to no margin, and each peer; rows of
peers.jsonl."""
import functools
import time

import numpy as np
import phongpd
import trajectories_judge as judge
from python_report import told
from trajectories_bounds import least_duration
from trajectories_instances import ends_of, world_of
from trajectories_peers import MARGIN, PEERS

WITHIN = 1.01  # of a limit, at samples: what solvers and grids leave open


@functools.lru_cache(1 << 6)
def _metric(world):
    return phongpd.EuclideanMetric(world.contact_spaces()[0])


class Problem:
    """What a peer is given."""

    def __init__(self, instance):
        self.world, self.limits = world_of(instance.scene), instance.limits
        self.start, self.goal = map(np.array, ends_of(instance))
        self.path = self.stops = None

    def box(self):
        if self.world.bounds is not None:
            return np.array(self.world.bounds)
        ends = np.array([self.start, self.goal])
        return (ends.min(axis=0) - self.world.length,
                ends.max(axis=0) + self.world.length)

    def distances(self, points):
        found = _metric(self.world).query(points)
        return found.signed_distance, found.gradient


def own(problem, preset):
    begin = time.process_time()
    motion = problem.world.optimize(
        problem.start, problem.goal, limits=problem.limits, margin=MARGIN,
        preset=preset, routes=8 if preset == "tight" else 0)
    cpu = time.process_time() - begin
    if not motion.certified:
        raise ValueError(f"{motion.status}: {motion.reason}")
    return motion, {"says": True, "duration": motion.duration, "free": True,
                    "within": True, "cpu": cpu, "pieces": len(motion.durations)}


def beside(problem, solve):
    begin = time.process_time()
    says, duration, at, slopes, place = solve(problem)
    cpu = time.process_time() - begin
    times = np.linspace(0.0, duration, judge.FINE + 1)
    points = np.asarray(at(times))
    shares = [None if of is None else float(np.abs(of).max() / limit)
              for of, limit in zip(slopes(times), problem.limits)]
    ends = max(np.abs(points[0] - problem.start).max(),
               np.abs(points[-1] - problem.goal).max())
    return {"says": says, "duration": duration, "cpu": cpu, "used": shares,
            "free": judge.is_place_free(problem.world, place),
            "within": all(s is None or s <= WITHIN for s in shares)
            and float(ends) <= 1e-5 * problem.world.length}


def measure(instance, peers=PEERS):
    """Errors of one are told, and keep no other away."""
    problem = Problem(instance)
    problem.world.contact_spaces()
    row = {"key": instance.key, "scene": instance.scene, "pair": instance.pair,
           "limits": list(instance.limits), "answers": {},
           "least_duration": least_duration(problem.start, problem.goal,
                                            instance.limits, False)}
    motion, row["answers"]["PhongPD"] = own(problem, "balanced")
    problem.path, problem.stops = motion.path, motion.row["stops_duration"]
    _, row["answers"]["PhongPD, tight"] = own(problem, "tight")
    for name, _, solve, _ in peers:
        try:
            row["answers"][name] = beside(problem, solve)
        except Exception as error:
            row["answers"][name] = {"error": told(error, 200)}
    return row
