# SPDX-License-Identifier: GPL-3.0-or-later
"""tracker.md of results/queries, from tracker.csv and totals.csv (tracker_benchmark)
in the folder."""

from python_report import (parse_folder, read_dicts, read_measured, read_table,
                           tables_and_figures)

HEAD = """\
# Metrics along motions

What Euclidean PD, PhongPD (followed by its branch, smoothing length 0, 0.1 and 0.2 \
of the diagonal) and `PenetrationTracker` (c = 3, κ = 10) do on the same motions: \
ways between random interior points, straight and bent in turn. The tracker is a \
state along a motion; it has no gradient for a solver.

## Where the tracker loses

"""
HARD = """
Walls are the hard case where the way round them is many times their thickness: a \
hollow body whose inside and outside hang together by a window, thin plates, \
slender bars. A contact that may not jump cannot come to the other side in time. \
`PenetrationTrackerCampaign` has five such among its 20 contact spaces and prints \
their figures in its long form.

"""


def own_losses(row):
    """Where the tracker misses what was aimed at."""
    if row["beyond"] != "0":
        yield f"{row['beyond']} changes beyond the bound"
    if row["exits elsewhere"] != "0":
        yield f"{row['exits elsewhere']} exits elsewhere"
    if float(row["mean ratio"]) > 1.1 or float(row["above 3, %"]) > 1:
        yield (f"mean ratio {row['mean ratio']}, {row['above 3, %']} % above 3 "
               "(aim: 1.1, 1 %)")
    if float(row["µs, median"]) > 2 or float(row["worst"]) > 200:
        yield (f"{row['µs, median']} µs median, {row['worst']} µs worst at "
               f"{row['triangles']} triangles (aim at 10⁴: 2, 200)")


def field_wins(row, tracker):
    """Where a field does better than it."""
    if int(row["jumps"]) < int(tracker["jumps"]):
        yield (f"{row['metric']} jumps {row['jumps']} times, the tracker "
               f"{tracker['jumps']}")
    if float(row["mean ratio"]) < float(tracker["mean ratio"]):
        yield (f"{row['metric']} has mean ratio {row['mean ratio']}, the tracker "
               f"{tracker['mean ratio']}")


def losses(rows):
    trackers = {row["contact space"]: row for row in rows
                if row["metric"] == "tracker"}
    text = ""
    for row in rows:
        space = row["contact space"]
        found = (own_losses(row) if row["metric"] == "tracker"
                 else field_wins(row, trackers[space])
                 if row["metric"] != "euclidean" else ())
        text += "".join(f"- {space}: {what}\n" for what in found)
    return text or "None in this run.\n"


def main():
    folder = parse_folder(__doc__)
    totals = read_dicts(folder / "totals.csv")
    times = ", ".join(f"{row['metric']} {row['µs, median']} µs" for row in totals)
    tables = [
        read_table(folder, "totals.csv", "Contact spaces together",
                   "Columns as below; triangles: their sum."),
        read_table(
            folder, "tracker.csv", "Along motions",
            "A jump: PD changes by more than 5 % of the diagonal between two frames, "
            "exits elsewhere included. Beyond: it changes by more than 11 times the "
            "robot's step, exits elsewhere apart. Exits elsewhere: `left_elsewhere` "
            "of the tracker, `branch_ended` outside of PhongPD; Euclidean PD has no "
            "state to leave. Ratio: depth over Euclidean depth, frames inside. Time "
            "of a step inside, the least of three repetitions.")]
    (folder / "tracker.md").write_text(
        f"{HEAD}{losses(read_dicts(folder / 'tracker.csv'))}{HARD}Median of a step "
        f"inside, {totals[0]['contact space']}: {times}.\n\n"
        f"{tables_and_figures(tables)}\n"
        f"{read_measured(folder, 'tracker_measured.txt')}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
