# SPDX-License-Identifier: GPL-3.0-or-later
"""What Python costs over C++: batches, single calls, the import.

python_benchmark.py --baseline PROGRAM --output DIR: writes rows.csv and
README.md.  C++ and Python take turns, a repetition each, so that both see the
same machine; figures are medians over repetitions of ratios and differences
within one.
"""
import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import phongpd
from python_report import parser_of

SEED, POINTS, STEPS = 1, 1_000_000, 20_000
AIMS = {"batch": 1.1, "call": 3.0, "import": 0.15}
# What is asked: kind, metric, how many points.  A cold PhongPD takes some 100 µs:
# fewer of them.
QUESTIONS = (("batch", "euclidean", POINTS), ("batch", "phong", 10_000),
             ("single", "euclidean", STEPS), ("motion", "phong", STEPS))


def cpu_seconds(process):
    """That its threads have been on a processor, as Linux counts it: what a
    busy machine does not change, unlike the clock."""
    return 1e-9 * sum(
        int((task / "schedstat").read_text().split()[0])
        for task in pathlib.Path(f"/proc/{process}/task").iterdir())


class Baseline:
    """python_baseline, asked line by line."""

    def __init__(self, program, *files):
        self.process = subprocess.Popen(
            [program, *files], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True)
        self.machine = self.process.stdout.readline().strip()

    def seconds(self, kind, metric, count):
        """Of the clock, and of all its threads on a processor."""
        begin = cpu_seconds(self.process.pid)
        print(kind, metric, count, file=self.process.stdin, flush=True)
        wall = float(self.process.stdout.readline())
        return wall, cpu_seconds(self.process.pid) - begin

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def one_by_one(metric, points):
    at = metric.at
    for q in points:
        at(q)


def along(metric, points):
    at, answer = metric.at, None
    for q in points:
        answer = at(q, answer)


def seconds(kind, metric, points):
    if kind == "single":
        points, work = list(map(tuple, points.tolist())), one_by_one
    elif kind == "motion":
        points, work = list(map(tuple, points.tolist())), along
    else:
        def work(metric, points):
            return metric.query(points)
    begin, cpu = time.perf_counter(), cpu_seconds(os.getpid())
    work(metric, points)
    wall = time.perf_counter() - begin
    return wall, cpu_seconds(os.getpid()) - cpu


def queries(baseline, space, points, motion, repetitions):
    """A row for each question and repetition."""
    metrics = {"euclidean": phongpd.EuclideanMetric(space),
               "phong": phongpd.PhongMetric(space, 0.2)}
    rows = []
    for repetition in range(repetitions + 1):
        for kind, name, count in QUESTIONS:
            asked = (motion if kind == "motion" else points)[:count]
            cpp = baseline.seconds(kind, name, count)
            python = seconds(kind, metrics[name], asked)
            if repetition:  # the first one warms up
                rows.append({
                    "kind": kind, "metric": name, "points": count,
                    "repetition": repetition, "cpp_seconds": cpp[0],
                    "cpp_cpu_seconds": cpp[1], "python_seconds": python[0],
                    "python_cpu_seconds": python[1]})
    return rows


def imports(repetitions):
    """Seconds of a fresh interpreter's import statement: on a processor, and by
    the clock."""
    rows = []
    for repetition in range(repetitions):
        row = {"repetition": repetition}
        for module in ("numpy", "phongpd"):
            program = ("import time; t, c = time.perf_counter(), "
                       f"time.process_time(); import {module}; print("
                       "time.process_time() - c, time.perf_counter() - t)")
            row[f"{module}_cpu"], row[module] = map(float, subprocess.run(
                [sys.executable, "-c", program], check=True, text=True,
                stdout=subprocess.PIPE).stdout.split())
        rows.append(row)
    return rows


def verdict(value, aim):
    return "within" if value <= aim else "**missed**"


def over(kind, count, rows, of):
    """What Python takes over C++: a ratio for batches, else µs a call."""
    if kind == "batch":
        return statistics.median(
            r[f"python_{of}"] / r[f"cpp_{of}"] for r in rows)
    return 1e6 / count * statistics.median(
        r[f"python_{of}"] - r[f"cpp_{of}"] for r in rows)


def tables(rows, imported):
    lines = ["| what | metric | points | C++ | Python | Python over C++, processor "
             "| by the clock | aim | |",
             "|---|---|---:|---:|---:|---:|---:|---:|---|"]
    for kind, name, count in QUESTIONS:
        mine = [r for r in rows if (r["kind"], r["metric"]) == (kind, name)]
        cpp, python = (1e6 / count * statistics.median(
            r[f"{side}_cpu_seconds"] for r in mine) for side in ("cpp", "python"))
        cpu, wall = (over(kind, count, mine, of)
                     for of in ("cpu_seconds", "seconds"))
        aim, unit = ((AIMS["batch"], "times") if kind == "batch"
                     else (AIMS["call"], "µs more"))
        lines.append(f"| {kind} | {name} | {count:,} | {cpp:.3g} µs | "
                     f"{python:.3g} µs | {cpu:.3g} {unit} | {wall:.3g} | "
                     f"{aim:g} {unit} | {verdict(cpu, aim)} |")
    whole, numpy, spent = (statistics.median(r[what] for r in imported)
                           for what in ("phongpd", "numpy", "phongpd_cpu"))
    lines += ["", f"`import phongpd` takes {whole:.3f} s by the clock, of them "
              f"{numpy:.3f} s NumPy's own import (aim: {AIMS['import']} s, "
              f"{verdict(whole, AIMS['import'])}); {spent:.3f} s of processor "
              "time, as NumPy's threads start, too."]
    return "\n".join(lines)


def write(output, how, machine, space, rows, imported, repetitions):
    output.mkdir(parents=True, exist_ok=True)
    with open(output / "rows.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    with open(output / "imports.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(imported[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(imported)
    (output / "README.md").write_text(f"""\
# What Python costs

The same questions to the same contact space by C++ and by the Python package,
in one run and in turns: times a point, medians of {repetitions} repetitions, and the
median of the ratios, or differences, within a repetition. Times are those that
all threads were on a processor, which other programs beside do not change; by
the clock they do. The verdict is on the former, but for the import.

{tables(rows, imported)}

- batch: the points in one call on all cores, `QueryBatch` into results that are
  there, and `metric.query` of an N x 3 array, which makes its columns;
- single: one point after the other, cold, `metric.Query` and `metric.at` of
  tuples of three floats;
- motion: steps of a motion, each on the branch of the one before;
- import: of a fresh interpreter, the files being in memory; median of
  {len(imported)}.

The contact space is that of the scene `ball_wrench`, {len(space.triangles)}
triangles; points are uniform in its bounding box, the motion winds through it.

Rows: [rows.csv](rows.csv), [imports.csv](imports.csv)

Command: `{how}`. Seed: {SEED}. Machine: {machine}, load
{os.getloadavg()[0]:.1f} at the end. Versions: PhongPD {phongpd.__version__}, Python
{sys.version.split()[0]}, NumPy {np.__version__}.
""", "utf-8")


def main():
    parser = parser_of(__doc__, "python_benchmark.py")
    parser.add_argument("--baseline", required=True)
    parser.add_argument("--repetitions", type=int, default=3)
    flags = parser.parse_args()
    world = phongpd.World.load("ball_wrench")
    space, = world.contact_spaces()
    low, high = space.vertices.min(axis=0), space.vertices.max(axis=0)
    points = np.random.default_rng(SEED).uniform(low, high, (POINTS, 3))
    turn = np.linspace(0, 6 * np.pi, STEPS)
    motion = (low + high) / 2 + (high - low) / 3 * np.stack(
        [np.sin(turn), np.cos(1.3 * turn), np.sin(0.7 * turn)], -1)
    with tempfile.TemporaryDirectory() as folder:
        mesh, raw, way = (f"{folder}/{name}"
                          for name in ("space.off", "points", "motion"))
        space.write(mesh)
        points.tofile(raw)
        motion.tofile(way)
        # Both halves take the mesh from the file.
        space = phongpd.ContactSpace.take(phongpd.Solid.read(mesh))
        baseline = Baseline(flags.baseline, mesh, raw, way)
        rows = queries(baseline, space, points, motion, flags.repetitions)
        baseline.close()
    write(flags.output, flags.how, baseline.machine, space, rows, imports(15),
          flags.repetitions)


if __name__ == "__main__":
    main()
