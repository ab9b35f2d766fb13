# SPDX-License-Identifier: GPL-3.0-or-later
"""The study's nonlinear program for solvers of others, in units of D:

    min f(v) = (N+1)/l0² Σ |v_{i+1} − v_i|²   subject to   gaps(v) >= 0,

v the N free waypoints about the middle of start and goal, l0 = |goal − start|, gaps
the rows of NonPenetrationRows less the margin: planners/trajectory/
trajectory_problem.h, whose samples, margin and longest segment these rows have."""
import time

import numpy as np
import phongpd

WAYPOINTS = 40
INSET = 1e-6  # free means strictly inside the bounds


class Spent(Exception):
    """The budget of row evaluations or seconds is used up."""


def sample_weights(waypoints, inner):
    """(samples, waypoints + 2): samples are this times the path, ends included;
    along the path, without the ends (constraints/non_penetration.h)."""
    found = []
    for segment in range(waypoints + 1):
        for j in range(0 if segment else 1, inner + 1):
            row = np.zeros(waypoints + 2)
            row[segment] = 1.0 - j / (inner + 1)
            row[segment + 1] = j / (inner + 1)
            found.append(row)
    return np.array(found)


def lots(points):
    """An angle in [0, 2π) by lot from the bits of each point, (K, 3)."""
    bits = np.zeros(len(points), np.uint64)
    for words in np.ascontiguousarray(points.T).view(np.uint64):
        bits ^= words
        for factor in (0xff51afd7ed558ccd, 0xc4ceb9fe1a85ec53):
            bits ^= bits >> np.uint64(33)
            bits *= np.uint64(factor)
        bits ^= bits >> np.uint64(33)
    return 2.0 * np.pi * (bits >> np.uint64(11)) * 2.0 ** -53


def turned(n, angle, lot):
    """Unit vectors that far from n, on a side by lot; all (K, 3) or (K,)."""
    least = np.eye(3)[np.argmin(np.abs(n), axis=1)]
    across = np.cross(n, least)
    across /= np.linalg.norm(across, axis=1)[:, None]
    side = (np.cos(lot)[:, None] * across
            + np.sin(lot)[:, None] * np.cross(n, across))
    return np.cos(angle)[:, None] * n + np.sin(angle)[:, None] * side


class PlaceboRows:
    """Euclid's rows whose direction inside is any that is as far from Euclid's as
    the smoothed one, drawn by lot from q: placebo@L of `phongpd compare`, made of
    two sets of rows, as NonPenetrationRows has it not."""

    def __init__(self, make, length):
        self._rows = make("euclidean")
        self._other = make("smoothed@" + length)
        self.shape, self.pattern = self._rows.shape, self._rows.pattern
        self.margin = self._rows.margin
        self.max_segment = self._rows.max_segment
        self.samples_per_segment = self._rows.samples_per_segment
        self.path = self._rows.path
        waypoints = self.shape[1] // 3
        self._weights = sample_weights(waypoints, self.samples_per_segment)
        # A block of three entries for each waypoint that a sample depends on.
        self._sample, self._waypoint = np.nonzero(self._weights[:, 1:-1])
        self._weight = self._weights[:, 1:-1][self._sample, self._waypoint]
        order = np.lexsort((-self._weight, self._sample))
        samples, first = np.unique(self._sample[order], return_index=True)
        assert len(samples) == len(self._weights)
        self._heaviest = order[first]

    def accept(self, u):
        """Euclid's rows have no branch."""

    def value(self, u):
        return self._rows.value(u)

    def _directions(self, entries):
        blocks = entries[:3 * len(self._sample)].reshape(-1, 3)
        return (blocks / self._weight[:, None])[self._heaviest]

    def entries(self, u):
        found = np.array(self._rows.entries(u))
        n = self._directions(found)
        other = self._directions(self._other.entries(u))
        inside = self._rows.value(u)[:len(n)] < 0.0
        angle = np.arctan2(np.linalg.norm(np.cross(n, other), axis=1),
                           (n * other).sum(axis=1))
        lot = lots(self._weights @ self.path(u))
        n = np.where(inside[:, None], turned(n, angle, lot), n)
        found[:3 * len(self._sample)] = (
            self._weight[:, None] * n[self._sample]).ravel()
        return found


def make_rows(world, metric, waypoints=WAYPOINTS):
    def make(name):
        return phongpd.NonPenetrationRows(world, world.start, world.goal,
                                          waypoints=waypoints, metric=name)
    kind, _, length = metric.partition("@")
    return PlaceboRows(make, length) if kind == "placebo" else make(metric)


class Program:
    """What a solver sees; v as above, (3N,)."""

    def __init__(self, rows, start, goal, unit, bounds=None, most=np.inf,
                 seconds=np.inf):
        """rows: of make_rows or their like.  most, seconds: row evaluations and
        time of the processor, after which is_spent."""
        self.rows, self.unit = rows, unit
        self.most, self.end = most, time.process_time() + seconds
        self.evaluations = 0
        self.center = 0.5 * (np.asarray(start) + goal)
        self.start, self.goal = ((x - self.center) / unit for x in (start, goal))
        self.size, self.waypoints = rows.shape[1], rows.shape[1] // 3
        self.count = rows.shape[0]
        self.pattern = rows.pattern
        reference = max(np.linalg.norm(self.goal - self.start), 1e-3)
        self.weight = (self.waypoints + 1) / reference ** 2
        self.first = np.linspace(self.start, self.goal,
                                 self.waypoints + 2)[1:-1].ravel()
        self.low, self.high = np.full(self.size, -np.inf), np.full(self.size, np.inf)
        if bounds is not None:
            box = (np.asarray(bounds) - self.center) / unit
            self.low = np.tile(box[0] + INSET, self.waypoints)
            self.high = np.tile(box[1] - INSET, self.waypoints)
        self._at = None

    def path(self, v):
        """(N+2, 3) in units of D, about the centre."""
        return np.vstack([self.start, np.reshape(v, (-1, 3)), self.goal])

    def told_path(self, v):
        """The same in the user's unit, for the judge."""
        return self.rows.path(self._user(v))

    def objective(self, v):
        return float(self.weight * (np.diff(self.path(v), axis=0) ** 2).sum())

    def slope(self, v):
        steps = np.diff(self.path(v), axis=0)
        return (2.0 * self.weight * (steps[:-1] - steps[1:])).ravel()

    def _user(self, v):
        return (np.reshape(v, (-1, 3)) * self.unit + self.center).ravel()

    def is_spent(self):
        return self.evaluations >= self.most or self.is_late()

    def is_late(self):
        return time.process_time() > self.end

    def _count(self, v):
        # Value and derivative at one point are one evaluation.
        key = np.asarray(v).tobytes()
        if key != self._at:
            self._at = key
            self.evaluations += 1

    def gaps(self, v):
        self._count(v)
        return (self.rows.value(self._user(v)) - self.rows.margin) / self.unit

    def entries(self, v):
        """d gaps / d v at the places of `pattern`."""
        self._count(v)
        return self.rows.entries(self._user(v))

    def accept(self, v):
        """v is the solver's new iterate: what rows remember follows it."""
        self._at = None
        self.rows.accept(self._user(v))

    @property
    def length_rows(self):
        """How many rows at the end are h − |step|."""
        samples = (self.waypoints + 1) * (self.rows.samples_per_segment + 1) - 1
        return self.count - samples


def make_program(world, metric, most, seconds):
    return Program(make_rows(world, metric), np.array(world.start),
                   np.array(world.goal), world.length, world.bounds, most, seconds)
