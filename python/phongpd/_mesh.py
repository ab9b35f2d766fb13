# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from typing import Union

import numpy as np
from numpy.typing import NDArray

from ._arguments import Floats
from ._native import ContactSpace, Solid


class MeshViews:
    """What a solid and a contact space show of their mesh."""

    _native: Union[Solid, ContactSpace]

    @property
    def vertices(self) -> Floats:
        """(N, 3), user's unit; read-only, no copy."""
        return self._native.vertices

    @property
    def triangles(self) -> NDArray[np.int32]:
        """(M, 3), counter-clockwise seen from outside; read-only, no copy."""
        return self._native.triangles

    def write(self, path: str | os.PathLike[str]) -> None:
        """OFF, OBJ, STL or PLY by the ending."""
        self._native.write(os.fspath(path))
