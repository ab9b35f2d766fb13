# SPDX-License-Identifier: GPL-3.0-or-later
"""One contact space as a graph: a task a piece, and one that joins them."""

from __future__ import annotations

import json
import os
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from distributed import Client

from .._arguments import whole_number
from .._contact import ContactSpace
from .._native import BuildRefusal, InputError, __version__
from ._jobs import Job, batches, digest
from ._piece_files import PieceFile
from ._run import Driver, connection
from ._solids import PathLike, folder_of, limit_of, pair_of
from ._work import SweepError

_ENDINGS = (".off", ".obj", ".stl", ".ply", ".pcs")


@dataclass(frozen=True)
class PieceBuild:
    """What contact_space did."""

    output: Path
    files: list[Path]
    """The pieces; more than were asked for where some were built in halves."""
    kept: int
    """Of the pieces asked for, those that were there before."""
    report: dict[str, Any]
    """What was built, as ContactSpace.report has it, and `length`."""
    seconds: float

    def read(self) -> ContactSpace:
        """What is in the output."""
        if self.output.suffix.lower() == ".pcs":
            return ContactSpace.read(self.output)
        return ContactSpace.take(self.output)


def contact_space(robot: Any, obstacle: Any, *, pieces: int, folder: PathLike,
                  output: PathLike, client: Client | None = None,
                  max_mib: float | None = None, robot_hull: bool = False,
                  target_faces: int = 0, wrap: float = 0.0,
                  outer_shell_only: bool = False) -> PieceBuild:
    """One contact space, built by `pieces` tasks and joined by one more: the
    surface of ContactSpace.build to the last bit, whatever the number of
    pieces and workers.

    folder: where workers put pieces, each at once or not at all, named by the
    build they are of; the same folder for all of them and the client.  They
    stay: those that are there are not built again, by whatever call; remove
    them when you are done.
    output: OFF, OBJ, STL, PLY or .pcs; the joining worker writes it.
    max_mib: a piece that takes more is built in halves, and these again, into
    64 parts at the most, by the same task; what does not fit then, its
    convolution or one box, is refused.  None: a thread's share of 0.7 of the
    worker's memory limit.
    robot_hull, ...: as ContactSpace.build has them.

    Every piece repeats the convolution of the solids: take some more pieces
    than workers, not many more.  Joining takes the memory of the surface and
    is done by one worker.

    Raises InputError naming a piece in the folder that is cut short, changed or
    of another build, and nothing is written then; BuildRefusal where no halving
    helps; SweepError where a piece could not be made, because every worker that
    tries dies of it for example: all others are in the folder then.
    """
    begin = time.perf_counter()
    count = whole_number(pieces, "pieces", 1)
    place, target = folder_of(folder), Path(os.path.abspath(output))
    folder_of(target.parent)
    if target.suffix.lower() not in _ENDINGS:
        raise InputError(f"{target}: expected a name that ends in one of "
                         f"{', '.join(_ENDINGS)}, found {target.suffix!r}")
    one, other, arrays = pair_of(robot, obstacle)
    options = {"robot_hull": bool(robot_hull), "wrap": float(wrap),
               "target_faces": whole_number(target_faces, "target_faces", 0),
               "outer_shell_only": bool(outer_shell_only)}
    name = digest(__version__, one, other, options)
    limit = limit_of(max_mib)
    parts = [PieceFile(place, name, i, count) for i in range(count)]
    missing = [part for part in parts if part.files() is None]
    building = {**arrays, "folder": str(place), "name": name,
                "options": options, "max_mib": limit}
    with connection(client) as connected:
        made = _Made(place)
        _run(connected, made, name, building, [
            Job.of("piece", name, {"index": part.index, "count": count})
            for part in missing])
        files = [file for part in parts for file in _all_of(part, made)]
        joining = {"folder": str(place), "output": str(target),
                   "files": [file.name for file in files]}
        subject = digest(joining)
        joined = _Made(place)
        _run(connected, joined, subject, joining,
             [Job.of("join", subject, {"pieces": len(files)})])
    report, = joined.rows.values()
    if not target.is_file():
        raise SweepError(f"{target}: expected the contact space that a worker "
                         "wrote, found none; workers and client need one folder")
    return PieceBuild(target, files, count - len(missing), report,
                      time.perf_counter() - begin)


class _Made:
    """What tasks say they have made, as they come; pieces are in the folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.rows: dict[str, dict[str, Any]] = {}

    def add(self, key: str, line: str) -> bool:
        row = json.loads(line)
        return self.rows.setdefault(key, row) is row

    def state(self) -> str:
        return (f"the pieces that are built are in {self._folder}, and the same "
                "call goes on from there")

    def with_advice(self, reason: str) -> str:
        """Where it names a piece."""
        if not reason.startswith(str(self._folder)):
            return reason
        return f"{reason}; or remove it, and the same call builds it again"


def _run(client: Client, made: _Made, subject: str, shared: dict[str, Any],
         jobs: list[Job]) -> None:
    """Raises what the library said of the first job that it refused."""
    Driver({subject: shared}, made).run(client, list(batches(jobs, 1)))
    for job in jobs:
        row = made.rows[job.key]
        if row["outcome"] == "refused":
            raise BuildRefusal(f"{row['reason']}; {made.state()}")
        if row["outcome"] != "done":
            raise InputError(made.with_advice(row["reason"]))


def _all_of(part: PieceFile, made: _Made) -> list[Path]:
    files = part.files()
    if files is None:
        raise SweepError(
            f"{part.path}: expected the piece that a worker wrote, found none; "
            f"workers and client need one folder; {made.state()}")
    return files
