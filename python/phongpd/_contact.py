# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, rows, whole_number
from ._mesh import MeshViews
from ._native import ContactSpace as NativeSpace, InputError
from ._solid import as_solid
from ._statuses import Statuses


class ContactSpace(MeshViews):
    """The boundary of obstacle + (-robot), exact: where they touch.

    All positions q (translations of the robot) at which it touches the
    obstacle, as one closed triangle mesh of exact topology; strictly inside
    they overlap.  Immutable, safe to share among threads.
    """

    _native: NativeSpace

    def __init__(self, native: NativeSpace) -> None:
        """Use build, or take."""
        self._native = native

    @classmethod
    def build(cls, robot: Any, obstacle: Any, *, robot_hull: bool = False,
              target_faces: int = 0, wrap: float = 0.0,
              outer_shell_only: bool = False, max_seconds: float = 0.0,
              max_mib: float = 0.0, cache: bool = False) -> ContactSpace:
        """Builds it; Ctrl-C stops that.

        robot, obstacle: Solid, file, or mesh with vertices and faces.
        robot_hull, target_faces, wrap: approximations with a proved bound
        (`report`): the robot's convex hull, decimation to so many triangles,
        alpha wrap with a share of the operand's diagonal.
        max_seconds, max_mib: what is predicted to take more is refused, what
        does is stopped; 0: no limit, and nine tenths of the free memory.
        cache: keep the result in the user's cache folder and look there first.
        """
        return cls(_native.ContactSpace.build(
            as_solid(robot, "robot")._native,
            as_solid(obstacle, "obstacle")._native, robot_hull,
            whole_number(target_faces, "target_faces", 0), float(wrap),
            outer_shell_only, float(max_seconds), float(max_mib), cache))

    @classmethod
    def take(cls, solid: Any) -> ContactSpace:
        """A closed mesh taken for a contact space: one that was saved, or the
        boundary of forbidden positions found in another way."""
        return cls(_native.ContactSpace.take(as_solid(solid, "mesh")._native))

    @property
    def length(self) -> float:
        """D, that shares refer to: the bounding box's diagonal."""
        return self._native.length

    @property
    def report(self) -> dict[str, Any]:
        """What was built: counts, genus, volume, seconds by stage, warnings."""
        return self._native.report

    def __repr__(self) -> str:
        report = self.report
        return (f"<ContactSpace: {report['triangles']} triangles, "
                f"{report['components']} components, D {self.length:g}>")


def minkowski(a: Any, b: Any, *, difference: bool = False,
              max_seconds: float = 0.0, max_mib: float = 0.0,
              cache: bool = False) -> ContactSpace:
    """The exact Minkowski sum a + b of two solids; with `difference` b + (-a),
    the contact space of a robot a and an obstacle b."""
    one, other = as_solid(a, "a"), as_solid(b, "b")
    if difference:
        return ContactSpace.build(one, other, max_seconds=max_seconds,
                                  max_mib=max_mib, cache=cache)
    return ContactSpace(_native.ContactSpace.sum(
        one._native, other._native, float(max_seconds), float(max_mib), cache))


@dataclass(frozen=True)
class QueryResult(Statuses):
    """Answers of a metric, a row for each of N points; user's unit."""

    WORDS = ("ok", "branch_ended", "euclidean_fallback", "invalid")

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
        columns: dict[str, Any] = {}
        for k, axis in enumerate("xyz"):
            columns[axis] = self.points[:, k]
        columns["status"] = self.statuses
        columns["inside"] = self.inside
        columns["signed_distance"] = self.signed_distance
        for name in ("contact", "direction", "gradient"):
            for k, axis in enumerate("xyz"):
                columns[f"{name}_{axis}"] = getattr(self, name)[:, k]
        columns["triangle"] = self.triangle
        return columns

    def __repr__(self) -> str:
        deepest = -float(self.signed_distance.min()) if len(self) else 0.0
        return (f"<QueryResult: {len(self)} points, {int(self.inside.sum())} "
                f"inside, at most {max(deepest, 0.0):g} deep>")


class _Metric:
    _native: _native.Metric

    def query(self, points: ArrayLike, *, tracked: bool = False) -> QueryResult:
        """points: (N, 3), or one of (3,).

        tracked: the points are one motion, and each answer continues the
        branch of the one before; otherwise each is answered for itself, on all
        cores.  Points that are not finite have status invalid.
        """
        array = rows(points, "points", 3)
        columns = self._native.query(array, tracked)
        columns["inside"] = columns["inside"].view(np.bool_)
        return QueryResult(points=array, **columns)


class PhongMetric(_Metric):
    """PhongPD: depth along a normal field that is continuous on the surface.

    smoothing_length: a share of D in [0, 1]; 0 is the paper's field, 0.2 what
    serves solvers best.  field: "normal" or "tangent-plane" (the paper's).
    """

    def __init__(self, space: ContactSpace, smoothing_length: float = 0.2,
                 field: str = "normal") -> None:
        if field not in ("normal", "tangent-plane"):
            raise InputError(
                f"field: expected 'normal' or 'tangent-plane', found {field!r}")
        self._native = _native.Metric.phong(
            native_space(space), float(smoothing_length), field == "tangent-plane")


class EuclideanMetric(_Metric):
    """Euclidean penetration depth: the nearest point.  Never deeper than
    needed; its direction jumps where two walls are equally near."""

    def __init__(self, space: ContactSpace) -> None:
        self._native = _native.Metric.euclidean(native_space(space))


def native_space(space: ContactSpace) -> _native.ContactSpace:
    if isinstance(space, ContactSpace):
        return space._native
    raise InputError(
        f"space: expected a ContactSpace, found {type(space).__name__}")


