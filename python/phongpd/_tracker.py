# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, rows
from ._contact import ContactSpace, native_space
from ._statuses import Statuses


@dataclass(frozen=True)
class TrackedMotion(Statuses):
    """A step a row; user's unit."""

    WORDS = ("following", "sliding", "left_elsewhere", "outside", "invalid")

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
            native_space(space), float(ratio), float(speed))
        self._state = _native.TrackerState()

    def follow(self, points: ArrayLike) -> TrackedMotion:
        """points: (N, 3), the next positions of the motion; goes on where the
        last call ended.  Not for several threads at once: make one each."""
        array = rows(points, "points", 3)
        columns = self._native.follow(self._state, array)
        columns["inside"] = columns["inside"].view(np.bool_)
        return TrackedMotion(points=array, **columns)

    def restart(self) -> None:
        """Begins a new motion."""
        self._state = _native.TrackerState()
