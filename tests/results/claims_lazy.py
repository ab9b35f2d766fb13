# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences in figures about windows, for claims.py."""
from claims_tables import where

MOST_SHARE = 0.3
LAZY_CLAIMS = []


def shares(metric):
    """Of the whole's time, all of it, from the straight line; by pair."""
    rows = where("lazy/window_path.csv", start="straight", metric=metric)
    assert len({row["pair"] for row in rows}) == len(rows)
    return [float(row["windows, CPU s"]) / float(row["whole, CPU s"])
            for row in rows]


def cheap(metric):
    return sum(share <= MOST_SHARE for share in shares(metric))


LAZY_CLAIMS.append((
    "docs/choosing.md", "from straight lines at most {} of the time on {} of {} pairs "
    "({}), the larger ones, but more than all of it",
    (MOST_SHARE, cheap("euclidean"), len(shares("euclidean")),
     cheap("smoothed@0.02"))))
assert max(shares("euclidean")) > 1
