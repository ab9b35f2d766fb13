# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, numbers, real, whole_number
from ._native import InputError
from ._plots import plot_poses
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

    def plot(self, axes: Any = None) -> Any:
        """Position, and the angle by which the robot is turned from its start
        in degrees, from pose to pose, whose numbers are below.  axes: two of
        matplotlib, which has to be there; None: of a new figure.  Returns
        them."""
        return plot_poses(axes, self.poses)


class RigidWorld:
    """A robot that moves and turns among fixed obstacles, and plans of it::

        world = phongpd.RigidWorld("part.stl", ["wall.stl", (V, F)])
        plan = world.plan(start, goal)    # 4 x 4 matrices
        plan.solved, plan.poses

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
        box = np.empty((0, 3)) if bounds is None else \
            numbers(bounds, "bounds", "(2, 3)")
        if bounds is not None and box.shape != (2, 3):
            raise InputError(f"bounds: expected shape (2, 3), found {box.shape}")
        status, reason, rows, length, planner, seconds = self._native.plan(
            np.stack([_pose(start, "start"), _pose(goal, "goal")]), box,
            real(time_limit, "time_limit", "seconds"),
            whole_number(seed, "seed", 0, 2 ** 64 - 1))
        return RigidPlan(status, reason, np.array(list(map(_matrix, rows))
                                                  ).reshape(-1, 4, 4),
                         length, planner, seconds)


def _matrix(row: tuple[float, ...]) -> Floats:
    x, y, z, w, a, b, c = row
    return np.array([
        [1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w), x],
        [2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w), y],
        [2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b), z],
        [0, 0, 0, 1]])
