# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of contact spaces in a folder: a piece is there as one file, or as
its two halves, each of them in the same way."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

# Of a piece that does not fit, into up to 64 parts.
MOST_HALVINGS = 6


@dataclass(frozen=True)
class PieceFile:
    """Part `index` of `count` of the build that `name` is the digest of."""

    folder: Path
    name: str
    index: int
    count: int
    halvings: int = 0
    """How often what was asked for has been halved to have it."""

    @property
    def path(self) -> Path:
        return self.folder / f"{self.name}-{self.index}-of-{self.count}.piece"

    def may_be_halved(self) -> bool:
        return self.halvings < MOST_HALVINGS

    def halves(self) -> tuple[PieceFile, ...]:
        return tuple(
            PieceFile(self.folder, self.name, index, 2 * self.count,
                      self.halvings + 1)
            for index in (2 * self.index, 2 * self.index + 1))

    def is_begun_in_halves(self) -> bool:
        """The first parts are built first."""
        return self.may_be_halved() and any(
            half.path.exists() or half.is_begun_in_halves()
            for half in self.halves()[:1])

    def files(self) -> list[Path] | None:
        """Those that are this piece; None: not all of them are there."""
        if self.path.exists():
            return [self.path]
        if not self.may_be_halved():
            return None
        found: list[Path] = []
        for half in self.halves():
            files = half.files()
            if files is None:
                return None
            found += files
        return found

    def __str__(self) -> str:
        return f"{self.index}/{self.count}"
