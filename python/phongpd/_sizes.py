# SPDX-License-Identifier: GPL-3.0-or-later
"""Metres beside millimetres, in sizes and in limits."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterable
from typing import Tuple

import numpy as np

from ._arguments import Floats

# As the program has them (operand_notes.cc, timed_answer.cc).
SUSPICIOUS = 300.0
SLOW = 600.0  # seconds

Named = Tuple[str, Floats]


def warn_of_sizes(robot: Named, obstacles: Iterable[Named]) -> None:
    """What the program says of a part in metres beside one in millimetres, said
    of the line that called phongpd."""
    for obstacle in obstacles:
        sizes = _diagonal(robot[1]), _diagonal(obstacle[1])
        if min(sizes) > 0.0 and max(sizes) > SUSPICIOUS * min(sizes):
            warnings.warn(
                f"{robot[0]} and {obstacle[0]}: diagonals {sizes[0]:.3g} and "
                f"{sizes[1]:.3g}, {max(sizes) / min(sizes):.3g} times apart; is "
                "one in metres and the other in millimetres?",
                UserWarning, stacklevel=_callers_level())


def warn_of_slowness(seconds: float, unit: str, whose: str = "") -> None:
    """What the program says of a motion of more than ten minutes that nobody
    asked for."""
    if seconds > SLOW:
        warnings.warn(
            f"{whose}the motion takes {seconds:.3g} s; are the limits in the "
            f"scene's unit{', ' + unit if unit else ''}?",
            UserWarning, stacklevel=_callers_level())


def _diagonal(vertices: Floats) -> float:
    if not len(vertices):
        return 0.0
    return float(np.linalg.norm(np.ptp(vertices, axis=0)))


def _callers_level() -> int:
    """Of warn in its callers: the first line outside of this package."""
    folder, level, frame = os.path.dirname(__file__), 1, sys._getframe(1)
    while frame.f_back is not None and \
            os.path.dirname(frame.f_code.co_filename) == folder:
        level, frame = level + 1, frame.f_back
    return level
