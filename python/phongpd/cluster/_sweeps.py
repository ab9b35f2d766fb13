# SPDX-License-Identifier: GPL-3.0-or-later
"""The sweeps there are, as jobs."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from distributed import Client
from numpy.typing import ArrayLike

from .. import _native
from .._arguments import Floats, length, rows, seconds
from .._lists import names, seed_numbers
from .._native import InputError
from ._jobs import Job, digest
from ._run import Sweep, run
from ._solids import PathLike, folder_of, limit_of, pair_of
from ._work import SweepError

def convergence(scenes: Sequence[PathLike], *, seeds: Iterable[int],
                output: PathLike, metrics: Sequence[str] = ("phong@0.2",),
                protocols: Sequence[str] = ("straight-adaptive",),
                client: Client | None = None, max_mib: float | None = None,
                cache: bool = False, batch: int = 1) -> Sweep:
    """Trajectory optimisation of every scene from every seed, by every protocol
    and metric: the rows of `phongpd compare`, whose `--rows` summarises them.

    scenes: files, or families with knobs.  seeds: whole numbers from 1 on.
    metrics, protocols: names as `phongpd compare --help` has them.
    """
    subjects = _scenes(scenes, max_mib, cache)
    methods = [(protocol, metric) for protocol in names(protocols, "protocols")
               for metric in names(metrics, "metrics")]
    for protocol, metric in methods:
        _native.check_method(protocol, metric)
    numbers = seed_numbers(seeds)
    jobs = [Job.of("convergence", subject,
                   {"seed": seed, "protocol": protocol, "metric": metric})
            for subject in subjects for seed in numbers
            for protocol, metric in methods]
    return run(jobs, subjects, output, client, batch)


def planning(scenes: Sequence[PathLike], *, seeds: Iterable[int], output: PathLike,
             planners: Sequence[str] = ("contact-surface",),
             retraction: str = "phong", clearance: float | str | None = None,
             max_seconds: float = 5.0, client: Client | None = None,
             max_mib: float | None = None, cache: bool = False,
             batch: int = 1) -> Sweep:
    """A plan from start to goal of every scene by every planner and seed: the
    rows of World.plan, with its arguments."""
    subjects = _scenes(scenes, max_mib, cache)
    room = length(clearance, "clearance")
    chosen = names(planners, "planners")
    for planner in chosen:
        _native.check_planner(planner, retraction, room)
    limit = seconds(max_seconds, "max_seconds")
    if not math.isfinite(limit):
        raise InputError("max_seconds: expected a finite number, found none")
    options = {"retraction": retraction, "clearance": room,
               "max_seconds": limit}
    numbers = seed_numbers(seeds)
    jobs = [Job.of("planning", subject,
                   {"seed": seed, "planner": planner, **options})
            for subject in subjects for seed in numbers
            for planner in chosen]
    return run(jobs, subjects, output, client, batch)


def depth(robot: Any, obstacle: Any, positions: ArrayLike,
          orientations: ArrayLike | None = None, *, output: PathLike,
          max_radius: float = math.inf, client: Client | None = None,
          batch: int = 100) -> Sweep:
    """Exact depth at many poses: the rows of DepthQuery.at, with `pose`, the
    index of the pose.  Poses of one orientation should be neighbours."""
    pair = pair_of(robot, obstacle)
    subject = digest(pair[0], pair[1], repr(float(max_radius)))
    places = _finite(rows(positions, "positions", 3), "positions")
    turns = _turns(orientations, len(places))
    jobs = [Job.of("depth", subject,
                   {"pose": i, "position": place, "orientation": turn})
            for i, (place, turn) in enumerate(zip(places.tolist(), turns))]
    return run(jobs, {subject: {**pair[2], "max_radius": float(max_radius)}},
               output, client, batch)


def contact_spaces(pairs: Mapping[str, tuple[Any, Any]], *, output: PathLike,
                   folder: PathLike | None = None, client: Client | None = None,
                   max_mib: float | None = None, cache: bool = False) -> Sweep:
    """The contact space of every pair (robot, obstacle): the rows are its
    reports, with `pair`, the name.

    folder: where workers write NAME.off, each at once or not at all; it is the
    same folder for all of them.  One task a pair, so a pair needs a worker that
    it fits; contact_space builds one pair by pieces.
    """
    max_mib = limit_of(max_mib)
    place = None if folder is None else folder_of(folder)
    jobs, subjects = [], {}
    for name, solids in pairs.items():
        robot, obstacle, arrays = pair_of(*_two(name, solids))
        file = "" if place is None else str(place / f"{_file_name(name)}.off")
        subject = digest(robot, obstacle, file, max_mib)
        subjects[subject] = {**arrays, "file": file, "max_mib": max_mib,
                             "cache": bool(cache)}
        jobs.append(Job.of("contact-space", subject, {"pair": name}))
    sweep = run(jobs, subjects, output, client, 1)
    if place is not None:
        _require_files(sweep, place)
    return sweep


def _scenes(scenes: Sequence[PathLike], max_mib: float | None,
            cache: bool) -> dict[str, dict[str, Any]]:
    max_mib = limit_of(max_mib)
    subjects: dict[str, dict[str, Any]] = {}
    for text in names(scenes, "scenes"):
        scene = os.path.abspath(text) if os.path.isfile(text) else text
        content = _native.scene_digest(scene)
        subject = digest(content, max_mib)
        if subject in subjects:
            raise InputError(f"scenes: expected different ones, found {text!r} "
                             "twice")
        subjects[subject] = {"scene": scene, "digest": content,
                             "max_mib": max_mib, "cache": bool(cache)}
    return subjects


def _two(name: str, solids: Any) -> tuple[Any, Any]:
    if not isinstance(solids, tuple) or len(solids) != 2:
        raise InputError(
            f"pairs: {name}: expected (robot, obstacle), found {solids!r}")
    return solids


def _file_name(name: str) -> str:
    if not name or name.startswith(".") or "/" in name:
        raise InputError(
            f"pairs: expected names that can be files, found {name!r}")
    return name


def _require_files(sweep: Sweep, folder: Path) -> None:
    """Rows may be older than the folder, or of workers that see another."""
    for row in sweep.read():
        file = folder / f"{row['pair']}.off"
        if row["outcome"] == "done" and not file.is_file():
            raise SweepError(
                f"{file}: expected the contact space that {sweep.output} has a "
                "row of, found none; workers and client need one folder; remove "
                "the rows to build again")


def _finite(values: Floats, name: str) -> Floats:
    if not np.isfinite(values).all():
        raise InputError(f"{name}: expected finite numbers, found others")
    return values


def _turns(orientations: ArrayLike | None, count: int) -> list[Any]:
    if orientations is None:
        return [None] * count
    turns = _finite(rows(orientations, "orientations", 4), "orientations")
    if len(turns) not in (1, count):
        raise InputError(f"orientations: expected one or {count}, as there are "
                         f"positions, found {len(turns)}")
    found: list[Any] = np.broadcast_to(turns, (count, 4)).tolist()
    return found
