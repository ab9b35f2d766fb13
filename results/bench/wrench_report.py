# SPDX-License-Identifier: GPL-3.0-or-later
"""README and tables of results/rigid-depth, from wrench.csv (wrench_benchmark) and
peg_force.csv (the example 09_peg_force) in the folder."""
import math
import statistics
import textwrap

from python_report import (Figure, Table, parse_folder, read_dicts, read_measured,
                           rounded, tables_and_figures, write_report)
from report_statistics import wilson
from step_figure import BASELINE, MAIN, STYLES, render

HALVES = 0.6  # of a halving of the step: what a change may be left at
SPEED = 2.0  # κ, the tracker's default
NONE = 1e-9  # a change as small is none
CHANGES = ("direction change", "torque change", "push change")
# One colour a metric: Euclid dashed black, PhongPD blue, as everywhere.
LOOKS = {"euclidean": STYLES[BASELINE], "phong": STYLES[MAIN],
         "phong followed": "lc rgb '#56B4E9' lw 2",
         "smoothed": "lc rgb '#E69F00' lw 2.5", "tracked": "lc rgb '#009E73' lw 2.5",
         "unbounded": "lc rgb '#CC79A7' lw 2 dt (4,3)"}
QUESTION = """\
# Depth of bodies that turn: direction, torque, way out

Question: along a motion that turns, does the wrench of a contact (its direction n, and
the torque r × n about the robot's origin) change less where the step is less, and how
much longer than the least way out is the one along n?

The metrics: Euclidean PD; PhongPD (ℓ = 0.2), cold and followed (of all projections the
nearest to the last contact); smoothed (`WrenchTracker::SmoothedAt`: the gradient of
smoothed occupancy at the pose, no memory); tracked (`WrenchTracker::Step`: a direction
that turns by at most κ = 2 radians a length L of the motion); unbounded, the tracker
without that bound.

"""
NOTES = """\
## What is measured

- Pairs: procedural solids of 10 to 120 triangles, one seed a pair; two motions each,
  60 degrees about a random axis through a point of the robot that rests in the obstacle,
  or goes straight between two of its points. Poses that are not inside are left out, and
  what a metric remembers ends there.
- Step lengths: each half of the one before, on the same motion. A change: the largest,
  of n, of r × n / L, and of the push (the vector of a force of stiffness 1: depth times
  n; the tracker's own ŝ·n) / L, between two poses in a row. L: the radius of gyration.
- The change halves: a halving of the step leaves at most 0.6 of it, in the geometric
  mean from the longest step to the shortest, on both motions of a pair. A jump
  leaves 1. For the tracker that is its bound, by construction, wherever it is met at all
  lengths; `bounded` says how often it was. κ was chosen on seeds 900 to 919, of 1, 2
  and 4.
- r: where the robot touches, put at q_c (Euclid and PhongPD), found by code of its own;
  the mean of the surface by its gap (smoothed, tracked).
- Exit: the way along n to the first place that is free, over Euclid's depth, at the
  shortest step; it frees the robot, whichever metric says it. Euclid's own is above 1
  where its nearest point is the tip of a re-entrant edge, which the ray passes by
  rounding. Where the depth is next to nothing a ratio may be anything: so the median
  stands beside the mean.
- Cost: each orientation needs a contact space of translations; `ms a space` is
  processor time of that with its Phong field, `µs` of the metric beyond it.
"""


def factor(rows, change):
    """What a halving of the step leaves of the change, the worse motion of a
    pair's rows of one metric."""
    worst = 0.0
    for motion in {row["motion"] for row in rows}:
        of = sorted((row for row in rows if row["motion"] == motion),
                    key=lambda row: int(row["steps"]))
        first, last = (float(row[change]) for row in (of[0], of[-1]))
        if last > NONE:
            worst = max(worst, (last / first) ** (1 / (len(of) - 1))
                        if first > NONE else math.inf)
    return worst


def by_metric(rows):
    """{metric: {pair: rows}}, in their order."""
    found = {}
    for row in rows:
        found.setdefault(row["metric"], {}).setdefault(row["pair"], []).append(row)
    return found


def finest(rows):
    most = max(int(row["steps"]) for row in rows)
    return [row for row in rows if int(row["steps"]) == most]


def halving(pairs, change):
    return sum(factor(rows, change) <= HALVES for rows in pairs.values())


def exits(pairs):
    """Mean and median over pairs and motions, and the worst of all poses."""
    of = [row for rows in pairs.values() for row in finest(rows)]
    means = [float(row["mean exit"]) for row in of]
    return (statistics.fmean(means), statistics.median(means),
            max(float(row["worst exit"]) for row in of))


def summary(metrics):
    """A row a metric."""
    for metric, pairs in metrics.items():
        of = [row for rows in pairs.values() for row in finest(rows)]
        inside = sum(int(row["inside"]) for row in of)
        yield [metric, len(pairs), *(halving(pairs, change) for change in CHANGES),
               *(max(float(row[change]) for row in of) for change in CHANGES),
               *exits(pairs),
               100 * sum(int(row["bounded"]) for row in of) / inside,
               sum(int(row["fallbacks"]) for row in of),
               statistics.median(float(row["µs"]) for row in of)]


def factors(metrics, change):
    """A row a pair: of each metric what a halving leaves."""
    names = list(metrics)
    return [[pair, *(factor(metrics[name][pair], change) for name in names)]
            for pair in metrics[names[0]]]


def wrapped(text):
    return textwrap.fill(text, 88, subsequent_indent="  ") + "\n"


def share(k, n):
    low, high = wilson(k, n)
    return f"{k} of {n} pairs ({100 * low:.0f} to {100 * high:.0f} %)"


def bound_line(metrics):
    """In how many rows the tracker's largest change is within κ times its step, to
    the digits that are published."""
    of = [row for rows in metrics.get("tracked", {}).values() for row in rows]
    kept = sum(float(row["direction change"]) <= 1.01 * SPEED * float(row["step"])
               for row in of)
    lengths = sorted({int(row["steps"]) for row in of})
    worst = [max(float(row["direction change"]) for row in of
                 if int(row["steps"]) == steps) for steps in lengths]
    return wrapped(
        f"- The tracker's bound, κ times the step, which halves with it, held in {kept} of "
        f"{len(of)} rows; the largest change of all pairs is "
        f"{', '.join(map(rounded, worst))} from the longest step to the shortest. Where a "
        "pair's change grows it was below the bound at the longest step, by chance or "
        "because half of the wish is less.") if of else ""


def cost_line(metrics):
    spaces = {(row["pair"], row["motion"]): float(row["ms a space"])
              for rows in next(iter(metrics.values())).values() for row in rows}
    return wrapped(
        f"- Cost: a contact space with its Phong field takes {rounded(min(spaces.values()))} "
        f"to {rounded(max(spaces.values()))} ms a pose, median "
        f"{rounded(statistics.median(spaces.values()))}, beside which the metrics (column "
        "µs) are cheap: too slow for a haptic rate of 1 ms.")


def findings(metrics):
    """Reached and not, and who loses what."""
    n = len(next(iter(metrics.values())))
    text = "## Reached, and not\n\n"
    for metric, pairs in metrics.items():
        counts = [halving(pairs, change) for change in CHANGES]
        mean, middle, worst = exits(pairs)
        verdicts = ["reached" if done else "**not reached**" for done in
                    (counts[0] == n and counts[1] == n, mean <= 1.15)]
        text += wrapped(
            f"- {metric}: the change of direction halves on {share(counts[0], n)}, of the "
            f"torque on {counts[1]}, of the push on {counts[2]} (aim: direction and torque "
            f"on all) – {verdicts[0]}; exits {mean:.4g} times Euclid's in the mean (aim: "
            f"1.15) – {verdicts[1]}; {rounded(middle)} in the median of the motions, "
            f"{rounded(worst)} at worst.")
    return text + bound_line(metrics) + cost_line(metrics) + "\n"


def loops(rows):
    """(steps, metric): the rows at the ends of the loop, there and back."""
    found = {}
    for row in rows:
        if float(row["t"]) == 1.0:
            found.setdefault((int(row["steps"]), row["metric"]), []).append(row)
    return found


def peg_table(rows):
    """Work as a share of the most energy that Euclid's depth stores."""
    peak = max(sum(float(row[k]) ** 2 for k in ("fx", "fy", "fz")) / 2
               for row in rows if row["metric"] == "euclidean")
    for (steps, metric), of in loops(rows).items():
        yield [metric, steps, *(float(row[k]) / peak for k in ("work", "held")
                                for row in of),
               max(float(row["change"]) for row in of)]


def peg_text(table):
    most = max(row[1] for row in table)
    last = {row[0]: row for row in table if row[1] == most}
    first = {row[0]: row for row in table if row[1] == min(r[1] for r in table)}
    text = ("## A peg by hand\n\nThe example `09_peg_force`: a peg is pushed on the rim "
            "of its hole, tilted, and\ntaken back to where it was. Work of the closed "
            "motion in shares of the most energy that\nEuclid's depth stores on it, the "
            "greater of there and back: what is above 0 is energy\nfrom nothing.\n\n")
    for metric, row in last.items():
        works, held = ([max(r[k:k + 2]) for r in (first[metric], row)]
                       for k in (2, 4))
        text += wrapped(f"- {metric}: {rounded(works[1])} at {most} steps "
                 f"({rounded(works[0])} at {first[metric][1]}); of forces held for a "
                 f"step {rounded(held[1])} ({rounded(held[0])}); largest change of "
                 f"force {rounded(row[6])} ({rounded(first[metric][6])}).")
    return text + """
Euclid's push is the gradient of ½ depth²: where its direction flips the force kicks,
but a closed motion creates energy only by the length of the step, and none where the
depth itself is continuous. A continuous direction that is no gradient has no kick, and
creates energy at any step, one way round, and takes as much the other way. "A flip
creates energy, a continuous field little" is therefore wrong as it stands: a flip kicks.

"""


def change_figure(metrics):
    """Median over pairs and motions of the largest change, over the step."""
    script, plots = "set logscale xy\n", []
    for k, (metric, pairs) in enumerate(metrics.items()):
        by_steps = {}
        for rows in pairs.values():
            for row in rows:
                by_steps.setdefault(int(row["steps"]), []).append(row)
        script += f"$m{k} << EOD\n" + "".join(
            f"{statistics.median(float(r['step']) for r in of):g} "
            f"{max(1e-3, statistics.median(float(r['direction change']) for r in of)):g}\n"
            for _, of in sorted(by_steps.items())) + "EOD\n"
        plots.append(f"$m{k} using 1:2 with linespoints pt 7 ps 0.5 {LOOKS[metric]} "
                     f"title '{metric}'")
    return render(script + "set key outside right\nset format '%g'\nset grid lc rgb "
                  "'#DDDDDD'\nset xlabel 'longest step, in L'\nset ylabel 'largest "
                  "change of n'\nset title 'Change of the direction by the step, median "
                  f"of the motions' noenhanced\nplot {', '.join(plots)}\n", 760, 400)


def peg_figure(rows):
    """Force along the loop there, and the work so far."""
    finest_steps = max(int(row["steps"]) for row in rows)
    script, force, work = "", [], []
    metrics = dict.fromkeys(row["metric"] for row in rows)
    for k, metric in enumerate(metrics):
        of = [row for row in rows if row["metric"] == metric and row["way"] == "1"
              and int(row["steps"]) == finest_steps]
        script += f"$m{k} << EOD\n" + "".join(
            f"{row['t']} {row['fx']} {row['work']}\n" for row in of) + "EOD\n"
        force.append(f"$m{k} using 1:2 with lines {LOOKS[metric]} title '{metric}'")
        work.append(f"$m{k} using 1:3 with lines {LOOKS[metric]} notitle")
    return render(
        script + "set multiplot layout 2,1\nset grid lc rgb '#DDDDDD'\nset lmargin 11\n"
        "set rmargin 18\nset key outside right\nset ylabel 'sideways force'\nset title "
        f"'A peg on the rim of its hole'\nplot {', '.join(force)}\nunset title\nset "
        "xlabel 'time along the closed motion'\nset ylabel 'work on the hand'\n"
        f"plot {', '.join(work)}\nunset multiplot\n", 760, 560)


def main():
    folder = parse_folder(__doc__)
    rows, peg = read_dicts(folder / "wrench.csv"), read_dicts(folder / "peg_force.csv")
    metrics = by_metric(rows)
    names = list(metrics)
    loop = list(peg_table(peg))
    tables = [
        Table("metrics.csv", "Metrics", "Pairs on which the change halves; the largest "
              "changes, exits, `bounded` and fallbacks at the shortest step.",
              ["metric", "pairs", "direction halves", "torque halves", "push halves",
               "direction change", "torque change", "push change", "mean exit",
               "median exit", "worst exit", "bounded, %", "fallbacks", "µs, median"],
              list(summary(metrics))),
        *(Table(f"{change.replace(' ', '_')}.csv",
                f"What a halving of the step leaves of the {change}",
                "The worse of two motions; a jump: 1.", ["pair", *names],
                factors(metrics, change)) for change in CHANGES),
        Table("peg_work.csv", "The peg's closed motion",
              "Work as a share of the most stored energy.",
              ["metric", "steps", "work there", "work back", "held there",
               "held back", "largest change of force"], loop)]
    figures = [Figure("direction.svg", "The largest change of the direction at four "
                      "lengths of steps: what jumps stays where it is.",
                      change_figure(metrics)),
               Figure("peg_force.svg", "The peg's sideways force and the work so far, "
                      "by each metric.", peg_figure(peg))]
    write_report(folder, f"{QUESTION}{findings(metrics)}{peg_text(loop)}{NOTES}\n"
                 f"{tables_and_figures(tables, figures)}"
                 "A metric, a motion, a length of steps each: [wrench.csv](wrench.csv); "
                 "the peg: [peg_force.csv](peg_force.csv).\n\n"
                 f"`scripts/bench.sh wrench`. "
                 f"{read_measured(folder, 'wrench_measured.txt')}\n", tables, figures)


if __name__ == "__main__":
    main()
