# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows as a Parquet file, for tools that read columns."""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

from .._frames import flat
from .._native import InputError
from ._columns import kinds_of, value_in
from ._solids import PathLike

ROWS_OF_GROUP = 10000


def write_parquet(rows: PathLike, output: PathLike) -> int:
    """Rows of a JSON Lines file as a Parquet file, at once or not at all; how
    many there are.  Needs pyarrow (`pip install 'phongpd[parquet]'`).

    rows: the output of a sweep, or OUTPUT.partial while it runs: a last line
    that is not whole yet is left out.  Any other file of JSON objects will do.

    A row of the file is a row, in its order.  Fields are columns, those of
    objects as "seconds.total".  A column is of whole numbers, numbers, texts,
    truth values, lists of numbers or lists of those; of anything else, or of
    several kinds, it is text in JSON.  A field that a row lacks is null.  It is
    read twice and never as a whole.

    Raises InputError: no pyarrow; a line, by its number, that is no object or
    gives two columns one name; files that cannot be read or written.
    """
    arrow, parquet = _pyarrow()
    source, target = Path(os.fspath(rows)), Path(os.fspath(output))
    kinds = kinds_of(_read(source))
    types = {"bool": arrow.bool_(), "int": arrow.int64(),
             "float": arrow.float64(), "text": arrow.string(),
             "json": arrow.string(), "floats": arrow.list_(arrow.float64()),
             "vectors": arrow.list_(arrow.list_(arrow.float64()))}
    schema = arrow.schema([(name, types[kind]) for name, kind in kinds.items()])
    part = target.with_name(f".{target.name}-{uuid.uuid4().hex}.part")
    count = 0
    try:
        with parquet.ParquetWriter(part, schema) as writer:
            every = _read(source)
            while group := list(islice(every, ROWS_OF_GROUP)):
                writer.write_table(arrow.Table.from_pylist(
                    [_columns(row, kinds) for row in group], schema=schema))
                count += len(group)
        os.replace(part, target)
    except OSError as error:
        raise InputError(f"{target}: expected a file to write, found "
                         f"{error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)
    return count


def _pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise InputError("write_parquet: expected the package pyarrow, found "
                         "none; pip install 'phongpd[parquet]'") from None
    return pyarrow, pyarrow.parquet


def _columns(row: dict[str, Any], kinds: dict[str, str]) -> dict[str, Any]:
    return {name: value_in(kinds[name], value) for name, value in flat(row)}


def _read(source: Path) -> Iterator[dict[str, Any]]:
    try:
        file = open(source, "rb")
    except OSError as error:
        raise InputError(f"{source}: expected a file of rows, found "
                         f"{error.strerror}") from None
    with file:
        for number, line in enumerate(file, 1):
            if line.endswith(b"\n"):
                yield _row(line, f"{source}: line {number}")


def _row(line: bytes, where: str) -> dict[str, Any]:
    try:
        row = json.loads(line)
    except ValueError:
        row = None
    if not isinstance(row, dict):
        raise InputError(f"{where}: expected a JSON object, found {line[:40]!r}")
    names = [name for name, _ in flat(row)]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"{where}: expected columns of different names, found "
                         f"{twice!r} twice")
    return row
