# SPDX-License-Identifier: GPL-3.0-or-later
"""defaults.md of results/trade, and the tests of defaults.csv, which
defaults_benchmark wrote into the folder."""

from python_report import (markdown, parse_folder, read_dicts, read_measured,
                           rounded, write_csv)
from report_statistics import holm, sign_test

LEVEL = 0.05
# Each test by the column of its counts; behind it stand p and verdict.
TESTS = {"faster : slower": ("p of time", "time is a"),
         "shorter : longer": ("p of it", "length or energy is a")}
HEAD = """\
# Defaults against their challengers

Whether a default is right is asked on the scenes of the studies, not on those
it was noticed on: every instance by both, in one process, paired.

"""


def tested(rows):
    """With p, after Holm's correction over all tests, and verdicts."""
    places = [(row, counts) for row in rows for counts in TESTS]
    splits = [tuple(map(int, row[counts].split(" : "))) for row, counts in places]
    for (row, counts), (wins, losses), p in zip(
            places, splits, holm([sign_test(*split) for split in splits])):
        row[TESTS[counts][0]] = rounded(p, 2)
        row[TESTS[counts][1]] = ("tie" if p >= LEVEL else
                                 "win" if wins > losses else "**loss**")
    header = []
    for column in rows[0]:
        if column not in header and not any(column in t for t in TESTS.values()):
            header += [column, *TESTS.get(column, ())]
    return header, [[row[column] for column in header] for row in rows]


def main():
    folder = parse_folder(__doc__)
    header, rows = tested(read_dicts(folder / "defaults.csv"))
    write_csv(folder / "defaults.csv", header, rows)
    (folder / "defaults.md").write_text(HEAD + markdown(
        "Defaults and their challengers",
        "Default first where two counts stand beside each other. Time: processor "
        "time of the challenger over the default's, median and quartiles. Length or "
        "energy: the same ratio, mean and quartiles; shorter and longer by more than "
        "0.1 %. p: two-sided sign test after Holm's correction over all tests of the "
        "table.", header, rows, "defaults.csv")
        + f"\n{read_measured(folder, 'defaults_measured.txt')}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
