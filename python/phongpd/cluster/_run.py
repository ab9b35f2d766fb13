# SPDX-License-Identifier: GPL-3.0-or-later
"""The client's side: tasks out, rows in, whatever happens in between."""

from __future__ import annotations

import contextlib
import json
import os
import time
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from distributed import Client, Future, KilledWorker, LocalCluster, \
    as_completed
from distributed.comm.core import CommClosedError

from .._arguments import whole_number
from .._frames import frame_of
from .._native import InputError
from ._jobs import Batch, Job, batches, digest, indices
from ._parquet import write_parquet
from ._rows import RowStore
from ._work import SweepError, keep, run_batch

# Tasks that are with the scheduler at a time, for each thread and at least:
# enough for workers never to wait, few enough to cost little memory.
TASKS_PER_THREAD, LEAST_TASKS = 20, 1000
# Between two looks at what has arrived: rows are fetched in lots, as asking for
# them one by one costs all sides more than making a short one.
FETCH_SECONDS = 0.05
# What Dask raises where the connection is cut in the middle of something.
_CUT = (CancelledError, CommClosedError, OSError)


@dataclass(frozen=True)
class Sweep:
    """What a sweep did."""

    output: Path
    rows: int
    """In the output."""
    kept: int
    """Of them, those that were there before."""
    repeated: int
    """Rows that came a second time, and were dropped."""
    reconnections: int
    """How often the scheduler was lost and found again."""
    seconds: float

    def read(self) -> Iterator[dict[str, Any]]:
        """The rows, as dicts."""
        with open(self.output, encoding="utf-8") as file:
            for line in file:
                yield json.loads(line)

    def frame(self) -> Any:
        """The rows as a pandas.DataFrame, all in memory; nested values have
        columns such as "seconds.total".  Needs pandas."""
        return frame_of(self.read(), "frame")

    def write_parquet(self, path: str | os.PathLike[str]) -> int:
        """The rows as columns, by cluster.write_parquet."""
        return write_parquet(self.output, path)


def run(jobs: Sequence[Job], subjects: Mapping[str, dict[str, Any]],
        output: str | os.PathLike[str], client: Client | None,
        batch: int) -> Sweep:
    """Runs the jobs that have no row yet; returns when all have one."""
    size = whole_number(batch, "batch", 1)
    begin = time.perf_counter()
    path = Path(os.fspath(output))
    with RowStore(path, indices(jobs)) as store:
        kept = len(store)
        missing = [job for job in jobs if job.key not in store]
        driver = Driver(subjects, store)
        if missing:
            with connection(client) as connected:
                driver.run(connected, list(batches(missing, size)))
        store.finish()
    return Sweep(path, len(jobs), kept, driver.repeated, driver.reconnections,
                 time.perf_counter() - begin)


@contextlib.contextmanager
def connection(client: Client | None) -> Iterator[Client]:
    """The client, or one to workers on this machine's cores."""
    if client is not None:
        if not isinstance(client, Client) or client.asynchronous:
            raise InputError(
                "client: expected a dask.distributed.Client that is not "
                f"asynchronous, found {type(client).__name__}")
        yield client
        return
    with LocalCluster(threads_per_worker=1) as cluster, Client(cluster) as own:
        try:
            yield own
        finally:
            # Dask cannot close a cluster one of whose workers, killed before,
            # is just starting again: that would hide what went wrong.
            with contextlib.suppress(TimeoutError):
                own.wait_for_workers(len(cluster.workers), timeout=30)


class Store(Protocol):
    """Where rows go."""

    def add(self, key: str, line: str) -> bool:
        """False: a row of that key is there already; it stays."""

    def state(self) -> str:
        """What is safe, for who is told that something went wrong."""


class Driver:
    """One sweep's tasks: which wait, which are with the scheduler."""

    def __init__(self, subjects: Mapping[str, dict[str, Any]],
                 store: Store) -> None:
        self._subjects = subjects
        self._store = store
        self._shared: dict[str, Future[Any]] = {}
        self._sent: dict[Future[Any], Batch] = {}
        self._suspects: list[Batch] = []
        self._failed: list[tuple[Batch, str]] = []
        self.repeated = 0
        self.reconnections = 0

    def run(self, client: Client, todo: list[Batch]) -> None:
        """Raises SweepError where rows are missing in the end."""
        try:
            self._drain(client, todo)
            # Dask suspects all tasks of a worker that dies, those that waited
            # there, too: only what kills workers when it is alone is guilty.
            suspects, self._suspects = self._suspects, []
            for one in (job for batch in suspects for job in batch.alone()):
                self._drain(client, [one])
        finally:
            if client.status == "running":
                client.cancel(list(self._sent))
        if self._failed:
            raise self._failure()

    def _drain(self, client: Client, todo: list[Batch]) -> None:
        waiting = deque(todo)
        arrivals = as_completed(loop=client.loop)
        while waiting or self._sent:
            self._send(client, waiting, arrivals)
            time.sleep(FETCH_SECONDS)
            lost = self._receive(client, arrivals.next_batch(block=True))
            if lost:
                waiting.extendleft(reversed(lost))
                self._await_scheduler(client)

    def _send(self, client: Client, waiting: deque[Batch],
              arrivals: as_completed) -> None:
        room = self._room(client) if waiting else 0
        lots: dict[str, list[Batch]] = {}
        for _ in range(min(room, len(waiting))):
            one = waiting.popleft()
            lots.setdefault(one.subject, []).append(one)
        for subject, lot in lots.items():
            futures = client.map(
                run_batch, lot, subject=self._subject(client, subject),
                key=[one.name for one in lot])
            self._sent.update(zip(futures, lot))
            arrivals.update(futures)

    def _subject(self, client: Client, subject: str) -> Any:
        """What the tasks of a subject share.  Its content is in the graph, so
        that it is made anew when the worker that held it dies."""
        if subject not in self._shared:
            self._shared[subject] = client.submit(
                keep, self._subjects[subject],
                key=f"phongpd-subject-0{digest(subject)}")
        return self._shared[subject]

    def _receive(self, client: Client,
                 arrived: Sequence[Future[Any]]) -> list[Batch]:
        """Stores rows; returns the tasks of which nobody knows any more."""
        finished = [f for f in arrived if f.status == "finished"]
        try:
            results = client.gather(finished)
        except _CUT:
            results, finished = [], []
        for future, rows in zip(finished, results):
            for key, line in rows:
                self.repeated += not self._store.add(key, line)
            del self._sent[future]
        lost = []
        for future in arrived:
            if future not in self._sent:
                continue
            one = self._sent.pop(future)
            if future.status == "error":
                self._note_failure(one, future)
            else:
                lost.append(one)
        return lost

    def _note_failure(self, one: Batch, future: Future[Any]) -> None:
        error = future.exception()
        if isinstance(error, SweepError):
            raise SweepError(f"{error}; {self._store.state()}")
        if isinstance(error, KilledWorker) and not one.is_alone:
            self._suspects.append(one)
            return
        cause = error.__cause__ or error
        self._failed.append((one, f"{type(cause).__name__}: {cause}"))

    def _await_scheduler(self, client: Client) -> None:
        """The client reconnects by itself, for its timeout."""
        self._shared.clear()
        while client.status == "connecting":
            time.sleep(0.05)
        if client.status != "running":
            raise SweepError(f"the scheduler is gone; {self._store.state()}")
        self.reconnections += 1

    def _failure(self) -> SweepError:
        one, reason = self._failed[0]
        count = sum(len(lost.jobs) for lost, _ in self._failed)
        return SweepError(
            f"{count} rows could not be made, the first of them "
            f"{one.jobs[0].kind} {one.jobs[0].arguments}: "
            f"{' '.join(reason.split())}; {self._store.state()}")

    def _room(self, client: Client) -> int:
        """For how many tasks more; 0 until it is worth the while: submitting
        them one by one costs the client a millisecond each."""
        window = LEAST_TASKS
        if len(self._sent) > 3 * window // 4:
            with contextlib.suppress(*_CUT):
                threads = sum(int(n) for n in client.nthreads().values())
                window = max(window, TASKS_PER_THREAD * threads)
        room = window - len(self._sent)
        return room if 4 * room >= window else 0
