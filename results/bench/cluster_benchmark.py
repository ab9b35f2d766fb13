# SPDX-License-Identifier: GPL-3.0-or-later
"""What phongpd.cluster costs, and how far it scales; see `--help`.

Scheduler and workers are processes of their own, on loopback.
"""

import asyncio
import contextlib
import logging
import os
import random
import statistics
import tempfile
import time
from pathlib import Path

import cluster_depth
import psutil
from cluster_report import TASKS_PER_WORKER, write_report
from cluster_simulation import Costs, simulate
from distributed import Client
from distributed.deploy.subprocess import SubprocessCluster
from python_report import parser_of, read_csv
from phongpd.cluster import _run
from phongpd.cluster._jobs import Job

SEED = 1
BUSY = "4 x 8"  # processes x threads that costs are taken from
PARTS = ["overhead", "speed_up", "row_times", "check"]
SEEDS = range(1, 4)  # of the rows that the simulation takes the times of
SIMULATED = [(n, 1) for n in (1, 2, 10, 50, 100, 200, 500, 1000)] + [
    (n, 10) for n in (200, 1000)]


@contextlib.contextmanager
def workers_of_their_own(count, threads=1):
    pauses = str(Path(__file__).with_name("cluster_pauses.py"))
    with SubprocessCluster(
            n_workers=count, threads_per_worker=threads,
            worker_class="distributed.Worker", dashboard_address=None,
            worker_kwargs={"preload": pauses}) as local, \
            Client(local, set_as_default=False) as client:
        client.wait_for_workers(count, timeout=120)
        yield client


def pauses(client, seconds, batch=1):
    """The wall time of a sweep of rows that take so long, and the sweep's."""
    jobs = [Job.of("pause", "pause", {"row": i, "pause": s, "salt": time.time()})
            for i, s in enumerate(seconds)]
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        _run.run(jobs, {"pause": {}}, Path(folder) / "rows.jsonl", client, batch)
        return time.perf_counter() - begin


def processor_seconds(process):
    times = process.cpu_times()
    return times.user + times.system


def measure_overhead(processes, threads, plan):
    """Rows that pause: wall time a task above the pause, and processor time a
    task, for each (batch, tasks, pause) of the plan."""
    rows = []
    with workers_of_their_own(processes, threads) as client:
        sides = [[psutil.Process(client.run_on_scheduler(os.getpid))],
                 [psutil.Process()],
                 [psutil.Process(p) for p in client.run(os.getpid).values()]]
        pauses(client, [0.0] * 100 * processes)
        for batch, tasks, pause in plan:
            before = [sum(map(processor_seconds, side)) for side in sides]
            wall = pauses(client, [pause] * tasks * batch, batch)
            wall -= pause * tasks * batch / (processes * threads)
            spent = [sum(map(processor_seconds, side)) - b
                     for side, b in zip(sides, before)]
            rows.append((f"{processes} x {threads}", batch, 1e3 * pause, tasks,
                         *(1e3 * s / tasks for s in (wall, *spent)),
                         os.getloadavg()[0]))
    return rows


def measure_speed_up(costs):
    """A hundred thousand rows on one worker and on two, in turn."""
    with tempfile.TemporaryDirectory() as folder, \
            workers_of_their_own(1) as one, workers_of_their_own(2) as two:
        return cluster_depth.measure(one, two, SEED, Path(folder), costs)


def row_times():
    """Processor seconds of real rows, in this process, one after the other."""
    from phongpd import _native
    seconds = []
    for scene in ("u_axis", "plate:thickness=0.02", "l"):
        study = _native.Comparison(scene, 0.0, False)
        study.row(1, "straight-adaptive", "euclidean")
        for seed in SEEDS:
            for metric in ("euclidean", "phong@0.2"):
                begin = time.process_time()
                study.row(seed, "straight-adaptive", metric)
                seconds.append(time.process_time() - begin)
    return seconds


def costs_of(overhead):
    """What a task of a busy scheduler costs beside what the simulation runs."""
    busy = [row for row in overhead if row[0] == BUSY]
    scheduler, client, worker = (
        statistics.median(row[k] for row in busy) / 1e3 for k in (5, 6, 7))
    bare = asyncio.run(simulate(32, 1, [0.0] * 1000, Costs(0.0, 0.0, 1e-4)))
    return Costs(max(scheduler - bare.scheduler_busy / bare.tasks, 0.0),
                 max(client - bare.client_busy / bare.tasks, 0.0), worker)


def sampled(times, count):
    return random.Random(SEED).choices(times, k=count)


def check_simulation(times, costs):
    """Real schedulers and workers that pause, beside the simulation."""
    rows = []
    for processes, threads in ((2, 1), (4, 8)):
        slots = processes * threads
        seconds = sampled(times, 20 * slots)
        with workers_of_their_own(processes, threads) as client:
            pauses(client, [0.0] * 10 * slots)
            real = sum(seconds) / (slots * pauses(client, seconds))
        made = asyncio.run(simulate(slots, 1, seconds, costs))
        rows.append((slots, len(seconds), real, made.efficiency))
    return rows


def simulate_all(times, costs):
    return [asyncio.run(simulate(
        workers, batch, sampled(times, TASKS_PER_WORKER * batch * max(workers, 10)),
        costs)) for workers, batch in SIMULATED]


def measure_all_overhead():
    overhead = measure_overhead(1, 1, [
        *[(1, 500, 0.0)] * 3, *[(1, 200, 0.02)] * 3, (100, 50, 0.0)])
    return overhead + measure_overhead(4, 8, [(1, 3000, 0.0)] * 3)


def tables(folder, parts):
    """Overhead, speed-up, times of rows, and the check of the simulation:
    measured, or as an earlier run has left them."""
    found = {}

    def find(name, measure):
        if name in parts:
            found[name] = measure()
            print(f"{name} measured", flush=True)
        else:
            found[name] = read_csv(folder / f"{name}.csv")
        return found[name]

    costs = costs_of(find("overhead", measure_all_overhead))
    find("speed_up", lambda: measure_speed_up(costs))
    find("row_times", lambda: [[seconds] for seconds in row_times()])
    times = found["row_times"] = [row[0] for row in found["row_times"]]
    find("check", lambda: check_simulation(times, costs))
    return found


def main():
    parser = parser_of(__doc__, "cluster_benchmark.py")
    parser.add_argument("--measure", nargs="*", default=PARTS, choices=PARTS,
                        help="what to measure; the others are the tables in the "
                        "folder, but for what is simulated with them")
    arguments = parser.parse_args()
    logging.disable(logging.WARNING)
    found = tables(arguments.output, arguments.measure)
    overhead, times = found["overhead"], found["row_times"]
    costs = costs_of(overhead)
    write_report(arguments.output, arguments.how, SEED, overhead,
                 found["speed_up"], times, costs, found["check"],
                 simulate_all(times, costs))


if __name__ == "__main__":
    main()
