# SPDX-License-Identifier: GPL-3.0-or-later
"""What the rows of PhongPD's motions say, in one table: summary.csv."""
import numpy as np
from trajectories_best import is_valid
from trajectories_statistics import median_interval, share_interval

HEADER = ["of", "set", "value", "low", "high", "n", "aim", "met"]
SHARES = {"certified", "at most 3 % above best known"}  # of `of`
OPEN = ("clutter", "knot", "forest50")
LARGE = ("maze", "forest200")  # a larger aim


def _family(row):
    return row["scene"].partition(":")[0]


def measured(rows):
    return [r for r in rows if "error" not in r]


def answered(rows):
    """Those for which there is a path, by the planner's word or the motion's."""
    return [r for r in measured(rows)
            if r["plan"] == "solved" or r["certified"]]


def _share(name, where, k, n, aim):
    return (name, where, k / n, *share_interval(k, n), n, f"{aim:g}",
            "yes" if k / n >= aim else "no")


def _median(name, where, rows, value, most=None, scale=1.0, least=None):
    """With an aim: `most`, or `least`."""
    values = [scale * value(r) for r in rows]
    if not values:
        return None
    middle, aim, met = float(np.median(values)), "-", "-"
    if most is not None:
        aim, met = f"{most:g}", "yes" if middle <= most else "no"
    if least is not None:
        aim, met = f"at least {least:g}", "yes" if middle >= least else "no"
    return (name, where, middle,
            *median_interval(values, [r["scene"] for r in rows]), len(values),
            aim, met)


def _above_least(r):
    return 100 * (r["duration"] / r["least_duration"] - 1)


def _beside_best(peer_rows, best):
    """PhongPD's motions with as little margin as the peers', by default."""
    def above(r):
        return 100 * (r["answers"]["PhongPD"]["duration"]
                      / best[r["key"]][0] - 1)
    rows = [r for r in peer_rows if "answers" in r]
    if not rows:
        return
    yield _median("above best known, %", "where peers ran", rows, above, 1.0)
    yield _share("at most 3 % above best known", "where peers ran",
                 sum(above(r) <= 3 for r in rows), len(rows), 0.95)
    stops = [r for r in rows
             if is_valid(r["answers"].get("Ruckig, stops", {}))]
    yield _median("Ruckig's stops at corners / motion", "where peers ran", stops,
                  lambda r: (r["answers"]["Ruckig, stops"]["duration"]
                             / r["answers"]["PhongPD"]["duration"]), least=1.4)


def summary(rows, peer_rows, best):
    asked, there = answered(rows), [r for r in measured(rows) if r["certified"]]
    lines = [_share("certified", "all that have a path",
                    sum(r["certified"] for r in asked), len(asked), 1.0)]
    for by in ("axis", "norm"):
        part = [r for r in asked if r["by"] == by]
        if part:
            lines.append(_share("certified", f"limits by {by}",
                                sum(r["certified"] for r in part), len(part),
                                1.0))
    narrow = [r for r in asked if "=1e-6" in r["scene"]]
    if narrow:
        lines.append(_share("certified", "passages of 1e-6",
                            sum(r["certified"] for r in narrow), len(narrow),
                            1.0))
    lines += _beside_best(peer_rows, best)
    for name in OPEN:
        lines.append(_median("above the lower bound, %", f"{name}, by axis", [
            r for r in there if _family(r) == name and r["by"] == "axis"],
            _above_least, 1.0))
    for by in ("axis", "norm"):
        lines.append(_median("above the lower bound, %", f"all, by {by}", [
            r for r in there if r["by"] == by], _above_least))
    lines.append(_median("own stops at corners / motion", "all", there,
                         lambda r: r["stops_duration"] / r["duration"]))
    usual = [r for r in there if _family(r) not in (*LARGE, "maze50")]
    lines.append(_median("CPU ms, plan and first", "all but the large", usual,
                         lambda r: r["cpu_first"], 20.0, 1e3))
    lines.append(_median("CPU ms, from first to refined", "all but the large",
                         usual, _refining, 100.0, 1e3))
    for name in (*LARGE, "maze50"):
        part = [r for r in there if _family(r) == name]
        first, refined = (None, None) if name == "maze50" else (150.0, 600.0)
        lines.append(_median("CPU ms, plan and first", name, part,
                             lambda r: r["cpu_first"], first, 1e3))
        lines.append(_median("CPU ms, from first to refined", name, part,
                             _refining, refined, 1e3))
    return [line for line in lines if line is not None]


def _refining(r):
    return max(0.0, r["cpu_refined"] - r["cpu_first"])


SCENES_HEADER = ["scene", "motions", "with a path", "certified",
                 "duration / lower bound, median", "stops / duration, median",
                 "pieces, median", "CPU ms, plan and first, median",
                 "CPU ms, refined, median", "least clearance / D"]


def by_scene(rows):
    lines = []
    for scene in dict.fromkeys(r["scene"] for r in rows):
        mine = [r for r in rows if r["scene"] == scene]
        there = [r for r in measured(mine) if r["certified"]]

        def middle(value):
            return float(np.median([value(r) for r in there])) if there else "-"
        lines.append((
            scene, len(mine), len(answered(mine)), len(there),
            middle(lambda r: r["duration"] / r["least_duration"]),
            middle(lambda r: r["stops_duration"] / r["duration"]),
            middle(lambda r: r["pieces"]), middle(lambda r: 1e3 * r["cpu_first"]),
            middle(lambda r: 1e3 * r["cpu_refined"]),
            min((r["clearance"] / r["D"] for r in there), default="-")))
    return lines


OWN_HEADER = ["scene", "pair", "limits by", "plan", "status", "certified",
              "duration", "lower bound", "stops", "best known", "pieces",
              "clearance", "limit used, proved", "limit used, sampled",
              "samples", "FCL hits", "exact hits", "CPU s, plan and first",
              "CPU s, refined"]


def own_table(rows, best):
    lines = []
    for r in rows:
        if "error" in r:
            lines.append((r["scene"], r["pair"], r["key"].rpartition("|")[2],
                          "-", r["error"], False, *["-"] * 13))
            continue
        lines.append((
            r["scene"], r["pair"], r["by"], r["plan"], r["status"],
            r["certified"], r["duration"], r["least_duration"],
            r.get("stops_duration", "-"), best.get(r["key"], ("-",))[0],
            r["pieces"], r.get("clearance", "-"), r.get("most_used", "-"),
            r.get("sampled_use", "-"), r.get("samples", 0),
            r.get("fcl_hits", "-"), r.get("exact_hits", "-"), r["cpu_first"],
            r["cpu_refined"]))
    return lines
