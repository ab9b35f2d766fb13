# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions in time."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import comb
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answers import WayInWorld
from ._arguments import Floats, flag, is_zero, length, motion_end, motion_limits, \
    numbers, places_on_the_way, real, seconds, text, whole_number
from ._native import InputError
from ._plots import PLACES, new_axes, plot_vectors
from ._room import Room, limits_in
from ._sizes import warn_of_slowness
from ._view import Canvas


@dataclass(frozen=True)
class Motion(WayInWorld):
    """A curve in time that a machine can follow, or why there is none; the row
    of `phongpd optimize --limits` or `phongpd retime` as `row`."""

    status: str
    """"converged", "round_limit" or "time_limit" of a curve; without one see
    docs/outputs.md."""
    reason: str
    solved: bool
    """Certified, and with the margin if that was required."""
    certified: bool
    """For all t, not at samples: free, and within the limits."""
    duration: float
    """Seconds; 0 without a curve."""
    clearance: float
    """A lower bound along the curve; user's unit."""
    durations: Floats = field(repr=False)
    """(N,): seconds of each piece."""
    points: Floats = field(repr=False)
    """(N, 6, 3): the Bézier points of each piece; of class C²."""
    path: Floats = field(repr=False)
    """(K, 3): the polyline that it began with."""
    row: dict[str, Any] = field(repr=False)
    world: Room | None = field(default=None, repr=False, compare=False)
    """That it is a motion in; None after a way through pickle."""

    @property
    def free(self) -> bool:
        """`certified`, by the name that it has of a Trajectory."""
        return self.certified

    def at(self, times: ArrayLike, order: int = 0) -> Floats:
        """(M, 3): position (order 0), velocity (1), acceleration (2) or jerk
        (3) at seconds in [0, duration], summed in double; where two pieces
        meet, of the later one."""
        t = numbers(times, "times", "(M,)")
        if t.ndim != 1:
            raise InputError(f"times: expected shape (M,), found {t.shape}")
        if order not in (0, 1, 2, 3):
            raise InputError(f"order: expected 0, 1, 2 or 3, found {order!r}")
        if not ((t >= 0.0) & (t <= self.duration)).all():
            raise InputError("times: expected seconds from 0 to the duration, "
                             f"{self.duration:.6g}, found others")
        if not len(self.durations):
            if len(t):
                raise InputError(
                    f"at: expected a motion with a curve, found {self.status}")
            return np.empty((0, 3))
        begins = np.concatenate([[0.0], np.cumsum(self.durations)[:-1]])
        piece: NDArray[np.intp] = np.searchsorted(begins, t, side="right") - 1
        length = self.durations[piece]
        s = np.clip((t - begins[piece]) / length, 0.0, 1.0)[:, np.newaxis]
        control = self.points
        for k in range(order):
            control = np.diff(control, axis=1) * (
                (5 - k) / self.durations[:, np.newaxis, np.newaxis])
        degree = control.shape[1] - 1
        weights = np.stack(
            [comb(degree, i) * s[:, 0] ** i * (1.0 - s[:, 0]) ** (degree - i)
             for i in range(degree + 1)], axis=1)
        found: Floats = np.einsum("mi,mik->mk", weights, control[piece])
        return found

    def plot(self, axes: Any = None) -> Any:
        """Position, velocity, acceleration and jerk of x, y and z over time,
        the limits dashed, by matplotlib, which has to be there.  axes: four of
        its axes; None: of a new figure.  Returns them."""
        axes = new_axes("plot", axes, 4, 1.75)
        unit = self.row["lengths"]["unit"] or "unit"
        times = np.linspace(0.0, self.duration, PLACES)
        names = ("position", "velocity", "acceleration", "jerk")
        for order, (name, one) in enumerate(zip(names, axes)):
            if len(self.durations):
                values = self.at(times, order)
                plot_vectors(one, times, values, name)
                if order and self.row["limits"]["by"] == "norm":
                    one.plot(times, np.linalg.norm(values, axis=1),
                             label="norm", color="0.2")
            limits = self.row["limits"].get(name, ())
            for limit in sorted({*limits, *(-x for x in limits)}):
                one.axhline(limit, color="0.5", linestyle="--", linewidth=0.8)
            power = {0: "", 1: "/s"}.get(order, f"/s{'²³'[order - 2]}")
            one.set_ylabel(f"{name} ({unit}{power})")
        axes[0].legend(loc="upper left")
        if self.row["limits"]["by"] == "norm":
            axes[1].legend(loc="upper left")
        axes[-1].set_xlabel("t (s)")
        return axes

    def samples(self, rate: float = 100.0) -> Floats:
        """(M, 10): the columns t,x,y,z,vx,vy,vz,ax,ay,az every 1/rate seconds
        and at the end, as `--output FILE.csv` writes them."""
        hertz = real(rate, "rate", "Hz")
        if not 0.0 < hertz <= 1e6:
            raise InputError("rate: expected a number above 0 and at most 1e6 "
                             f"(Hz), found {hertz:g}")
        if not len(self.durations):
            return np.empty((0, 10))
        if self.duration * hertz > 1e7:
            raise InputError("rate: expected at most 1e7 rows for the "
                             f"{self.duration:.6g} s of the motion, found "
                             f"{hertz:g} Hz")
        times = np.arange(np.floor(self.duration * hertz) + 1.0) / hertz
        times = np.append(times[times < self.duration], self.duration)
        return np.column_stack([times, *(self.at(times, k) for k in range(3))])

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        used = self.row["limits_used"]
        return {"scene": self.row["scene"], "status": self.status,
                "reason": self.reason, "solved": self.solved,
                "certified": self.certified, "verified": self.row["verified"],
                "duration": self.duration,
                "stops_duration": self.row["stops_duration"],
                "length": self.row["length"], "clearance": self.clearance,
                "pieces": len(self.durations),
                **{f"{name}_used": share for name, share in used.items()}}

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        self._draw_world(canvas)
        if len(self.durations):
            times = np.linspace(0.0, self.duration, PLACES)
            canvas.path(name or "motion", self.at(times), self.certified)

    def __str__(self) -> str:
        because = self._because()
        if not len(self.durations):
            return f"no motion, {self.status}{because}"
        return (f"{self.duration:.6g} s, "
                f"{'certified' if self.certified else 'NOT CERTIFIED'}, "
                f"{self.status}{because}: {len(self.durations)} pieces, "
                f"clearance {self.clearance:.6g} at least")


def motion_of(answer: _native.PathAnswer, world: Room, asked: float,
              whose: str = "") -> Motion:
    """`asked`: the seconds that it was to take; 0: as few as can be."""
    if not asked:
        warn_of_slowness(answer.duration, world.unit, whose)
    return Motion(
        status=answer.status, reason=answer.reason, solved=answer.is_solved,
        certified=answer.is_free, duration=answer.duration,
        clearance=answer.clearance, durations=answer.durations,
        points=answer.points.reshape(-1, 6, 3), path=answer.path,
        row=answer.row, world=world)


def wishes_of(scene: _native.Scene, *, limits: Any, margin: Any, require: Any,
              preset: Any, routes: Any, max_seconds: Any, by_norm: Any,
              via: Any = None, tolerance: Any = None, dwell: Any = 0.0,
              duration: Any = None, departure: Any = None,
              arrival: Any = None) -> _native.MotionWishes:
    """What is asked of a motion, as World.optimize takes it; None: the
    scene's."""
    if via is None:
        for name, given in (("tolerance", tolerance is not None),
                            ("dwell", not is_zero(dwell))):
            if given:
                raise InputError(f"{name}: expected the places of via with it, "
                                 "found via None")
    known, of_norm = limits_in(scene, limits, by_norm)
    if known is None:
        raise InputError("limits: expected (velocity, acceleration, jerk), "
                         "found None, and the scene has none")
    return _native.MotionWishes(
        motion_limits(known, of_norm),
        scene.via if via is None else places_on_the_way(via, tolerance, dwell),
        real(scene.duration if duration is None else duration, "duration"),
        length(margin, "margin"), text(preset, "preset"),
        seconds(max_seconds, "max_seconds"), flag(require, "require"),
        whole_number(routes, "routes", 0, 8), of_norm,
        scene.departure if departure is None
        else motion_end(departure, "departure"),
        scene.arrival if arrival is None else motion_end(arrival, "arrival"))
