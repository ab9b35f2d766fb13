# SPDX-License-Identifier: GPL-3.0-or-later
"""What a world answers."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import Floats
from ._native import InputError
from ._plots import plot_path
from ._statuses import Answer
from ._view import Canvas, Shown

if TYPE_CHECKING:
    from ._world import World


@dataclass(frozen=True)
class Diagnosis:
    """Is a position free, and if not, why; exact, of the solids themselves."""

    free: bool
    contacts: list[dict[str, Any]]
    """For each obstacle in the way: its name, a translation `depth_at_most`
    along `direction` that leaves it."""
    excesses: list[dict[str, Any]]
    """For each bound that is not kept: axis, is_maximum, bound, by."""

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"free": self.free,
                "in_obstacles": "; ".join(c["obstacle"] for c in self.contacts),
                "depth_at_most": max(
                    (c["depth_at_most"] for c in self.contacts), default=0.0),
                "out_of_bounds_by": max(
                    (e["by"] for e in self.excesses), default=0.0)}

    def __str__(self) -> str:
        if self.free:
            return "free"
        return "; ".join(
            [f"in {c['obstacle']}, at most {c['depth_at_most']:.6g} deep"
             for c in self.contacts]
            + [f"beyond the bounds in {'xyz'[e['axis']]} by {e['by']:.6g}"
               for e in self.excesses])


@dataclass(frozen=True)
class Trajectory(Answer, Shown):
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
    world: World | None = field(default=None, repr=False, compare=False)
    """That it is a path of; None after a way through pickle."""

    _LIVE = ("world",)

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {
            **_known(self.row, "scene", "metric", "smoothing_length", "seed"),
            "status": self.status, "reason": self.reason, "free": self.free,
            **_known(self.row, "verified"), "points": len(self.path),
            "length": _length(self.path), "objective": self.objective,
            "clearance": self.clearance, "iterations": self.iterations,
            "seconds": self.seconds}

    def plot(self, axes: Any = None) -> Any:
        """Position and clearance along the way, the margin that was asked for
        dashed; the world builds its contact space for that if it has none, and
        an answer without a world has no second figure.  axes: as many of
        matplotlib, which has to be there; None: of a new figure.  Returns
        them."""
        return _plot_answer(self, axes)

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        _draw_answer(canvas, self, name or "trajectory", self.free)

    def _facts(self) -> dict[str, Any]:
        return self.to_row()

    def __str__(self) -> str:
        return (f"{self.status}{_because(self)}: "
                f"{'free' if self.free else 'NOT FREE'} path of "
                f"{len(self.path)} points, clearance {self.clearance:.6g}, "
                f"{self.iterations} iterations, {self.seconds:.3g} s")


@dataclass(frozen=True)
class Plan(Answer, Shown):
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
    world: World | None = field(default=None, repr=False, compare=False)
    """That it is a path of; None after a way through pickle."""
    ends: Floats | None = field(default=None, repr=False, compare=False)
    """(2, 3): start and goal."""

    _LIVE = ("world",)

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {
            **_known(self.row, "scene", "planner", "metric", "seed"),
            "status": self.status, "reason": self.reason,
            "solved": self.solved, "infeasible": self.infeasible,
            **_known(self.row, "verified"), "points": len(self.path),
            "length": self.length, "clearance": self.clearance,
            "seconds": self.seconds}

    def plot(self, axes: Any = None) -> Any:
        """Position and clearance along the way, the margin that was asked for
        dashed; the world builds its contact space for that if it has none, and
        an answer without a world has no second figure.  axes: as many of
        matplotlib, which has to be there; None: of a new figure.  Returns
        them."""
        return _plot_answer(self, axes)

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        if self.ends is not None:
            canvas.ends(*self.ends)
        _draw_answer(canvas, self, name or "plan", self.solved)

    def _facts(self) -> dict[str, Any]:
        return self.to_row()

    def __str__(self) -> str:
        if self.infeasible:
            return f"no path, proved{_because(self)}, {self.seconds:.3g} s"
        if not self.solved:
            return f"{self.status}{_because(self)}, {self.seconds:.3g} s"
        return (f"{self.status}: path of {len(self.path)} points, length "
                f"{self.length:.6g}, clearance {self.clearance:.6g}, "
                f"{self.seconds:.3g} s")


def _plot_answer(answer: Trajectory | Plan, axes: Any) -> Any:
    lengths = answer.row.get("lengths", {})
    world = answer.world
    return plot_path(
        axes, answer.path,
        (world.unit if world is not None else lengths.get("unit")) or "unit",
        (lengths.get("asked_clearance") or {}).get("unit"),
        None if world is None else world.clearance)


def _length(path: Floats) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def _known(row: dict[str, Any], *names: str) -> dict[str, Any]:
    return {name: row[name] for name in names if name in row}


def _because(answer: Trajectory | Plan) -> str:
    return f" ({answer.reason})" if answer.reason else ""


def _draw_answer(canvas: Canvas, answer: Trajectory | Plan, name: str,
                 free: bool) -> None:
    if answer.world is None:
        raise InputError("view: expected an answer with its world, found one "
                         "that came through pickle")
    answer.world._draw(canvas, None)
    if len(answer.path):
        canvas.path(name, answer.path, free)
