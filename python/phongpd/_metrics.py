# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, flag, real, rows
from ._contact import ContactSpace, native_space
from ._native import InputError
from ._statuses import Statuses, axes, columns_of


@dataclass(frozen=True, repr=False)
class QueryResult(Statuses):
    """Answers of a metric, a row for each of N points; user's unit."""

    points: Floats
    """(N, 3), as they were asked."""
    status: NDArray[np.uint8]
    """(N,), indices into WORDS; `statuses` are the words."""
    inside: NDArray[np.bool_]
    """(N,), exact: strictly inside, the solids overlap."""
    signed_distance: Floats
    """(N,): minus the depth inside, the distance outside, 0 in contact."""
    contact: Floats
    """(N, 3): q_c on the contact space."""
    direction: Floats
    """(N, 3): unit, from q towards q_c inside, outward gradient outside."""
    gradient: Floats
    """(N, 3): of signed_distance; one-sided on edges."""
    triangle: NDArray[np.int32]
    """(N,): of the contact space, holds q_c; -1 where status is invalid."""

    @property
    def penetration(self) -> Floats:
        """(N, 3): PD(q) = q_c - q inside, zero outside."""
        return np.where(self.inside[:, None], self.contact - self.points, 0.0)

    def to_columns(self) -> dict[str, Any]:
        """One-dimensional columns as `phongpd query` writes them, for
        pandas.DataFrame."""
        return columns_of(self)

    def __repr__(self) -> str:
        deepest = -float(self.signed_distance.min()) if len(self) else 0.0
        return (f"<QueryResult: {len(self)} points, {int(self.inside.sum())} "
                f"inside, at most {max(deepest, 0.0):g} deep>")


class Penetration:
    """The answer at one point; vectors are copies, made when asked for."""

    __slots__ = ("_native",)

    def __init__(self, native: _native.Answer) -> None:
        """Use `at` of a metric."""
        self._native = native

    @property
    def point(self) -> Floats:
        """(3,), as it was asked."""
        return self._native.point

    @property
    def status(self) -> str:
        """One of QueryResult.WORDS."""
        return QueryResult.WORDS[self._native.status]

    @property
    def inside(self) -> bool:
        """Exact: strictly inside, the solids overlap."""
        return self._native.inside

    @property
    def signed_distance(self) -> float:
        """Minus the depth inside, the distance outside, 0 in contact."""
        return self._native.signed_distance

    @property
    def contact(self) -> Floats:
        """(3,): q_c on the contact space."""
        return self._native.contact

    @property
    def direction(self) -> Floats:
        """(3,): unit, from q towards q_c inside, outward gradient outside."""
        return self._native.direction

    @property
    def gradient(self) -> Floats:
        """(3,): of signed_distance; one-sided on edges."""
        return self._native.gradient

    @property
    def penetration(self) -> Floats:
        """(3,): PD(q) = q_c - q inside, zero outside."""
        return self._native.penetration

    @property
    def triangle(self) -> int:
        """Of the contact space, holds q_c; -1 where status is invalid."""
        return self._native.triangle

    def to_row(self) -> dict[str, Any]:
        """Flat, as a row of QueryResult.to_columns."""
        return {**dict(zip("xyz", map(float, self.point))),
                "status": self.status, "inside": self.inside,
                "signed_distance": self.signed_distance,
                **axes("contact", self.contact),
                **axes("direction", self.direction),
                **axes("gradient", self.gradient), "triangle": self.triangle}

    def __repr__(self) -> str:
        depth = -self.signed_distance
        return (f"<Penetration: {self.status}, "
                + (f"{depth:g} deep>" if self.inside else f"{-depth:g} away>"))


class _Metric:
    _native: _native.Metric

    def at(self, q: Sequence[float] | Floats,
           after: Penetration | None = None) -> Penetration:
        """The answer at one point, by a shorter way than `query`.

        q: three numbers.  after: the answer at the point before, of a motion:
        its branch is continued.  Numbers that are not finite: status invalid.
        """
        try:
            return Penetration(self._native.at(
                q, None if after is None else after._native))
        except (TypeError, AttributeError):  # numbers of another kind, or none
            if not (after is None or isinstance(after, Penetration)):
                raise InputError(
                    f"after: expected a Penetration, found {after!r}") from None
            place = rows(q, "q", 3)
            if len(place) != 1:
                raise InputError(
                    f"q: expected three numbers, found {q!r}") from None
            return self.at(place[0].tolist(), after)

    def query(self, points: ArrayLike, *, tracked: bool = False) -> QueryResult:
        """points: (N, 3), or one of (3,).

        tracked: the points are one motion, and each answer continues the
        branch of the one before; otherwise each is answered for itself, on all
        cores.  Points that are not finite have status invalid.
        """
        array = rows(points, "points", 3)
        columns = self._native.query(array, flag(tracked, "tracked"))
        columns["inside"] = columns["inside"].view(np.bool_)
        return QueryResult(points=array, **columns)


DEFAULT_SMOOTHING_LENGTH = _native.default_smoothing_length


class PhongMetric(_Metric):
    """PhongPD: depth along a normal field that is continuous on the surface.

    smoothing_length: a share of D in [0, 1]; 0 is the paper's field, None the
    default everywhere, DEFAULT_SMOOTHING_LENGTH.  field: "normal" or
    "tangent-plane" (the paper's).
    """

    def __init__(self, space: ContactSpace,
                 smoothing_length: float | None = None,
                 field: str = "normal") -> None:
        if field not in ("normal", "tangent-plane"):
            raise InputError(
                f"field: expected 'normal' or 'tangent-plane', found {field!r}")
        self._native = _native.Metric.phong(
            native_space(space), _smoothing(smoothing_length),
            field == "tangent-plane")


class EuclideanMetric(_Metric):
    """Euclidean penetration depth: the nearest point.  Never deeper than
    needed; its direction jumps where two walls are equally near."""

    def __init__(self, space: ContactSpace) -> None:
        self._native = _native.Metric.euclidean(native_space(space))


class SmoothedMetric(_Metric):
    """Euclidean depth with a smoothed direction.

    signed_distance, contact and gradient are the EuclideanMetric's.  direction
    is, inside, the gradient of occupancy smoothed over 2 smoothing_length at
    the point, or at_contact, at its contact; outward.  Where that is not known,
    deeper than this or in the middle of what is symmetric, it is the Euclidean
    one, and the status euclidean_fallback.

    smoothing_length: a share of D in [1e-9, 1]; None:
    DEFAULT_SMOOTHING_LENGTH.
    """

    def __init__(self, space: ContactSpace,
                 smoothing_length: float | None = None, *,
                 at_contact: bool = False) -> None:
        self._native = _native.Metric.smoothed(
            native_space(space), _smoothing(smoothing_length),
            flag(at_contact, "at_contact"))


def _smoothing(length: float | None) -> float:
    return real(DEFAULT_SMOOTHING_LENGTH if length is None else length,
                "smoothing_length", "a share of D")
