# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps on up to a thousand workers, simulated event by event.

Dask's own Scheduler decides and is what costs: every message that it would get
is handed to it, the processor time it takes then is what the simulated
scheduler is busy for.  What messages cost it beyond that (to be read, written
and gathered) is given as measured (`Costs`).  Simulated are the clock, the
wire (a constant latency) and the workers: they are busy with a row for the time
that a real one took.  Left out: heartbeats, work stealing, lost messages, and
the building of a scene's contact space on every worker.
"""

from __future__ import annotations

import heapq
import itertools
import time
from collections import deque
from dataclasses import dataclass

from distributed import Client, Scheduler
from distributed.scheduler import DEFAULT_EXTENSIONS, ClientState
from phongpd.cluster import _run
from phongpd.cluster._jobs import Job, batches
from phongpd.cluster._work import keep, run_batch

CLIENT = "client"
LATENCY = 0.5e-3  # seconds, one way
# Stealing looks at workers that are not there, and fails at every transition.
_EXTENSIONS = {name: extension for name, extension in DEFAULT_EXTENSIONS.items()
               if name != "stealing"}
# Of a worker's first heartbeat.
_METRICS = {"memory": 1, "cpu": 0, "managed_bytes": 0, "spilled_bytes": {
    "memory": 0, "disk": 0}, "event_loop_interval": 0.02, "task_counts": {},
    "bandwidth": {"total": 1e8, "workers": {}, "types": {}},
    "digests_total_since_heartbeat": {}, "transfer": {}}


@dataclass(frozen=True)
class Costs:
    """Processor seconds for every task of `batch` rows, as measured."""

    scheduler: float  # beyond the state machine
    client: float
    worker: float  # beyond the row


class _Mailbox:
    """What the scheduler writes to a worker or the client."""

    def __init__(self, owner, sent):
        self._owner, self._sent = owner, sent

    def send(self, *messages):
        self._sent += ((self._owner, message) for message in messages)

    async def write(self, message):
        del message

    def closed(self):
        return False


class _FakeScheduler(Scheduler):
    """Never started: it listens to nobody, and its clock is not asked."""

    async def handle_worker(self, comm, worker):
        self.stream_comms[worker] = comm


@dataclass
class _Machine:
    """Something that does one thing after the other."""

    free_at: float = 0.0
    busy: float = 0.0

    def work(self, arrival, cost):
        self.free_at = max(self.free_at, arrival) + cost
        self.busy += cost
        return self.free_at


@dataclass
class Outcome:
    workers: int
    batch: int
    tasks: int
    rows_per_second: float
    efficiency: float  # of the workers' time, the share spent on rows
    # The same between the first and the last fifth of the tasks: without the
    # start, and without the end, where some workers have nothing left.
    steady_rows_per_second: float
    steady_efficiency: float
    seconds: float
    scheduler_busy: float  # seconds
    client_busy: float


class Simulation:
    def __init__(self, client, captured, workers, batch, seconds, costs):
        """client: a real one, of which `captured` collects what it would send.
        seconds: of the rows, one each."""
        self._client, self._captured = client, captured
        self._costs = costs
        jobs = [Job.of("convergence", "scene", {"row": i})
                for i in range(len(seconds))]
        self._time_of = {job.key: s for job, s in zip(jobs, seconds)}
        self._todo = deque(batches(jobs, batch))
        self._batch_of = {one.name: one for one in self._todo}
        self._tasks, self._batch = len(self._todo), batch
        self._workers = {f"tcp://10.0.{i // 250}.{i % 250}:1": _Machine()
                         for i in range(workers)}
        self._window = max(_run.LEAST_TASKS, _run.TASKS_PER_THREAD * workers)
        self._in_flight = 0
        self._scheduler, self._client_machine = _Machine(), _Machine()
        self._events, self._count = [], itertools.count()
        self._sent = []  # by the scheduler: receiver, message
        self._last = 0.0
        self._ends = []  # when the client had a task's rows

    async def run(self):
        self._dask = _FakeScheduler(
            dashboard=False, dashboard_address="127.0.0.1:0",
            extensions=_EXTENSIONS)
        for i, address in enumerate(self._workers):
            await self._dask.add_worker(
                _Mailbox(address, self._sent), address=address, status="running", server_id=address,
                nthreads=1, name=i, resolve_address=False, now=time.time(),
                resources={}, memory_limit=2 ** 32, metrics=_METRICS,
                services={}, local_directory="", versions={}, nanny="",
                extra={}, stimulus_id="start")
        self._dask.clients[CLIENT] = ClientState(CLIENT, versions={})
        self._dask.client_comms[CLIENT] = _Mailbox(CLIENT, self._sent)
        self._submit(0.0)
        while self._events:
            when, _, what, arguments = heapq.heappop(self._events)
            await getattr(self, what)(when, *arguments)
        rows = sum(self._time_of.values())
        fifth = len(self._ends) // 5
        span = self._ends[-fifth] - self._ends[fifth]
        steady = self._batch * (len(self._ends) - 2 * fifth) / span
        return Outcome(
            len(self._workers), self._batch, self._tasks,
            len(self._time_of) / self._last,
            rows / (len(self._workers) * self._last), steady,
            steady * rows / len(self._time_of) / len(self._workers),
            self._last, self._scheduler.busy, self._client_machine.busy)

    def _at(self, when, what, *arguments):
        heapq.heappush(self._events, (when, next(self._count), what, arguments))

    # The client, as _run.Driver does it.

    def _submit(self, now):
        if not self._todo or self._in_flight > 3 * self._window // 4:
            return
        lot = [self._todo.popleft() for _ in range(
            min(self._window - self._in_flight, len(self._todo)))]
        self._in_flight += len(lot)
        begin = time.process_time()
        if not hasattr(self, "_subject"):
            self._subject = self._client.submit(keep, {"scene": "u_axis"},
                                                key="phongpd-subject-0")
        # Held until the task is over, as the driver does.
        self._futures = self._client.map(run_batch, lot, subject=self._subject,
                                         key=[one.name for one in lot])
        # What the client spends on a task is in Costs: this is a part of it.
        spent = time.process_time() - begin
        sent = self._client_machine.work(now, spent)
        while self._captured:
            self._at(sent + LATENCY, "_graph", self._captured.pop(0))

    async def _arrived(self, now, keys):
        cost = self._costs.client * len(keys)
        end = self._client_machine.work(now, cost)
        self._last = max(self._last, end)
        self._ends += [end] * len(keys)
        self._in_flight -= len(keys)
        self._at(end + LATENCY, "_released", keys)
        self._submit(end)

    # The scheduler.

    async def _graph(self, now, message):
        begin = time.process_time()
        await self._dask.update_graph(client=CLIENT, **message)
        self._deliver(now, time.process_time() - begin)

    async def _released(self, now, keys):
        begin = time.process_time()
        self._dask.client_releases_keys(keys=keys, client=CLIENT)
        self._deliver(now, time.process_time() - begin)

    async def _finished(self, now, worker, key, run_id, seconds):
        stop = time.time()
        begin = time.process_time()
        self._dask.handle_task_finished(
            key=key, worker=worker, stimulus_id=f"task-finished-{key}",
            run_id=run_id, metadata={}, nbytes=1500, typename="list", type=b"",
            thread=1, startstops=({"action": "compute", "start": stop - seconds,
                                   "stop": stop},))
        spent = time.process_time() - begin
        self._deliver(now, spent + self._costs.scheduler)

    def _deliver(self, arrival, cost):
        end = self._scheduler.work(arrival, cost) + LATENCY
        sent, self._sent[:] = list(self._sent), []
        keys = []
        for owner, message in sent:
            if owner != CLIENT and message["op"] == "compute-task":
                self._compute(end, owner, message)
            elif owner == CLIENT and message["op"] == "key-in-memory":
                keys += [message["key"]] * (message["key"] in self._batch_of)
        if keys:
            self._at(end, "_arrived", keys)

    # The workers.

    def _compute(self, now, address, message):
        key = message["key"]
        one = self._batch_of.get(key)
        seconds = sum(self._time_of[j.key] for j in one.jobs) if one else 0.0
        end = self._workers[address].work(now, seconds + self._costs.worker)
        self._at(end + LATENCY, "_finished", address, key,
                       message["run_id"], seconds)


async def simulate(workers, batch, seconds, costs):
    """An Outcome.  Runs in an event loop of its own."""
    async with Scheduler(protocol="inproc://", dashboard=False,
                         dashboard_address="127.0.0.1:0") as real:
        async with Client(real.address, asynchronous=True,
                          set_as_default=False) as client:
            captured = []
            client._send_to_scheduler = lambda message: captured.append(
                _as_received(message)) if message["op"] == "update-graph" else 0
            one = Simulation(client, captured, workers, batch, seconds, costs)
            try:
                return await one.run()
            finally:
                del client._send_to_scheduler


def _as_received(message):
    """As the scheduler gets it after the wire."""
    return {name: getattr(value, "data", value)
            if type(value).__name__ == "ToPickle" else value
            for name, value in message.items() if name != "op"}
