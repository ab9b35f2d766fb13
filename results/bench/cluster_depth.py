# SPDX-License-Identifier: GPL-3.0-or-later
"""A hundred thousand rows on one worker and on two, in turn: the depth of a ball
in a wrench at as many poses, and that of a box in another, which takes so little
that the client beside the workers is what counts.

The two clusters are there all the time and do slice after slice of the rows,
one first in one slice, the other first in the next, so that whatever else the
machine does meets both.  Beside the walls stands what they are made of: the
processor time that the workers had, and the time that Dask's workers say their
tasks took, from which the simulation predicts the walls.
"""

from __future__ import annotations

import asyncio
import json
import os
import statistics

import numpy as np
import psutil
from cluster_simulation import simulate
from distributed import get_task_stream
from peers_shapes import of_scene, solid_of
from phongpd import cluster

ROWS, SLICES, BATCH = 100_000, 10, 100
COLUMNS = ["pair", "slice", "rows", "workers", "wall, s", "workers' processor, s",
           "processor a worker had", "in tasks, s", "simulated wall, s",
           "load average"]


def _box(half):
    return solid_of([([-half] * 3, [half] * 3)], "box")


def _pairs():
    """Name, robot, obstacle."""
    return [("ball in wrench", *of_scene("ball_wrench")),
            ("box in box", _box(0.5), _box(1.0))]


def _poses(robot, obstacle, random):
    """Where their boxes meet."""
    low, high = (np.array(getattr(obstacle.vertices, end)(axis=0))
                 - getattr(robot.vertices, other)(axis=0)
                 for end, other in (("min", "max"), ("max", "min")))
    return random.uniform(low, high, (ROWS, 3))


def _processor_seconds(client):
    times = [psutil.Process(p).cpu_times() for p in client.run(os.getpid).values()]
    return sum(one.user + one.system for one in times)


def _one_run(client, workers, pair, number, poses, folder, costs):
    """A row of the table."""
    name, robot, obstacle = pair
    output = folder / f"{name}-{number}-{workers}.jsonl"
    before = _processor_seconds(client)
    with get_task_stream(client) as stream:
        done = cluster.depth(robot, obstacle, poses, output=output,
                             client=client, batch=BATCH)
    spent = _processor_seconds(client) - before
    tasks = [one["stop"] - one["start"]
             for task in stream.data if "phongpd-depth" in str(task["key"])
             for one in task["startstops"] if one["action"] == "compute"]
    assert len(tasks) * BATCH == done.rows == len(poses)
    made = asyncio.run(simulate(workers, 1, tasks, costs))
    return (name, number, done.rows, workers, done.seconds, spent,
            spent / done.seconds / workers, sum(tasks), made.seconds,
            os.getloadavg()[0])


def measure(one, two, seed, folder, costs):
    """one, two: clients of so many workers.  The table, two rows a slice."""
    random = np.random.default_rng(seed)
    table = []
    for pair in _pairs():
        name, robot, obstacle = pair
        poses = _poses(robot, obstacle, random)
        for number, part in enumerate(np.split(poses, SLICES)):
            turns = [(one, 1), (two, 2)][::1 if number % 2 else -1]
            if number == 0:  # connects, and prepares the solids
                for client, workers in turns:
                    cluster.depth(robot, obstacle, part[:4 * BATCH],
                                  client=client, batch=BATCH,
                                  output=folder / f"{name}-first-{workers}.jsonl")
            table += sorted((_one_run(client, workers, pair, number, part, folder,
                                      costs) for client, workers in turns),
                            key=lambda row: row[3])
        files = [folder / f"{name}-{i}-{n}.jsonl" for i in range(SLICES)
                 for n in (1, 2)]
        rows = [[cluster.without_timing(row) for row in _rows_of(file)]
                for file in files]
        assert rows[::2] == rows[1::2], "the rows depend on the number of workers"
    return table


def _rows_of(file):
    with open(file, encoding="utf-8") as lines:
        return [json.loads(line) for line in lines]


def findings(table):
    """Lines of README.md."""
    pairs = dict.fromkeys(row[0] for row in table)
    errors = [abs(row[8] / row[4] - 1) for row in table]
    return [
        *(_finding([row for row in table if row[0] == pair]) for pair in pairs),
        "- The simulation, given the times of the tasks, predicts the wall time "
        f"of the {len(table)} runs within {100 * statistics.median(errors):.2g} % "
        f"(median), {100 * max(errors):.2g} % (worst): it knows nothing of cores "
        "that are shared, with scheduler and client or with other jobs.",
    ]


def _finding(table):
    """Of one pair."""
    ones = [row for row in table if row[3] == 1]
    twos = [row for row in table if row[3] == 2]
    ratios = [a[4] / b[4] for a, b in zip(ones, twos)]
    whole = sum(a[4] for a in ones) / sum(b[4] for b in twos)
    had = [statistics.median(row[6] for row in some) for some in (ones, twos)]
    work = sum(b[5] for b in twos) / sum(a[5] for a in ones)
    load = statistics.median(row[9] for row in table)
    each = 1e3 * sum(row[5] for row in ones) / sum(row[2] for row in ones)
    return (
        f"- Two workers against one, {table[0][0]}, {ROWS:,} rows ({each:.2g} ms "
        f"of processor time each, {BATCH} a task): {whole:.3g} times as fast in "
        f"all, median of {len(ratios)} pairs {statistics.median(ratios):.3g} "
        f"({min(ratios):.3g} to {max(ratios):.3g}; aim: 1.8), at a load average "
        f"of {load:.2g} on {os.cpu_count()} cores. Two workers spent {work:.3g} "
        "times the processor time of one on the same rows, and each had "
        f"{had[1]:.2g} of a core, the one alone {had[0]:.2g}: scheduler, client "
        "and other jobs have the rest of the cores.")
