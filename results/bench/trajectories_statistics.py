# SPDX-License-Identifier: GPL-3.0-or-later
"""Intervals of 95 %: of shares by Clopper and Pearson, of medians by the
bootstrap over scenes, as pairs of one scene are alike."""
import math

import numpy as np

ROUNDS, SEED = 2_000, 1


def _tail(k, n, p):
    """P(at most k of n)."""
    if p <= 0.0:
        return 1.0
    if p >= 1.0:
        return float(k >= n)
    return math.fsum(math.exp(
        math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1)
        + i * math.log(p) + (n - i) * math.log1p(-p)) for i in range(k + 1))


def _root(is_below):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_below(middle) else (low, middle)
    return 0.5 * (low + high)


def share_interval(k, n):
    """Where the share may lie of which k of n were seen."""
    low = 0.0 if k == 0 else _root(lambda p: 1.0 - _tail(k - 1, n, p) < 0.025)
    high = 1.0 if k == n else _root(lambda p: _tail(k, n, p) > 0.025)
    return low, high


def median_interval(values, scenes):
    """Of values, one for each entry of scenes, which are drawn as a whole; where
    there is one alone, its values are."""
    by_scene = {}
    for value, scene in zip(values, scenes):
        by_scene.setdefault(scene, []).append(value)
    groups = [np.array(group) for group in by_scene.values()]
    if len(groups) == 1:
        groups = [np.array([value]) for value in groups[0]]
    chance = np.random.default_rng(SEED)
    medians = [np.median(np.concatenate(
        [groups[k] for k in chance.integers(len(groups), size=len(groups))]))
        for _ in range(ROUNDS)]
    return tuple(float(x) for x in np.quantile(medians, (0.025, 0.975)))
