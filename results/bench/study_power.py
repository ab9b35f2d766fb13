# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study of solvers has to cost: from the rows of results/study how many
seeds show a difference of so many points, and the hours that they take.

    build/venv/bin/python -B results/bench/study_power.py results/study

writes power.csv and power.md there; --measure PROGRAM first runs all scenes, metrics
and protocols on one seed, and writes rate.csv, what a run costs.  A comparison's estimate is the mean over F
families of the differences within them, of `scenes` scenes and s seeds each; its
variance is

    (τ² + σ² · h / s) / F,      h = mean over families of 1 / scenes

with σ² within a scene, from seed to seed, and τ² between families.  A difference δ
is seen with power 1 − β at the two-sided level α where the root of this times
z(1 − α/2) + z(1 − β) is at most δ (normal approximation).
"""
import argparse
import csv
import datetime
import math
import pathlib
import resource
import subprocess
import tempfile
from collections import defaultdict
from statistics import NormalDist, fmean, median, variance

from study_report import HYPOTHESES, PROTOCOLS, paired, read_csv

EFFECTS = (0.02, 0.05, 0.1)
POWER = 0.8
LEVEL = 0.05
RATE = ("runs", "processor seconds", "seed", "date")
SEED = "70001"


def reach(level, power=POWER):
    """What the standard error is multiplied by to be seen."""
    normal = NormalDist()
    return normal.inv_cdf(1.0 - level / 2.0) + normal.inv_cdf(power)


def parts(pairs):
    """(within σ², between τ², h, families) of paired runs {(scene, seed): (a, b)}.
    Scenes of a single seed say nothing of what is within."""
    scenes = defaultdict(list)
    for (scene, _), (a, b) in pairs.items():
        scenes[a["family"], scene].append(
            float(a["converged"]) - float(b["converged"]))
    free = sum(len(x) - 1 for x in scenes.values())
    if free == 0:
        raise SystemExit("rows.csv: expected two seeds of a scene at least, found "
                         "one; run more seeds")
    within = sum((len(x) - 1) * variance(x) for x in scenes.values()
                 if len(x) > 1) / free
    families = defaultdict(list)
    for (family, _), x in scenes.items():
        families[family].append((fmean(x), within / len(x)))
    means = [fmean(mean for mean, _ in x) for x in families.values()]
    noise = fmean(sum(v for _, v in x) / len(x) ** 2 for x in families.values())
    between = max(0.0, variance(means) - noise) if len(means) > 1 else 0.0
    return (within, between, fmean(1.0 / len(x) for x in families.values()),
            len(families))


def seeds_needed(effect, within, between, h, families, level=LEVEL):
    """Least number, at least 1; none where no number of seeds is enough, as the
    families themselves differ."""
    left = families * (effect / reach(level)) ** 2 - between
    if left <= 0.0:
        return None
    return max(1, math.ceil(within * h / left - 1e-9))


def families_needed(effect, within, between, h, seeds, level=LEVEL):
    """The same of families, with so many seeds of each scene."""
    spread = between + within * h / seeds
    return max(2, math.ceil(spread * (reach(level) / effect) ** 2 - 1e-9))


def needs(rows):
    """A dictionary for each comparison."""
    found = []
    for name, a, b in HYPOTHESES:
        for protocol in PROTOCOLS:
            within, between, h, families = parts(paired(rows, protocol, a, b))
            found.append({"name": name, "a": a, "b": b, "protocol": protocol,
                          "within": within, "between": between, "h": h,
                          "families": families})
    return found


def write_csv(folder, found):
    with open(folder / "power.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["hypothesis", "a", "b", "protocol", "variance within",
                         "variance between", "families"] +
                        [f"seeds, {100 * effect:g} points, {kind}"
                         for kind in ("these families", "any families")
                         for effect in EFFECTS])
        for one in found:
            fixed, drawn = ([seeds_needed(effect, one["within"], between, one["h"],
                                          one["families"]) for effect in EFFECTS]
                            for between in (0.0, one["between"]))
            writer.writerow(
                [one["name"], one["a"], one["b"], one["protocol"],
                 f"{one['within']:.4f}", f"{one['between']:.5f}", one["families"]] +
                ["none" if n is None else n for n in fixed + drawn])


def measure(program, folder):
    """rate.csv: the processor seconds of all runs of one seed."""
    root = pathlib.Path(__file__).resolve().parents[2]
    with tempfile.TemporaryDirectory() as rows:
        command = ('. scripts/study_scenes.sh; exec "$0" compare "${study_scenes[@]}" '
                   f'--seed {SEED} --runs 1 --max-iter "$study_cap" --protocols '
                   + " ".join(PROTOCOLS) + ' --metrics "${study_metrics[@]}" --output '
                   + rows)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(["bash", "-c", command, program.resolve()], cwd=root, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        lines = (pathlib.Path(rows) / "rows.jsonl").read_text().splitlines()
    seconds = sum(getattr(after, name) - getattr(before, name)
                  for name in ("ru_utime", "ru_stime"))
    with open(folder / "rate.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(RATE)
        writer.writerow([len(lines), f"{seconds:.0f}", SEED, datetime.date.today()])


def read_rate(folder):
    """Processor seconds of a run."""
    with open(folder / "rate.csv", newline="") as file:
        row = next(csv.DictReader(file))
    return float(row["processor seconds"]) / float(row["runs"])


class Bill:
    """What seeds cost: every one of them is run by all metrics and protocols."""

    def __init__(self, rows, seconds):
        seeds = {row["seed"] for row in rows}
        self.runs = len(rows) / len(seeds)
        self.seconds = seconds

    def hours(self, seeds):
        """Of a processor."""
        return seeds * self.runs * self.seconds / 3600.0

    def text(self, counts):
        """Median and worst of the comparisons, and hours of the latter."""
        if None in counts:
            missing = counts.count(None)
            known = [n for n in counts if n is not None]
            least = f"{median(known):g} in the median of the others; " if known else ""
            return f"{least}no number in {missing} of {len(counts)}"
        most = max(counts)
        return (f"{median(counts):g}, at most {most}; {self.hours(most):.2g} h")


def seeds_table(found, bill, between_counts, level):
    lines = ["| protocol | " + " | ".join(f"{100 * e:g} points" for e in EFFECTS) +
             " |", "|---|" + "---|" * len(EFFECTS)]
    for protocol in PROTOCOLS:
        own = [one for one in found if one["protocol"] == protocol]
        cells = [bill.text([seeds_needed(
            effect, one["within"], one["between"] if between_counts else 0.0,
            one["h"], one["families"], level) for one in own])
            for effect in EFFECTS]
        lines.append(f"| {protocol} | " + " | ".join(cells) + " |")
    return lines


def families_table(found, seeds):
    lines = ["| protocol | " + " | ".join(f"{100 * e:g} points" for e in EFFECTS) +
             " |", "|---|" + "---|" * len(EFFECTS)]
    for protocol in PROTOCOLS:
        own = [one for one in found if one["protocol"] == protocol]
        cells = []
        for effect in EFFECTS:
            counts = [families_needed(effect, one["within"], one["between"],
                                      one["h"], seeds) for one in own]
            cells.append(f"{median(counts):g}, at most {max(counts)}")
        lines.append(f"| {protocol} | " + " | ".join(cells) + " |")
    return lines


def uncertainty(freedom):
    """Standard error of a standard deviation, a share of it."""
    return f"{100 / math.sqrt(2 * max(1, freedom)):.2g} %"


def page(rows, seconds):
    found, bill = needs(rows), Bill(rows, seconds)
    seeds = sorted({int(row["seed"]) for row in rows})
    families = found[0]["families"]
    scenes = len({row["scene"] for row in rows})
    some, many = len(seeds), 20
    tests = len(found)
    return "\n".join([
        "# What a comparison of solvers costs", "",
        "How many seeds show a difference of so many points of the share that "
        "converges, with 80 % power at the two-sided level of 5 %? Computed from the "
        f"{len(rows)} rows of [rows.csv](rows.csv): {len(found)} comparisons of "
        f"{scenes} scenes of {families} families, "
        f"{some} seeds each ({seeds[0]} to {seeds[-1]}). Every comparison: "
        "[power.csv](power.csv).", "",
        "A cell: the median over the seven comparisons of a protocol, the most that "
        "one of them needs, and the processor hours of that. A seed is run on all "
        f"scenes by all metrics and protocols, {bill.runs:g} runs of "
        f"{seconds:.2g} processor seconds each in the mean ([rate.csv](rate.csv), "
        f"`--measure build/phongpd`), so a seed is {60 * bill.hours(1):.2g} processor "
        "minutes; runs go on as many cores as there are. "
        "Standard deviations are themselves estimates: good to about "
        f"{uncertainty(scenes * (some - 1))} within scenes "
        f"({scenes * (some - 1)} degrees of freedom), {uncertainty(families - 1)} "
        f"between families ({families - 1}).",
        "", "## For these families", "",
        "What is found holds for these scenes alone: of chance there is only what "
        "seeds draw.", "", *seeds_table(found, bill, False, LEVEL), "",
        f"The same for the first of {tests} comparisons that Holm's correction lets "
        f"through (level 0.05 / {tests}):", "",
        *seeds_table(found, bill, False, LEVEL / tests), "",
        "## For families like these", "",
        "What is found is to hold for families that were not run. They differ among "
        "themselves, and more seeds do not help against that.", "",
        *seeds_table(found, bill, True, LEVEL), "",
        f"Families that would be needed, with {many} seeds of each scene (a family "
        f"more is {bill.hours(many) / families:.2g} h):", "",
        *families_table(found, many), "",
        "How to read it: a difference that this study leaves open is no tie. Before "
        "a comparison is run, look up its effect here; where the table says more "
        "hours than there are, ask for a larger effect or another measure "
        "(iterations differ by factors, and show with few seeds).", "",
        "Command: `build/venv/bin/python -B results/bench/study_power.py results/study`.", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--measure", type=pathlib.Path, metavar="PROGRAM")
    asked = parser.parse_args()
    if asked.measure:
        measure(asked.measure, asked.folder)
    rows = read_csv(asked.folder)
    write_csv(asked.folder, needs(rows))
    (asked.folder / "power.md").write_text(page(rows, read_rate(asked.folder)),
                                           encoding="utf-8")


if __name__ == "__main__":
    main()
