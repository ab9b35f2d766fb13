# SPDX-License-Identifier: GPL-3.0-or-later
"""results/trajectories/README.md and its tables."""
import datetime

import phongpd
import trajectories_best
import trajectories_duels as duels
import trajectories_gcs as gcs
import trajectories_growth as growth
import trajectories_moving as moving
import trajectories_summary as own
from python_report import cell, machine, versions, write_csv, write_tables
from trajectories_judge import FINE
from trajectories_peers import COLLISION_SAMPLES, CONTROL_POINTS, MARGIN, \
    WIDE
from trajectories_statistics import share_interval

QUESTION = """\
Question: are PhongPD's motions in time (`World.optimize(limits=...)`) free and
within their limits wherever there is a path, how near are they to the least time,
and what do others make of the same ends and limits?
"""
NOT_RUN = """\
## What was not run

- Graphs of convex sets where free space is not made of boxes: regions have to be
  grown first, which take minutes a scene.
- MINCO-like optimisers: no wheel of one was found.
- `maze50` has the published maze's size, seed and count of removed walls, the
  forests have the published sizes, counts and radii, buildings the published
  counts and sizes of rooms; walls and trees stand elsewhere, as nothing was copied.
- Wall times: other jobs shared the machine. All times are processor time of all
  threads, calls as a user makes them, contact spaces being there.
"""


def _percent(x):
    return f"{100 * x:.4g} %"


def _hits(rows):
    seen = [r for r in own.measured(rows) if r.get("samples")]
    by_fcl = [r for r in seen if r["fcl_hits"] is not None]
    yield (f"- Independent check at {max(r['samples'] for r in seen):,} samples a "
           f"curve: FCL {sum(r['fcl_hits'] for r in by_fcl)} hits in "
           f"{len(by_fcl)} curves, the exact kernel "
           f"{sum(r['exact_hits'] for r in seen)} in {len(seen)}."
           + ("" if len(by_fcl) == len(seen)
              else " FCL did not load for the others."))
    above = sum(r["most_used"] > 1 for r in seen)
    most = max(r["sampled_use"] for r in seen)
    yield (f"- Limits: {above} of {len(seen)} proved shares are above 1; the "
           f"largest at samples is 1 {'-' if most <= 1 else '+'} "
           f"{abs(1 - most):.1g}.")


def _aims(lines):
    yield "| of | set | value | 95 % | n | aim | met |"
    yield "|---|---|---:|---|---:|---:|---|"
    for of, where, value, low, high, n, aim, met in lines:
        is_share = of in own.SHARES
        say = _percent if is_share else cell
        at = _percent(float(aim)) if is_share else aim
        yield (f"| {of} | {where} | {say(value)} | {say(low)} to {say(high)} | "
               f"{n} | {at} | {met} |")


def _beside(lines):
    yield ("| | version | says solved | free | free and in limits | "
           "duration / PhongPD: median (95 %), range | PhongPD faster, as fast, "
           "slower, peer has none | CPU s |")
    yield "|---|---|---:|---:|---:|---|---|---:|"
    for line in lines:
        v = dict(zip(duels.SUMMARY_HEADER, line))
        if v["version"] == "not installed":
            yield f"| {v['by']} | not installed | - | - | - | - | - | - |"
            continue
        n = v["pairs"]
        yield (f"| {v['by']} | {v['version']} | {v['says solved']} of {n} | "
               f"{v['free']} | {v['free and in limits']} | {duels.spread(v)} | "
               f"{v['PhongPD faster']}, {v['as fast']}, {v['peer faster']}, "
               f"{v['peer has none']} | {cell(v['CPU s, median'])} |")


def _losses(rows, peer_rows, best):
    for r in [*rows, *peer_rows]:
        if "error" in r:
            yield f"- {r['key']}: {r['error']}."
    for r in own.answered(rows):
        if not r["certified"]:
            yield f"- {r['key']}: a path, but {r['status']} ({r['reason']})."
    for r in own.measured(rows):
        if r["plan"] != "solved" and not r["certified"]:
            yield f"- {r['key']}: no path, {r['plan']}; not counted above."
    for name, count, words in duels.errors(peer_rows):
        yield f"- {name} fails on {count} pairs, first by {words}."
    late = sorted(((r["answers"]["PhongPD"]["duration"] / best[r["key"]][0] - 1,
                    r["key"]) for r in peer_rows if "answers" in r), reverse=True)
    worse = [f"{key} {100 * by:.2f} % ({best[key][1]})" for by, key in late
             if by > 0.03]
    if worse:
        yield ("- More than 3 % above the best known of its ends: "
               + ", ".join(worse) + ".")


def _wins(lines):
    """Of peers, in time and in effort."""
    seen = [dict(zip(duels.SUMMARY_HEADER, line)) for line in lines]
    mine = next(v for v in seen if v["by"] == duels.OWN)
    for v in seen:
        if v["version"] == "not installed" or v["by"].startswith(duels.OWN):
            continue
        n = v["free and in limits"]
        if v["CPU s, median"] != v["CPU s, median"]:  # it threw everywhere
            yield f"- {v['by']}, {v['note']}: no answer."
            continue
        yield (f"- {v['by']}, {v['note']}: free and in limits in {n} of "
               f"{v['pairs']} pairs; of those PhongPD is faster in "
               f"{v['PhongPD faster']}, the peer in {v['peer faster']}. It says "
               f"solved and is not so in {v['says solved but is not']}. Its "
               f"processor time is {v['CPU s, median'] / mine['CPU s, median']:.2g} "
               "of PhongPD's"
               + (", which includes the plan that it begins with."
                  if "line" not in v["by"] else "."))


def _kto(rows, default):
    for name, margin in (
            (duels.PATH, f"both with a margin of {MARGIN:g} D"),
            (duels.WIDE, f"margin {WIDE:g} D at its samples, and PhongPD's by "
                         "default, which gives way where that saves time")):
        worse = duels.longer(name, rows, default)
        if worse:
            yield ("- Beside Drake from our path, where its curve is free and in "
                   f"limits ({len(worse)} of {len(rows)} pairs; {margin}): PhongPD "
                   f"takes at most {worse[0]:.2g} % longer, more than 1 % in "
                   f"{sum(w > 1 for w in worse)}.")


def _tables(folder, rows, best):
    """Writes them; summary, peers, and README.md's line that leads there."""
    own_rows, peer_rows = rows["own"], rows["peers"]
    default = duels.with_default_margin(own_rows)
    lines = own.summary(own_rows, peer_rows, best)
    beside = duels.summary(peer_rows, default)
    where = write_tables(folder, "Motions in time", [
        ("summary.csv", "What all motions say", own.HEADER, lines,
         "Shares: interval by Clopper and Pearson. Medians: bootstrap over "
         "scenes, over pairs where there is one scene."),
        ("scenes.csv", "By scene", own.SCENES_HEADER, own.by_scene(own_rows),
         "Lower bound: the slowest axis alone (by norm: the straight line), no "
         "obstacles, in closed form. Stops: at rest in every corner of the "
         "same path, one quintic a segment, slower than Ruckig's. Margin: the default, 0.01 D, where there is room."),
        ("peers_summary.csv", "Peers", duels.SUMMARY_HEADER, beside,
         f"Limits by axis; margin {MARGIN:g} D for PhongPD and Drake; wide is "
         f"beside PhongPD's default, {WIDE:g} D for both. Ratios of what is "
         "free and in limits alone. Faster: by a thousandth at least. Free: for "
         "all t, by the judge of curves."),
    ])
    write_csv(folder / "own.csv", own.OWN_HEADER, own.own_table(own_rows, best))
    write_csv(folder / "peers.csv", duels.HEADER,
              duels.table(peer_rows, default))
    for part, of in (("gcs", gcs), ("moving", moving), ("growth", growth)):
        write_csv(folder / f"{part}.csv", of.HEADER, of.table(rows[part]))
    (folder / "growth.svg").write_text(growth.figure(rows["growth"]),
                                       encoding="utf-8")
    return lines, beside, where


BEST = """\
Best known is what any run or peer found up to now, free and in limits
([best_known.csv](best_known.csv)); where peers ran it is looked for with the
preset tight and eight routes, too. The lower bound ignores obstacles: in passages
and mazes no motion comes near it. `maze` is a family of small ones, `maze50` the
large one.
"""


def _about_peers(rows):
    return (
        f"{len(rows)} pairs in {len({r['scene'] for r in rows})} scenes, limits "
        "of velocity, acceleration and jerk by axis. Ruckig, TOPP-RA and Drake "
        "(path) are given the polyline that PhongPD's motion began with. Free: "
        "for all t, proved of Ruckig's segments and of the others' splines by "
        f"`World.check_curve`. In limits: to 1 % at {FINE + 1:,} samples. TOPP-RA "
        "keeps no limit of jerk, an easier problem, and knows no obstacle. Drake: "
        f"KinematicTrajectoryOptimization, cubic, {CONTROL_POINTS} control "
        f"points, {COLLISION_SAMPLES} samples against PhongPD's exact distance, "
        f"SNOPT; wide: margin {WIDE:g} D, beside PhongPD's default, which is "
        f"the same, but gives way where that saves time; {MARGIN:g} D else.")


def write_report(folder, how, commit, rows, packages):
    """`rows`: of each part."""
    folder.mkdir(parents=True, exist_ok=True)
    own_rows, peer_rows = rows["own"], rows["peers"]
    best = trajectories_best.improve(folder, own_rows, peer_rows)
    lines, beside, where = _tables(folder, rows, best)
    asked = own.answered(own_rows)
    certified = sum(r["certified"] for r in asked)
    low, high = share_interval(certified, len(asked))
    text = [
        "# Motions in time: certified, and beside peers", "", QUESTION,
        f"- Certified: {certified} of {len(asked)} motions that have a path "
        f"({_percent(low)} to {_percent(high)} with 95 %); {len(own_rows)} were "
        f"asked for, in {len({r['scene'] for r in own_rows})} scenes.",
        *_hits(own_rows),
        *_kto(peer_rows, duels.with_default_margin(own_rows)), "",
        "## What all motions say", "", *_aims(lines), "", BEST,
        "## Beside peers", "", _about_peers(peer_rows), "",
        *_beside(beside), "", *_wins(beside), "", *gcs.page(rows["gcs"]), "",
        *moving.page(rows["moving"]), "", *growth.page(rows["growth"]), "",
        "## Losses and what failed", "",
        *(list(_losses(own_rows, peer_rows, best)) or ["- None."]), "",
        NOT_RUN, where, "",
        "Each motion: [own.csv](own.csv), [peers.csv](peers.csv).", "",
        f"Command: {how}. Date: {datetime.date.today()}. Seeds: pairs 1 to 6 of "
        f"families, 1 of forests, 4 of the maze. Machine: {machine()}, shared. "
        f"Versions: PhongPD {phongpd.__version__} of commit {commit}, "
        f"{versions(*packages)}.", ""]
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")
