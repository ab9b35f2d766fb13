# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of JSON as columns, one kind of value each."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from .._frames import flat

KINDS = ("bool", "int", "float", "text", "floats", "vectors", "json")
"""Of a column: of lists of numbers, "floats"; of lists of such, "vectors"; of
all else, and of values of several kinds, "json", the text of them."""


def kinds_of(rows: Iterable[dict[str, Any]]) -> dict[str, str]:
    """Of the columns, in the order in which they first come."""
    kinds: dict[str, Any] = {}
    for row in rows:
        for name, value in flat(row):
            kinds[name] = _both(kinds.get(name), _kind(value))
    return {name: {None: "json", "empty": "floats"}.get(kind, kind)
            for name, kind in kinds.items()}


def value_in(kind: str, value: Any) -> Any:
    """The value as a column of that kind has it."""
    if value is None:
        return None
    if kind == "json":
        return json.dumps(value)
    return float(value) if kind == "float" else value


def _kind(value: Any) -> str | None:
    """None: of any kind."""
    if value is None:
        return None
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, int):
        return "int" if abs(value) < 2 ** 63 else "json"
    if isinstance(value, float):
        return "float"
    if isinstance(value, str):
        return "text"
    if isinstance(value, list):
        return _kind_of_list(value)
    return "json"


def _kind_of_list(values: list[Any]) -> str:
    """Of no values "empty", which is any kind of list."""
    kinds = {_kind(value) for value in values}
    if not kinds:
        return "empty"
    if kinds <= {"int", "float"}:
        return "floats"
    return "vectors" if kinds <= {"floats", "empty"} else "json"


def _both(a: str | None, b: str | None) -> str | None:
    if a == b or b is None:
        return a
    if a is None:
        return b
    if {a, b} == {"int", "float"}:
        return "float"
    one, other = sorted((a, b))
    is_list = one == "empty" and other in ("floats", "vectors")
    return other if is_list else "json"
