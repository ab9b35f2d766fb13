# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, is_single, rows
from ._native import InputError
from ._solid import as_solid


@dataclass(frozen=True)
class Depth:
    """How deep two solids are in each other, or how far apart; user's unit."""

    status: str
    """"penetrating", "touching" or "separate"."""
    depth: float
    """The shortest translation of the robot that parts them; 0 unless
    penetrating."""
    clearance: float
    """The least distance; 0 unless separate."""
    direction: Floats
    """(3,): unit; the robot leaves the obstacle along it."""
    contact: Floats
    """(3,): the robot's position nearest to the given one where they touch."""
    on_robot: Floats
    """(3,): a point of the robot, as it is put, that touches there ..."""
    on_obstacle: Floats
    """(3,): ... and the one of the obstacle it touches."""
    robot_feature: tuple[str, tuple[int, ...]]
    """"vertex", "edge" or "facet" that on_robot lies on, and its vertices."""
    obstacle_feature: tuple[str, tuple[int, ...]]
    certified: bool
    """Proved to be the global answer; otherwise a limit was met, and the depth
    lies between explored_radius and `depth`."""
    explored_radius: float
    level: str
    """How much of the contact space was modelled: "none", "window", "full"."""
    grid_step: float
    """What coordinates were rounded by; the answer is that of the given
    solids to 7 times that."""
    seconds: float

    def __str__(self) -> str:
        if self.status == "separate":
            return f"separate, clearance {self.clearance:.9g}"
        if self.status == "touching":
            return "touching"
        way = ", ".join(f"{x:.6g}" for x in self.direction)
        return (f"penetrating, depth {self.depth:.9g} along ({way})"
                + ("" if self.certified else ", NOT CERTIFIED"))


class DepthQuery:
    """Exact penetration depth of two solids at many poses, nothing built.

    Only boxes of the contact space around each pose are modelled, until the
    answer is proved.  Right for depths that are small against the solids; for
    thousands of deep poses in one orientation build a ContactSpace.
    """

    def __init__(self, robot: Any, obstacle: Any, *,
                 max_radius: float = math.inf,
                 max_seconds: float = 0.0) -> None:
        """max_radius, max_seconds: stop there, uncertified; 0 s: no limit."""
        self._native = _native.DepthQuery(
            as_solid(robot, "robot")._native,
            as_solid(obstacle, "obstacle")._native, float(max_radius),
            float(max_seconds))

    @property
    def warnings(self) -> list[str]:
        return self._native.warnings

    def at(self, positions: ArrayLike,
           orientations: ArrayLike | None = None) -> Depth | list[Depth]:
        """Translational depth of the robot turned, then moved.

        positions: (3,) for one answer, (N, 3) for a list of them.
        orientations: unit quaternions (w, x, y, z) of the same number, or one
        for all; None: the robot as it was given.  Other orientations than the
        last cost a new preparation of the robot.
        """
        is_one = is_single(positions, 3)
        places = rows(positions, "positions", 3)
        turns = None
        if orientations is not None:
            turns = rows(orientations, "orientations", 4)
            if len(turns) == 1:
                turns = np.ascontiguousarray(
                    np.broadcast_to(turns, (len(places), 4)))
            if len(turns) != len(places):
                raise InputError(
                    f"orientations: expected one or {len(places)}, as there "
                    f"are positions, found {len(turns)}")
        columns = self._native.at(places, turns)
        answers = [_row(columns, i) for i in range(len(places))]
        return answers[0] if is_one else answers


def depth(robot: Any, obstacle: Any, at: ArrayLike = (0.0, 0.0, 0.0),
          orientation: ArrayLike = (1.0, 0.0, 0.0, 0.0)) -> Depth:
    """Exact depth of two solids (Solid, file or mesh with vertices and faces)
    as they lie, or with the robot turned by a quaternion (w, x, y, z) and
    moved."""
    answer = DepthQuery(robot, obstacle).at(rows(at, "at", 3), orientation)
    return answer[0]  # type: ignore[index]


def _row(columns: dict[str, Any], i: int) -> Depth:
    values = {}
    for name, column in columns.items():
        value = column[i]
        values[name] = value.item() if isinstance(value, np.generic) else value
    values["certified"] = bool(values["certified"])
    return Depth(**values)
