# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences in figures about fleets, for claims.py."""
import statistics

from claims_tables import table

FLEET_CLAIMS = []


ROWS = table("fleets/fleets.csv")
FOUND = [row for row in ROWS if row["solved"] == "yes"]
# "every pair of those certified"
assert all(row["certified"] == row["pairs"] for row in FOUND)


def later():
    """How much later than the slowest alone all have arrived, in %: the median of
    each kind and number of robots."""
    groups = {}
    for row in FOUND:
        groups.setdefault((row["kind"], int(row["robots"])), []).append(
            100 * (float(row["duration"]) / float(row["alone"]) - 1))
    return {key: round(statistics.median(of)) for key, of in groups.items()}


LATER = later()
CIRCLES = [LATER.pop(("across a circle", robots)) for robots in (8, 16)]
FLEET_CLAIMS.append((
    "results/README.md", "{} of {} fleets have motions, every pair of those certified; "
    "{} to {} % later in the median of most kinds, {} and {} % where 8 and 16 cross a "
    "circle", (len(FOUND), len(ROWS), min(LATER.values()), max(LATER.values()),
               *CIRCLES)))
