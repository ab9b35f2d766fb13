# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, numbers, real, rows
from ._native import InputError
from ._solid import Solid, triangle_rows


@dataclass(frozen=True)
class RigidCheck:
    """Is a motion from pose to pose free?"""

    status: str
    """"free": for the whole motion, proved; "collides": at `time`, proved;
    "undecided": closer to contact than is resolved."""
    time: float
    """In [0, 1]: when it collides, not first; else the middle of `interval`."""
    interval: tuple[float, float]
    """The part of the motion that is undecided; where it collides, one around
    `time`; the whole of it where it is free."""
    robot: tuple[int, int]
    """Mesh and triangle of the robot that meets, or may meet, ..."""
    obstacle: tuple[int, int]
    """... this one of the obstacles; (-1, -1): none, or all of one side is
    inside of the other."""
    tests: int
    """Pairs of boxes and triangles looked at."""

    @property
    def free(self) -> bool:
        return self.status == "free"

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"status": self.status, "time": self.time,
                "from": self.interval[0], "to": self.interval[1],
                "robot_mesh": self.robot[0], "robot_triangle": self.robot[1],
                "obstacle_mesh": self.obstacle[0],
                "obstacle_triangle": self.obstacle[1], "tests": self.tests}


@dataclass(frozen=True)
class RigidFirstHit:
    """When does a motion from pose to pose collide first?"""

    status: str
    """"free", "collides" or "undecided", as of RigidCheck."""
    interval: tuple[float, float]
    """Where it collides: free before the first of the two times and colliding at
    the second, both proved. Undecided: free before and after, proved. (0, 1)
    where it is free."""
    robot: tuple[int, int]
    """Mesh and triangle of the robot that meets, or may meet, ..."""
    obstacle: tuple[int, int]
    """... this one of the obstacles; as of RigidCheck."""
    tests: int
    """Pairs of boxes and triangles looked at."""

    @property
    def free(self) -> bool:
        return self.status == "free"


class RigidJudge:
    """Motions of a robot that moves and turns among fixed obstacles, judged for
    all times, without samples::

        judge = phongpd.RigidJudge("part.stl", ["wall.stl", (V, F)])
        judge.check(start, goal).free     # 4 x 4 matrices

    From pose to pose the robot's origin goes straight and its orientation turns
    about one axis, the shorter way.  Surfaces need not be closed; what is
    closed is solid.  "free" and "collides" are proved for the meshes as given,
    rounding included; what touches is not free.
    """

    def __init__(self, robot: Any, obstacles: Any) -> None:
        """Each a Solid, its file, a tuple (vertices, triangles) of (N, 3) and
        (M, 3), a mesh with vertices and faces, or a list of such; those of the
        robot move together.  It turns about its origin."""
        self._native = _native.RigidJudge(
            _meshes(robot, "robot"), _meshes(obstacles, "obstacles"))

    def check(self, start: ArrayLike, end: ArrayLike) -> RigidCheck:
        """From one pose to another: rotation and position of the robot as
        matrices of (4, 4)."""
        return self._check([_pose(start, "start"), _pose(end, "end")],
                           ["start", "end"])[0]

    def first_hit(self, start: ArrayLike, end: ArrayLike, *,
                  resolution: float = 1e-9) -> RigidFirstHit:
        """The first contact on the way: an interval as short as `resolution`, a
        share of the way, or as rounding allows; some times as long as
        check."""
        poses = np.stack([_pose(start, "start"), _pose(end, "end")])
        status, first, last, robot, obstacle, tests = self._native.first_hit(
            poses, ["start", "end"],
            real(resolution, "resolution", "a share of the way"))
        return RigidFirstHit(status, (first, last), robot, obstacle, tests)

    def check_path(self, poses: ArrayLike) -> list[RigidCheck]:
        """Of a way through poses, (N, 4, 4): N - 1 answers, a motion each."""
        array = numbers(poses, "poses", "(N, 4, 4)")
        if array.ndim != 3 or array.shape[1:] != (4, 4) or len(array) < 2:
            raise InputError("poses: expected shape (N, 4, 4) with at least two, "
                             f"found {array.shape}")
        names = [f"pose {i}" for i in range(len(array))]
        return self._check(list(map(_pose, array, names)), names)

    def _check(self, poses: list[Floats],
               names: list[str]) -> list[RigidCheck]:
        return [RigidCheck(status, time, (first, last), robot, obstacle, tests)
                for status, time, first, last, robot, obstacle, tests
                in self._native.check(np.stack(poses), names)]


def _pose(value: ArrayLike, name: str) -> Floats:
    array = numbers(value, name, "(4, 4)")
    if array.shape != (4, 4):
        raise InputError(f"{name}: expected a pose of shape (4, 4), "
                         f"found {array.shape}")
    if not (array[3] == (0.0, 0.0, 0.0, 1.0)).all():
        raise InputError(f"{name}: expected a last row of 0, 0, 0, 1, "
                         f"found {', '.join(f'{x:g}' for x in array[3])}")
    return array


def _meshes(value: Any, name: str) -> list[tuple[Floats, NDArray[np.int32]]]:
    if not isinstance(value, list):
        return [_mesh(value, name)]
    return [_mesh(one, f"{name} {i}") for i, one in enumerate(value)]


def _mesh(value: Any, name: str) -> tuple[Floats, NDArray[np.int32]]:
    if isinstance(value, (str, os.PathLike)):
        value = Solid.read(value)
    if isinstance(value, Solid):
        return value.vertices, value.triangles
    if hasattr(value, "vertices") and hasattr(value, "faces"):
        value = value.vertices, value.faces
    if not isinstance(value, tuple) or len(value) != 2:
        raise InputError(
            f"{name}: expected a Solid, its file, a tuple (vertices, triangles) "
            "or a mesh with vertices and faces, or a list of them, found "
            f"{type(value).__name__}")
    return (rows(value[0], f"{name}: vertices", 3),
            triangle_rows(value[1], name))
