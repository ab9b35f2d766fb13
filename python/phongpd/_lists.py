# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists of names and of seeds, as users give them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from ._arguments import whole_number
from ._native import InputError


def names(values: Any, name: str) -> list[str]:
    """A list of texts or files, at least one."""
    if isinstance(values, (str, os.PathLike)) or not isinstance(
            values, Iterable):
        raise InputError(f"{name}: expected a list of names, found {values!r}")
    texts = [os.fspath(value) for value in values]
    if not texts:
        raise InputError(f"{name}: expected at least one, found none")
    return texts


def seed_numbers(seeds: Iterable[int]) -> list[int]:
    if isinstance(seeds, (str, int)) or not isinstance(seeds, Iterable):
        raise InputError(
            f"seeds: expected whole numbers, range(1, 51) for example, found "
            f"{seeds!r}")
    return [whole_number(seed, "seeds", 1) for seed in seeds]
