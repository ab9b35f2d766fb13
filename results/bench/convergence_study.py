# SPDX-License-Identifier: GPL-3.0-or-later
"""What results/convergence is about: protocols, groups of scenes, and its rows."""

from dataclasses import dataclass

from python_report import read_dicts
from report_statistics import median

# The metric that is compared, and with which.
PRESET, RIVAL = "phong@0.2", "euclidean"
# As phongpd compare --help has them.
PROTOCOLS = {
    "straight-monotone":
        "straight start, Ipopt's monotone mu, no stall stop, 1 row a sample",
    "straight-adaptive": "straight start, adaptive mu, stall stop, 1 row a sample",
    "repaired-monotone":
        "repaired start, monotone mu, no stall stop, 1 row a sample",
    "repaired-adaptive": "repaired start, adaptive mu, stall stop, 3 rows a sample",
    "pipeline":
        "the default of optimize: repair, Ipopt, judge, corridor where needed"}
# What kind of trouble scenes are: families, and whether obstacles are scanned
# (knob `edge`).
GROUPS = {
    "traps": ({"u_axis", "u_trap", "l"}, False),
    "plates": ({"plate", "long_plate"}, False),
    "scanned traps, plates": ({"u_axis", "u_trap", "plate", "long_plate"}, True),
    "holes and tunnels": ({"torus_hole", "peg_tunnel"}, False),
    "other": ({"cone_axes", "ball_wrench", "ball_convex", "clutter", "knot"},
              False)}


def belongs(scene, group):
    families, is_scanned = GROUPS[group]
    return (scene.partition(":")[0] in families
            and ("edge=" in scene) == is_scanned)


@dataclass
class Cell:
    """All runs of one scene, protocol and method."""
    scene: str
    protocol: str
    method: str
    runs: int
    solved: int  # claimed by solver or pipeline, and free
    stalled: int  # of them
    free_only: int  # exactly free, not solved
    claims_only: int  # "solved" but collides
    iterations: float  # median
    restoration_share: float  # of all iterations
    seconds: float  # median, without the contact space
    callback_share: float
    within_2_percent: int


def solved_text(c):
    """Solved / runs, and what the tables explain."""
    return (f"{c.solved}/{c.runs}" + (f" ({c.stalled}s)" if c.stalled else "")
            + (f" +{c.free_only}f" if c.free_only else "")
            + (f" {c.claims_only}c" if c.claims_only else ""))


def _total(rows, column):
    return sum(float(row[column]) for row in rows)


def _share(rows, part, whole):
    return _total(rows, part) / _total(rows, whole) if _total(rows, whole) else 0.0


def _cell(of, rows):
    """`of` is a line of summary.csv, the rows are its own: what these tell comes
    from them, as summary.csv is rounded."""
    cell = Cell(of["scene"], of["protocol"], of["method"], len(rows),
                sum(row["solved"] == "true" for row in rows),
                sum(row["solved"] == "true"
                    and row["status_class"] == "stalled_feasible" for row in rows),
                sum(row["collision_free"] == "true" and row["solved"] == "false"
                    for row in rows),
                int(of["claims_but_collides"]),
                median(float(row["iterations"]) for row in rows),
                _share(rows, "restoration_iterations", "iterations"),
                float(of["median_seconds"]),
                _share(rows, "seconds_callbacks", "seconds_total"),
                int(of["within_2_percent"]))
    told = [int(of[key]) for key in ("runs", "solved", "stalled", "free_not_solved")]
    found = [cell.runs, cell.solved, cell.stalled, cell.free_only]
    if told != found:
        raise ValueError(
            f"summary.csv: {cell.scene}, {cell.protocol}, {cell.method}: expected "
            f"what rows.csv says, {found}, found {told}; take both from one compare")
    return cell


class Study:
    """The rows of a folder: rows.csv, summary.csv."""

    def __init__(self, folder):
        self.rows = read_dicts(folder / "rows.csv")
        of_cell, self._runs = {}, {}
        for row in self.rows:
            of_cell.setdefault((row["scene"], row["protocol"], row["method"]),
                               []).append(row)
            seeds = self._runs.setdefault((row["scene"], row["protocol"]), {})
            seeds.setdefault(row["seed"], {})[row["method"]] = row
        self._cells = {}
        for of in read_dicts(folder / "summary.csv"):
            key = of["scene"], of["protocol"], of["method"]
            self._cells[key] = _cell(of, of_cell.get(key, []))
        if set(of_cell) != set(self._cells):
            raise ValueError(f"{folder}: expected the same scenes, protocols and "
                             "methods in rows.csv and summary.csv")
        self.cells = list(self._cells.values())
        self.scenes = list(dict.fromkeys(c.scene for c in self.cells))

    def cell(self, scene, protocol, method):
        return self._cells.get((scene, protocol, method))

    def methods(self, protocol):
        """In the order of the rows."""
        return list(dict.fromkeys(c.method for c in self.cells
                                  if c.protocol == protocol))

    def runs(self, scene, protocol):
        """Of every seed: rows by method."""
        return list(self._runs.get((scene, protocol), {}).values())

    def gaps(self):
        """Which protocols were not run on all scenes."""
        text = []
        for protocol in PROTOCOLS:
            there = len({c.scene for c in self.cells if c.protocol == protocol})
            if there < len(self.scenes):
                text.append(f"{protocol} ({there} of {len(self.scenes)})")
        return f"Not run on all scenes: {', '.join(text)}.\n\n" if text else ""
