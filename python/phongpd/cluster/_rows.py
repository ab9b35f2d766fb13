# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows that are kept as they come, and put in order at the end."""

from __future__ import annotations

import errno
import fcntl
import json
import os
import stat
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from .._native import InputError

TIMING_FIELDS = ("seconds", "peak_mib")
"""What differs between two runs of one row, wherever it is in it."""


def without_timing(row: Any) -> Any:
    """The row, or anything of JSON, without TIMING_FIELDS: the same whatever
    the machine is busy with and however many workers there are."""
    if isinstance(row, dict):
        return {key: without_timing(value) for key, value in row.items()
                if key not in TIMING_FIELDS}
    if isinstance(row, list):
        return [without_timing(value) for value in row]
    return row


class RowStore:
    """The rows of one sweep, in OUTPUT.partial until all are there.

    Every row is one line of JSON with its `key`, handed to the system as soon
    as it comes: what ends the process takes no row away, a power cut may take
    the last ones.  A last line that is torn does not count and is written
    over.  finish() puts all rows into OUTPUT, at once or not at all, in the
    order of the sweep.

    One process at a time (flock).  Raises InputError naming the file: it is in
    use, cannot be written, or holds what this sweep does not ask for.
    """

    def __init__(self, output: Path, order: Mapping[str, int]) -> None:
        """order: of the rows, by key."""
        self.output = output
        self.partial = output.with_name(output.name + ".partial")
        self._order = order
        self._place: dict[str, tuple[bool, int, int]] = {}
        self._file = _open_locked(self.partial)
        try:
            self._take_up()
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> RowStore:
        return self

    def __exit__(self, kind: type[BaseException] | None,
                 value: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def __contains__(self, key: str) -> bool:
        return key in self._place

    def __len__(self) -> int:
        return len(self._place)

    def add(self, key: str, line: str) -> bool:
        """False: a row of that key is there already; it stays."""
        if key in self._place:
            return False
        data = line.encode() + b"\n"
        self._append(data)
        self._place[key] = (False, self._size, len(data))
        self._size += len(data)
        return True

    def state(self) -> str:
        """What is safe, for who is told that something went wrong."""
        return (f"{len(self)} rows are in {self.partial}, and the same call "
                "goes on from there")

    def lines(self) -> Iterator[bytes]:
        """Those that are there, with their ends, in the order of the sweep."""
        whole = -1
        if any(is_whole for is_whole, _, _ in self._place.values()):
            whole = os.open(self.output, os.O_RDONLY | os.O_CLOEXEC)
        try:
            for key in sorted(self._place, key=self._order.__getitem__):
                is_whole, begin, size = self._place[key]
                yield os.pread(whole if is_whole else self._file, size, begin)
        finally:
            if whole >= 0:
                os.close(whole)

    def finish(self) -> None:
        """All rows are there: writes OUTPUT and removes OUTPUT.partial."""
        handle, name = tempfile.mkstemp(
            prefix=f".{self.output.name}-", suffix=".part",
            dir=self.output.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.writelines(self.lines())
                file.flush()
                os.fsync(file.fileno())
            os.chmod(name, _mode_of_new_files())
            os.replace(name, self.output)
        except BaseException:
            os.unlink(name)
            raise
        os.unlink(self.partial)

    def close(self) -> None:
        """Lets others at it; a partial file without rows goes."""
        if self._file < 0:
            return
        if os.fstat(self._file).st_size == 0 and os.path.exists(self.partial):
            os.unlink(self.partial)
        os.close(self._file)
        self._file = -1

    def _take_up(self) -> None:
        if self.output.exists():
            self._read(self.output, True, self.output.read_bytes())
        data = self.partial.read_bytes()
        self._size = data.rfind(b"\n") + 1
        self._read(self.partial, False, data[:self._size])
        os.ftruncate(self._file, self._size)
        os.lseek(self._file, 0, os.SEEK_END)

    def _read(self, path: Path, is_whole: bool, data: bytes) -> None:
        begin = 0
        for number, line in enumerate(data.splitlines(keepends=True), 1):
            key = _key_of(line)
            if key is None:
                raise InputError(
                    f"{path}: line {number}: expected a row with a key, found "
                    f"{line[:40]!r}; name another output or remove the file")
            if key not in self._order:
                raise InputError(
                    f"{path}: line {number}: expected a row of this sweep, "
                    f"found one of other scenes, options or versions (key "
                    f"{key}); name another output or remove the file")
            self._place.setdefault(key, (is_whole, begin, len(line)))
            begin += len(line)

    def _append(self, data: bytes) -> None:
        try:
            if os.write(self._file, data) == len(data):
                return
            reason = "no room for the whole row"
        except OSError as error:
            reason = str(error.strerror)
        os.ftruncate(self._file, self._size)
        raise InputError(f"{self.partial}: expected to write a row, found "
                         f"{reason}; the rows before it are safe")


def _key_of(line: bytes) -> str | None:
    try:
        row = json.loads(line)
    except ValueError:
        return None
    key = row.get("key") if isinstance(row, dict) else None
    return key if isinstance(key, str) else None


def _open_locked(path: Path) -> int:
    """A descriptor of the file that has this name while it is locked."""
    while True:
        try:
            file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND
                           | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
        except OSError as error:
            raise InputError(
                f"{path}: expected a file to write, found {error.strerror}"
            ) from None
        try:
            if not stat.S_ISREG(os.fstat(file).st_mode):
                raise InputError(f"{path}: expected a regular file")
            _lock(file, path)
            # Another process may have finished, and removed it, meanwhile.
            if os.path.exists(path) and os.path.samestat(
                    os.fstat(file), os.stat(path)):
                return file
        except BaseException:
            os.close(file)
            raise
        os.close(file)


def _lock(file: int, path: Path) -> None:
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno not in (errno.EWOULDBLOCK, errno.EACCES):
            raise
        raise InputError(
            f"{path}: expected to be alone, found another process that writes "
            "this output; wait for it or name another") from None


def _mode_of_new_files() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
