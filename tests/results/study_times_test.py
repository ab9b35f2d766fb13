# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of metrics with everything in them: ratios by hand, and is the published page
that of the published rows?"""
import math
import pathlib
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results/bench"))
import study_times  # noqa: E402
from python_report import read_dicts  # noqa: E402

FOLDER = ROOT / "results/study"


def rows_of(seconds):
    return [{"scene": scene, "metric": metric, "problems": "1", "seconds": str(value)}
            for (scene, metric), value in seconds.items()]


def test_scenes_of_a_family_count_as_one():
    rows = rows_of({("u:a", "euclidean"): 1.0, ("u:a", "phong@0.2"): 4.0,
                    ("u:b", "euclidean"): 3.0, ("u:b", "phong@0.2"): 3.0,
                    ("v", "euclidean"): 2.0, ("v", "phong@0.2"): 1.0})
    # u: the root of 4 · 1 is 2; v: 1/2.
    assert sorted(study_times.ratios(rows, "phong@0.2", 1)) == \
        pytest.approx([-math.log(2.0), math.log(2.0)])
    assert study_times.ratios(rows, "euclidean", 1) == [0.0, 0.0]


def test_times_grow_with_problems_and_hold_what_was_built():
    rows = read_dicts(FOLDER / "times.csv")
    series = {}
    for row in rows:
        series.setdefault((row["scene"], row["metric"]), []).append(row)
    assert {len(of) for of in series.values()} == {len(study_times.COUNTS)}
    for of in series.values():
        assert [int(row["problems"]) for row in of] == list(study_times.COUNTS)
        seconds = [float(row["seconds"]) for row in of]
        assert seconds == sorted(seconds)
        assert 0.0 <= float(of[0]["before"]) <= seconds[0]
        assert all(int(r["free"]) <= int(r["problems"]) for r in of)


def test_the_page_is_that_of_the_rows():
    text = (FOLDER / "times.md").read_text()
    how = text.rstrip("\n").split("\n\n")[-1]
    assert text == study_times.page(read_dicts(FOLDER / "times.csv"), how)
