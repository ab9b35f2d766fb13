# SPDX-License-Identifier: GPL-3.0-or-later
"""results/cluster/README.md and its tables."""

import statistics

from python_report import machine, markdown, versions, write_csv

OVERHEAD = ["workers x threads", "rows a task", "row, ms", "tasks",
            "wall above the row, ms a task", "scheduler, CPU ms",
            "client, CPU ms", "workers, CPU ms"]
SPEED_UP = ["pair", "rows", "one worker, s", "two workers, s", "ratio",
            "load average"]
CHECK = ["threads", "rows", "efficiency, real", "efficiency, simulated"]
SCALING = ["workers", "rows a task", "tasks", "rows a second", "efficiency",
           "scheduler busy", "client busy"]


def _median(rows, column, **wanted):
    return statistics.median(
        row[column] for row in rows
        if all(row[int(k[1:])] == v for k, v in wanted.items()))


def scaling_rows(outcomes):
    return [(o.workers, o.batch, o.tasks, o.rows_per_second, o.efficiency,
             o.scheduler_busy / o.seconds, o.client_busy / o.seconds)
            for o in outcomes]


def _findings(overhead, speed_up, times, costs, outcomes):
    mean = statistics.mean(times)
    ratio = [row[4] for row in speed_up]
    singles = [o for o in outcomes if o.batch == 1]
    # Of a task, what the busier one of scheduler and client spends.
    serial = max(max(o.scheduler_busy, o.client_busy) / o.tasks for o in singles)
    who = max(("scheduler", "client"), key=lambda name: sum(
        getattr(o, f"{name}_busy") for o in singles))
    good = max(o.workers for o in singles if o.efficiency >= 0.8)
    largest = singles[-1]
    tens = [o for o in outcomes if o.batch == 10][-1]
    return [
        f"- Overhead of a task beside rows of 20 ms, one worker: "
        f"{_median(overhead, 4, _1=1, _2=20.0):.2g} ms of wall time (aim: at "
        "most 5). Rows without any work wait for each other's round trips: "
        f"{_median(overhead, 4, _0='1 x 1', _1=1, _2=0.0):.2g} ms on one "
        f"thread, {_median(overhead, 4, _0='4 x 8'):.2g} ms on 32; "
        f"{_median(overhead, 4, _1=100) / 100:.2g} ms a row in tasks of 100 "
        "rows.",
        f"- Two workers against one: {statistics.median(ratio):.3g} times as "
        f"fast, median of {len(ratio)} pairs ({min(ratio):.3g} to "
        f"{max(ratio):.3g}; aim: 1.8), real rows of {1e3 * mean:.3g} ms of "
        "processor time on average. The machine was shared with other jobs "
        f"(load average {speed_up[-1][5]:.2g} on its cores), which take from "
        "two workers more than from one.",
        f"- Simulated with these rows, one a task: 0.8 of the workers' time "
        f"goes into rows up to {good} workers; {largest.workers} workers do "
        f"{largest.rows_per_second:.3g} rows a second, efficiency "
        f"{largest.efficiency:.2g}.",
        f"- Where it stops and why: scheduler and client are one process each, "
        f"and the {who} spends {1e3 * serial:.2g} ms on a task, so that no "
        f"number of workers does more than about {1 / serial:.2g} tasks a "
        f"second: workers beyond (row time) / {1e3 * serial:.2g} ms wait. Tasks "
        f"of 10 rows move that tenfold: {tens.workers} workers do "
        f"{tens.rows_per_second:.3g} rows a second, efficiency "
        f"{tens.efficiency:.2g}.",
        "- For the last few per cent of a sweep some workers have nothing left; "
        "with 10 tasks a worker, as here, that is most of what small numbers of "
        "workers lose.",
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
        ("speed_up.csv", "Two workers against one", SPEED_UP, speed_up,
         "Convergence rows of u_axis, plate:thickness=0.02 and l, two metrics, "
         "three seeds; both clusters are there all the time and take turns."),
        ("check.csv", "The simulation beside the real thing", CHECK, checks,
         "Rows that pause for as long as the real ones take; efficiency: pauses "
         "over wall time times threads. What is lower in reality is what other "
         "jobs took of the machine's two cores."),
        ("scaling.csv", "Scaling, simulated", SCALING, scaling,
         "10 tasks a worker, at least 100; busy: share of the time.")]
    text = ["# Sweeps on Dask", "",
            *_findings(overhead, speed_up, times, costs, outcomes), "",
            _SIMULATED.format(scheduler=1e3 * costs.scheduler,
                              client=1e3 * costs.client,
                              worker=1e3 * costs.worker), "## Tables", ""]
    for file, title, header, rows, note in tables:
        write_csv(folder / file, header, rows)
        text.append(markdown(title, note, header, rows, file))
    write_csv(folder / "row_times.csv", ["processor seconds"],
              [(s,) for s in times])
    text += ["Times of rows, for the simulation: [row_times.csv](row_times.csv)",
             "", f"Command: {how}. Seed: {seed}. Machine: {machine()}. Versions: "
             f"{versions('distributed', 'dask', 'numpy')}.", ""]
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")
