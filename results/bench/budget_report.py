# SPDX-License-Identifier: GPL-3.0-or-later
"""results/trade/budget.md: which flags of plan and optimize to take for a budget of
seconds and a number of triangles, from the rows of budget_benchmark.

    python3 -B results/bench/budget_report.py --output results/trade
    python3 -B results/bench/budget_report.py --output results/trade --code

The latter prints the table for planners/world/budget.cc instead.
"""
import argparse
from collections import defaultdict
from pathlib import Path

from python_report import Table, markdown, read_dicts, read_measured, write_csv
from report_statistics import median, wilson
from step_figure import Curve, step_figure

DECADES = (1000, 10000, 100000, 1000000)
BUDGETS = (0.01, 0.1, 1.0, 10.0)
LEAST = 4  # problems of a size that is picked by
EQUAL = 0.95  # of a clearance: less than so much of it is another one
USES = ("plan", "optimize")
BALANCED = "--model full --preset balanced"


class Run:
    def __init__(self, row):
        self.use, self.flags, self.status = row["use"], row["flags"], row["status"]
        self.decade = int(row["decade"])
        self.triangles = int(row["triangles"])
        self.problem = (row["family"], self.decade, row["seed"])
        self.is_free = row["free"] == "yes"
        self.length = float(row["length / D"])
        self.clearance = float(row["clearance / D"])
        self.seconds = float(row["build, CPU s"]) + float(row["answer, CPU s"])
        self.excess = None  # %, of a free path

    def answers(self, budget):
        return self.is_free and self.seconds <= budget


def add_excess(runs):
    """Over the shortest path of the same problem, by any flags of either use, that
    keeps as much clearance."""
    problems = defaultdict(list)
    for run in runs:
        if run.is_free:
            problems[run.problem].append(run)
    for of_problem in problems.values():
        for run in of_problem:
            least = min(other.length for other in of_problem
                        if other.clearance >= EQUAL * run.clearance)
            run.excess = 100.0 * (run.length / least - 1.0)


class Cell:
    """One set of flags within one budget."""

    def __init__(self, flags, runs, budget):
        answered = [run for run in runs if run.answers(budget)]
        self.flags, self.n, self.k = flags, len(runs), len(answered)
        self.excess = (sum(run.excess for run in answered) / self.k
                       if answered else 0.0)
        known = [run.seconds for run in runs if run.is_free]
        self.seconds = median(known) if known else float("inf")

    def rank(self):
        """Least for the one to take.  Where none answers in time, the quickest."""
        return -self.k, round(self.excess, 1), self.seconds

    def share(self):
        low, high = wilson(self.k, self.n)
        return f"{self.k} of {self.n} ({100 * low:.0f} – {100 * high:.0f} %)"

    def spent(self):
        return "-" if self.seconds == float("inf") else f"{self.seconds:.3g}"


def cells(runs, use, decade, budget):
    by_flags = defaultdict(list)
    for run in runs:
        if run.use == use and run.decade == decade:
            by_flags[run.flags].append(run)
    return [Cell(flags, of, budget) for flags, of in by_flags.items()]


def sizes(runs):
    """Of which there are enough problems."""
    problems = {run.problem for run in runs}
    return [decade for decade in sorted({p[1] for p in problems})
            if sum(p[1] == decade for p in problems) >= LEAST]


def picks(runs):
    """(use, decade, budget, cell to take), of what was measured."""
    for use in USES:
        for decade in sizes(runs):
            for budget in BUDGETS:
                yield use, decade, budget, min(cells(runs, use, decade, budget),
                                               key=Cell.rank)


def duration(seconds):
    return f"{1000 * seconds:g} ms" if seconds < 1 else f"{seconds:g} s"


def lookup_table(runs, use):
    lines = ["| triangles | " + " | ".join(map(duration, BUDGETS)) + " |",
             "|---|" + "---|" * len(BUDGETS)]
    rows = defaultdict(list)
    for of, decade, budget, cell in picks(runs):
        if of != use:
            continue
        rows[decade].append(
            f"`{cell.flags}`: {cell.share()}, excess {cell.excess:.2g} %"
            if cell.k else f"none; the quickest: `{cell.flags}`, {cell.spent()} s")
    for decade, texts in rows.items():
        own = [run.triangles for run in runs if run.decade == decade]
        lines.append(f"| about {decade:,} ({min(own):,} – {max(own):,}) | " +
                     " | ".join(texts) + " |")
    return lines


def all_table(runs):
    rows = []
    for use in USES:
        for decade in sorted({run.decade for run in runs}):
            for k, cell in enumerate(cells(runs, use, decade, BUDGETS[-1])):
                within = [cells(runs, use, decade, budget)[k].share()
                          for budget in BUDGETS]
                rows.append([use, decade, cell.flags, *within, cell.spent(),
                             f"{cell.excess:.2g}"])
    return Table("budget_shares.csv", "All flags",
                 "Problems answered within each budget, with Wilson's 95 % interval; "
                 "processor seconds of those with an answer, median, and their excess "
                 f"within {duration(BUDGETS[-1])}, %.",
                 ["use", "triangles", "flags", *map(duration, BUDGETS), "median s",
                  "excess, %"], rows)


def dominated(runs):
    """Presets that no cell takes, and that some others beat or equal everywhere."""
    taken = {(use, cell.flags) for use, _, _, cell in picks(runs)}
    for use in USES:
        for preset in ("fast", "balanced", "tight"):
            names = sorted({run.flags for run in runs if run.use == use and
                            f"--preset {preset}" in run.flags})
            cells_of = sum((use, name) in taken for name in names)
            yield (f"- `{use} --preset {preset}`: " +
                   ("taken in no cell." if cells_of == 0 else "taken in " + ", ".join(
                       f"{sum(of == use and cell.flags == name for of, _, _, cell in picks(runs))}"
                       f" cells as `{name}`" for name in names
                       if (use, name) in taken) + "."))


def figure(runs, use, decade):
    """Shares answered within a time, of flags that some cell of it takes, and of
    the default."""
    own = [run for run in runs if run.use == use and run.decade == decade]
    wanted = {cell.flags for of, at, _, cell in picks(runs)
              if of == use and at == decade} | {BALANCED}
    curves = []
    for flags in sorted(wanted):
        of = [run for run in own if run.flags == flags]
        times = sorted(run.seconds for run in of if run.is_free)
        curves.append(Curve(flags, "main" if flags == BALANCED else "other",
                            [(t, (i + 1) / len(of)) for i, t in enumerate(times)]))
    return step_figure(curves, f"{use}, about {decade:,} triangles",
                       "processor seconds, builds included",
                       "share of problems answered", 0.005, 20.0)


def measured(runs, decade):
    problems = {run.problem for run in runs if run.decade == decade}
    kinds = sorted({problem[0] for problem in problems})
    n = len(problems)
    few = "" if n >= LEAST else "; too few to pick by"
    return (f"- about {decade:,} triangles: {n} problem{'s' * (n != 1)} of "
            f"{', '.join(kinds)}{few}")


def complete(problems):
    """Is every size there, with as many kinds of pairs?"""
    counts = [len({p[0] for p in problems if p[1] == decade}) for decade in DECADES]
    return min(counts) == max(counts)


def page(folder, runs):
    problems = {run.problem for run in runs}
    decades = sorted({run.decade for run in runs})
    ungot = sorted({(run.use, run.decade, run.problem[0], run.status)
                    for run in runs if run.status in ("over", "refused")})
    text = [
        "# What a budget buys", "",
        "Which flags answer within so many seconds, with so many triangles? Answer: "
        "the two tables, which `--budget SECONDS` of `plan` and `optimize` (in C++ "
        "`ApplyBudget`, in Python `budget=`) picks by, and `--explain` tells.", "",
        f"n: {len(problems)} problems of {len({p[0] for p in problems})} kinds of pairs "
        "of solids (triangles: of both together), ends drawn around the contact "
        "space so that the line between them collides. Every set of flags begins in a "
        "world where nothing is built. A budget is processor time of all threads, not "
        "the wall's, as the machine had other work; builds of contact space or free "
        "space count, reading and checking the meshes does not. Answered: a path, "
        "exactly free, within the budget. Intervals: Wilson, 95 %. Excess: over the "
        "shortest path to the same goal by any of the flags that keeps at least "
        f"{EQUAL} of its clearance.", "",
        "A cell names the flags that answered most problems; of equals those of the "
        "least excess (to 0.1 %), then the quickest. Differences of a problem or two "
        "are chance: the intervals say so. `--budget` takes the nearest size, and "
        "refuses one beyond √10 times the largest that was measured.", "",
        *(measured(runs, decade) for decade in decades), "",
    ]
    for use, title in (("optimize", "Trajectories: `optimize`"),
                       ("plan", "Paths, retraction among them: `plan`")):
        text += [f"## {title}", "", *lookup_table(runs, use), ""]
    text += ["## Benchmarking convergence", "",
             "A study has no budget for a run but one for all: which difference is to "
             "be seen decides the seeds, and these the hours: "
             "[study/power.md](../study/power.md).", "",
             "## Presets", "", *dominated(runs), "",
             "## What was not to be had", "",
             *([f"- {use}, about {decade:,} triangles, {family}: the whole contact "
                f"space is {'beyond 10 s' if status == 'over' else 'refused at 60 s'}."
                for use, decade, family, status in ungot] or ["Nothing."]), "",
             "## Anytime", ""]
    for use in USES:
        for decade in sizes(runs):
            text += [f"![{use}, {decade}](budget_{use}_{decade}.svg)", ""]
    table = all_table(runs)
    text += ["## All flags", "", markdown("Within each budget", table.note,
                                          table.header, table.rows, table.file), "",
             "Rows: [budget.csv](budget.csv); more problems of each pair: "
             "`TRADE_SEEDS=10 scripts/bench.sh trade`.", "",
             ("" if complete(problems) else
              "The program goes from a thousand to a million triangles; what is missing "
              "here was not reached when it was cut off. ")
             + read_measured(folder, "budget_measured.txt"), ""]
    return "\n".join(text)


def enumerator(name):
    return "k" + "".join(word.capitalize() for word in name.split("-"))


def typed(flags):
    """BudgetFlags: `--model full --preset tight` as Model::kFull, Preset::kTight."""
    words = flags.split()
    said = dict(zip(words[::2], words[1::2]))
    values = {"--model": "auto", "--preset": "balanced", "--planner": "contact-surface",
              "--metric": "phong", **said}
    types = ("Model", "Preset", "PlannerId", "MetricKind")
    last = max(k for k, flag in enumerate(values) if flag in said)
    return ", ".join(f"{kind}::{enumerator(value)}"
                     for kind, value in zip(types[:last + 1], values.values()))


def code(runs):
    for use, decade, budget, cell in picks(runs):
        yield (f"      {{{'kPlan' if use == 'plan' else 'kOptimize'}, {decade}, "
               f"{budget:g}, {{{typed(cell.flags)}}}, {cell.k}, {cell.n}}},")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--code", action="store_true")
    asked = parser.parse_args()
    folder = asked.output
    runs = [Run(row) for row in read_dicts(folder / "budget.csv")]
    add_excess(runs)
    if asked.code:
        print("\n".join(code(runs)))
        return
    write_csv(folder / "budget_flags.csv",
              ["use", "triangles", "seconds", "flags", "answered", "problems"],
              [[use, decade, f"{budget:g}", cell.flags, cell.k, cell.n]
               for use, decade, budget, cell in picks(runs)])
    table = all_table(runs)
    write_csv(folder / table.file, table.header, table.rows)
    for use in USES:
        for decade in sizes(runs):
            (folder / f"budget_{use}_{decade}.svg").write_text(
                figure(runs, use, decade), encoding="utf-8")
    (folder / "budget.md").write_text(page(folder, runs), encoding="utf-8")


if __name__ == "__main__":
    main()
