# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of JSON as a table of pandas, which need not be there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any


def flat(row: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Of {"a": {"b": 1}} the column "a.b"."""
    for name, value in row.items():
        if isinstance(value, dict) and value:
            yield from flat(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


def frame_of(rows: Iterable[dict[str, Any]], what: str) -> Any:
    """A pandas.DataFrame, a line a row, in the order of the rows; columns in the
    order in which they first come, missing values empty."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError(f"{what}: expected the package pandas, found none; pip "
                          "install pandas, or take the rows as they are"
                          ) from error
    return pandas.DataFrame([dict(flat(row)) for row in rows])
