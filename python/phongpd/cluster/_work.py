# SPDX-License-Identifier: GPL-3.0-or-later
"""What runs on the workers.

A task is a pure function of its batch: run twice, or on another worker, it
gives the same rows but for their timing.  What several tasks of one subject
need (a world, the preparation of two solids) is kept in the process, the last
few of them, and made anew where it is not there.
"""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
import threading
import time
import uuid
from collections import OrderedDict
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from distributed import get_worker

from .. import _native
from .._contact import ContactSpace
from .._depth import DepthQuery
from .._native import BuildRefusal, InputError
from .._piece import ContactSpacePiece
from ._jobs import Batch, Job
from ._piece_files import PieceFile
from ._solids import solid_of

KEPT_SUBJECTS = 4
# Of a worker's memory limit, what builds may take: Dask pauses a worker at
# 0.8 of it.
BUILD_SHARE = 0.7


class SweepError(RuntimeError):
    """The sweep cannot go on as it is; one line."""


def run_batch(batch: Batch, subject: dict[str, Any]) -> list[tuple[str, str]]:
    """The rows of a task by key, as lines.  What the library refuses is a row
    that says so; anything else is raised."""
    with _threads_of_worker():
        return [(job.key, _line(job, subject)) for job in batch.jobs]


@contextlib.contextmanager
def _threads_of_worker() -> Iterator[None]:
    """On a worker, the library uses as many threads as the worker has: other
    workers have the other cores."""
    try:
        threads = get_worker().state.nthreads
    except ValueError:  # not on a worker
        yield
        return
    limit = _native.ThreadLimit(threads)
    try:
        yield
    finally:
        limit.release()


def keep(subject: dict[str, Any]) -> dict[str, Any]:
    """A task of its own: solids travel once to a worker, not with each task."""
    return subject


def _line(job: Job, subject: dict[str, Any]) -> str:
    try:
        outcome, body = "done", WORK[job.kind](job, subject)
    except BuildRefusal as refusal:
        outcome, body = "refused", _reason(job, subject, refusal)
    except InputError as error:
        outcome, body = "invalid", _reason(job, subject, error)
    head = json.dumps({"key": job.key, "outcome": outcome})
    return head[:-1] + ", " + body[1:]


def _reason(job: Job, subject: dict[str, Any], error: Exception) -> str:
    named = {k: v for k, v in subject.items() if isinstance(v, (str, float))}
    return json.dumps({**named, **job.arguments, "reason": str(error)})


def _comparison_row(job: Job, subject: dict[str, Any]) -> str:
    study = _kept(job, subject, lambda: _native.Comparison(
        _same_scene(job, subject), _max_mib(subject), subject["cache"]))
    row: str = study.row(job.arguments["seed"], job.arguments["protocol"],
                         job.arguments["metric"])
    return row


def _planning_row(job: Job, subject: dict[str, Any]) -> str:
    world = _kept(job, subject, lambda: _native.World(
        _native.Scene.load(_same_scene(job, subject), None), subject["cache"],
        _max_mib(subject)))
    what, scene = job.arguments, world.scene
    return json.dumps(world.plan(
        tuple(scene.start), tuple(scene.goal), planner=what["planner"],
        retraction=what["retraction"], clearance=what["clearance"],
        max_seconds=what["max_seconds"], seed=what["seed"], preset="",
        model="", require=False).row)


def _depth_row(job: Job, subject: dict[str, Any]) -> str:
    query = _kept(job, subject, lambda: DepthQuery(
        solid_of(subject["robot"]), solid_of(subject["obstacle"]),
        max_radius=subject["max_radius"]))
    what = job.arguments
    found = query.at(what["position"], what["orientation"])
    body = {one.name: _plain(getattr(found, one.name))
            for one in dataclasses.fields(found) if one.name != "solids"}
    return json.dumps({**what, **body})


def _contact_space_row(job: Job, subject: dict[str, Any]) -> str:
    space = ContactSpace.build(
        solid_of(subject["robot"]), solid_of(subject["obstacle"]),
        max_mib=_max_mib(subject), cache=subject["cache"])
    if subject["file"]:
        _write(space, Path(subject["file"]))
    return _report_row(job, space)


def _piece_row(job: Job, subject: dict[str, Any]) -> str:
    what = job.arguments
    robot, obstacle = _kept(job, subject, lambda: (
        solid_of(subject["robot"]), solid_of(subject["obstacle"])))
    begin = time.perf_counter()
    built: list[str] = []

    def fill(part: PieceFile) -> None:
        if part.path.exists():
            return
        if not part.is_begun_in_halves():
            try:
                _write(ContactSpacePiece.build(
                    robot, obstacle, part.index, part.count,
                    max_mib=_max_mib(subject), **subject["options"]), part.path)
                built.append(str(part))
                return
            except BuildRefusal:
                if not part.may_be_halved():
                    raise
        for half in part.halves():
            fill(half)

    fill(PieceFile(Path(subject["folder"]), subject["name"], what["index"],
                   what["count"]))
    return json.dumps({**what, "built": built,
                       "seconds": time.perf_counter() - begin})


def _join_row(job: Job, subject: dict[str, Any]) -> str:
    space = ContactSpace.join(
        [Path(subject["folder"]) / name for name in subject["files"]])
    _write(space, Path(subject["output"]))
    return _report_row(job, space)


def _report_row(job: Job, space: ContactSpace) -> str:
    return json.dumps({**job.arguments, "length": space.length,
                       **_plain(space.report)})


WORK: dict[str, Callable[[Job, dict[str, Any]], str]] = {
    "convergence": _comparison_row,
    "planning": _planning_row,
    "depth": _depth_row,
    "contact-space": _contact_space_row,
    "piece": _piece_row,
    "join": _join_row,
}

_kept_subjects: OrderedDict[tuple[str, str], Any] = OrderedDict()
_making = threading.Lock()


def _kept(job: Job, subject: dict[str, Any], make: Callable[[], Any]) -> Any:
    name = (job.kind, job.subject)
    with _making:
        if name not in _kept_subjects:
            while len(_kept_subjects) >= KEPT_SUBJECTS or (
                    _kept_subjects and _is_crowded()):
                _kept_subjects.popitem(last=False)
            _kept_subjects[name] = make()
        _kept_subjects.move_to_end(name)
        return _kept_subjects[name]


def _same_scene(job: Job, subject: dict[str, Any]) -> str:
    """The scene's name here, where it must be what it is for the client."""
    scene = str(subject["scene"])
    try:
        found = _native.scene_digest(scene)
    except InputError as error:
        raise SweepError(f"a worker cannot read the scene: {error}") from None
    if found != subject["digest"]:
        raise SweepError(f"{scene}: expected the same contents on all workers, "
                         "found others")
    return scene


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(value.tolist())
    # JSON has no infinity: a radius without a bound is null.
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _write(thing: ContactSpace | ContactSpacePiece, path: Path) -> None:
    """At once or not at all."""
    part = path.with_name(f".{path.stem}-{uuid.uuid4().hex}.part{path.suffix}")
    try:
        thing.write(part)
        os.replace(part, path)
    except (OSError, InputError) as error:
        raise SweepError(f"{path}: a worker cannot write it: {error}") from None


def _memory_limit() -> tuple[float, int]:
    """MiB of this worker (0: none), and threads that share them."""
    try:
        worker = get_worker()
    except ValueError:  # not on a worker
        return 0.0, 1
    limit = worker.memory_manager.memory_limit or 0
    return limit / 2 ** 20, worker.state.nthreads


def _max_mib(subject: dict[str, Any]) -> float:
    """As asked, else a thread's share of the worker's limit."""
    if subject["max_mib"] is not None:
        return float(subject["max_mib"])
    limit, threads = _memory_limit()
    return BUILD_SHARE * limit / threads


def _is_crowded() -> bool:
    limit, _ = _memory_limit()
    with open("/proc/self/statm", encoding="ascii") as file:
        pages = int(file.read().split()[1])
    used = pages * os.sysconf("SC_PAGESIZE") / 2 ** 20
    return limit > 0 and used > limit / 2
