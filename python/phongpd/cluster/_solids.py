# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids as what travels to workers; where these may write, and how much of
their memory builds may take."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Union

import numpy as np

from .._native import InputError
from .._solid import Solid, as_solid
from ._jobs import digest

PathLike = Union[str, "os.PathLike[str]"]


def pair_of(robot: Any, obstacle: Any) -> tuple[str, str, dict[str, Any]]:
    """Digests of two solids, and what travels to the workers."""
    solids = {"robot": as_solid(robot, "robot"),
              "obstacle": as_solid(obstacle, "obstacle")}
    one, other = (digest(solid.vertices.tobytes().hex(),
                         solid.triangles.tobytes().hex())
                  for solid in solids.values())
    return one, other, {name: _arrays(solid) for name, solid in solids.items()}


def _arrays(solid: Solid) -> tuple[Any, Any, str]:
    return np.array(solid.vertices), np.array(solid.triangles), solid.name


def solid_of(arrays: tuple[Any, Any, str]) -> Solid:
    """What pair_of took apart."""
    return Solid(*arrays)


def folder_of(folder: PathLike) -> Path:
    """Its absolute path.  Raises InputError where there is none."""
    path = Path(os.path.abspath(folder))
    if not path.is_dir():
        raise InputError(f"{os.fspath(folder)}: expected a folder, found none")
    return path


def limit_of(max_mib: float | None) -> float | None:
    """Raises InputError for what is no limit."""
    if max_mib is not None and not float(max_mib) >= 0.0:
        raise InputError(f"max_mib: expected 0 or more, found {max_mib!r}")
    return max_mib
