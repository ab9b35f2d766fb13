# SPDX-License-Identifier: GPL-3.0-or-later
"""Metrics beside each other in a solver, on scenes of one's own."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _native
from ._arguments import flag, real, text
from ._colours import lines_of
from ._frames import frame_of
from ._lists import names, seed_numbers
from ._native import InputError
from ._plots import new_axes, plot_profile

MEASURES = ("iterations", "evaluations.jacobian", "seconds.total")
# A profile ends there, at so many times the least.
_LARGEST = 100.0


@dataclass(frozen=True)
class Comparison:
    """Rows of `compare`, of `phongpd compare` or of `cluster.convergence`."""

    rows: list[dict[str, Any]] = field(repr=False)
    """As docs/outputs.md has those of `optimize`, with `method`, the metric, and
    `protocol`, how it was run."""

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Comparison:
        """Of rows.jsonl that `phongpd compare --output` or a sweep wrote; rows
        that were refused have no answer and are left out."""
        with open(path, encoding="utf-8") as file:
            rows = [json.loads(line) for line in file if line.strip()]
        found = [row for row in rows if "method" in row and "protocol" in row]
        if not found:
            raise InputError(f"{os.fspath(path)}: expected rows of a comparison, "
                             f"found none among {len(rows)}")
        return cls(found)

    @property
    def methods(self) -> list[str]:
        """Names of the metrics, as they first come."""
        return list(dict.fromkeys(row["method"] for row in self.rows))

    @property
    def protocols(self) -> list[str]:
        return list(dict.fromkeys(row["protocol"] for row in self.rows))

    def frame(self) -> Any:
        """A pandas.DataFrame, a line a run; nested values have columns such as
        "seconds.total".  Needs pandas."""
        return frame_of(self.rows, "frame")

    def profile(self, protocol: str, measure: str = "iterations"
                ) -> dict[str, list[tuple[float, float]]]:
        """The performance profile: by metric, where its curve rises, (f, share):
        the share of its problems that it solved within f times the least
        `measure` that any metric took there; f from small to large."""
        value = _measure(measure)
        problems: dict[tuple[Any, ...], dict[str, float]] = {}
        for row in self.rows:
            if row["protocol"] == protocol:
                problems.setdefault((row["scene"], row["seed"]), {})[
                    row["method"]] = value(row) if row["solved"] else np.inf
        if not problems:
            raise InputError(f"protocol: expected one of {self.protocols}, found "
                             f"{protocol!r}")
        curves: dict[str, list[tuple[float, float]]] = {}
        for method in self.methods:
            asked = [costs for costs in problems.values() if method in costs]
            ratios = sorted(costs[method] / min(costs.values())
                            for costs in asked if np.isfinite(costs[method]))
            if asked:
                curves[method] = [(ratio, (i + 1) / len(asked))
                                  for i, ratio in enumerate(ratios)]
        return curves

    def plot(self, measure: str = "iterations", axes: Any = None) -> Any:
        """Performance profiles, one for each protocol, in the colours and lines
        of results/: higher and further left is better.  axes: as many of
        matplotlib as there are protocols; None: of a new figure.  Returns them.
        Needs matplotlib."""
        _measure(measure)
        protocols = self.protocols
        axes = new_axes("plot", axes, len(protocols), 3.2)
        for protocol, one in zip(protocols, axes):
            curves = self.profile(protocol, measure)
            plot_profile(one, curves, lines_of(self.methods), _LARGEST)
            one.set_title(protocol)
            one.set_ylabel("share of problems solved")
        axes[-1].set_xlabel(f"{measure} over the least of all metrics'")
        return axes

    def __str__(self) -> str:
        lines = []
        for protocol in self.protocols:
            for method in self.methods:
                rows = [row for row in self.rows if row["protocol"] == protocol
                        and row["method"] == method]
                if not rows:
                    continue
                solved = [row["iterations"] for row in rows if row["solved"]]
                lines.append(
                    f"{protocol}, {method}: {len(solved)} of {len(rows)} solved"
                    + (f", median of {np.median(solved):g} iterations"
                       if solved else ""))
        return "\n".join(lines)

    def __repr__(self) -> str:
        return (f"<Comparison: {len(self.rows)} runs of {len(self.methods)} "
                f"metrics by {len(self.protocols)} protocols>")


def compare(scenes: str | os.PathLike[str] | Sequence[str | os.PathLike[str]], *,
            metrics: Sequence[str] = ("euclidean", "phong@0.2"),
            protocols: Sequence[str] = ("straight-adaptive",),
            seeds: Iterable[int] = range(1, 6), max_mib: float = 0.0,
            cache: bool = False) -> Comparison:
    """Optimises a trajectory of every scene from every seed by every protocol
    and metric, as `phongpd compare` does, one after the other.

    scenes: a file or a family with knobs ("u_axis"), or a list of such.
    metrics, protocols: as `phongpd compare --help` has them.  seeds: whole
    numbers from 1 on; a seed draws start and goal of a family.  max_mib, cache:
    as of World.  Five seeds show that it runs; a finding takes fifty, and
    `cluster.convergence` all cores.
    """
    if isinstance(scenes, (str, os.PathLike)):
        scenes = [scenes]
    subjects = names(scenes, "scenes")
    methods = [(protocol, metric) for protocol in names(protocols, "protocols")
               for metric in names(metrics, "metrics")]
    for protocol, metric in methods:
        _native.check_method(text(protocol, "protocols"), text(metric, "metrics"))
    numbers = seed_numbers(seeds)
    limit, keeps = real(max_mib, "max_mib", "MiB"), flag(cache, "cache")
    rows, seen = [], set()
    for subject in subjects:
        digest = _native.scene_digest(subject)
        if digest in seen:
            raise InputError(f"scenes: expected different ones, found {subject!r} "
                             "twice")
        seen.add(digest)
    for subject in subjects:
        study = _native.Comparison(subject, limit, keeps)
        rows += [json.loads(study.row(seed, protocol, metric))
                 for seed in numbers for protocol, metric in methods]
    return Comparison(rows)


def _measure(name: str) -> Any:
    """What it is of a row."""
    if name not in MEASURES:
        raise InputError(f"measure: expected one of {', '.join(MEASURES)}, found "
                         f"{name!r}")

    def value(row: dict[str, Any]) -> float:
        found: Any = row
        for key in name.split("."):
            found = found[key]
        return max(1e-9, float(found))
    return value
