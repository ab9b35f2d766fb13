# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves in time of whoever made them, and the judge's word on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import comb
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, numbers
from ._native import InputError
from ._solid import as_solid

# Of a double: what numpy calls eps.
_EPS = 2.0**-52


@dataclass(frozen=True)
class CurveCheck:
    """Is a curve in time free, for all t and not at samples?"""

    status: str
    """"free": all of it, proved; "collides": at `time`, proved of the place,
    rounded; "undecided": closer to contact than is resolved."""
    free_until: float
    """Seconds; free before, proved."""
    time: float
    """Seconds: when it collides, or the middle of what is undecided; 0 where it
    is free."""
    piece: int
    """In which piece, from 0 on, the last one also where it rests after that; -1
    where it is free."""
    position: Floats = field(repr=False)
    """(3,): where it is then."""
    limits_used: dict[str, float]
    """Upper bounds of the largest velocity, acceleration and jerk within the
    pieces, as shares of the limits: at most 1 where they are kept for all t, by
    a spline to the rounding of its Bézier points; empty where none were
    given."""
    jumps: tuple[float, float]
    """The largest jumps of velocity and acceleration where pieces meet."""
    tests: int
    """Parts of the curve looked at."""
    obstacle: str = ""
    """Which of those that move it meets, or may meet; "" of what rests, and of
    bounds."""

    @property
    def free(self) -> bool:
        return self.status == "free"

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"status": self.status, "free_until": self.free_until,
                "time": self.time, "piece": self.piece,
                **{f"{name}_used": share
                   for name, share in self.limits_used.items()},
                "velocity_jump": self.jumps[0],
                "acceleration_jump": self.jumps[1], "tests": self.tests,
                "obstacle": self.obstacle}

    def __str__(self) -> str:
        used = ", ".join(f"{name} {share:.3g}"
                         for name, share in self.limits_used.items())
        return (self.status
                + ("" if self.free
                   else f" at {self.time:.6g} s, in piece {self.piece}"
                   + (f", with {self.obstacle}" if self.obstacle else ""))
                + (f"; of the limits: {used}" if used else ""))


def curve_of(curve: Any, name: str) -> tuple[Floats, Floats, float]:
    """Seconds (N,) and Bézier points (N, K, 3) of the pieces of a Motion, of
    (durations, points), or of a spline as scipy's PPoly or BSpline has it; and
    how far rounding may have moved it."""
    if hasattr(curve, "durations") and hasattr(curve, "points"):
        curve = (curve.durations, curve.points)
    if hasattr(curve, "c") and hasattr(curve, "x"):
        return _of_powers(curve.c, curve.x, name)
    if hasattr(curve, "c") and hasattr(curve, "t") and hasattr(curve, "k"):
        return _of_knots(curve.t, curve.c, int(curve.k), name)
    try:
        durations, points = curve
    except (TypeError, ValueError):
        raise InputError(
            f"{name}: expected a Motion, (durations, points) or a spline of "
            f"scipy, found {type(curve).__name__}") from None
    times = numbers(durations, f"{name}: durations", "(N,)")
    places = numbers(points, f"{name}: points", "(N, K, 3)")
    if (times.ndim != 1 or places.ndim != 3 or len(times) == 0
            or len(places) != len(times) or places.shape[2] != 3):
        raise InputError(f"{name}: expected durations (N,) and points (N, K, 3), "
                         f"found {times.shape} and {places.shape}")
    return times, places, 0.0


def moving_of(moving: Mapping[str, Any] | None) -> tuple[
        list[tuple[str, _native.Solid, Floats, Floats]], float]:
    """Of {name: (solid, motion)} of obstacles that move, the motion as curve_of
    takes it; and how far rounding may have moved one."""
    found, most = [], 0.0
    for name, value in (moving or {}).items():
        what = f"moving: {name}"
        try:
            solid, motion = value
        except (TypeError, ValueError):
            raise InputError(f"{what}: expected (solid, motion), found "
                             f"{type(value).__name__}") from None
        times, places, blur = curve_of(motion, what)
        most = max(most, blur)
        found.append((str(name), as_solid(solid, str(name))._native, times,
                      places.reshape(-1, 3)))
    return found, most


def _of_powers(coefficients: ArrayLike, breaks: ArrayLike,
               name: str) -> tuple[Floats, Floats, float]:
    """q(t) = Σ_j a_j (t − x_i)^j with a_j = c[n − j, i] is Σ_i C(n, i)
    (1 − s)^(n − i) s^i b_i with b_i = Σ_{j ≤ i} C(i, j) / C(n, j) a_j h^j."""
    c = numbers(coefficients, f"{name}: c", "(K, N, 3)")
    x = numbers(breaks, f"{name}: x", "(N + 1,)")
    if (c.ndim != 3 or c.shape[2] != 3 or c.shape[1] == 0
            or x.shape != (c.shape[1] + 1,)):
        raise InputError(f"{name}: expected c (K, N, 3) and x (N + 1,), found "
                         f"{c.shape} and {x.shape}")
    n, h = len(c) - 1, np.diff(x)
    powers = c[::-1] * (h ** np.arange(n + 1)[:, np.newaxis])[..., np.newaxis]
    weights = np.array([[comb(i, j) / comb(n, j) for j in range(n + 1)]
                        for i in range(n + 1)])
    points: Floats = np.einsum("ij,jmk->mik", weights, powers)
    # Of lengths, powers, products and the sum, to spare.
    blur = 4.0 * (n + 3) * _EPS * float(np.abs(powers).sum(axis=0).max())
    return h, points, blur


def _of_knots(knots: ArrayLike, coefficients: ArrayLike, degree: int,
              name: str) -> tuple[Floats, Floats, float]:
    """Point j of the piece from t_i to t_(i + 1) is the blossom at t_i, degree −
    j times, and t_(i + 1), j times, by de Boor's algorithm."""
    t = numbers(knots, f"{name}: t", "(N + k + 1,)")
    c = numbers(coefficients, f"{name}: c", "(N, 3)")
    if (c.ndim != 2 or c.shape[1] != 3 or t.ndim != 1 or degree < 1
            or len(t) != len(c) + degree + 1 or len(c) <= degree):
        raise InputError(f"{name}: expected c (N, 3), t (N + k + 1,) and k < N, "
                         f"found {c.shape}, {t.shape} and {degree}")
    durations, pieces = [], []
    for i in range(degree, len(c)):
        if t[i] == t[i + 1]:
            continue
        durations.append(t[i + 1] - t[i])
        pieces.append([_blossom(t, c, degree, i, j) for j in range(degree + 1)])
    blur = 8.0 * (degree + 1) * _EPS * float(np.abs(c).max())
    return np.array(durations), np.array(pieces).reshape(-1, degree + 1, 3), blur


def _blossom(t: Floats, c: Floats, degree: int, i: int, later: int) -> Floats:
    """The last `later` arguments are t[i + 1], those before t[i]."""
    d = c[i - degree:i + 1]
    for r in range(1, degree + 1):
        at = t[i + 1] if r > degree - later else t[i]
        low, high = t[i - degree + r:i + 1], t[i + 1:i + degree - r + 2]
        share = ((at - low) / (high - low))[:, np.newaxis]
        d = (1.0 - share) * d[:-1] + share * d[1:]
    found: Floats = d[0]
    return found
