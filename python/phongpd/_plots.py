# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures by matplotlib, which need not be there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Callable

import numpy as np

from ._arguments import Floats
from ._colours import GREY, GRID, LINE_COLOURS, Line
from ._native import InputError

# A figure asks for so many places of a way.
PLACES = 400


def pyplot(what: str) -> Any:
    try:
        from matplotlib import pyplot as found
    except ImportError as error:
        raise ImportError(f"{what}: expected the package matplotlib, found none; "
                          "pip install matplotlib") from error
    return found


def new_axes(what: str, axes: Any, count: int, height: float = 2.2) -> Any:
    """`count` of them, one above the other: a new figure's, or those given."""
    plots = pyplot(what)
    if axes is None:
        _, axes = plots.subplots(
            count, 1, sharex=True, figsize=(7, 1 + height * count),
            constrained_layout=True, squeeze=False)
        axes = axes[:, 0]
    axes = np.atleast_1d(axes)
    if axes.shape != (count,) or not hasattr(axes[0], "plot"):
        raise InputError(f"axes: expected {count} of matplotlib, found "
                         f"{axes.size} of {type(axes.flat[0]).__name__}"
                         if axes.size else
                         f"axes: expected {count} of matplotlib, found none")
    return axes


def plot_vectors(one: Any, x: Floats, values: Floats, name: str) -> None:
    """x, y and z of (M, 3), each in its colour."""
    for k, axis in enumerate("xyz"):
        one.plot(x, values[:, k], label=axis, color=LINE_COLOURS[k])
    one.set_ylabel(name)
    one.grid(color=GRID)


def places_on(path: Floats) -> tuple[Floats, Floats]:
    """Ways gone and places: corners of a polyline and PLACES in even steps."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    gone = np.concatenate([[0.0], np.cumsum(steps)])
    ways = np.union1d(gone, np.linspace(0.0, gone[-1], PLACES))
    places = np.stack([np.interp(ways, gone, path[:, k]) for k in range(3)],
                      axis=1)
    return ways, places


def plot_path(axes: Any, path: Floats, unit: str, margin: float | None,
              clearance: Callable[[Floats], Floats] | None) -> Any:
    """Position and, where it can be asked for, the room that it has, along the
    way; the margin that was asked for is dashed."""
    axes = new_axes("plot", axes, 1 if clearance is None else 2)
    axes[-1].set_xlabel(f"way ({unit})")
    if clearance is not None:
        axes[1].set_ylabel(f"clearance ({unit})")
        axes[1].grid(color=GRID)
        if margin is not None:
            axes[1].axhline(margin, color=GREY, linestyle="--", linewidth=0.8)
    ways, places = places_on(path) if len(path) else (
        np.empty(0), np.empty((0, 3)))
    plot_vectors(axes[0], ways, places, f"position ({unit})")
    axes[0].legend(loc="upper left")
    if clearance is not None and len(ways):
        axes[1].plot(ways, clearance(places), color=LINE_COLOURS[0])
    return axes


def plot_poses(axes: Any, poses: Floats) -> Any:
    """Position and turn from the first, in degrees, of (N, 4, 4)."""
    axes = new_axes("plot", axes, 2)
    numbers = np.arange(float(len(poses)))
    plot_vectors(axes[0], numbers, poses[:, :3, 3], "position")
    axes[0].legend(loc="upper left")
    if len(poses):
        turns = poses[0, :3, :3].T @ poses[:, :3, :3]
        # By both, as neither tells all angles well.
        sine = np.linalg.norm(turns - turns.transpose(0, 2, 1),
                              axis=(1, 2)) / np.sqrt(8.0)
        cosine = (np.trace(turns, axis1=1, axis2=2) - 1.0) / 2.0
        axes[1].plot(numbers, np.degrees(np.arctan2(sine, cosine)),
                     color=LINE_COLOURS[0])
    axes[1].set_ylabel("turn (°)")
    axes[1].grid(color=GRID)
    axes[1].set_xlabel("pose")
    return axes


def plot_profile(one: Any, curves: Mapping[str, Sequence[tuple[float, float]]],
                 lines: Mapping[str, Line], most: float) -> None:
    """Curves that rise in steps, (x, share), from 1 to `most`, named in the
    legend with the highest on top."""
    ends = {}
    for name, points in curves.items():
        seen = [(x, y) for x, y in points if x <= most]
        ends[name] = seen[-1][1] if seen else 0.0
        line = lines[name]
        one.step([1.0, *(x for x, _ in seen), most],
                 [0.0, *(y for _, y in seen), ends[name]], where="post",
                 color=line.colour, linewidth=0.75 * line.width, label=name,
                 linestyle=(0, line.dash) if line.dash else "-")
    one.set(xscale="log", xlim=(1.0, most), ylim=(0.0, 1.03))
    one.grid(color=GRID)
    handles, names = one.get_legend_handles_labels()
    order = sorted(range(len(names)), key=lambda i: -ends[names[i]])
    one.legend([handles[i] for i in order], [names[i] for i in order],
               loc="lower right")
