# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study costs: beside the textbook's formula, SciPy's exact binomial and
runs that are drawn; and is the published page that of the published rows?"""
import math
import pathlib
import sys

import numpy as np
import pytest
from scipy import stats

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results/bench"))
import study_power  # noqa: E402
import study_report  # noqa: E402


def test_reach_is_that_of_scipys_normal():
    assert study_power.reach(0.05) == pytest.approx(
        stats.norm.ppf(0.975) + stats.norm.ppf(0.8), abs=1e-9)


def test_two_shares_need_what_the_textbook_says():
    # Two independent shares of about one half, 10 points apart: 2·0.25·(2.8016/0.1)²
    # = 392.4 of each, whether families or seeds make them up.
    variance = 2 * 0.5 * 0.5
    assert study_power.seeds_needed(0.1, variance, 0.0, 1.0, 1) == 393
    assert study_power.seeds_needed(0.1, variance, 0.0, 1.0, 10) == 40
    assert study_power.seeds_needed(0.1, variance, 0.0, 0.5, 1) == 197
    assert study_power.families_needed(0.1, variance, 0.0, 1.0, 1) == 393
    # Half the effect, four times as many.
    assert study_power.seeds_needed(0.05, variance, 0.0, 1.0, 1) == \
        math.ceil(4 * 392.44)


def test_as_many_pairs_have_the_power_that_was_asked_for():
    # A differs from B in one pair of five, two times of three to its advantage:
    # δ = 1/15.  Power of the exact z test by SciPy's binomials.
    apart, won = 0.2, 2 / 3
    effect = apart * (2 * won - 1)
    variance = apart - effect ** 2
    n = study_power.seeds_needed(effect, variance, 0.0, 1.0, 1)
    power = 0.0
    for d in range(n + 1):
        wins = np.arange(d + 1)
        estimate = (2 * wins - d) / n
        error = np.sqrt(np.maximum(d / n - estimate ** 2, 0.0) / n)
        seen = estimate > 1.959964 * error
        power += stats.binom.pmf(d, n, apart) * \
            stats.binom.pmf(wins, d, won)[seen].sum()
    assert power == pytest.approx(0.8, abs=0.01)


def test_families_that_differ_set_a_floor():
    # With τ = 0.1 of 15 families the standard error never falls below 0.0258.
    assert study_power.seeds_needed(0.05, 0.1, 0.01, 1.0, 15) is None
    floor = study_power.reach(0.05) * 0.1 / math.sqrt(15)
    assert study_power.seeds_needed(floor * 1.01, 0.1, 0.01, 1.0, 15) > 400
    assert study_power.families_needed(0.05, 0.0, 0.01, 1.0, 20) == \
        math.ceil((study_power.reach(0.05) * 0.1 / 0.05) ** 2)


def drawn(families, scenes, seeds, between, chance):
    """Paired runs: A wins a pair with a probability that its family has."""
    pairs = {}
    for f in range(families):
        shift = chance.normal(0.0, between)
        for c in range(scenes):
            for s in range(seeds):
                a = chance.random() < min(1.0, max(0.0, 0.5 + shift))
                b = chance.random() < 0.5
                pairs[f"f{f}:c={c}", str(s)] = (
                    {"family": f"f{f}", "scene": f"f{f}:c={c}", "converged": a},
                    {"converged": b})
    return pairs


def test_variances_are_those_that_were_drawn():
    chance = np.random.default_rng(3)
    within, between, h, families = study_power.parts(
        drawn(400, 2, 10, 0.1, chance))
    # 0.25 of b, and E[p(1 − p)] = 0.25 − τ² of a.
    assert within == pytest.approx(0.49, abs=0.02)
    assert between == pytest.approx(0.01, abs=0.004)
    assert (h, families) == (0.5, 400)
    _, none, _, _ = study_power.parts(drawn(400, 2, 10, 0.0, chance))
    assert none < 0.003


def test_one_seed_is_refused():
    with pytest.raises(SystemExit, match="two seeds"):
        study_power.parts(drawn(3, 1, 1, 0.0, np.random.default_rng(1)))


def test_hours_are_runs_times_their_seconds():
    rows = [{"seed": str(seed)} for seed in range(5) for _ in range(552)]
    assert study_power.Bill(rows, 3600 / 8280).hours(15) == pytest.approx(1.0)


def test_published_page_is_that_of_the_published_rows(tmp_path):
    folder = ROOT / "results/study"
    rows = study_report.read_csv(folder)
    study_power.write_csv(tmp_path, study_power.needs(rows))
    assert (tmp_path / "power.csv").read_bytes() == \
        (folder / "power.csv").read_bytes()
    assert (folder / "power.md").read_text(encoding="utf-8") == \
        study_power.page(rows, study_power.read_rate(folder))
