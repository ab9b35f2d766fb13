# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, flag, numbers, real, scene_name, \
    seed_number, whole_number
from ._native import InputError
from ._plots import plot_poses
from ._rigid import RigidClearance, _meshes, _pose
from ._sizes import warn_of_sizes
from ._view import Canvas, Shown


@dataclass(frozen=True)
class RigidPlan(Shown):
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
    world: RigidWorld = field(repr=False)
    """In which it was planned."""
    clearance: RigidClearance | None
    """How close the path comes to the obstacles, proved, and where; None: there
    is no path."""

    @property
    def solved(self) -> bool:
        return self.status == "solved"

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"status": self.status, "planner": self.planner,
                "poses": len(self.poses), "length": self.length,
                "seconds": self.seconds}

    def plot(self, axes: Any = None) -> Any:
        """Position, and the angle by which the robot is turned from its start
        in degrees, from pose to pose, whose numbers are below.  axes: two of
        matplotlib, which has to be there; None: of a new figure.  Returns
        them."""
        return plot_poses(axes, self.poses)

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        self.world._draw(canvas, None)
        if len(self.poses):
            canvas.turned_ends(self.poses[0], self.poses[-1])
            canvas.turning_way(name or f"{self.planner} · {self.status}",
                               self.poses, self.solved)

    def _facts(self) -> dict[str, Any]:
        return {**self.to_row(), "reason": self.reason}


@dataclass(frozen=True)
class RigidOptimum(RigidPlan):
    """A short path of poses, by Ipopt, or none.

    `status` is as of RigidPlan, and also "stalled_feasible": there is a path,
    proved free for all t, but Ipopt did not converge to it. `planner` is the
    start that led to it: "line", "straight", "planner"; or it is the planner's
    own path ("slide", …), as nothing shorter was found."""

    solver: str
    """"converged": no small step shortens the path; "stalled_feasible": steps that
    should were refused; else what ended the run before."""
    confirmed: bool
    """What Ipopt called solved was proved free for all t, once at least."""
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


class RigidWorld(Shown):
    """A robot that moves and turns among fixed obstacles, and plans of it::

        world = phongpd.RigidWorld("part.stl", ["wall.stl", (V, F)])
        plan = world.plan(start, goal)    # 4 x 4 matrices
        plan.solved, plan.poses
        short = world.optimize(start, goal)
        phongpd.RigidWorld.load("alpha:1.5").plan()

    Surfaces need not be closed; what is closed is solid.  For robots that only
    translate take World, which proves where there is no way.
    """

    def __init__(self, robot: Any, obstacles: Any) -> None:
        """As of RigidJudge."""
        moved, fixed = _meshes(robot, "robot"), _meshes(obstacles, "obstacles")
        self._native = _native.RigidWorld(moved, fixed)
        warn_of_sizes(
            ("the robot", np.concatenate([mesh[0] for mesh in moved]))
            if moved else ("the robot", np.empty((0, 3))),
            ((f"obstacle {i}" if len(fixed) > 1 else "obstacle", mesh[0])
             for i, mesh in enumerate(fixed)))
        self._scene: _Loaded | None = None

    @classmethod
    def load(cls, scene: str | os.PathLike[str]) -> RigidWorld:
        """Of a scene file whose robot has `turns`, or of a family that `phongpd
        scenes list` shows: "alpha", "alpha:1.2", "peg:play=0.01".  The scene has
        start, goal, bounds and time limit, which plan() takes where it is told
        none."""
        world = cls.__new__(cls)
        (world._native, name, unit, ends, bounds, time_limit,
         warnings) = _native.load_turning(scene_name(scene))
        start, goal = map(_matrix, ends)
        world._scene = _Loaded(name, unit, start, goal, bounds, time_limit,
                               warnings)
        return world

    @property
    def start(self) -> Floats | None:
        """Of the scene it was loaded from, (4, 4); None: of none."""
        return self._scene.start if self._scene else None

    @property
    def goal(self) -> Floats | None:
        return self._scene.goal if self._scene else None

    @property
    def bounds(self) -> Floats | None:
        """Of the robot's origin in that scene, (2, 3); None: it has none."""
        return self._scene.bounds if self._scene else None

    @property
    def warnings(self) -> list[str]:
        """About the scene's meshes, such as surfaces that are not closed."""
        return self._scene.warnings if self._scene else []

    @property
    def robot(self) -> list[tuple[Floats, NDArray[np.int32]]]:
        """Its meshes, vertices and triangles each, as they are judged."""
        return self._native.robot

    @property
    def obstacles(self) -> list[tuple[Floats, NDArray[np.int32]]]:
        return self._native.obstacles

    def plan(self, start: ArrayLike | None = None,
             goal: ArrayLike | None = None, *,
             bounds: ArrayLike | None = None, time_limit: float | None = None,
             seed: int = 1, threads: int = 2) -> RigidPlan:
        """Searches a path between two poses, (4, 4) each; None: the scene's where
        it was loaded.  bounds: (2, 3), of the robot's origin; None: the scene's,
        or around obstacles, start and goal.  time_limit: in seconds; None: the
        scene's, or 10.  threads: so many searches race, each on a thread and with
        random numbers of its own; as many as there are processors to spare.  The
        same seed and threads give the same path unless time runs out."""
        return RigidPlan(*self._answer(self._native.plan(
            *self._task(start, goal, bounds, time_limit),
            seed_number(seed), _thread_number(threads))))

    def optimize(self, start: ArrayLike | None = None,
                 goal: ArrayLike | None = None, *,
                 bounds: ArrayLike | None = None,
                 time_limit: float | None = None,
                 seed: int = 1, threads: int = 2, start_from: str = "both",
                 knots: int = 8, margin: float = 0.0,
                 start_noise: float = 0.0, tracked: bool = False
                 ) -> RigidOptimum:
        """A short path between two poses, as of plan: Ipopt with rows on exact
        depth, added where a motion between samples is not proved free.

        threads: of plan.  start_from: "straight", through what is in its way,
        "planner", from the path of plan, or "both", the second where the first fails. knots: poses
        between the ends, at least. margin: clearance at samples, 0: a
        thousandth of the robot's reach. start_noise: share of the straight
        way's length by which its knots are moved, at random. tracked:
        directions out of a collision that do not jump (TrackedPoseRow).  Not to
        find a path proves nothing.  One at a time in a process."""
        (answer, solver, confirmed, planned_length, rounds, iterations,
         added) = self._native.optimize(
            *self._task(start, goal, bounds, time_limit),
            seed_number(seed), _thread_number(threads), start_from,
            whole_number(knots, "knots", 0), real(margin, "margin"),
            real(start_noise, "start_noise"), flag(tracked, "tracked"))
        return RigidOptimum(*self._answer(answer), solver, confirmed,
                            planned_length, rounds, iterations, added)

    def _task(self, start: ArrayLike | None, goal: ArrayLike | None,
              bounds: ArrayLike | None, time_limit: float | None
              ) -> tuple[Floats, Floats, float]:
        """Ends, box and seconds, the scene's where nothing is given."""
        ends = np.stack([_pose(self._end(start, self.start, "start"), "start"),
                         _pose(self._end(goal, self.goal, "goal"), "goal")])
        if time_limit is None:
            time_limit = self._scene.time_limit if self._scene else 10.0
        seconds = real(time_limit, "time_limit", "seconds")
        if bounds is None:
            bounds = self.bounds
        if bounds is None:
            return ends, np.empty((0, 3)), seconds
        box = numbers(bounds, "bounds", "(2, 3)")
        if box.shape != (2, 3):
            raise InputError(f"bounds: expected shape (2, 3), found {box.shape}")
        return ends, box, seconds

    def _answer(self, answer: _native._RigidAnswer) -> tuple[
            str, str, Floats, float, str, float, RigidWorld,
            RigidClearance | None]:
        status, reason, rows, length, planner, seconds, clearance = answer
        return (status, reason, pose_matrices(rows), length, planner, seconds,
                self, RigidClearance(*clearance) if clearance else None)

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        if not canvas.is_new(self):
            return
        if self._scene and self._scene.unit:
            canvas.unit(self._scene.unit)
        canvas.robot(_Joined.of(self.robot))
        for i, mesh in enumerate(self.obstacles):
            canvas.mesh(f"obstacle {i}", "obstacle", _Joined.of([mesh]))
        if self._scene:
            canvas.turned_ends(self._scene.start, self._scene.goal)

    @staticmethod
    def _end(given: ArrayLike | None, of_scene: Floats | None,
             name: str) -> ArrayLike:
        if given is not None:
            return given
        if of_scene is None:
            raise InputError(f"{name}: expected a pose, found None, and no scene "
                             "was loaded that has one")
        return of_scene


def _thread_number(value: Any) -> int:
    return whole_number(value, "threads", 1, 64)


@dataclass(frozen=True)
class _Joined:
    """Several meshes as one, to draw."""

    vertices: Floats
    triangles: NDArray[np.int32]

    @classmethod
    def of(cls, meshes: list[tuple[Floats, NDArray[np.int32]]]) -> _Joined:
        first = np.cumsum([0, *(len(vertices) for vertices, _ in meshes)])
        return cls(np.concatenate([vertices for vertices, _ in meshes]),
                   np.concatenate([triangles + np.int32(k) for k, (_, triangles)
                                   in zip(first, meshes)]))


@dataclass(frozen=True)
class _Loaded:
    name: str
    unit: str
    start: Floats
    goal: Floats
    bounds: Floats | None
    time_limit: float
    warnings: list[str]


def pose_matrices(rows: list[tuple[float, ...]]) -> Floats:
    return np.array(list(map(_matrix, rows))).reshape(-1, 4, 4)


def _matrix(row: tuple[float, ...]) -> Floats:
    x, y, z, w, a, b, c = row
    return np.array([
        [1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w), x],
        [2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w), y],
        [2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b), z],
        [0, 0, 0, 1]])
