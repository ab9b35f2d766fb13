# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of the reports: of counts and of medians, without any package, so
that every table can be made anew by a plain Python.  Tested against SciPy."""

import math

NORMAL_95 = 1.959964  # of a normal distribution, 95 % lie within ± that


def quantile(values, fraction):
    """Below which that fraction lies, linear between the two nearest: 0.5 is the
    median.  0 without any."""
    ordered = sorted(values)
    if not ordered:
        return 0.0
    place = fraction * (len(ordered) - 1)
    below = math.floor(place)
    rest = place - below
    if rest == 0.0:
        return ordered[below]
    return ordered[below] + rest * (ordered[below + 1] - ordered[below])


def median(values):
    return quantile(values, 0.5)


def sign_test(wins, losses):
    """Exact, two-sided: how likely is it that of as many fair coins the fewer
    are at most as many as here?  1 without any."""
    n = wins + losses
    tail = sum(math.comb(n, k) for k in range(min(wins, losses) + 1))
    return min(1.0, 2 * tail / 2 ** n)


def holm(p):
    """Holm's step-down: p values as they are after as many tests, in the order
    given.  A family of tests then errs at all with at most the level taken."""
    adjusted, least = [0.0] * len(p), 0.0
    for i, at in enumerate(sorted(range(len(p)), key=p.__getitem__)):
        least = min(1.0, max(least, (len(p) - i) * p[at]))
        adjusted[at] = least
    return adjusted


def median_interval(values):
    """Median, and the order statistics that enclose it in about 95 % (normal
    approximation: 92 to 98 % from 10 values on, 94 to 96 % from 200)."""
    ordered = sorted(values)
    n = len(ordered)
    low = max(0, math.floor(0.5 * n - 0.5 * NORMAL_95 * math.sqrt(n)))
    return median(ordered), ordered[low], ordered[n - 1 - low]


def paired_difference(only_own, only_rival, n):
    """Of two shares of the same n problems: own less rival's, and Wald's 95 %
    interval, from how many either solved alone."""
    n = max(1, n)
    apart = only_own - only_rival
    half = NORMAL_95 * math.sqrt(only_own + only_rival - apart * apart / n) / n
    return apart / n, apart / n - half, apart / n + half


def wilson(k, n):
    """Wilson's 95 % interval of a share k/n."""
    z, p = 1.96, k / n
    middle = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = (z / (1 + z * z / n)
            * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n)))
    return max(0.0, middle - half), min(1.0, middle + half)
