# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, length, numbers, point, real, text, \
    whole_number
from ._native import InputError
from ._room import native_world
from ._world import World


class NonPenetrationRows:
    """Constraint rows d(sample) >= margin of a path, for a solver of your own.

    The path runs from start through N free waypoints to goal; samples are the
    waypoints and inner points of every segment.  d is the signed metric:
    distance outside, minus the depth inside.  Values and derivatives by the
    waypoints' 3N coordinates; the pattern never changes::

        rows = phongpd.NonPenetrationRows(world, start, goal, waypoints=20)
        keep = {"type": "ineq", "fun": lambda u: rows.value(u) - rows.margin,
                "jac": rows.jacobian}
        found = scipy.optimize.minimize(f, u0, method="SLSQP", constraints=keep)
        path = rows.path(found.x)
        if not world.is_motion_free(path[:-1], path[1:]).all():
            raise RuntimeError("the path collides, whatever the solver says")

    margin: to keep, as World.optimize takes it; None: the scene's, 0.01.

    samples_per_segment: 0, as many as the Lipschitz rule asks for: d changes
    no faster than the path moves, so S with S + 1 > h / (2 margin) inner points
    leave nothing out between them where no segment is longer than h =
    max_segment (user's unit; None: 1.6 times those of the straight line).  One
    row a segment sees to that, at the end of the others and told alike: margin
    + h - length >= margin.  The start and goal must have the margin.  Where
    the way around is longer than 1.6 times the line, give max_segment.  With a
    number of your own there are no such rows, and nothing is known of what lies
    between samples.

    metric: as `phongpd optimize` names them.  Inside, the derivative of
    "phong@0.2" is the metric's unit direction, which is continuous, and not the
    slope of d, which jumps at edges; "phong@0.2/exact" has the slope.
    "smoothed@0.2" is the Euclidean depth with a smoothed direction.

    A Phong depth follows a branch.  Branches are chosen at the first u that is
    asked, and advanced by `accept` alone, best once an iteration: between two
    calls values are one smooth function.  `start` forgets them.
    """

    def __init__(self, world: World, start: ArrayLike, goal: ArrayLike, *,
                 waypoints: int = 40, margin: float | str | None = None,
                 samples_per_segment: int = 0,
                 max_segment: float | None = None,
                 metric: str = "phong@0.2", rows_per_sample: int = 1) -> None:
        longest = 0.0 if max_segment is None else real(
            max_segment, "max_segment", "in the user's unit")
        if max_segment is not None and not 0.0 < longest < math.inf:
            raise InputError(
                f"max_segment: expected a finite length > 0, found {longest}")
        self._ends = (np.array(point(start, "start")),
                      np.array(point(goal, "goal")))
        self._native = _native.Rows(
            native_world(world), text(metric, "metric"), point(start, "start"), point(goal, "goal"),
            whole_number(waypoints, "waypoints", 1),
            length(margin, "margin"),
            whole_number(samples_per_segment, "samples_per_segment", 0),
            longest,
            whole_number(rows_per_sample, "rows_per_sample", 1))
        self.pattern: tuple[NDArray[np.int32], NDArray[np.int32]] = \
            self._native.sparsity()
        """Row and column of each entry of the Jacobian, zero-based."""
        self._last: tuple[bytes, tuple[Floats, Floats]] | None = None

    @property
    def margin(self) -> float:
        """What the rows are to keep; user's unit."""
        return self._native.margin

    @property
    def max_segment(self) -> float:
        """h, which holds where samples are by the rule; user's unit."""
        return self._native.max_segment

    @property
    def samples_per_segment(self) -> int:
        """Inner points of a segment, given or by the rule."""
        return self._native.samples_per_segment

    def path(self, u: ArrayLike) -> Floats:
        """(N + 2, 3): from start through the waypoints u to goal; what
        World.is_motion_free is to judge."""
        start, goal = self._ends
        return np.vstack([start, self._waypoints(u), goal])

    @property
    def shape(self) -> tuple[int, int]:
        """Rows, and variables: 3 a waypoint, x y z."""
        return self._native.rows, self._native.variables

    def start(self, u: ArrayLike) -> None:
        """Chooses the branches anew: the least depth at every sample."""
        self._last = None
        self._native.start(self._waypoints(u))

    def accept(self, u: ArrayLike) -> None:
        """u is the solver's new iterate: the branches follow it there."""
        self._last = None
        self._native.accept(self._waypoints(u))

    def value(self, u: ArrayLike) -> Floats:
        """(rows,): d at every sample, then the segments' rows; user's unit."""
        return self._evaluate(u)[0]

    def entries(self, u: ArrayLike) -> Floats:
        """Derivatives, one for each place of `pattern`."""
        return self._evaluate(u)[1]

    def jacobian(self, u: ArrayLike) -> Floats:
        """(rows, variables), dense; sparse solvers take `entries`."""
        dense = np.zeros(self.shape)
        dense[self.pattern] = self.entries(u)
        return dense

    def _waypoints(self, u: ArrayLike) -> Floats:
        array = numbers(u, "waypoints", f"({self.shape[1]},)")
        if array.size != self.shape[1]:
            raise InputError(f"waypoints: expected {self.shape[1]} numbers, "
                             f"found {array.size}")
        return array.reshape(-1, 3)

    def _evaluate(self, u: ArrayLike) -> tuple[Floats, Floats]:
        # Solvers ask for value and derivative at the same u.
        waypoints = self._waypoints(u)
        key = waypoints.tobytes()
        last = self._last  # another thread may replace it
        if last is None or last[0] != key:
            last = self._last = key, self._native.evaluate(waypoints)
        return last[1]
