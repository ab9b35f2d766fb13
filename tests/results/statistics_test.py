# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of the reports beside SciPy's and NumPy's, on random counts."""
import pathlib
import sys

import numpy as np
import pytest
from scipy import stats

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]
                       / "results/bench"))
import report_statistics as ours  # noqa: E402

RANDOM = np.random.default_rng(1)
COUNTS = RANDOM.integers(0, 400, (200, 2)).tolist()


@pytest.mark.parametrize("wins, losses", COUNTS)
def test_sign_test_is_the_exact_binomial(wins, losses):
    wanted = stats.binomtest(wins, wins + losses, 0.5).pvalue
    assert ours.sign_test(wins, losses) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("k, more", COUNTS)
def test_wilson_is_scipys(k, more):
    n = k + more
    wanted = stats.binomtest(k, n).proportion_ci(method="wilson")
    # 1.96 is the normal quantile to four digits.
    assert ours.wilson(k, n) == pytest.approx(wanted, abs=2e-5)


def test_quantiles_are_numpys():
    for n in range(1, 60):
        values = RANDOM.normal(size=n)
        for fraction in 0, 0.1, 0.25, 0.5, 0.99, 1:
            assert ours.quantile(values.tolist(), fraction) == pytest.approx(
                np.quantile(values, fraction), rel=1e-12, abs=1e-14)


def test_holm_rejects_as_its_rule_says():
    """Another route: the rule itself, one test after the other."""
    for n in range(1, 40):
        p = (RANDOM.uniform(size=n) ** 3).tolist()
        adjusted = ours.holm(p)
        for level in 0.01, 0.05, 0.2:
            rejected, order = set(), sorted(range(n), key=p.__getitem__)
            for i, at in enumerate(order):
                if p[at] > level / (n - i):
                    break
                rejected.add(at)
            assert {i for i in range(n) if adjusted[i] <= level} == rejected


def test_the_interval_of_a_median_covers_it_as_a_fair_coin_says():
    """Between the i-th and the j-th of n values the median lies if from i to j - 1
    of n fair coins show heads: 92 to 98 % here, 94 to 96 % from 200 on."""
    for n in range(10, 1000):
        _, i, j = ours.median_interval(range(1, n + 1))
        covered = stats.binom.cdf(j - 1, n, 0.5) - stats.binom.cdf(i - 1, n, 0.5)
        assert abs(covered - 0.95) < (0.01 if n >= 200 else 0.03), n


def test_the_paired_difference_is_that_of_its_counts():
    """Wald's interval from the differences themselves, one a problem."""
    for only_own, only_rival in COUNTS[:50]:
        n = only_own + only_rival + 30
        apart = np.array([1] * only_own + [-1] * only_rival + [0] * 30)
        half = stats.norm.ppf(0.975) * apart.std() / np.sqrt(n)
        assert ours.paired_difference(only_own, only_rival, n) == pytest.approx(
            (apart.mean(), apart.mean() - half, apart.mean() + half), abs=1e-6)
