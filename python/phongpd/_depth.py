# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, is_single, point, real, rows, text
from ._contact import ContactSpace
from ._metrics import Penetration, PhongMetric, SmoothedMetric
from ._native import InputError
from ._sizes import warn_of_sizes
from ._solid import Solid, as_solid
from ._statuses import Answer, axes
from ._view import Canvas, Shown


@dataclass(frozen=True)
class Depth(Answer, Shown):
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
    position: Floats
    """(3,): where the robot was put ..."""
    orientation: Floats
    """(4,): ... and how it was turned: (w, x, y, z)."""
    solids: tuple[Solid, Solid] | None = field(
        default=None, repr=False, compare=False)
    """Robot and obstacle; None after a way through pickle."""
    beside: Penetration | None = field(default=None, repr=False, compare=False)
    """What the metric that was asked for answers at this position; None: none
    was but "euclidean", or after a way through pickle."""

    _LIVE = ("solids", "beside")

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        row: dict[str, Any] = {
            **dict(zip("xyz", map(float, self.position))),
            **{f"q{axis}": float(q) for axis, q in zip("wxyz", self.orientation)},
            "status": self.status, "depth": self.depth,
            "clearance": self.clearance}
        for name in ("direction", "contact", "on_robot", "on_obstacle"):
            row.update(axes(name, getattr(self, name)))
        for name in ("robot_feature", "obstacle_feature"):
            row[name] = getattr(self, name)[0]
        for name in ("certified", "explored_radius", "level", "grid_step",
                     "seconds"):
            row[name] = getattr(self, name)
        return row

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        if self.solids is None:
            raise InputError("view: expected an answer with its solids, found "
                             "one that came through pickle")
        if canvas.is_new(self.solids[1]):
            canvas.mesh(self.solids[1].name, "obstacle", self.solids[1])
        canvas.robot(self.solids[0])
        canvas.answer(
            [self.position, self.direction, self.on_robot, self.on_obstacle],
            self.orientation, self.status, self.depth, self.clearance)

    def _facts(self) -> dict[str, Any]:
        return {"status": str(self), "certified": self.certified,
                "level": self.level, "seconds": self.seconds}

    def __str__(self) -> str:
        if self.status == "separate":
            return f"separate, clearance {self.clearance:.6g}"
        if self.status == "touching":
            return "touching"
        way = ", ".join(f"{x:.6g}" for x in self.direction)
        return (f"penetrating, depth {self.depth:.6g} along ({way})"
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
        self._solids = as_solid(robot, "robot"), as_solid(obstacle, "obstacle")
        warn_of_sizes(("the robot", self._solids[0].vertices),
                      [("the obstacle", self._solids[1].vertices)])
        self._native = _native.DepthQuery(
            self._solids[0]._native, self._solids[1]._native,
            real(max_radius, "max_radius", "in the solids' unit"),
            real(max_seconds, "max_seconds", "seconds"))

    def __repr__(self) -> str:
        return f"<DepthQuery: {self._solids[0]!r} in {self._solids[1]!r}>"

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
        places = rows(positions, "positions", 3)
        is_one = is_single(positions, 3)
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
        columns["position"] = places.copy()
        columns["orientation"] = np.tile((1.0, 0.0, 0.0, 0.0), (
            len(places), 1)) if turns is None else turns.copy()
        answers = [_row(columns, i, self._solids) for i in range(len(places))]
        return answers[0] if is_one else answers


def depth(robot: Any, obstacle: Any, at: ArrayLike = (0.0, 0.0, 0.0),
          orientation: ArrayLike = (1.0, 0.0, 0.0, 0.0), *, metric: str = "",
          smoothing_length: float | None = None) -> Depth:
    """Exact depth of two solids (Solid, file or mesh with vertices and faces)
    as they lie, or with the robot turned by a quaternion (w, x, y, z) and
    moved.

    metric: "phong", "smoothed" or "smoothed-foot": its answer is `beside` the
    exact one, from the whole contact space, which is built for it; "euclidean"
    or "": none.  smoothing_length: of that metric, a share of D; of "phong" if
    it is all that is set.
    """
    turn = rows(orientation, "orientation", 4)
    if len(turn) != 1:
        raise InputError(f"orientation: expected one, found {len(turn)}")
    place, other = point(at, "at"), _metric_beside(metric, smoothing_length)
    solids = as_solid(robot, "robot"), as_solid(obstacle, "obstacle")
    answer: Depth = DepthQuery(*solids).at(place, turn)  # type: ignore[assignment]
    if other is None:
        return answer
    corners = solids[0].vertices @ _rotation(turn[0]).T
    space = ContactSpace.build(
        Solid(corners, solids[0].triangles, solids[0].name), solids[1])
    if other == "phong":
        metric_there: Any = PhongMetric(space, smoothing_length)
    else:
        metric_there = SmoothedMetric(space, smoothing_length,
                                      at_contact=other == "smoothed-foot")
    return replace(answer, beside=metric_there.at(place))


def _metric_beside(metric: Any, smoothing_length: Any) -> str | None:
    known = ("phong", "euclidean", "smoothed", "smoothed-foot")
    name = text(metric, "metric")
    if name and name not in known:
        raise InputError(f"metric: expected one of {', '.join(known)}, found "
                         f"{name!r}" + _native.did_you_mean(name, list(known)))
    if name == "euclidean" and smoothing_length is not None:
        raise InputError("smoothing_length: expected None with metric "
                         f"'euclidean', found {smoothing_length!r}")
    if not name:
        return None if smoothing_length is None else "phong"
    return None if name == "euclidean" else name


def _rotation(q: Floats) -> Floats:
    w, x, y, z = q
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def _row(columns: dict[str, Any], i: int,
         solids: tuple[Solid, Solid]) -> Depth:
    values = {}
    for name, column in columns.items():
        value = column[i]
        values[name] = value.item() if isinstance(value, np.generic) else value
    values["certified"] = bool(values["certified"])
    return Depth(**values, solids=solids)
