# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import fields
from typing import Any, ClassVar, Tuple

import numpy as np
from numpy.typing import NDArray


class Statuses:
    """Answers of which each row has a status: a number, and a word for it, how
    it goes on from the answer before (QueryStatus in C++).  Metrics use the
    first four words, a tracker `invalid` and those behind it."""

    WORDS: ClassVar[Tuple[str, ...]] = (
        "ok", "branch_ended", "euclidean_fallback", "invalid", "following",
        "sliding", "left_elsewhere", "outside")
    status: NDArray[np.uint8]

    @property
    def statuses(self) -> list[str]:
        """The words, a row each."""
        return [self.WORDS[s] for s in self.status]

    def __len__(self) -> int:
        return len(self.status)


def columns_of(answers: Any) -> dict[str, Any]:
    """The fields of a dataclass as one-dimensional columns: vectors as three
    of them, points as x, y, z, statuses as words."""
    columns: dict[str, Any] = {}
    for field in fields(answers):
        value = getattr(answers, field.name)
        if field.name == "status":
            columns["status"] = answers.statuses
        elif value.ndim == 1:
            columns[field.name] = value
        else:
            prefix = "" if field.name == "points" else field.name + "_"
            for k, axis in enumerate("xyz"):
                columns[prefix + axis] = value[:, k]
    return columns


def axes(name: str, vector: Any) -> dict[str, float]:
    """A vector as three entries of a row."""
    return {f"{name}_{axis}": float(x) for axis, x in zip("xyz", vector)}


class Answer:
    """Mixed into results that know what they are answers about: a result that
    is sent to another process goes without."""

    _LIVE: ClassVar[Tuple[str, ...]] = ()

    def __getstate__(self) -> dict[str, Any]:
        return {key: value for key, value in self.__dict__.items()
                if key not in self._LIVE}
