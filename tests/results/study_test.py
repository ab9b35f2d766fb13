# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of results/study: by hand, by SciPy's own, and of rows whose
answer is known."""
import json
import pathlib
import sys

import numpy as np
import pytest
from scipy import stats

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results/bench"))
import study_report  # noqa: E402
from report_statistics import holm  # noqa: E402
from study_statistics import interval, p_of_flips, verdict  # noqa: E402


def test_flips_count_all_ways():
    # Of 2^3 signs of (1, 2, 3) the two of the largest sum.
    assert p_of_flips([1.0, 2.0, 3.0]) == 2 / 8
    assert p_of_flips([1.0, -1.0]) == 1.0
    assert p_of_flips([0.0, 0.0]) == 1.0
    # Families without a difference decide nothing.
    assert p_of_flips([1.0, 2.0, 3.0, 0.0]) == 2 / 8
    values = np.random.default_rng(5).normal(0.4, 1.0, 14)
    truth = stats.permutation_test(
        (values,), np.mean, permutation_type="samples", n_resamples=np.inf)
    assert p_of_flips(values) == pytest.approx(truth.pvalue, abs=1e-12)


def test_intervals_are_those_of_scipys_bootstrap():
    values = np.random.default_rng(7).normal(0.1, 0.2, 15)
    own = interval(values, 0.95)
    other = stats.bootstrap((values,), np.mean, n_resamples=10_000,
                            method="percentile", random_state=3)
    assert own == pytest.approx(tuple(other.confidence_interval), abs=0.01)
    assert interval([0.25] * 6, 0.95) == (0.25, 0.25)


def test_holm_by_hand():
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([0.5, 0.9]) == [1.0, 1.0]


def test_a_tie_needs_a_narrow_interval():
    assert verdict([0.01, -0.01, 0.005, 0.0], 1.0) == "tie"
    assert verdict([0.2, -0.2, 0.1, -0.1], 1.0) == "open"
    assert verdict([0.2, 0.3], 0.04) == "win"
    assert verdict([-0.2, -0.3], 0.04) == "loss"


def made_rows(won):
    """Of 8 families; smoothed converges where the others do not, in `won`."""
    rows = []
    for family in range(8):
        for protocol in study_report.PROTOCOLS:
            for method in ("euclidean", "phong@0.2", "smoothed@0.2",
                           "smoothed-foot@0.2", "diffused@0.2", "placebo@0.2"):
                is_won = method.startswith("smoothed") and protocol in won
                rows.append({
                    "scene": f"f{family}:x=1", "family": f"f{family}", "seed": "1",
                    "protocol": protocol, "method": method, "free": True,
                    "converged": is_won, "stalled": False, "iterations": 10})
    return rows


def test_the_rule_follows_the_hypotheses():
    everywhere = study_report.hypotheses(made_rows(study_report.PROTOCOLS))
    words = {(one["name"], one["verdict"]) for one in everywhere}
    # 2 of 2^8 ways, times 28 at most.
    assert ("H1", "open") in words or ("H1", "win") in words
    none = study_report.hypotheses(made_rows(()))
    assert {one["verdict"] for one in none} == {"tie"}
    assert "the default stays" in study_report.conclusion(none)
    for one in everywhere:
        one["verdict"] = "win" if one["name"] == "H1" else "open"
    assert "becomes the default" in study_report.conclusion(everywhere)
    everywhere[0]["verdict"] = "loss"
    assert "the default stays" in study_report.conclusion(everywhere)


def test_rows_of_incomplete_blocks_are_refused():
    rows = made_rows(())[:-1]
    with pytest.raises(SystemExit, match="incomplete"):
        study_report.hypotheses(rows)


def test_later_seeds_join_published_rows(tmp_path):
    published = ROOT / "results/study/rows.csv"
    lines = published.read_text().splitlines()
    run = dict(zip(lines[0].split(","), lines[1].split(",")))
    later = dict(run, seed=70002, collision_free=True, iterations=7,
                 restoration_iterations=0, objective=1.25, seconds=3.0)
    (tmp_path / "later.jsonl").write_text(
        json.dumps(later) + "\n" + json.dumps(dict(later, seed=100000)) + "\n")
    (tmp_path / "published.csv").write_text("\n".join(lines[:2]) + "\n")
    study_report.write_csv(tmp_path, [tmp_path / "later.jsonl",
                                      tmp_path / "published.csv",
                                      tmp_path / "published.csv"])
    joined = (tmp_path / "rows.csv").read_text().splitlines()
    assert joined[:2] == lines[:2]
    assert [line.split(",")[3] for line in joined[1:]] == ["70001", "70002", "100000"]
    assert joined[3].endswith(",true,7,0,1.25")

    other = lines[1].replace(",18,", ",19,")
    assert other != lines[1]
    (tmp_path / "other.csv").write_text("\n".join((lines[0], other)) + "\n")
    with pytest.raises(SystemExit, match="the same program"):
        study_report.write_csv(tmp_path, [published, tmp_path / "other.csv"])


@pytest.mark.parametrize("block", study_report.BLOCKS.values(),
                         ids=study_report.BLOCKS)
def test_the_published_page_is_that_of_its_rows(block, tmp_path):
    folder = ROOT / "results/study"
    if not (folder / block.rows).exists():
        pytest.skip("no rows yet")
    for file in folder.glob("*.csv"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    page = (folder / block.page).read_text()
    study_report.report(tmp_path, page.rstrip().splitlines()[-1], block)
    assert (tmp_path / block.page).read_text() == page


def test_the_page_of_further_metrics_is_that_of_its_rows(tmp_path):
    folder = ROOT / "results/study"
    (tmp_path / "further.csv").write_bytes((folder / "further.csv").read_bytes())
    page = (folder / "further.md").read_text()
    study_report.further_report(tmp_path, page.rstrip().splitlines()[-1])
    assert (tmp_path / "further.md").read_text() == page


def test_intervals_that_leave_zero_out_are_named():
    found = [{"a": "x", "b": "y", "protocol": "p", "difference": 0.02,
              "interval": interval} for interval in
             ((-0.01, 0.05), (0.01, 0.03), (0.0, 0.04), (-0.04, -0.01))]
    assert study_report.apart_from_zero(found) == (
        "`x` against `y`, p: +2.0; `x` against `y`, p: +2.0")
    assert study_report.apart_from_zero(found[:1]) == "none"


def test_scenes_of_a_kind_are_counted_together():
    found = [study_report.kind(scene, {"bunny00"}) for scene in
             ("bunny00", "joint", "u:robot", "several3")]
    assert found == ["a scan as the obstacle", "the obstacle", "the robot",
                     "several obstacles"]


def test_wins_are_told_beside_the_first_block(tmp_path):
    (tmp_path / "rows.csv").write_bytes((ROOT / "results/study/rows.csv").read_bytes())
    found = study_report.hypotheses(made_rows(()))
    assert study_report.beside_first(tmp_path, found) == "none"
    found[0]["verdict"], found[-1]["verdict"] = "win", "loss"
    assert study_report.beside_first(tmp_path, found) == (
        "H1, straight-monotone: win, there open; "
        "H7, repaired-adaptive: loss, there tie")


if __name__ == "__main__":
    sys.exit(pytest.main([__file__, "-q", "-p", "no:cacheprovider"]))
