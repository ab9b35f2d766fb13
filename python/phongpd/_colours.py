# SPDX-License-Identifier: GPL-3.0-or-later
"""The one table of how curves of metrics look, in the package's figures and in
those of results, which read this file by itself: nothing is imported here but
what Python has."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Tuple


class Line(NamedTuple):
    """A width in pixels; dashes are lengths on and off, none of a solid line."""

    colour: str
    width: float
    dash: Tuple[int, ...] = ()


# One colour a metric, here, in still pictures and in pages
# (problems/output/metric_color.h, viewer/colors.js; a test compares them).
METRIC_COLOURS = {"phong": "#0060B0", "euclidean": "#D55E00",
                  "sliding": "#009E73"}
# The metric that is compared is thick, what it is compared with dashed; others by
# Okabe and Ito and by Tol, told apart by colour-blind readers, and by dash once
# more.
MAIN = Line(METRIC_COLOURS["phong"], 4.0)
BASELINE = Line(METRIC_COLOURS["euclidean"], 2.0, (10, 4))
OTHER_COLOURS = ("#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#000000", "#882255",
                 "#999933", "#888888")
OTHER_WIDTH = 1.8
OTHER_DASHES: Tuple[Tuple[int, ...], ...] = ((), (4, 3), (12, 4, 2, 4))
# Of lines that name no colour; x, y and z are the first three.
LINE_COLOURS = ("#0060B0", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9",
                "#882255", "#999933")
GRID, GREY = "#DDDDDD", "#888888"

# Metrics that have a role, whatever else is drawn.
ROLES = {"euclidean": BASELINE, "phong@0.2": MAIN}


def other(k: int) -> Line:
    """Of the k-th curve without a role, k from 0."""
    return Line(OTHER_COLOURS[k % len(OTHER_COLOURS)], OTHER_WIDTH,
                OTHER_DASHES[k % len(OTHER_DASHES)])


def lines_of(metrics: Iterable[str]) -> dict[str, Line]:
    """By name; those without a role take the others' in their order."""
    found: dict[str, Line] = {}
    others = 0
    for metric in metrics:
        if metric in found:
            continue
        if metric in ROLES:
            found[metric] = ROLES[metric]
        else:
            found[metric] = other(others)
            others += 1
    return found
