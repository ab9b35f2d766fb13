# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from typing import Any

from . import _native
from ._arguments import flag, real, whole_number
from ._mesh import MeshViews
from ._native import ContactSpace as NativeSpace, InputError
from ._piece import joined
from ._solid import as_solid
from ._view import Canvas, Shown


class ContactSpace(MeshViews, Shown):
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
        What would need more memory in one is built by boxes, to the same
        bytes (`report["method"]`).
        cache: keep the result in the user's cache folder and look there first.
        """
        return cls(_native.ContactSpace.build(
            as_solid(robot, "robot")._native,
            as_solid(obstacle, "obstacle")._native,
            flag(robot_hull, "robot_hull"),
            whole_number(target_faces, "target_faces", 0), real(wrap, "wrap"),
            flag(outer_shell_only, "outer_shell_only"),
            real(max_seconds, "max_seconds", "seconds"), real(max_mib, "max_mib", "MiB"),
            flag(cache, "cache")))

    @classmethod
    def take(cls, solid: Any) -> ContactSpace:
        """A closed mesh taken for a contact space: one that was saved, or the
        boundary of forbidden positions found in another way."""
        return cls(_native.ContactSpace.take(as_solid(solid, "mesh")._native))

    @classmethod
    def join(cls, pieces: Any) -> ContactSpace:
        """Of all parts of one build (ContactSpacePiece), or their files, in any
        order: the surface that build makes, to the last bit.  Its report says
        nothing of time and memory.

        Raises InputError naming the part that is missing, there twice, cut
        short or of another build; and, for few and degenerate solids, where a
        cell beside the border of a box is too thin to be judged: build the
        whole then.
        """
        return cls(joined(pieces))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> ContactSpace:
        """Of a .pcs file, bit for bit what was written.  Of any other file
        ContactSpace.take(path) takes the mesh."""
        return cls(_native.ContactSpace.read(os.fspath(path)))

    def write(self, path: str | os.PathLike[str]) -> None:
        """OFF, OBJ, STL or PLY by the ending; as .pcs, with planes, kinds and
        report, for read and for `phongpd`."""
        super().write(path)

    @property
    def length(self) -> float:
        """D, that shares refer to: the bounding box's diagonal."""
        return self._native.length

    @property
    def report(self) -> dict[str, Any]:
        """What was built: counts, genus, volume, seconds by stage, warnings."""
        return self._native.report

    def to_row(self) -> dict[str, Any]:
        """For pandas.DataFrame([one.to_row(), ...]): `report`, flat."""
        row: dict[str, Any] = {"length": self.length}
        for key, value in self.report.items():
            if key == "seconds":
                value = sum(value.values())
            row[key] = "; ".join(value) if key == "warnings" else value
        return row

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        canvas.mesh(name or "contact space", "contact", self)

    def _facts(self) -> dict[str, Any]:
        row = self.to_row()
        return {key: row[key] for key in ("triangles", "components", "genus",
                                          "volume", "length", "warnings")}

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
    if flag(difference, "difference"):
        return ContactSpace.build(one, other, max_seconds=max_seconds,
                                  max_mib=max_mib, cache=cache)
    return ContactSpace(_native.ContactSpace.sum(
        one._native, other._native, real(max_seconds, "max_seconds", "seconds"),
        real(max_mib, "max_mib", "MiB"), flag(cache, "cache")))


def native_space(space: ContactSpace) -> _native.ContactSpace:
    if isinstance(space, ContactSpace):
        return space._native
    is_file = isinstance(space, (str, os.PathLike))
    raise InputError(
        f"space: expected a ContactSpace, found {type(space).__name__}"
        + ("; ContactSpace.read(file) reads one" if is_file else ""))
