# SPDX-License-Identifier: GPL-3.0-or-later
"""Solvers of others on the study's problems (results/study/solvers_protocol.md):
rows to FILE as JSON Lines, one a run, in whole blocks of a seed; what is there
already is not run again."""
import argparse
import importlib
import importlib.metadata
import json
import pathlib
import sys
import time

import numpy as np
import phongpd

from python_report import machine, told, versions
from study_solvers_program import make_program

METRICS = ("euclidean", "phong@0.2", "smoothed@0.2", "placebo@0.2",
           "phong@0.2/exact")
EVALUATIONS, SECONDS = 1000, 30.0  # of one run, for all alike
# Name in the rows: module here, function, packages that it needs.
SOLVERS = {
    "ipopt-3.14": ("study_solvers_peers", "by_ipopt_of_casadi", ("casadi",)),
    "ipopt-3.11": ("study_solvers_peers", "by_cyipopt", ("cyipopt", "casadi")),
    "snopt": ("study_solvers_peers", "by_snopt", ("pydrake",)),
    "kto": ("study_solvers_peers", "by_kto", ("pydrake",)),
    "sqp": ("study_solvers_sqp", "solve", ("osqp", "scipy")),
    "chomp": ("study_solvers_chomp", "solve", ())}


def load_solvers(names):
    """{name: function}; one that does not load is told."""
    found = {}
    for name in names:
        module, function, packages = SOLVERS[name]
        try:
            for package in packages:
                importlib.import_module(package)
            found[name] = getattr(importlib.import_module(module), function)
        except ImportError as error:
            print(f"{name} is left out: {told(error)}", file=sys.stderr)
    return found


def run_one(world, metric, solve):
    """What a row tells of a run; the judge is exact and of the whole path."""
    program = make_program(world, metric, EVALUATIONS, SECONDS)
    begin, error = time.process_time(), ""
    v, says = program.first, False
    try:
        v, says = solve(program)
    except Exception as problem:  # a peer's; the row tells it
        error = told(problem)
    path = program.told_path(v)
    free = bool(np.isfinite(path).all()
                and world.is_motion_free(path[:-1], path[1:]).all())
    end = "capped" if program.is_spent() and not says else error or "ended"
    return {"says": bool(says), "free": free, "end": end,
            "objective": program.objective(v), "evaluations": program.evaluations,
            "least_gap": float(program.gaps(v).min()),
            "late": program.is_late(),
            "seconds": time.process_time() - begin}


def rows_there(file):
    if not file.exists():
        return set()
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    return {(r["scene"], r["seed"], r["solver"], r["metric"]) for r in rows}


def told_versions():
    packages = []
    for name in ("numpy", "scipy", "casadi", "cyipopt", "drake", "osqp"):
        try:
            importlib.metadata.version(name)
            packages.append(name)
        except importlib.metadata.PackageNotFoundError:
            pass
    return f"PhongPD {phongpd.__version__}, {versions(*packages)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--scenes", nargs="+", required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--solvers", nargs="+", default=list(SOLVERS),
                        choices=SOLVERS)
    arguments = parser.parse_args()
    arguments.file.parent.mkdir(parents=True, exist_ok=True)
    solvers = load_solvers(arguments.solvers)
    done = rows_there(arguments.file)
    for seed in range(arguments.seed, arguments.seed + arguments.runs):
        for scene in arguments.scenes:
            wanted = [(name, metric) for metric in METRICS for name in solvers
                      if (scene, seed, name, metric) not in done]
            if not wanted:
                continue
            world = phongpd.World.load(scene, seed=seed)
            for name, metric in wanted:
                row = {"scene": scene, "seed": seed, "solver": name,
                       "metric": metric, **run_one(world, metric, solvers[name])}
                with open(arguments.file, "a") as file:
                    file.write(json.dumps(row) + "\n")
            print(f"{seed} {scene} done", flush=True)
    arguments.file.with_name("measured.txt").write_text(
        f"Machine: {machine()}, busy with other jobs: no times are told. Versions: "
        f"{told_versions()}.\n")


if __name__ == "__main__":
    main()
