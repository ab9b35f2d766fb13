# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that turn: the certified judge beside FCL, and planners; see `--help`.

Runs rigid_judge_benchmark and rigid_plan_benchmark, one process a run, keeps
their rows as JSON Lines, and makes tables of them, and of those that rigid_peers.py
and rigid_ompl2.py left beside them."""
import json
import subprocess
from pathlib import Path
from typing import NamedTuple

import kept_rows as rows
from rigid_report import write_report

# Tight and less tight ones of every family (problems/scenes/rigid_scenes.h).
JUDGED = ["window:4", "piano:0.1", "peg:0.1", "peg:0.01", "ell:2.2",
          "lock:0.05", "rod_trap:0.1", "flange:0.15", "alpha:1.5", "alpha:1.2"]
# Of so many refinements, each triangle in four each time: about 3,000 and 25,000.
FINE = [("peg:0.1", 3), ("flange:0.15", 1), ("lock:0.05", 2), ("alpha:1.5", 2),
        ("piano:0.1", 4)]
# What is wanted in the end takes days; this takes about an hour on two cores.
# Where there is room many planners are asked.  Where it is tight ours runs with all its
# seeds first, as OMPL's take their whole limit where they find nothing: there they have
# three seeds, and all where most of them find paths.
EASY, EASY_LIMIT = ["window:4", "peg:1.5", "alpha:2.5"], 20
TIGHT, TIGHT_LIMIT = ["piano:0.1", "peg:0.1", "peg:0.01", "ell:2", "lock:0.05",
                      "rod_trap:0.1", "flange:0.15", "alpha:1.5", "alpha:1.2"], 60
FEW_SEEDS, WITH_PATHS = 3, ["alpha:1.5", "alpha:1.2"]
OURS = ("phongpd", "proof", "default")
EASY_RUNS = [OURS, ("RRTConnect", "proof", "tuned"),
             ("RRTConnect", "proof", "default"), ("RRTConnect", "0.01", "tuned"),
             ("RRTConnect", "0.01", "default"), ("KPIECE1", "0.01", "default"),
             ("STRIDE", "0.01", "default"), ("BITstar", "0.01", "default")]
TIGHT_RUNS = [("KPIECE1", "0.01", "default"), ("RRTConnect", "0.01", "default"),
              ("STRIDE", "0.01", "default"), ("BITstar", "0.01", "default"),
              ("RRTConnect", "proof", "tuned")]
WHOLE = ["window:4", "piano:0.1", "peg:0.1", "peg:0.01", "ell:2", "lock:0.05",
         "rod_trap:0.1", "flange:0.15", "alpha:1.5", "alpha:1.2"]
PLANNERS = ["RRTConnect", "KPIECE1", "BKPIECE1", "EST", "STRIDE", "PRM", "BITstar"]
CHECKS = ["0.01", "0.001", "proof"]
TUNED = ["RRTConnect"]


class Judged(NamedTuple):
    scene: str
    motions: int
    refined: int = 0
    pair: int = 1  # the seed

    @property
    def key(self):
        return f"{self.scene} {self.refined} {self.motions} {self.pair}"


class Planned(NamedTuple):
    scene: str
    planner: str
    check: str
    tuning: str
    limit: int
    pair: int  # the seed

    @property
    def key(self):
        return (f"{self.scene} {self.planner} {self.check} {self.tuning} "
                f"{self.limit} {self.pair}")


def plans(scenes, limits, seeds):
    """Seed by seed: what is interrupted has as many of each."""
    for limit in limits:
        for seed in range(1, seeds + 1):
            for scene in scenes:
                for planner in PLANNERS:
                    for check in CHECKS:
                        yield Planned(scene, planner, check, "default", limit,
                                      seed)
                        if planner in TUNED:
                            yield Planned(scene, planner, check, "tuned", limit,
                                          seed)
                yield Planned(scene, "phongpd", "proof", "default", limit, seed)


def short_plans(seeds):
    """Where there is room, then where it is tight, ours first, each seed by seed,
    planner by planner."""
    def runs(scenes, chosen, limit, first, last):
        for seed in range(first, last + 1):
            for planner, check, tuning in chosen:
                for scene in scenes:
                    yield Planned(scene, planner, check, tuning, limit, seed)
    few = min(FEW_SEEDS, seeds)
    yield from runs(EASY, EASY_RUNS, EASY_LIMIT, 1, seeds)
    yield from runs(TIGHT, [OURS], TIGHT_LIMIT, 1, seeds)
    yield from runs(TIGHT, TIGHT_RUNS, TIGHT_LIMIT, 1, few)
    yield from runs(WITH_PATHS, TIGHT_RUNS, TIGHT_LIMIT, few + 1, seeds)


def ask(program, *arguments):
    """The program's rows; what it says on failing is the error."""
    done = subprocess.run([str(program), *map(str, arguments)],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"exit code {done.returncode}: {done.stderr}")
    return [json.loads(line) for line in done.stdout.splitlines()]


def judge_rows(build):
    def measure(one):
        return {"key": one.key, "scene": one.scene, "rows": ask(
            build / "rigid_judge_benchmark", one.scene, "--motions",
            one.motions, "--seed", one.pair, "--refined", one.refined)}
    return measure


def plan_rows(build):
    def measure(one):
        return {"key": one.key} | ask(
            build / "rigid_plan_benchmark", one.scene, "--planner", one.planner,
            "--check", one.check, "--tuning", one.tuning, "--limit", one.limit,
            "--seed", one.pair)[0]
    return measure


def main():
    parser = rows.parser_for(__doc__, "rigid_benchmark.py", ["judge", "plan"])
    parser.add_argument("--build", type=Path, default=Path("build"),
                        help="folder of the two programs")
    parser.add_argument("--long", action="store_true",
                        help="all scenes, 10 seeds, 60 s and then 600 s: days; "
                             "goes on where it was")
    parser.add_argument("--seeds", type=int, default=10,
                        help="of planners, but for --long")
    arguments = parser.parse_args()
    deadline = rows.deadline_of(arguments)
    motions = 1000 if arguments.long else 100
    judged = [*(Judged(scene, motions) for scene in JUDGED),
              *(Judged(scene, motions // 2, times) for scene, times in FINE)]
    planned = list(plans(WHOLE, [60, 600], 10) if arguments.long
                   else short_plans(arguments.seeds))
    judges = rows.run_part(arguments, "judge", judged, judge_rows(arguments.build),
                           deadline, "runs of judges")
    plans_found = rows.run_part(arguments, "plan", planned, plan_rows(arguments.build),
                                deadline, "runs of planners", arguments.jobs)
    if arguments.part in ("report", "all"):
        write_report(arguments.output, arguments.how, arguments.commit, judges,
                     plans_found, *(rows.read(arguments.rows / f"{part}.jsonl")
                                    for part in ("peers", "ompl2")))


if __name__ == "__main__":
    main()
