# SPDX-License-Identifier: GPL-3.0-or-later
"""results/cluster/README.md and its tables."""

import os
import statistics

import cluster_depth
from python_report import machine, versions, write_csv, write_tables

TASKS_PER_WORKER = 8
OVERHEAD = ["workers x threads", "rows a task", "row, ms", "tasks",
            "wall above the row, ms a task", "scheduler, CPU ms",
            "client, CPU ms", "workers, CPU ms", "load average"]
CHECK = ["threads", "rows", "efficiency, real", "efficiency, simulated"]
SCALING = ["workers", "rows a task", "tasks", "rows a second", "efficiency",
           "rows a second, steady", "efficiency, steady", "scheduler busy",
           "client busy"]


def _median(rows, column, **wanted):
    return statistics.median(
        row[column] for row in rows
        if all(row[int(k[1:])] == v for k, v in wanted.items()))


def scaling_rows(outcomes):
    return [(o.workers, o.batch, o.tasks, o.rows_per_second, o.efficiency,
             o.steady_rows_per_second, o.steady_efficiency,
             o.scheduler_busy / o.seconds, o.client_busy / o.seconds)
            for o in outcomes]


def _measured(overhead, speed_up):
    def wall(**wanted):
        return _median(overhead, 4, **wanted)

    def processors(**wanted):
        return sum(_median(overhead, k, **wanted) for k in (5, 6, 7))

    load = statistics.median(row[8] for row in overhead)
    return [
        "- Overhead of a task beside rows of 20 ms, one worker: "
        f"{wall(_1=1, _2=20.0):.2g} ms of wall time (aim: at most 5), at a load "
        f"average of {load:.2g} on {os.cpu_count()} cores, of which these "
        "processes are a part; other jobs delay every message. Processor time of a task, all processes together: "
        f"{processors(_0='1 x 1', _1=1, _2=20.0):.2g} ms where tasks come one by "
        f"one, {processors(_0='4 x 8'):.2g} ms where they come in a stream.",
        "- Rows without any work wait for round trips: "
        f"{wall(_0='1 x 1', _1=1, _2=0.0):.2g} ms a row on one thread, "
        f"{wall(_0='4 x 8'):.2g} ms on 32; {wall(_1=100) / 100:.2g} ms in tasks "
        "of 100 rows.",
        *cluster_depth.findings(speed_up),
    ]


def _simulated(times, outcomes):
    mean = statistics.mean(times)
    singles = [o for o in outcomes if o.batch == 1]
    largest = max(singles, key=lambda o: o.workers)
    tens = [o for o in outcomes if o.batch == 10][-1]
    good = max(o.workers for o in singles if o.steady_efficiency >= 0.8)
    # Of a task, what the busier one of scheduler and client spends.
    who = max(("scheduler", "client"),
              key=lambda name: getattr(largest, f"{name}_busy"))
    serial = getattr(largest, f"{who}_busy") / largest.tasks
    return [
        "- Simulated with these rows, one a task: once tasks are submitted and "
        f"while there are some for all, 0.8 of the workers' time goes into rows "
        f"up to {good} workers; "
        f"{largest.workers} workers do {largest.steady_rows_per_second:.3g} rows "
        f"a second, efficiency {largest.steady_efficiency:.2g}.",
        "- Where it stops and why: scheduler and client are one process each, "
        f"and the {who} spends {1e3 * serial:.2g} ms on a task of "
        f"{largest.workers} workers, its submission included. No number of "
        f"workers does more than {1 / serial:.2g} tasks a second for long; with "
        f"rows of {1e3 * mean:.3g} ms {mean / serial:.3g} workers do that. In "
        f"tasks of 10 rows {tens.workers} workers do "
        f"{tens.steady_rows_per_second:.3g} rows a second, efficiency "
        f"{tens.steady_efficiency:.2g}.",
        "- The end of a sweep costs besides: the longest row takes "
        f"{max(times) / mean:.2g} times the mean, and while it runs other "
        f"workers have nothing left. With {TASKS_PER_WORKER} tasks a worker, as "
        f"here, efficiency over the whole sweep is {largest.efficiency:.2g} and "
        f"{tens.efficiency:.2g}.",
    ]


_SIMULATED = """\
## What is simulated

Real: Dask's `Scheduler`, which is handed every message and decides, and the
processor time that takes; the client's submitting; the rows' times. Given: what
a task costs scheduler ({scheduler:.2g} ms), client ({client:.2g} ms) and worker
({worker:.2g} ms) beyond that, measured above on 32 busy threads. Simulated: the
clock, the wire (0.5 ms a message), the workers, which are busy for a row's time.
Left out: heartbeats, work stealing, memory, and building the contact space of a
scene once on every worker.
"""


def write_report(folder, how, seed, overhead, speed_up, times, costs, checks,
                 outcomes):
    folder.mkdir(parents=True, exist_ok=True)
    scaling = scaling_rows(outcomes)
    tables = [
        ("overhead.csv", "Overhead", OVERHEAD, overhead,
         "Rows that pause instead of computing, 1.6 kB of JSON each; scheduler, "
         "client and workers are processes of their own on loopback."),
        ("speed_up.csv", "Two workers against one", cluster_depth.COLUMNS,
         speed_up,
         "Depth at random poses; both clusters are there all the time and take "
         "turns, each slice in the other order. In tasks: wall time of the tasks "
         "as workers tell it; what they had of the cores is in it, and so it is in "
         "the simulated wall."),
        ("check.csv", "The simulation beside the real thing", CHECK, checks,
         "Rows that pause for as long as the real ones take; efficiency: pauses "
         "over wall time times threads. The simulation gives every thread a core "
         "of its own, and knows nothing of other jobs, which delay every message "
         "(load average above)."),
        ("scaling.csv", "Scaling, simulated", SCALING, scaling,
         f"{TASKS_PER_WORKER} tasks a worker, for at least 10 workers; steady: "
         "without the first and the last fifth of the tasks; busy: share of the "
         "time.")]
    text = ["# Sweeps on Dask", "",
            *_measured(overhead, speed_up),
            *_simulated(times, outcomes), "",
            _SIMULATED.format(scheduler=1e3 * costs.scheduler,
                              client=1e3 * costs.client,
                              worker=1e3 * costs.worker),
            write_tables(folder, "Sweeps on Dask", tables), ""]
    write_csv(folder / "row_times.csv", ["processor seconds"],
              [(s,) for s in times])
    text += ["Times of rows, for the simulation: [row_times.csv](row_times.csv)",
             "", f"Command: {how}. Seed: {seed}. Machine: {machine()}. Versions: "
             f"{versions('distributed', 'dask', 'numpy')}.", ""]
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")
