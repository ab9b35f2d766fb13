# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from . import _native
from ._arguments import Floats, flag, real
from ._native import InputError
from ._rigid_plan import pose_matrices
from ._solid import Solid, as_solid


@dataclass(frozen=True)
class Removal:
    """How one part comes out of others, by translation alone or with turns."""

    part: int
    """Its number in the list that was given; 0 of `remove`."""
    status: str
    """"solved": it is out; "infeasible_proved": no translation takes it out;
    "time_limit": none does, proved, and no way with turns was found in time;
    "start_in_collision": it is not free as it lies, within the tolerance;
    else there is no answer, and `reason` says why."""
    reason: str
    """One sentence unless it is out."""
    path: Floats
    """Its translations, (N, 3), from (0, 0, 0) to beside the box of the rest;
    certified as a polyline.  Without rows: none, or it turns."""
    poses: Floats
    """Of a way with turns, (N, 4, 4), from where it lies: of the part moved so
    that `pivot` is its origin; certified as RigidJudge.check_path has it."""
    pivot: Floats
    needs_turns: bool
    """No translation takes it out, proved."""
    length: float
    """Of positions; of a way with turns by the radius of gyration of these, too."""
    clearance: float
    """Of all of the path, as it was planned for; with turns none is told: 0."""
    granted: tuple[float, float]
    """What was granted of the tolerance: its faces lie at least so far below
    where they were drawn, and no vertex farther from there than that."""
    seconds: float

    @property
    def out(self) -> bool:
        return self.status == "solved"


@dataclass(frozen=True)
class Disassembly:
    """Which part comes out when."""

    steps: list[Removal]
    """In order, each out of those that are left."""
    stuck: list[Removal]
    """Why each of those that do not come out is held by the others of them."""

    @property
    def complete(self) -> bool:
        return not self.stuck

    @property
    def proved(self) -> bool:
        """No order of single parts by translation takes out one more."""
        return all(one.status == "infeasible_proved" for one in self.stuck)


def remove(part: Solid, rest: Sequence[Solid], tolerance: float = 0.0,
           verify: bool = True, turn_seconds: float = 0.0) -> Removal:
    """The way of a part out of others as they lie, by translation alone, or a
    proof that there is none::

        out = phongpd.remove(pin, [housing, lid], tolerance=0.01)
        out.status, out.path, out.granted

    Parts are often drawn to fit exactly, and nothing moves: the faces of the
    part are drawn in by `tolerance` then, in the solids' unit.  Where no
    translation takes it out, proved, a way on which it turns is looked for, for
    `turn_seconds`; not to find one proves nothing.  Raises InputError for walls
    too thin for the tolerance."""
    return _removal(_native.remove(
        as_solid(part, "part")._native, _solids(rest, "rest"),
        _length(tolerance), flag(verify, "verify"),
        real(turn_seconds, "turn_seconds", "seconds")))


def disassemble(parts: Sequence[Solid], tolerance: float = 0.0,
                verify: bool = True, turn_seconds: float = 0.0) -> Disassembly:
    """An order in which all parts come out one by one, as `remove` has it of
    each; what is taken away only gives room, so that none is missed.  Turns are
    looked for when no part comes out without."""
    steps, stuck = _native.disassemble(
        _solids(parts, "parts"), _length(tolerance), flag(verify, "verify"),
        real(turn_seconds, "turn_seconds", "seconds"))
    return Disassembly(list(map(_removal, steps)), list(map(_removal, stuck)))


def _solids(values: Any, name: str) -> list[_native.Solid]:
    if isinstance(values, (str, os.PathLike)) or not isinstance(
            values, Iterable):
        raise InputError(f"{name}: expected a list of solids, found "
                         f"{type(values).__name__}")
    return [as_solid(one, f"{name} {i}")._native for i, one in enumerate(values)]


def _length(tolerance: Any) -> float:
    return real(tolerance, "tolerance", "in the solids' unit")


def _removal(row: _native._Removal) -> Removal:
    (part, status, reason, path, poses, pivot, needs_turns, length, clearance,
     least, most, seconds) = row
    return Removal(part, status, reason, path, pose_matrices(poses), pivot,
                   needs_turns, length, clearance, (least, most), seconds)
