# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the study's published rows still come out?

    study_slice.py results/study --program build/phongpd --scenes FOLDER --how COMMAND

makes rows spread evenly over every CSV file of that folder anew, with the same
settings and seeds, compares them cell by cell, and writes slice.md there.  FOLDER has
what study_models.py made for the seed of models.csv.  What deviates is named, not
judged; only an answer that is missing is an error."""
import argparse
import datetime
import os
import pathlib
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import study_models
import study_power
import study_report
from python_report import machine, read_dicts

ROUNDING = 1e-12  # of the larger one, or of one
CAP = "3000"  # iterations, as the protocol has them


@dataclass
class Slice:
    """Some rows of one published file."""
    file: str
    published: int
    but: str = "nothing"  # what is not compared
    made: int = 0
    identical: int = 0
    rounded: int = 0  # others, but for rounding
    deviations: list = field(default_factory=list)


def spread(rows, count):
    """So many of them, evenly; all where there are not more."""
    if len(rows) <= count:
        return list(rows)
    return [rows[i * len(rows) // count] for i in range(count)]


def is_rounding(a, b):
    try:
        a, b = float(a), float(b)
    except ValueError:
        return False
    return abs(a - b) <= ROUNDING * max(1.0, abs(a), abs(b))


def compare(into, published, found, columns, name):
    """Notes where the two rows, as texts, differ in these columns."""
    differing = [c for c in columns if published[c] != found[c]]
    others = [c for c in differing if not is_rounding(published[c], found[c])]
    into.made += 1
    into.identical += not differing
    into.rounded += bool(differing) and not others
    into.deviations += [(into.file, name, c, published[c], found[c]) for c in others]


def run_again(program, row, scene):
    """The row that phongpd compare makes of its problem."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [program, "compare", scene, "--seed", row["seed"], "--runs", "1",
             "--max-iter", CAP, "--protocols", row["protocol"], "--metrics",
             row["method"], "--output", folder], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr.strip())
        (values,) = study_report.rows_of(pathlib.Path(folder) / "rows.jsonl")
        return dict(zip(study_report.COLUMNS, values))


def of_comparisons(folder, file, program, count, scene_of):
    """Each run is a process of its own."""
    rows = read_dicts(folder / file)
    chosen = spread(rows, count)
    into = Slice(file, len(rows))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        again = pool.map(lambda r: run_again(program, r, scene_of(r["scene"])), chosen)
        for row, found in zip(chosen, again):
            name = ", ".join(row[c] for c in study_report.COLUMNS[:4])
            compare(into, row, found, study_report.COLUMNS, name)
    return into


def of_meshes(folder, scenes):
    """Which meshes were taken, all of them."""
    rows, again = (read_dicts(file) for file in
                   (folder / "models_meshes.csv", scenes / "meshes.csv"))
    into = Slice("models_meshes.csv", len(rows))
    by_name = {row["mesh"]: row for row in again}
    for row in rows:
        compare(into, row, by_name[row["mesh"]], list(row), row["mesh"])
    return into


def of_power(folder):
    """A function of rows.csv, all of it."""
    into = Slice("power.csv", 0)
    with tempfile.TemporaryDirectory() as place:
        study_power.write_csv(pathlib.Path(place),
                              study_power.needs(study_power.read_csv(folder)))
        rows, again = (read_dicts(pathlib.Path(f) / "power.csv")
                       for f in (folder, place))
    into.published = len(rows)
    for row, found in zip(rows, again, strict=True):
        compare(into, row, found, list(row), f"{row['hypothesis']}, {row['protocol']}")
    return into


def of_solvers(folder, count):
    import phongpd
    import study_solvers
    import study_solvers_report
    rows = read_dicts(folder / "solvers.csv")
    into = Slice("solvers.csv", len(rows), "runs that time ends now")
    solvers = study_solvers.load_solvers(study_solvers.SOLVERS)
    for row in spread(rows, count):
        if row["solver"] not in solvers:
            continue
        world = phongpd.World.load(row["scene"], seed=int(row["seed"]))
        found = study_solvers.run_one(world, row["metric"], solvers[row["solver"]])
        if found.pop("late"):
            continue
        texts = {c: str(study_solvers_report.text_of(v)) for c, v in found.items()}
        compare(into, row, row | texts, list(row),
                ", ".join(row[c] for c in ("scene", "seed", "solver", "metric")))
    return into


def of_times(folder, count, seed):
    """The first scenes' first problems; times are another machine's."""
    import study_times
    rows = read_dicts(folder / "times.csv")
    counts = sorted({int(row["problems"]) for row in rows})[:2]
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    into = Slice("times.csv", len(rows), "times")
    by_key = {tuple(row[c] for c in ("scene", "metric", "problems")): row
              for row in rows}
    scenes = spread(scenes, max(1, count // (len(counts) * len(study_times.METRICS))))
    for found in study_times.measure(scenes, seed, counts):
        again = dict(zip(study_times.HEADER, map(str, found)))
        key = tuple(again[c] for c in ("scene", "metric", "problems"))
        compare(into, by_key[key], again, ["free"], ", ".join(key))
    return into


def page(slices, how):
    made, identical, rounded = (sum(getattr(s, of) for s in slices)
                                for of in ("made", "identical", "rounded"))
    lines = [
        "# Do the study's rows still come out?", "",
        "Rows spread evenly over the study's files, made anew by the code as it is and",
        f"compared cell by cell: {identical} of {made} are identical, {rounded} more but "
        "for rounding", "(1e-12). rate.csv is a time alone, and not made anew.", "",
        "| file | rows | made anew | identical | but for rounding | others | compared "
        "is all but |", "|---|---:|---:|---:|---:|---:|---|"]
    lines += [f"| {s.file} | {s.published} | {s.made} | {s.identical} | {s.rounded} | "
              f"{s.made - s.identical - s.rounded} | {s.but} |" for s in slices]
    deviations = [d for s in slices for d in s.deviations]
    if deviations:
        lines += ["", "## What deviates", "",
                  "What is known to be rounded otherwise: [protocol.md](protocol.md).", "",
                  "| file | row | column | published | now |", "|---|---|---|---|---|"]
        lines += ["| " + " | ".join(d) + " |" for d in deviations]
    return "\n".join([*lines, "", how, ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--scenes", type=pathlib.Path, required=True)
    parser.add_argument("--seed", type=int, required=True, help="the study's first")
    parser.add_argument("--rows", type=int, default=40, help="of each file")
    parser.add_argument("--how", default="")
    asked = parser.parse_args()
    slices = []
    for make in (
            lambda: of_comparisons(asked.folder, "rows.csv", asked.program, asked.rows,
                                   str),
            lambda: of_comparisons(asked.folder, "further.csv", asked.program,
                                   asked.rows, str),
            lambda: of_comparisons(asked.folder, "models.csv", asked.program, asked.rows,
                                   lambda name: str(asked.scenes / study_models.file_of(name))),
            lambda: of_meshes(asked.folder, asked.scenes),
            lambda: of_solvers(asked.folder, asked.rows),
            lambda: of_times(asked.folder, asked.rows, asked.seed),
            lambda: of_power(asked.folder)):
        slices.append(make())
        one = slices[-1]
        print(f"{one.file}: {one.identical} of {one.made} identical", flush=True)
    text = page(slices, f"{asked.how} Date: {datetime.date.today()}. Machine: "
                        f"{machine()}.")
    (asked.folder / "slice.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
