# SPDX-License-Identifier: GPL-3.0-or-later
"""Several robots in one room."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._curve import moving_of
from ._motion import Motion, motion_of, wishes_of
from ._native import InputError
from ._plots import PLACES, new_axes, plot_vectors
from ._solid import Solid
from ._statuses import Answer
from ._view import Canvas, Shown
from ._world import World


@dataclass(frozen=True)
class Fleet(Answer, Shown):
    """Curves in time of several robots that keep off each other, or why there
    are none; the row of `phongpd optimize` of a scene of several as `row`."""

    status: str
    """"converged", or that of the robot without a motion."""
    reason: str
    solved: bool
    certified: bool
    """For all t: every robot, and every pair of them."""
    duration: float
    """Seconds until all have arrived; all begin at 0."""
    motions: dict[str, Motion] = field(repr=False)
    """By the robots' names; without a curve where there was none."""
    pairs: list[dict[str, Any]] = field(repr=False)
    """Of two robots, or a robot and a moving obstacle: `robots`, `certified`,
    `clearance` (a lower bound, proved), `least` (seen) at `time`,
    `verified`."""
    row: dict[str, Any] = field(repr=False)

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"scene": self.row["scene"], "status": self.status,
                "reason": self.reason, "solved": self.solved,
                "certified": self.certified, "duration": self.duration,
                "robots": len(self.motions), "tries": self.row["tries"],
                "clearance": min((pair["clearance"] for pair in self.pairs),
                                 default=np.inf)}

    def plot(self, axes: Any = None) -> Any:
        """Where each robot is over time, a figure a robot.  axes: as many of
        matplotlib, which has to be there; None: of a new figure.  Returns
        them."""
        axes = new_axes("plot", axes, len(self.motions))
        for (name, motion), one in zip(self.motions.items(), axes):
            if motion.duration > 0.0:
                times = np.linspace(0.0, motion.duration, PLACES)
                plot_vectors(one, times, motion.at(times), name)
        axes[0].legend(loc="upper left")
        axes[-1].set_xlabel("t (s)")
        return axes

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        """Paths, and each robot where it begins; `phongpd optimize --html`
        plays them together."""
        worlds = [motion.world for motion in self.motions.values()]
        if not worlds or worlds[0] is None:
            raise InputError("view: expected an answer with its worlds, found "
                             "one that came through pickle")
        for obstacle in worlds[0].obstacles:
            canvas.mesh(obstacle.name, "obstacle", obstacle)
        if worlds[0].unit:
            canvas.unit(worlds[0].unit)
        for (robot, motion), world in zip(self.motions.items(), worlds):
            if world is None or not len(motion.durations):
                continue
            places = motion.at(np.linspace(0.0, motion.duration,
                                           PLACES))
            solid = world.robot
            canvas.mesh(robot, "mesh", Solid(solid.vertices + places[0],
                                             solid.triangles, robot))
            canvas.path(robot, places, motion.certified)

    def _facts(self) -> dict[str, Any]:
        return self.to_row()

    def __str__(self) -> str:
        if not self.solved:
            return f"no motions, {self.status} ({self.reason})"
        return (f"{len(self.motions)} robots, {self.duration:.6g} s, "
                f"{'certified' if self.certified else 'NOT CERTIFIED'}")


def optimize_fleet(robots: Mapping[str, Tuple[World, ArrayLike, ArrayLike]]
                   | str | os.PathLike[str], *, limits: Any = None,
                   moving: Mapping[str, Any] | None = None,
                   margin: float | str | None = None, require: bool = False,
                   preset: str = "", routes: int = 0,
                   max_seconds: float | None = None,
                   by_norm: bool = False) -> Fleet:
    """Curves in time of several robots in one room: each free of what is fixed
    in its world, within its limits, and off all others, for all t, proved.
    They begin at the time 0, from rest to rest, and stay where they come to.

    robots: by name (world, start, goal), equal robots best of one world; or a
    scene file with `robots` (docs/command-line.md).
    limits: of all; None: those of the worlds' scenes.  moving: obstacles that
    move, as World.optimize has them, to be kept off by all; None: those of the
    scenes.  The rest as World.optimize has it, of each robot.

    By order of priority: those before are moving obstacles to those after, and
    other orders are tried.  Where no motions are found, that is no proof.
    """
    if isinstance(robots, Mapping):
        name = "fleet"
        tasks = [(str(key), *_task(value, str(key)))
                 for key, value in robots.items()]
    elif not isinstance(robots, (str, os.PathLike)):
        raise InputError("robots: expected a dict {name: (world, start, goal)} or "
                         f"a scene file, found {type(robots).__name__}")
    else:
        name, scenes = _native.load_robots(os.fspath(robots))
        tasks = []
        for key, scene in scenes:
            world = World._of(scene)
            tasks.append((key, world, world.start, world.goal))
    if not tasks:
        raise InputError("robots: expected one at least, found none")
    rest = (0.0, 0.0, 0.0)
    given = []
    for key, world, start, goal in tasks:
        wishes = wishes_of(
            world._native.scene, limits=limits, margin=margin, require=require,
            preset=preset, routes=routes, max_seconds=max_seconds,
            by_norm=by_norm, duration=0.0, departure=rest, arrival=rest)
        given.append((key, world._native, *world._ends(start, goal), wishes))
    answer = _native.optimize_fleet(name, given, moving_of(moving)[0])
    row = answer.row
    motions = {task[0]: motion_of(one, task[1], 0.0, f"{task[0]}: ")
               for one, task in zip(answer.robots, tasks)}
    return Fleet(status=answer.status, reason=answer.reason,
                 solved=answer.is_solved, certified=answer.is_solved,
                 duration=answer.duration, motions=motions,
                 pairs=row["pairs"], row=row)


def _task(value: Any, name: str) -> tuple[World, Any, Any]:
    if (not isinstance(value, tuple) or len(value) != 3
            or not isinstance(value[0], World)):
        raise InputError(f"robots: \"{name}\": expected (world, start, goal), "
                         f"found {type(value).__name__}")
    return value
