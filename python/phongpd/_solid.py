# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import rows
from ._mesh import MeshViews
from ._native import InputError, Solid as NativeSolid
from ._view import Canvas, Shown


class Solid(MeshViews, Shown):
    """A closed triangle mesh that was checked once and never changes.

    Equal vertices are joined where that closes the surface, shells that face
    inwards are turned; `warnings` says so.  Anything that is no solid (open,
    not manifold, self-intersecting within a component, no volume) raises
    InputError with counts.  Components may overlap: their union is meant.
    """

    _native: NativeSolid
    _notes: list[str] = []  # of the file that it was read from

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike,
                 name: str = "solid") -> None:
        """vertices: (N, 3), any unit; triangles: (M, 3), whole numbers."""
        corners = triangle_rows(triangles, name)
        self._native = _native.Solid.from_arrays(
            rows(vertices, f"{name}: vertices", 3),
            corners, str(name))

    @classmethod
    def _of(cls, native: NativeSolid) -> Solid:
        solid = cls.__new__(cls)
        solid._native = native
        return solid

    @classmethod
    def read(cls, path: str | os.PathLike[str], name: str | None = None) -> Solid:
        """Of an OFF, OBJ, STL or PLY file; in single precision of COLLADA,
        glTF, GLB or 3MF; of a link of URDF or SDF, `robot.urdf#link`, or of all
        of a URDF, `robot.urdf@joint=1.5,other=0` (radians, metres).  What there
        is to know of the file is in `warnings`.  Wheels are built without
        Assimp and read the first four only; they say so in the error."""
        if not isinstance(path, (str, os.PathLike)):
            raise InputError("path: expected a file of a mesh, found "
                             f"{type(path).__name__}")
        text = os.fspath(path)
        native, notes = _native.Solid.read(text, text if name is None else name)
        solid = cls._of(native)
        solid._notes = notes
        return solid

    @classmethod
    def from_trimesh(cls, mesh: Any, name: str = "solid") -> Solid:
        """Of anything with `vertices` and `faces`, as trimesh has them."""
        return cls(np.asarray(mesh.vertices), np.asarray(mesh.faces), name)

    @property
    def name(self) -> str:
        """Stands in messages about it."""
        return self._native.name

    @property
    def volume(self) -> float:
        """Of the components, each counted alone; user's unit cubed."""
        return self._native.volume

    @property
    def components(self) -> int:
        return self._native.components

    @property
    def warnings(self) -> list[str]:
        """What was done to it, and what is no error but worth knowing."""
        return self._native.warnings + self._notes

    def to_row(self) -> dict[str, Any]:
        """For pandas.DataFrame([one.to_row(), ...])."""
        return {"name": self.name, "vertices": len(self.vertices),
                "triangles": len(self.triangles),
                "components": self.components, "volume": self.volume}

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        canvas.mesh(name or self.name, "mesh", self)

    _facts = to_row

    def __repr__(self) -> str:
        return (f"<Solid {self.name!r}: {len(self.triangles)} triangles, "
                f"volume {self.volume:g}>")


def as_solid(value: Any, name: str) -> Solid:
    """A Solid, a path, or an object with vertices and faces."""
    if isinstance(value, Solid):
        return value
    if isinstance(value, (str, os.PathLike)):
        return Solid.read(value)
    if hasattr(value, "vertices") and hasattr(value, "faces"):
        return Solid.from_trimesh(value, name)
    raise InputError(
        f"{name}: expected a Solid, a file or a mesh with vertices and faces, "
        f"found {type(value).__name__}")


def triangle_rows(triangles: ArrayLike, name: str) -> NDArray[np.int32]:
    """Of shape (M, 3), none below 0."""
    try:
        corners = np.asarray(triangles)
    except ValueError as error:  # rows of different lengths
        raise InputError(f"{name}: triangles: expected whole numbers of "
                         f"shape (M, 3), found {error}") from None
    if corners.dtype.kind not in "iu" or corners.ndim != 2 \
            or corners.shape[1] != 3:
        raise InputError(
            f"{name}: triangles: expected whole numbers of shape (M, 3), "
            f"found {corners.dtype} of shape {corners.shape}")
    limit = np.iinfo(np.int32).max
    if corners.size and (corners.max() > limit or corners.min() < 0):
        raise InputError(
            f"{name}: triangles: expected existing vertices, found "
            f"{corners.min()} to {corners.max()}")
    return np.ascontiguousarray(corners, dtype=np.int32)
