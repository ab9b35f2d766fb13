# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of results/study/protocol.md: differences of families, which are
drawn as a whole, as runs of one are alike."""
import numpy as np

ROUNDS, SEED = 10_000, 1
MOST_FLIPS = 20  # of all 2^n ways; beyond, as many are drawn
TIE = 0.03  # of a share
LEVEL = 0.05


def interval(differences, level):
    """Of the mean of the families' differences, by the bootstrap."""
    values = np.asarray(differences, dtype=float)
    chance = np.random.default_rng(SEED)
    drawn = chance.integers(len(values), size=(ROUNDS, len(values)))
    tail = (1.0 - level) / 2.0
    low, high = np.quantile(values[drawn].mean(axis=1), (tail, 1.0 - tail))
    return float(low), float(high)


def p_of_flips(differences):
    """Two-sided: how often the mean is as far from 0 if every family's difference
    may as well have the other sign."""
    values = np.asarray(differences, dtype=float)
    values = values[values != 0.0]  # those have no sign
    if len(values) == 0:
        return 1.0
    if len(values) <= MOST_FLIPS:
        numbers = np.arange(2 ** len(values))
        bits = (numbers[:, None] >> np.arange(len(values))) & 1
    else:
        bits = np.random.default_rng(SEED).integers(
            2, size=(2 ** MOST_FLIPS, len(values)))
    sums = np.abs((1 - 2 * bits) @ values)
    # Sums of the same terms in another order round differently.
    return float(np.mean(sums >= abs(values.sum()) * (1.0 - 1e-12)))


def verdict(differences, corrected):
    if corrected < LEVEL:
        return "win" if np.mean(differences) > 0.0 else "loss"
    low, high = interval(differences, 0.9)
    return "tie" if -TIE < low and high < TIE else "open"
