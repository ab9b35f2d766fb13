# SPDX-License-Identifier: GPL-3.0-or-later
"""baselines.md and widths.md of results/planning, each where its rows are in the
folder: baselines.csv of retraction_benchmark, whose tests are made here, and
widths.csv of width_benchmark."""

from python_report import (markdown, parse_folder, read_dicts, read_measured,
                           read_table, rounded, write_csv)
from report_statistics import holm, sign_test

LEVEL = 0.05
BASELINES = """\
# Retraction against baselines of equal strength

A colliding sample has many projections along Phong directions, and one nearest
point: a comparison of those two is one of many candidates with one. Here the
baselines are as strong: `euclidean-all` takes every point that is the nearest
one around it, `contact-points` as many random points of the contact space as
there are Phong branches, `contact-point` one of them. `retraction-forest`, the
same seeds and exact motion checks for all.

"""
WIDTHS = """\
# How narrow a passage may be

δ is the side of the free channel in a world of size 2. OMPL's samplers with
OMPL's own settings (`rrt-connect`: the range that its setup takes from the
space's extent; `prm`: its connection strategy; the others: `prm` with its
obstacle-based, Gaussian and bridge-test samplers), 60 s a run, and how many runs
were solved after 1, 10 and 60 s. A planner whose first run fails in one passage
has no further ones there, nor in narrower ones. All planners have the same exact
motion checks. Narrowest δ of which every run was solved:

"""


def write_page(folder, name, text):
    (folder / f"{name}.md").write_text(
        f"{text}\n{read_measured(folder, f'{name}_measured.txt')}\n",
        encoding="utf-8")


def tested(rows):
    """The same rows with p and verdict, Holm's correction over all of them."""
    splits = [tuple(map(int, row["fewer : more"].split(" : "))) for row in rows]
    for row, split, p in zip(rows, splits, holm([sign_test(*s) for s in splits])):
        row["p"] = rounded(p)
        row["Phong"] = ("tie" if p >= LEVEL else
                        "win" if split[0] > split[1] else "loss")
    return rows


def baseline_page(folder):
    rows = tested(read_dicts(folder / "baselines.csv"))
    header, cells = list(rows[0]), [list(row.values()) for row in rows]
    write_csv(folder / "baselines.csv", header, cells)
    found = ""
    for baseline in dict.fromkeys(row["baseline"] for row in rows):
        verdicts = [row["Phong"] for row in rows if row["baseline"] == baseline]
        found += f"- Against `{baseline}`: " + ", ".join(
            f"{verdicts.count(one)} {words}" for one, words in
            (("win", "wins"), ("tie", "ties"), ("loss", "losses"))) + ".\n"
    write_page(folder, "baselines", f"{BASELINES}{found}\n" + markdown(
        "All Phong branches against each baseline",
        "Median samples until solved; a run that its limit of 2 s ends counts as "
        "more than any. Fewer: seeds on which Phong took fewer samples, and on which "
        "it took more. p: exact sign test over the seeds, "
        "Holm's correction over all rows; win or loss below 0.05, else tie.",
        header, cells, "baselines.csv"))
    print(found, end="")


def width_lines(rows):
    exact = [row for row in rows if row["planner"] == "contact-surface"]
    sure = {row["planner"]: {} for row in rows if row not in exact}
    for row in rows:
        if row not in exact and row["runs"] not in ("0", "–") and (
                row["60 s"] == row["runs"]):
            # From wide to narrow: the last one stays.
            sure[row["planner"]][row["scene"]] = row["δ"]
    for planner, widths in sure.items():
        yield f"- `{planner}`: " + (", ".join(
            f"{scene} {width}" for scene, width in sorted(widths.items()))
            or "none of these passages") + ".\n"
    wrong = sum(row["60 s"] == "0" for row in exact)
    slowest = 1e3 * max(float(row["median s"]) for row in exact)
    yield (f"- `contact-surface`: all {len(exact)}"
           + (f" but {wrong}" if wrong else "")
           + f", at most {rounded(slowest)} ms once its tables are there.\n")


def width_page(folder):
    table = read_table(
        folder, "widths.csv", "Passages from wide to narrow",
        "Solved within 1, 10 and 60 s, of the runs, and the median time of those "
        "solved. –: not asked, as no run solved the next wider passage in 60 s.")
    found = "".join(width_lines(read_dicts(folder / table.file)))
    write_page(folder, "widths", f"{WIDTHS}{found}\n" + markdown(
        table.title, table.note, table.header, table.rows, table.file))
    print(found, end="")


def main():
    folder = parse_folder(__doc__)
    if (folder / "baselines.csv").exists():
        baseline_page(folder)
    if (folder / "widths.csv").exists():
        width_page(folder)


if __name__ == "__main__":
    main()
