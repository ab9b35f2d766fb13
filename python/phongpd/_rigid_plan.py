# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, numbers
from ._native import InputError
from ._rigid import _meshes, _pose


@dataclass(frozen=True)
class RigidPlan:
    """A path of poses of a robot that moves and turns, or none."""

    status: str
    """"solved"; "start_in_collision", "goal_in_collision" (undecided counts as
    that), "start_out_of_bounds", "goal_out_of_bounds"; "time_limit": none was
    found, which proves nothing; "interrupted"; "not_certified": a fault of
    ours."""
    reason: str
    """One sentence where there is no path."""
    poses: Floats = field(repr=False)
    """(N, 4, 4), from start to goal; from one to the next the robot moves as
    RigidJudge has it, free for all t, proved twice."""
    length: float
    """Of positions and, times the radius of gyration, of turns."""
    planner: str
    """"line", "straight", "slide" or "tow", which found it."""
    seconds: float

    @property
    def solved(self) -> bool:
        return self.status == "solved"


@dataclass(frozen=True)
class RigidOptimum(RigidPlan):
    """A short path of poses, by Ipopt, or none.

    `status` is as of RigidPlan, and also "stalled_feasible": there is a path,
    proved free for all t, but Ipopt did not converge to it. `planner` is the
    start that led to it: "line", "straight", "planner"; or it is the planner's
    own path ("slide", …), as nothing shorter was found."""

    solver: str
    """Ipopt's word on its last round: "converged", "stalled_feasible", …"""
    confirmed: bool
    """What Ipopt called solved was proved free for all t."""
    planned_length: float
    """Of the planner's path; 0: not asked."""
    rounds: int
    """Solves; after each rows are added where the judge finds a collision."""
    iterations: int
    added_samples: int

    @property
    def solved(self) -> bool:
        """There is a path, proved free, converged or not."""
        return self.status in ("solved", "stalled_feasible")


class RigidWorld:
    """A robot that moves and turns among fixed obstacles, and plans of it::

        world = phongpd.RigidWorld("part.stl", ["wall.stl", (V, F)])
        plan = world.plan(start, goal)    # 4 x 4 matrices
        plan.solved, plan.poses
        short = world.optimize(start, goal)

    Surfaces need not be closed; what is closed is solid.  For robots that only
    translate take World, which proves where there is no way.
    """

    def __init__(self, robot: Any, obstacles: Any) -> None:
        """As of RigidJudge."""
        self._native = _native.RigidWorld(
            _meshes(robot, "robot"), _meshes(obstacles, "obstacles"))

    def plan(self, start: ArrayLike, goal: ArrayLike, *,
             bounds: ArrayLike | None = None, time_limit: float = 10.0,
             seed: int = 1) -> RigidPlan:
        """Searches a path between two poses, (4, 4) each.  bounds: (2, 3), of the
        robot's origin; None: around obstacles, start and goal.  time_limit: in
        seconds.  The same seed gives the same path unless time runs out."""
        status, reason, rows, length, planner, seconds = self._native.plan(
            _ends(start, goal), _box(bounds), float(time_limit), seed)
        return RigidPlan(status, reason, _matrices(rows), length, planner,
                         seconds)

    def optimize(self, start: ArrayLike, goal: ArrayLike, *,
                 bounds: ArrayLike | None = None, time_limit: float = 10.0,
                 seed: int = 1, start_from: str = "both", knots: int = 8,
                 margin: float = 0.0, start_noise: float = 0.0,
                 tracked: bool = False) -> RigidOptimum:
        """A short path between two poses, (4, 4) each: Ipopt with rows on exact
        depth, added where a motion between samples is not proved free.

        start_from: "straight", through what is in its way, "planner", from the
        path of plan, or "both", the second where the first fails. knots: poses
        between the ends, at least. margin: clearance at samples, 0: a
        thousandth of the robot's reach. start_noise: share of the straight
        way's length by which its knots are moved, at random. tracked:
        directions out of a collision that do not jump (TrackedPoseRow).  Not to
        find a path proves nothing.  One at a time in a process."""
        answer, *rest = self._native.optimize(
            _ends(start, goal), _box(bounds), float(time_limit), seed,
            start_from, knots, float(margin), float(start_noise), tracked)
        status, reason, rows, length, planner, seconds = answer
        return RigidOptimum(status, reason, _matrices(rows), length, planner,
                            seconds, *rest)


def _ends(start: ArrayLike, goal: ArrayLike) -> Floats:
    return np.stack([_pose(start, "start"), _pose(goal, "goal")])


def _box(bounds: ArrayLike | None) -> Floats:
    if bounds is None:
        return np.empty((0, 3))
    box = numbers(bounds, "bounds", "(2, 3)")
    if box.shape != (2, 3):
        raise InputError(f"bounds: expected shape (2, 3), found {box.shape}")
    return box


def _matrices(rows: list[tuple[float, ...]]) -> Floats:
    return np.array(list(map(_matrix, rows))).reshape(-1, 4, 4)


def _matrix(row: tuple[float, ...]) -> Floats:
    x, y, z, w, a, b, c = row
    return np.array([
        [1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w), x],
        [2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w), y],
        [2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b), z],
        [0, 0, 0, 1]])
