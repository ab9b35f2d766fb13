# SPDX-License-Identifier: GPL-3.0-or-later
"""Peers beside PhongPD: peers.csv, peers_summary.csv."""
import importlib.metadata

import numpy as np
import phongpd
from trajectories_best import is_valid
from trajectories_peers import PEERS
from trajectories_statistics import median_interval

OWN, PATH, WIDE = "PhongPD", "Drake KTO, path", "Drake KTO, path, wide"
TIE = 1e-3  # of the duration
HEADER = ["scene", "pair", "by", "says solved", "duration", "free", "in limits",
          "duration / PhongPD", "velocity used", "acceleration used",
          "jerk used", "CPU s", "error"]
SUMMARY_HEADER = ["by", "version", "pairs", "says solved", "free",
                  "free and in limits", "says solved but is not",
                  "duration / PhongPD, median", "low", "high", "least", "most",
                  "PhongPD faster", "as fast", "peer faster", "peer has none",
                  "CPU s, median", "note"]


def version(package):
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def spread(line):
    """Of a summary's line, a dictionary: its ratios in a table's cell."""
    middle = line["duration / PhongPD, median"]
    return "-" if middle == "-" else (
        f"{middle:.3f} ({line['low']:.3f} to {line['high']:.3f}), "
        f"{line['least']:.3f} to {line['most']:.3f}")


def _beside(name, row, default):
    """PhongPD's seconds with the same margin."""
    if name == WIDE and row["key"] in default:
        return default[row["key"]]
    return row["answers"][OWN]["duration"]


def with_default_margin(own_rows):
    """Seconds by key."""
    return {r["key"]: r["duration"] for r in own_rows if r.get("certified")}


def table(rows, default):
    lines = []
    for row in rows:
        if "error" in row:
            lines.append((row["scene"], row["pair"], OWN, *["-"] * 9,
                          row["error"]))
        for name, a in row.get("answers", {}).items():
            if "error" in a:
                lines.append((row["scene"], row["pair"], name, *["-"] * 9,
                              a["error"]))
                continue
            used = ["-" if u is None else u for u in a.get("used", [None] * 3)]
            lines.append((row["scene"], row["pair"], name, a["says"],
                          a["duration"], a["free"], a["within"],
                          a["duration"] / _beside(name, row, default), *used,
                          a["cpu"], ""))
    return lines


def summary(rows, default):
    rows = [row for row in rows if "answers" in row]
    known = [(OWN, None, "certified for all t"),
             (f"{OWN}, tight", None, "preset tight, 8 routes: for best_known.csv")]
    known += [(name, package, note) for name, package, _, note in PEERS]
    return [_line(name, package, note, rows, default)
            for name, package, note in known]


def _line(name, package, note, rows, default):
    of = phongpd.__version__ if package is None else version(package)
    if of is None:
        return (name, "not installed", *["-"] * 15, "its wheel did not install")
    pairs = [(r["answers"][name], _beside(name, r, default), r["scene"])
             for r in rows if name in r["answers"]]
    good = [(a["duration"] / mine, scene) for a, mine, scene in pairs
            if is_valid(a)]
    ratios = [ratio for ratio, _ in good]
    faster = sum(ratio > 1 + TIE for ratio in ratios)
    slower = sum(ratio < 1 - TIE for ratio in ratios)
    says = sum(bool(a.get("says")) for a, _, _ in pairs)
    middle = (float(np.median(ratios)),
              *median_interval(ratios, [scene for _, scene in good]),
              min(ratios), max(ratios)) if good else ("-",) * 5
    return (name, of, len(pairs), says,
            sum(bool(a.get("free")) for a, _, _ in pairs), len(good),
            sum(bool(a.get("says")) and not is_valid(a) for a, _, _ in pairs),
            *middle, faster, len(good) - faster - slower, slower,
            len(pairs) - len(good),
            float(np.median([a["cpu"] for a, _, _ in pairs if "cpu" in a] or
                            [float("nan")])), note)


def longer(name, rows, default):
    """Where a peer's answer is free and in limits: how many, and by how much
    PhongPD takes longer, %, most first."""
    return sorted((100 * (_beside(name, r, default)
                          / r["answers"][name]["duration"] - 1)
                   for r in rows
                   if is_valid(r.get("answers", {}).get(name, {}))),
                  reverse=True)


def errors(rows):
    """What peers threw: name, pairs, the first one's words."""
    found = {}
    for r in rows:
        for name, a in r.get("answers", {}).items():
            if "error" in a:
                found.setdefault(name, []).append(a["error"])
    return [(name, len(said), said[0]) for name, said in found.items()]
