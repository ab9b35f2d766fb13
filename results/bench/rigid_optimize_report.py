# SPDX-License-Identifier: GPL-3.0-or-later
"""README of results/rigid-optimize, from rows.jsonl (rigid_optimize_benchmark) and
measured.txt in the folder."""
import json
import sys

from python_report import markdown, parse_folder, read_measured, rounded
from report_statistics import median

SAMPLES = "samples"
QUESTION = """\
# Paths of poses by Ipopt: free for all t, or at samples

Question: of paths of a robot that turns, as Ipopt makes them, how many are free for all
t and not at samples alone, and how much shorter are they than the path they began from?

"""
NOTES = """\
## What is measured

- Scenes: a bar through a slot, an L through a window (4 wide), a bar around a corner;
  harder, a peg (play 1), an L through a hole it has to turn in (2.5), a rod out of a
  trap (play 0.3). The knobs are those of `phongpd scenes`; all but slot and corner,
  which the program makes, are of these families.
- `samples`: what optimisers do that have rows at samples alone. The straight motion
  with 8 knots, moved at random (2 % of its length); rows at the middle and the end of
  each link, Ipopt's settings as in the first round of `Optimize`, solved once, not
  judged on the way.
- `straight`, `planner`, `both`: `Optimize` from there, from the path of `Plan`, or from
  the straight motion and, where that does not come free, the planner's.
- Certified: `RigidJudge` proves every motion of the answer free for all t. Converged
  and stalled are Ipopt's: of `samples` its word on the only solve, whether or not the
  path is free; of `Optimize` only paths that are proved: converged, where no small step
  of the knots shortens it by 1e-4 to first order; stalled, all others: steps were
  refused, or rounds or time were up.
  Refuted: what Ipopt called solved, in one of the rounds at least, does collide
  between its samples; of `samples` that is the answer, `Optimize` goes on from there.
  No plan: the time was up before the planner had a path, which is no fault of the
  optimiser.
- Shorter: the answer's length over that of the planner's path, which was cut short
  before, in the object norm; 1 is the planner's own path.
- CPU s: processor seconds of the whole run, the planner in it; the limit is on these.
"""
HEADER = ["scene", "method", "runs", "converged", "stalled", "certified", "refuted",
          "no plan", "length, median", "over the plan, median (most)",
          "iterations, median", "CPU s, median", "CPU s, most"]


def read_rows(path):
    with open(path, encoding="utf-8") as file:
        rows = [json.loads(line) for line in file]
    if not rows:
        sys.exit(f"{path}: expected rows, found none; measure them first "
                 "(scripts/bench.sh rigid-optimize)")
    return rows


def converged(row):
    return row["solver"] in ("converged", "acceptable") and (
        row["method"] == SAMPLES or row["certified"])


def stalled(row):
    if row["method"] == SAMPLES:
        return row["solver"] == "stalled_feasible"
    return row["certified"] and not converged(row)


def has_no_plan(row):
    return not (row["certified"] or row["planned_length"] > 0
                or row["method"] in (SAMPLES, "straight"))


def groups(rows):
    """Of each scene and method, in the order of the rows."""
    found = {}
    for row in rows:
        found.setdefault((row["scene"], row["method"]), []).append(row)
    return dict(sorted(found.items(), key=lambda item: [
        row["scene"] for row in rows].index(item[0][0])))


def line(scene, method, rows):
    ratios = [row["length"] / row["planned_length"] for row in rows
              if row["certified"] and row["planned_length"] > 0]
    lengths = [row["length"] for row in rows if row["certified"]]
    seconds = [row["cpu_seconds"] for row in rows]
    return [scene, method, len(rows), sum(map(converged, rows)),
            sum(map(stalled, rows)), sum(row["certified"] for row in rows),
            sum(row["refuted"] for row in rows), sum(map(has_no_plan, rows)),
            rounded(median(lengths), 4) if lengths else "-",
            f"{rounded(median(ratios))} ({rounded(max(ratios))})" if ratios else "-",
            f"{median([row['iterations'] for row in rows]):.0f}",
            rounded(median(seconds), 2), rounded(max(seconds), 2)]


def findings(rows):
    text = []
    for method in dict.fromkeys(row["method"] for row in rows):
        own = [row for row in rows if row["method"] == method]
        scenes = {key: of for key, of in groups(own).items() if len(of) >= 10}
        enough = sum(10 * sum(row["certified"] for row in of) >= 9 * len(of)
                     for of in scenes.values())
        parts = [f"- `{method}`: {sum(row['certified'] for row in own)} of {len(own)} "
                 f"runs end with a path that is free for all t, proved; 9 of 10 or more "
                 f"on {enough} of {len(scenes)} scenes that have 10 runs or "
                 "more."]
        claims = [row for row in own if method == SAMPLES and
                  (converged(row) or stalled(row))]
        if method == SAMPLES:
            parts.append(f"Ipopt calls {len(claims)} of its ends solved; the judge "
                         f"refutes {sum(row['refuted'] for row in claims)} of them.")
        else:
            parts.append(f"{sum(map(converged, own))} converged, "
                         f"{sum(map(stalled, own))} stalled; no plan in time: "
                         f"{sum(map(has_no_plan, own))}.")
            planned = [row for row in own if row["planned_length"] > 0]
            longer = sum(row["length"] > row["planned_length"] * (1 + 1e-12)
                         for row in planned)
            if planned:
                parts.append(f"Of {len(planned)} with a plan {longer} are longer "
                             "than it.")
        text.append(" ".join(parts))
    return text


def wrapped(lines):
    import textwrap
    return "\n".join(textwrap.fill(text, 88, subsequent_indent="  ",
                                   break_on_hyphens=False) for text in lines)


def main():
    folder = parse_folder(__doc__)
    rows = read_rows(folder / "rows.jsonl")
    table = [line(*key, of) for key, of in groups(rows).items()]
    seeds = sorted({row["seed"] for row in rows})
    text = [QUESTION + wrapped(findings(rows)), "",
            markdown("Runs", "", HEADER, table, "rows.jsonl"), NOTES,
            wrapped([f"{read_measured(folder)} Seeds: {', '.join(map(str, seeds))}; "
                     "seeds 1 to 10 were looked at while it was made. Limit: "
                     f"{rounded(rows[0]['limit'])} processor seconds a run."]), ""]
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")


if __name__ == "__main__":
    main()
