# SPDX-License-Identifier: GPL-3.0-or-later
"""OMPL.app's own problems for a robot that turns, planned by `phongpd plan` from a
checkout of the user's; their meshes are not ours to hand on:

    results/bench/rigid_ompl_app.py CHECKOUT/resources/3D --output results/rigid \\
        --rows build/rigid/ompl_app

A run is a process on one thread; its seconds are of the processor, reading of the
meshes and shortening of the path included. One more of each seed, as users have it, on
two threads, has seconds of wall time."""
import json
import resource
import signal
import statistics
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

import kept_rows as rows
from python_report import cell, machine, read_dicts, write_csv
from report_statistics import wilson

SEEDS, LIMIT = 10, 60
# Problems and how many seeds: those that take the whole limit have few, and one whose
# goal collides asks no seed.
PROBLEMS = {name: SEEDS for name in (
    "Easy", "cubicles", "Abstract", "Home", "Twistycool", "Apartment",
    "Apartment_hard", "bugtrap", "alpha-1.5", "Twistycooler", "alpha-1.2")}
PROBLEMS.update({"escape": 1, "alpha-1.1": 3, "spirelli": 3})
HEADER = ("problem", "seed", "status", "certified", "planner", "seconds", "length",
          "wall_seconds")


class Run(NamedTuple):
    scene: str
    pair: int  # the seed

    @property
    def key(self):
        return f"{self.scene} {self.pair}"


def plan_of(program, folder, one):
    return [program, "plan", folder / f"{one.scene}.cfg", "--seed", str(one.pair),
            "--json"]


def wall_seconds(program, folder, one):
    """Until a path is proved, by default: on two threads.  None: none is."""
    begin = time.monotonic()
    answer = subprocess.run(
        [*plan_of(program, folder, one), "--time", str(LIMIT)],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.monotonic() - begin if answer.returncode == 0 else None


def measure(program, folder, one):
    return {**on_one_thread(program, folder, one),
            "wall_seconds": wall_seconds(program, folder, one)}


def on_one_thread(program, folder, one):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # The kernel ends it: the clock of a machine that others use runs ahead of the
    # processor's, so the program's own limit is far off.
    answer = subprocess.run(
        [*plan_of(program, folder, one), "--threads", "1", "--time", "1h"],
        capture_output=True, text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU,
                                              (LIMIT, LIMIT + 1)))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    row = {"key": one.key, "scene": one.scene, "pair": one.pair,
           "seconds": after.ru_utime + after.ru_stime - before.ru_utime
           - before.ru_stime}
    if answer.returncode == -signal.SIGXCPU:
        return {**row, "status": "time_limit", "certified": False}
    if answer.returncode not in (0, 1):
        raise RuntimeError(answer.stderr.strip().splitlines()[-1])
    told = json.loads(answer.stdout.splitlines()[0])
    return {**row, "status": told["status"], "certified": told["collision_free"],
            "planner": told["planner"], "length": told["path_length"]}


def solved(row):
    return row["status"] == "solved" and row["certified"] == "yes"


def has_wall(found):
    """Rows that were made before the planner had threads have none."""
    return "wall_seconds" in found[0]


def lines(found):
    """Of the rows of ompl_app.csv, a line a problem."""
    two = has_wall(found)
    yield ("| problem | seeds | a certified path within the limit (95 %) | seconds, "
           "median of these | most | else |"
           + " on two threads | wall seconds, median of these | most |" * two)
    yield "|---|---:|---:|---:|---:|---|" + "---:|---:|---:|" * two
    for problem in dict.fromkeys(r["problem"] for r in found):
        of = [r for r in found if r["problem"] == problem]
        good = [float(r["seconds"]) for r in of if solved(r)]
        low, high = wilson(len(good), len(of))
        wall = [float(r["wall_seconds"]) for r in of if r.get("wall_seconds")]
        yield "| " + " | ".join(
            [problem, cell(len(of)),
             f"{len(good)} ({100 * low:.0f} – {100 * high:.0f} %)",
             cell(statistics.median(good)) if good else "",
             cell(max(good)) if good else "",
             ", ".join(sorted({r["status"] for r in of if not solved(r)})),
             *[cell(len(wall)), *([cell(statistics.median(wall)), cell(max(wall))]
                                  if wall else ["", ""])] * two]) + " |"


def page(found, how):
    table = "\n".join(lines(found))
    two = f"""
- On two threads, which is the default, the limit is {LIMIT} s of wall time, on a machine
  with whatever else it does.""" if has_wall(found) else ""
    return f"""# OMPL.app's own problems

Question: what does `phongpd plan` make of the problems that OMPL.app comes with, whose
meshes are not ours and not here? They are read from a checkout: `phongpd plan
alpha-1.5.cfg`. The limit is {LIMIT} s of the processor for a run, on one core, with all
of it counted: reading, planning, shortening and the proof.

{table}

- No path is wrong: each is proved motion by motion before it is an answer.
- escape is refused, `goal_in_collision`: the goal that its file names touches the tube.
- Beside OMPL: on twins of ours, which are here: [planners](README.md#planners).{two}

Rows: [ompl_app.csv](ompl_app.csv)

{how}
"""


def write(folder, found, how):
    found = sorted(found, key=lambda r: (list(PROBLEMS).index(r["scene"]), r["pair"]))
    write_csv(folder / "ompl_app.csv", HEADER,
              [[r["scene"], r["pair"], r.get("status", "error"),
                cell(r.get("certified", False)), r.get("planner", ""),
                r.get("seconds", 0.0), r.get("length") or "",
                r.get("wall_seconds") or ""] for r in found])
    (folder / "ompl_app.md").write_text(
        page(read_dicts(folder / "ompl_app.csv"), how), encoding="utf-8")


def main():
    parser = rows.parser_for(__doc__, "rigid_ompl_app.py", ["ompl_app"])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--program", default="build/phongpd")
    arguments = parser.parse_args()
    wanted = [Run(problem, seed + 1) for problem, seeds in PROBLEMS.items()
              for seed in range(seeds)]
    rows.run_part(
        arguments, "ompl_app", wanted,
        lambda one: measure(arguments.program, arguments.folder, one),
        rows.deadline_of(arguments), "runs")
    write(arguments.output, rows.read(arguments.rows / "ompl_app.jsonl"),
          "Command: `scripts/bench.sh rigid-ompl-app CHECKOUT/resources/3D`. Commit: "
          f"{arguments.commit}. Machine: {machine()}, shared.")


if __name__ == "__main__":
    main()
