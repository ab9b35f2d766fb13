# SPDX-License-Identifier: GPL-3.0-or-later
"""The slice of the study that is made anew: rows chosen, cells compared, and what the
page says of rows that came out otherwise."""
import csv
import json
import pathlib
import stat
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results/bench"))
pytest.importorskip("phongpd")
import study_slice as slices  # noqa: E402


def write(path, header, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def test_rows_are_spread_over_the_whole_file_and_few_are_all_taken():
    assert slices.spread(range(100), 4) == [0, 25, 50, 75]
    assert slices.spread(range(3), 4) == [0, 1, 2]
    chosen = slices.spread(range(11040), 40)
    assert len(set(chosen)) == 40 and chosen[-1] == 11040 - 276


def test_cells_are_identical_or_rounded_or_told():
    into = slices.Slice("some.csv", 3)
    published = {"status": "solved", "length": "1.25", "steps": "7"}
    for length, steps in (("1.25", "7"), ("1.2500000000000009", "7"),
                          ("1.2500000001", "8")):
        slices.compare(into, published, published | {"length": length, "steps": steps},
                       ["status", "length", "steps"], length)
    assert (into.made, into.identical, into.rounded) == (3, 1, 1)
    assert into.deviations == [
        ("some.csv", "1.2500000001", "length", "1.25", "1.2500000001"),
        ("some.csv", "1.2500000001", "steps", "7", "8")]
    text = slices.page([into], "Command: x.")
    assert "1 of 3 are identical, 1 more but for rounding" in text
    assert "| some.csv | 3 | 3 | 1 | 1 | 1 | nothing |" in text
    assert "| some.csv | 1.2500000001 | steps | 7 | 8 |" in text


def test_runs_are_asked_for_by_the_problem_of_their_row(tmp_path):
    """A program that answers with what it was asked for, and another status for one
    of two seeds."""
    header = slices.study_report.COLUMNS
    row = {"protocol": "repaired-adaptive", "method": "phong@0.2", "status": "ok",
           "status_class": "solved", "collision_free": True, "iterations": 3,
           "restoration_iterations": 0, "objective": 1.5}
    program = tmp_path / "program"
    program.write_text(f"""#!{sys.executable}
import json, pathlib, sys
given = sys.argv[1:]
row = {row!r}
row["scene"], row["seed"] = given[1], int(given[given.index("--seed") + 1])
row["protocol"] = given[given.index("--protocols") + 1]
row["method"] = given[given.index("--metrics") + 1]
row["iterations"] = int(given[given.index("--max-iter") + 1]) // 1000
row["status"] = "ok" if row["seed"] == 1 else "other"
folder = pathlib.Path(given[given.index("--output") + 1])
(folder / "rows.jsonl").write_text(json.dumps(row) + chr(10))
""")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    texts = {c: json.dumps(v) if isinstance(v, bool) else str(v) for c, v in row.items()}
    write(tmp_path / "rows.csv", header,
          [[{**texts, "scene": "u_trap", "seed": seed}[c] for c in header]
           for seed in (1, 2)])
    found = slices.of_comparisons(tmp_path, "rows.csv", program, 40, str)
    assert (found.made, found.identical, found.rounded) == (2, 1, 0)
    assert found.deviations == [
        ("rows.csv", "u_trap, repaired-adaptive, phong@0.2, 2", "status", "ok", "other")]


def test_published_powers_come_out_again():
    found = slices.of_power(ROOT / "results/study")
    assert found.made == found.published == found.identical == 28
