# SPDX-License-Identifier: GPL-3.0-or-later
"""What a world answers: paths, and why there is none."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _native
from ._arguments import Floats, Point
from ._native import InputError
from ._plots import plot_path
from ._room import Room
from ._statuses import Answer
from ._view import Canvas, Shown


class WayInWorld(Answer, Shown):
    """A way in a world: shown with it, sent to another process without."""

    _LIVE = ("world",)
    reason: str
    path: Floats
    world: Room | None

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        raise NotImplementedError

    def _draw_world(self, canvas: Canvas) -> None:
        if self.world is None:
            raise InputError("view: expected an answer with its world, found "
                             "one that came through pickle")
        self.world._draw(canvas, None)

    def _facts(self) -> dict[str, Any]:
        return self.to_row()

    def _because(self) -> str:
        return f" ({self.reason})" if self.reason else ""


class Polyline(WayInWorld):
    """A way that is a path without time."""

    row: dict[str, Any]

    def plot(self, axes: Any = None) -> Any:
        """Position and clearance along the way, the margin that was asked for
        dashed; the world builds its contact space for that if it has none, and
        an answer without a world has no second figure.  axes: as many of
        matplotlib, which has to be there; None: of a new figure.  Returns
        them."""
        lengths = self.row.get("lengths", {})
        world = self.world
        return plot_path(
            axes, self.path,
            (world.unit if world is not None else lengths.get("unit"))
            or "unit",
            (lengths.get("asked_clearance") or {}).get("unit"),
            None if world is None else world.clearance)

    def _draw_path(self, canvas: Canvas, name: str, free: bool) -> None:
        self._draw_world(canvas)
        if len(self.path):
            canvas.path(name, self.path, free)


@dataclass(frozen=True)
class Trajectory(Polyline):
    """One optimised trajectory; the row of `phongpd optimize` as `row`."""

    status: str
    """"solved" and what else there is: see `reason`."""
    reason: str
    free: bool
    """The exact judge's word on the whole path."""
    path: Floats = field(repr=False)
    """(K, 3), from start to goal; empty without any."""
    objective: float
    clearance: float
    """From contact and bounds, of the whole path; user's unit."""
    iterations: int
    seconds: float
    row: dict[str, Any] = field(repr=False)
    world: Room | None = field(default=None, repr=False, compare=False)
    """That it is a path of; None after a way through pickle."""

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {
            **_known(self.row, "scene", "metric", "smoothing_length", "seed"),
            "status": self.status, "reason": self.reason, "free": self.free,
            **_known(self.row, "verified"), "points": len(self.path),
            "length": _length(self.path), "objective": self.objective,
            "clearance": self.clearance, "iterations": self.iterations,
            "seconds": self.seconds}

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        self._draw_path(canvas, name or "trajectory", self.free)

    def __str__(self) -> str:
        return (f"{self.status}{self._because()}: "
                f"{'free' if self.free else 'NOT FREE'} path of "
                f"{len(self.path)} points, clearance {self.clearance:.6g}, "
                f"{self.iterations} iterations, {self.seconds:.3g} s")


@dataclass(frozen=True)
class Plan(Polyline):
    """One answer of a planner; the row of `phongpd plan` as `row`."""

    status: str
    reason: str
    solved: bool
    """With a path that is free by exact tests."""
    infeasible: bool
    """Proved: start and goal lie in different cells of free space."""
    path: Floats = field(repr=False)
    """(K, 3); empty without any."""
    length: float
    clearance: float
    seconds: float
    row: dict[str, Any] = field(repr=False)
    world: Room | None = field(default=None, repr=False, compare=False)
    """That it is a path of; None after a way through pickle."""
    ends: Floats | None = field(default=None, repr=False, compare=False)
    """(2, 3): start and goal."""

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {
            **_known(self.row, "scene", "planner", "metric", "seed"),
            "status": self.status, "reason": self.reason,
            "solved": self.solved, "infeasible": self.infeasible,
            **_known(self.row, "verified"), "points": len(self.path),
            "length": self.length, "clearance": self.clearance,
            "seconds": self.seconds}

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        if self.ends is not None:
            canvas.ends(*self.ends)
        self._draw_path(canvas, name or "plan", self.solved)

    def __str__(self) -> str:
        if self.infeasible:
            return f"no path, proved{self._because()}, {self.seconds:.3g} s"
        if not self.solved:
            return f"{self.status}{self._because()}, {self.seconds:.3g} s"
        return (f"{self.status}: path of {len(self.path)} points, length "
                f"{self.length:.6g}, clearance {self.clearance:.6g}, "
                f"{self.seconds:.3g} s")


def trajectory_of(answer: _native.PathAnswer, world: Room) -> Trajectory:
    return Trajectory(
        status=answer.status, reason=answer.reason, free=answer.is_free,
        path=answer.path, objective=answer.objective,
        clearance=answer.clearance, iterations=answer.iterations,
        seconds=answer.seconds, row=answer.row, world=world)


def plan_of(answer: _native.PathAnswer, world: Room,
            ends: tuple[Point, Point]) -> Plan:
    return Plan(
        status=answer.status, reason=answer.reason, solved=answer.is_solved,
        infeasible=answer.is_infeasible, path=answer.path,
        length=answer.length, clearance=answer.clearance,
        seconds=answer.seconds, row=answer.row, world=world,
        ends=np.array(ends))


def _length(path: Floats) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def _known(row: dict[str, Any], *names: str) -> dict[str, Any]:
    return {name: row[name] for name in names if name in row}
