# SPDX-License-Identifier: GPL-3.0-or-later
"""README.md of results/fleets, from fleets.csv (fleet_benchmark) in the folder."""

from python_report import parse_folder, read_dicts, read_measured, verdict
from report_statistics import median, median_interval

AIM = 1.10  # of the slowest alone
SECONDS = {4: 0.5, 8: 3.0, 16: 30.0}

HEAD = """\
# Several robots at once

Question: how long after the slowest robot could have arrived alone have all of them,
and what does it cost to find motions that are certified pair by pair?

Boxes of side 1 in rooms that grow with their number (half a side 2 + 0.4 n), limits
1, 2 and 10 of velocity, acceleration and jerk of each axis, the default preset. Across a
circle: from places around it, unevenly, to those across. Anywhere: from places drawn by
lot to others, in a plane, where robots can only pass beside each other, or in space.
Alone: the largest of the times that each takes without the others, a lower bound of
what the optimiser finds. By order: with priorities, the orders that the preset tries.
Together: `OptimizeFleet`, which makes the motions faster together in the end
(`joint_curves.h`); all arrive at the same time then. Certified: every pair proved
free for all t, and confirmed on the solids. The rule of steps was chosen on other
seeds; the start in which all turn the same way with seeds 101 to 110 in sight. Those
here were in nobody's.

"""


def ratios(rows, column):
    return [float(row[column]) / float(row["alone"]) for row in rows
            if row["solved"] == "yes"]


def said(values):
    middle, low, high = median_interval(values)
    return f"{middle:.3f} ({low:.3f} to {high:.3f}), at most {max(values):.3f}"


def table(rows):
    lines = ["| kind | robots | found | pairs certified | FCL hits | by order / alone | "
             "together / alone: median (95 %) | CPU s, median |",
             "|---|---:|---:|---:|---:|---:|---|---:|"]
    groups = {}
    for row in rows:
        groups.setdefault((row["kind"], int(row["robots"])), []).append(row)
    for (kind, robots), of in groups.items():
        found = [row for row in of if row["solved"] == "yes"]
        pairs, certified, hits = (sum(int(row[name]) for row in found)
                                  for name in ("pairs", "certified", "hits"))
        lines.append(
            f"| {kind} | {robots} | {len(found)} of {len(of)} | {certified} of {pairs} | "
            f"{hits} | {median(ratios(of, 'by order')):.3f} | "
            f"{said(ratios(of, 'duration'))} | "
            f"{median([float(row['CPU s']) for row in of]):.2f} |")
    return "\n".join(lines)


def findings(rows):
    text = []
    for robots in (2, 4, 8, 16):
        of = [row for row in rows if int(row["robots"]) == robots]
        if not of:
            continue
        values = ratios(of, "duration")
        within = sum(value <= AIM for value in values)
        text.append(f"- {robots} robots: at most 10 % above the slowest alone in "
                    f"{within} of {len(of)}" + verdict(within == len(of)))
        if robots in SECONDS:
            seconds = median([float(row["CPU s"]) for row in of])
            text.append(f"- {robots} robots: {seconds:.2f} s of processor in the "
                        f"median, {SECONDS[robots]:g} s were asked"
                        + verdict(seconds <= SECONDS[robots]))
    for row in rows:
        if row["solved"] != "yes":
            text.append(f"- Not found: {row['kind']}, {row['robots']} robots, seed "
                        f"{row['seed']}.\n")
    return "".join(text)


def main():
    folder = parse_folder(__doc__)
    rows = read_dicts(folder / "fleets.csv")
    (folder / "README.md").write_text(
        HEAD + "## Found, and missed\n\n" + findings(rows) + "\n## Table\n\n"
        + table(rows) + "\n\nRows: [fleets.csv](fleets.csv)\n\n"
        + f"{read_measured(folder, 'measured.txt')}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
