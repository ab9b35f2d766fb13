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
    exact: bool = False
    """Was it decided exactly, of the motion whose quaternion is linear in time?
    See RigidJudge.check; False without exact=True."""

    @property
    def free(self) -> bool:
        return self.status == "free"

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"status": self.status, "time": self.time,
                "from": self.interval[0], "to": self.interval[1],
                "robot_mesh": self.robot[0], "robot_triangle": self.robot[1],
                "obstacle_mesh": self.obstacle[0],
                "obstacle_triangle": self.obstacle[1], "tests": self.tests,
                "exact": self.exact}


@dataclass(frozen=True)
class RigidClearance:
    """How close does a motion come to the obstacles?  The least distance over
    all times is at least `lower` and at most `upper`, both proved."""

    lower: float
    """No nearer at any time; above 0 the motion is free, 0 says nothing."""
    upper: float
    """So near, or nearer, at `time`."""
    time: float
    """In [0, 1], of the motion from pose `motion` of a path to the next."""
    motion: int
    robot: tuple[int, int]
    """Mesh and triangle of the robot that is so near then to ..."""
    obstacle: tuple[int, int]
    """... this one of the obstacles; (-1, -1): all of one side is inside of the
    other."""
    resolved: bool
    """`upper` - `lower` is within the tolerance, or within rounding (1e-9 of
    half the robot's diagonal); False: that took too long."""
    tests: int
    """Pairs of boxes and triangles looked at."""


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

    def check(self, start: ArrayLike, end: ArrayLike, *,
              exact: bool = False) -> RigidCheck:
        """From one pose to another: rotation and position of the robot as
        matrices of (4, 4).

        exact: what stays undecided is decided in rational numbers, touching
        collides, and the answer says `exact`.  It is then about another motion
        between the two poses: the same orientations about the same axis and the
        same positions, but the quaternion is linear in time, which turns faster
        in the middle of the way.  Where the robot only translates, or only
        turns, both go through the same poses, to rounding."""
        return self._check([_pose(start, "start"), _pose(end, "end")],
                           ["start", "end"], exact)[0]

    def clearance(self, *poses: ArrayLike, relative: float = 1e-3,
                  absolute: float = 0.0) -> RigidClearance:
        """How close it comes on the way: `clearance(start, end)`, or
        `clearance(poses)` of a path, (N, 4, 4).  Refined until `upper` - `lower`
        is at most `relative` of `upper`, or `absolute`: some milliseconds, 6 to
        140 times as long as check."""
        way: Any = poses[0] if len(poses) == 1 else list(poses)
        array = numbers(way, "poses", "(N, 4, 4)")
        if array.ndim != 3 or array.shape[1:] != (4, 4) or len(array) < 1:
            raise InputError("poses: expected two poses of shape (4, 4) or a path "
                             f"of shape (N, 4, 4), found {array.shape}")
        names = ["start", "end"] if len(poses) == 2 else \
            [f"pose {i}" for i in range(len(array))]
        return RigidClearance(*self._native.clearance(
            np.stack(list(map(_pose, array, names))), names, float(relative),
            float(absolute)))

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

    def check_path(self, poses: ArrayLike, *,
                   exact: bool = False) -> list[RigidCheck]:
        """Of a way through poses, (N, 4, 4): N - 1 answers, a motion each."""
        array = numbers(poses, "poses", "(N, 4, 4)")
        if array.ndim != 3 or array.shape[1:] != (4, 4) or len(array) < 2:
            raise InputError("poses: expected shape (N, 4, 4) with at least two, "
                             f"found {array.shape}")
        names = [f"pose {i}" for i in range(len(array))]
        return self._check(list(map(_pose, array, names)), names, exact)

    def _check(self, poses: list[Floats], names: list[str],
               exact: bool) -> list[RigidCheck]:
        return [RigidCheck(status, time, (first, last), robot, obstacle, tests,
                           is_exact)
                for status, time, first, last, robot, obstacle, tests, is_exact
                in self._native.check(np.stack(poses), names, bool(exact))]


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
