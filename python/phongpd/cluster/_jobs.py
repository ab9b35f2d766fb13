# SPDX-License-Identifier: GPL-3.0-or-later
"""A row to be: what it depends on, and the key that follows from it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from .._native import InputError, __version__


def digest(*parts: Any) -> str:
    """32 hexadecimal digits of the JSON of the parts."""
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@dataclass(frozen=True)
class Job:
    """One row.  Two jobs of one key are one job."""

    kind: str
    """Of the work, a name of _work.WORK; names the task in the dashboard."""
    subject: str
    """Digest of what jobs share: a scene, a pair of solids."""
    arguments: dict[str, Any]
    """What else the row depends on, as JSON has it."""
    key: str

    @classmethod
    def of(cls, kind: str, subject: str, arguments: dict[str, Any]) -> Job:
        return cls(kind, subject, arguments,
                   digest(__version__, kind, subject, arguments))


@dataclass(frozen=True)
class Batch:
    """Jobs of one subject that are one task."""

    jobs: tuple[Job, ...]
    is_alone: bool = False
    """Tried again while nothing else runs."""

    @property
    def subject(self) -> str:
        return self.jobs[0].subject

    @property
    def name(self) -> str:
        """The task's key.  Dask groups tasks by what is before the digits."""
        content = digest(self.is_alone, [job.key for job in self.jobs])
        return f"phongpd-{self.jobs[0].kind}-0{content}"

    def __dask_tokenize__(self) -> str:
        """For Dask, which would go through all arguments of all jobs to name
        what it submits, before the first worker has anything to do."""
        return self.name

    def alone(self) -> Iterator[Batch]:
        """Its jobs as tasks of their own."""
        return (Batch((job,), is_alone=True) for job in self.jobs)


def batches(jobs: Sequence[Job], size: int) -> Iterator[Batch]:
    """In the order of the jobs; up to `size` neighbours of one subject."""
    begin = 0
    while begin < len(jobs):
        end = begin + 1
        while (end < len(jobs) and end - begin < size
               and jobs[end].subject == jobs[begin].subject):
            end += 1
        yield Batch(tuple(jobs[begin:end]))
        begin = end


def indices(jobs: Sequence[Job]) -> dict[str, int]:
    """Of the jobs, by key.  Throws InputError where one is given twice."""
    order: dict[str, int] = {}
    for i, job in enumerate(jobs):
        if order.setdefault(job.key, i) != i:
            raise InputError(
                f"{job.kind}: expected every row once, found rows "
                f"{order[job.key] + 1} and {i + 1} the same: {job.arguments}")
    return order
