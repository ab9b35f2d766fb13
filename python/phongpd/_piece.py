# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
from typing import Any

from . import _native
from ._arguments import flag, real, whole_number
from ._native import ContactSpacePiece as NativePiece, InputError
from ._solid import as_solid


class ContactSpacePiece:
    """Part i of n of the build of a contact space, which processes or machines
    can share; ContactSpace.join puts all n together.

    Memory is that of the boxes that are being arranged and of the part's
    surface.  Parts 2i and 2i + 1 of 2n may stand for i of n: one that takes too
    much can be built in halves.  Every part repeats the convolution of the
    solids, as a rule the smaller share of the work.  Immutable.
    """

    _native: NativePiece

    def __init__(self, native: NativePiece) -> None:
        """Use build, or read."""
        self._native = native

    @classmethod
    def build(cls, robot: Any, obstacle: Any, index: int, count: int, *,
              robot_hull: bool = False, target_faces: int = 0,
              wrap: float = 0.0, outer_shell_only: bool = False,
              max_seconds: float = 0.0,
              max_mib: float = 0.0) -> ContactSpacePiece:
        """Part `index` of `count`, 0 <= index < count; Ctrl-C stops that.

        robot, obstacle and options as ContactSpace.build has them, the same for
        all parts; limits may differ.  Raises BuildRefusal where a limit is
        passed; of what a part will take nothing is predicted.
        """
        number = whole_number(index, "index", 0)
        parts = whole_number(count, "count", 1)
        if number >= parts:
            raise InputError(f"index: expected one below the count, {parts}, "
                             f"found {number}")
        return cls(NativePiece.build(
            as_solid(robot, "robot")._native,
            as_solid(obstacle, "obstacle")._native, number, parts,
            flag(robot_hull, "robot_hull"),
            whole_number(target_faces, "target_faces", 0), real(wrap, "wrap"),
            flag(outer_shell_only, "outer_shell_only"),
            real(max_seconds, "max_seconds", "seconds"), real(max_mib, "max_mib", "MiB")))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> ContactSpacePiece:
        """Of a file of write, or of `phongpd contact-space --piece`.  Raises
        InputError naming it: missing, cut short, changed, of another version or
        kind of machine."""
        return cls(NativePiece.read(os.fspath(path)))

    def write(self, path: str | os.PathLike[str]) -> None:
        """A file for read and for `phongpd join`, with a checksum.  Raises
        InputError where it cannot be written."""
        try:
            with open(path, "wb") as file:
                file.write(self._native.content())
        except OSError as error:
            raise InputError(f"{os.fspath(path)}: expected a file to write, "
                             f"found {error.strerror}") from None

    @property
    def index(self) -> int:
        return self._native.index

    @property
    def count(self) -> int:
        return self._native.count

    @property
    def boxes(self) -> int:
        """That it was arranged in."""
        return self._native.boxes

    @property
    def faces(self) -> int:
        """Of the contact space, found in them."""
        return self._native.faces

    def __repr__(self) -> str:
        return (f"<ContactSpacePiece {self.index}/{self.count}: {self.faces} "
                f"faces in {self.boxes} boxes>")


def joined(pieces: Any) -> _native.ContactSpace:
    """Of pieces, or of their files."""
    return _native.join([_as_piece(one)._native for one in _listed(pieces)])


def _listed(pieces: Any) -> list[Any]:
    if isinstance(pieces, (str, os.PathLike, ContactSpacePiece)):
        return [pieces]
    try:
        return list(pieces)
    except TypeError:
        raise InputError("pieces: expected a list of pieces or of their files, "
                         f"found {type(pieces).__name__}") from None


def _as_piece(value: Any) -> ContactSpacePiece:
    if isinstance(value, ContactSpacePiece):
        return value
    if isinstance(value, (str, os.PathLike)):
        return ContactSpacePiece.read(value)
    raise InputError("pieces: expected a ContactSpacePiece or a file, found "
                     f"{type(value).__name__}")
