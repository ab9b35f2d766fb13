# SPDX-License-Identifier: GPL-3.0-or-later
"""What users give, as the arrays that the library takes."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import Any, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import InputError

Floats = NDArray[np.float64]
Point = Tuple[float, float, float]
LIMITS = ("velocity", "acceleration", "jerk")


def numbers(value: ArrayLike, name: str, shape: str) -> Floats:
    """As they are; C-contiguous, of doubles."""
    try:
        array = np.asarray(value)
    except ValueError as error:  # rows of different lengths
        raise InputError(
            f"{name}: expected numbers of shape {shape}, found {error}"
        ) from None
    if array.dtype.kind not in "fiub":
        raise InputError(
            f"{name}: expected real numbers, found "
            + (_told(value) if array.dtype.kind in "US"
               else f"an array of {array.dtype}"))
    return np.ascontiguousarray(array, dtype=np.float64)


def rows(value: ArrayLike, name: str, width: int) -> Floats:
    """An array of shape (N, width); a single row is one of (1, width)."""
    array = numbers(value, name, f"(N, {width})")
    if array.ndim == 1 and array.shape[0] == width:
        array = array[np.newaxis, :]
    if array.size == 0 and array.ndim <= 2:
        return np.empty((0, width))
    if array.ndim != 2 or array.shape[1] != width:
        raise InputError(
            f"{name}: expected shape (N, {width}), found {array.shape}")
    return array


def is_single(value: Any, width: int) -> bool:
    return np.ndim(value) == 1 and np.shape(value) == (width,)


def point(value: ArrayLike, name: str) -> Point:
    """Three finite numbers."""
    array = numbers(value, name, "(3,)")
    if array.shape != (3,) or not np.isfinite(array).all():
        raise InputError(f"{name}: expected three finite numbers, "
                         f"found {_told(value)}")
    return float(array[0]), float(array[1]), float(array[2])


def real(value: Any, name: str, unit: str = "") -> float:
    """A number, finite or not; of what, where it has a unit."""
    try:
        # float() takes these too: True for 1, and "1".
        if isinstance(value, (bool, np.bool_, str, bytes)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name}: expected a number"
                         f"{unit and f' ({unit})'}, found {_told(value)}") from None


def flag(value: Any, name: str) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise InputError(f"{name}: expected True or False, found {_told(value)}")


def text(value: Any, name: str) -> str:
    if isinstance(value, str):
        return value
    raise InputError(f"{name}: expected a text, found {_told(value)}")


def _told(value: Any) -> str:
    """In one line that is no longer than one."""
    said = " ".join(repr(value).split())
    return said if len(said) <= 60 else said[:57] + "..."


def is_zero(value: Any) -> bool:
    return isinstance(value, (int, float)) and value == 0


def whole_number(value: Any, name: str, least: int,
                 most: int = 2 ** 31 - 1) -> int:
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise InputError(f"{name}: expected a whole number, found {_told(value)}")
    number = value.__index__()
    if number < least:
        raise InputError(
            f"{name}: expected a whole number of at least {least}, "
            f"found {number}")
    if number > most:
        raise InputError(f"{name}: expected a whole number of at most {most}, "
                         f"found {_told(number)}")
    return int(number)


def seed_number(value: Any) -> int:
    return whole_number(value, "seed", 0, 2 ** 64 - 1)


def seconds(value: Any, name: str) -> float:
    """More than 0; None: no limit."""
    if value is None:
        return math.inf
    number = real(value, name)
    if not number > 0.0:
        raise InputError(f"{name}: expected seconds, more than 0, "
                         f"found {_told(value)}")
    return number


def motion_limits(value: Any, by_norm: bool = False
                  ) -> tuple[Point, Point, Point]:
    """(velocity, acceleration, jerk), or a mapping of them, each one number or
    of x, y and z; by_norm: one number."""
    if isinstance(value, Mapping):
        for key in value:
            if key not in LIMITS:
                raise InputError(f"limits: expected the keys {', '.join(LIMITS)}, "
                                 f"found {_told(key)}")
        for key in LIMITS:
            if key not in value:
                raise InputError(f"limits: {key}: expected a number or one of x, "
                                 "y and z, found none")
        value = [value[key] for key in LIMITS]
    try:
        v, a, j = value
    except (TypeError, ValueError):
        raise InputError("limits: expected (velocity, acceleration, jerk), each "
                         "a number or one of x, y and z, found "
                         f"{_told(value)}") from None

    def one(limit: Any, name: str) -> Point:
        array = numbers(limit, f"limits: {name}", "() or (3,)")
        if array.shape not in ((1,), (3,)):  # a number is one of (1,)
            raise InputError(f"limits: {name}: expected a number or three, "
                             f"found {_told(limit)}")
        x, y, z = np.broadcast_to(array, (3,))
        if by_norm and not x == y == z:
            raise InputError(f"limits: {name}: expected one number with by_norm, "
                             f"found {_told(limit)}")
        return float(x), float(y), float(z)

    return one(v, "velocity"), one(a, "acceleration"), one(j, "jerk")


def motion_end(value: Any, name: str) -> tuple[Point, Point]:
    """Velocity (3,), or velocity and acceleration (2, 3)."""
    array = numbers(value, name, "(3,) or (2, 3)")
    if array.shape == (3,):
        array = np.stack([array, np.zeros(3)])
    if array.shape != (2, 3):
        raise InputError(f"{name}: expected shape (3,) or (2, 3), found "
                         f"{array.shape}")
    return point(array[0], name), point(array[1], name)


def places_on_the_way(
        via: ArrayLike, tolerance: Any, dwell: ArrayLike,
) -> list[tuple[Point, str, float]]:
    """Places (M, 3), a length, or one for each of them, and seconds, or so."""
    places = rows(via, "via", 3)
    count = len(places)
    if isinstance(tolerance, (list, tuple, np.ndarray)):
        close = [length(one, "tolerance") for one in tolerance]
    else:
        close = [length(tolerance, "tolerance")] * count
    rests = numbers(dwell, "dwell", "() or (M,)")
    if rests.shape == (1,):
        rests = np.full(count, rests[0])
    for name, found in (("tolerance", len(close)), ("dwell", rests.size)):
        if found != count or rests.ndim != 1:
            raise InputError(f"{name}: expected one, or one for each of the "
                             f"{count} places of via, found {found}")
    return [(point(place, f"via {i}"), close[i], float(rests[i]))
            for i, place in enumerate(places)]


def length(value: Any, name: str) -> str:
    """A number, a share of D or in the scene's unit if that has a name, or a
    text with the unit, "0.5unit"; None: default."""
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    number = real(value, name)
    if not math.isfinite(number):
        raise InputError(f"{name}: expected a finite length, found {_told(value)}")
    return repr(number)


def scene_name(scene: Any) -> str:
    if isinstance(scene, (str, os.PathLike)):
        return os.fspath(scene)
    raise InputError("scene: expected a file or a family, found "
                     f"{type(scene).__name__}")
