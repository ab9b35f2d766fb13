# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, real, rows
from ._contact import ContactSpace, native_space
from ._native import InputError
from ._statuses import Statuses, columns_of


@dataclass(frozen=True, repr=False)
class TrackedMotion(Statuses):
    """A step a row; user's unit."""

    points: Floats
    """(N, 3): the robot's positions."""
    status: NDArray[np.uint8]
    """(N,), indices into WORDS; `statuses` are the words."""
    inside: NDArray[np.bool_]
    """(N,), exact."""
    penetration: Floats
    """(N, 3): from the robot's position to the contact inside, else zero."""
    depth: Floats
    """(N,): its length."""
    euclidean_depth: Floats
    """(N,): the least possible."""
    ratio: Floats
    """(N,): depth over euclidean_depth inside, else 0."""
    moved: Floats
    """(N,): how far the contact slid."""
    contact: Floats
    """(N, 3): on the contact space, inside."""
    triangle: NDArray[np.int32]
    """(N,): of the contact space; -1 outside."""

    def to_columns(self) -> dict[str, Any]:
        """One-dimensional columns, for pandas.DataFrame."""
        return columns_of(self)

    def __repr__(self) -> str:
        deepest = float(self.depth.max()) if len(self) else 0.0
        return (f"<TrackedMotion: {len(self)} steps, {int(self.inside.sum())} "
                f"inside, at most {deepest:g} deep>")


class PenetrationTracker:
    """Penetration depth of a robot that moves, without a jump.

    The contact is a point that slides over the contact space at a bounded
    speed: while the robot is inside, the penetration vector changes by at most
    (speed + 1) times the robot's step.  For force rendering and animation; it
    has no gradient.

    ratio: the contact makes for where the depth is at most so many times the
    Euclidean.  speed: how far it slides at most, in steps of the robot.
    """

    def __init__(self, space: ContactSpace, ratio: float = 3.0,
                 speed: float = 10.0) -> None:
        self._native = _native.PenetrationTracker(
            native_space(space), real(ratio, "ratio"), real(speed, "speed"))
        self._state = _native.TrackerState()
        self._turn = threading.Lock()

    def follow(self, points: ArrayLike) -> TrackedMotion:
        """points: (N, 3), the next positions of the motion; goes on where the
        last call ended.  One motion, one thread: a second one is refused."""
        array = rows(points, "points", 3)
        if not self._turn.acquire(blocking=False):
            raise InputError("tracker: expected one thread at a time, found "
                             "another in it; make a tracker for each")
        try:
            columns = self._native.follow(self._state, array)
        finally:
            self._turn.release()
        columns["inside"] = columns["inside"].view(np.bool_)
        return TrackedMotion(points=array, **columns)

    def restart(self) -> None:
        """Begins a new motion."""
        self._state = _native.TrackerState()
