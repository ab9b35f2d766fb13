# SPDX-License-Identifier: GPL-3.0-or-later
"""Claims of claims.py on programs of others, beside which PhongPD was run."""
import re
import statistics

from claims_tables import cell, table, total, where
from claims_tables import column as of

CLAIMS = []


def claim(page, sentence, *figures):
    CLAIMS.append((page, sentence, figures))


def freed(given):
    found = [int(row["crossing called free"]) for row in
             where("peers/motions.csv", motion="translates",
                   solver="conservative advancement", **{"given as": given})]
    return min(found), max(found)


claim("docs/choosing.md", "called {} to {} of {} motions through a mesh free, of bodies "
      "that only translate; between its own boxes {} to {}.", *freed("meshes"),
      cell("peers/motions.csv", "crossing", obstacle="cube", motion="turns",
           solver="naive, 10 samples", **{"given as": "boxes"}), *freed("boxes"))


def two(value):
    """To two digits, without an exponent."""
    return f"{float(f'{value:.2g}'):g}"


def span(values):
    return two(min(values)), two(max(values))


def peers(by, pair=None):
    rows = [row for row in where("peers/depth.csv", by=by)
            if ("(convex)" in row["pair"]) == (pair == "convex")]
    right, free = ([float(row[c]) for row in rows] for c in
                   ("within 1 % of exact, %", "free after moving by it, %"))
    return min(right), max(right), min(free), max(free)


MICROS = "CPU us a query, median"
BUILT = {"ball + cone", "cone + axes", "ball + wrench", "turned L + U"}
for BY, OF in (("coal", "convex bodies; of meshes the deepest pair of triangles"),
               ("python-fcl", "as Coal"), ("mujoco", "convex hulls")):
    claim("docs/choosing.md", "| " + OF + " | {:.0f} %, {:.0f} % | {:.0f} to {:.0f} %, "
          "{:.0f} to {:.0f} % | {} to {} µs |", *peers(BY, "convex")[::2], *peers(BY),
          *span(of("peers/depth.csv", MICROS, by=BY)))
for BY, OF in (("PhongPD, DepthQuery", "any two solids, any pose, exact | "),
               ("PhongPD, contact space", "one orientation, exact | ")):
    LEAST = [min(of("peers/depth.csv", c, by=BY)) for c in
             ("within 1 % of exact, %", "free after moving by it, %")]
    TIMES = of("peers/depth.csv", MICROS, by=BY)
    FOR = OF + "{:.0f} %, {:.0f} % | {:.0f} %, {:.0f} % | "
    if "Query" in BY:
        claim("docs/choosing.md", FOR + "{} to {} ms, nothing precomputed", *LEAST,
              *LEAST, *span([1e-3 * t for t in TIMES]))
    else:
        claim("docs/choosing.md", FOR + "{} to {} µs after a build of {} to {} ms",
              *LEAST, *LEAST, *span(TIMES),
              *span([1e3 * float(row["CPU s"]) for row in
                     where("peers/minkowski.csv", by="PhongPD")
                     if row["pair"] in BUILT]))
RATIO = "ratio to PhongPD"
claim("docs/choosing.md", "Open3D 0.20.0 takes {} to {} times the time of PhongPD's "
      "Euclidean metric, in single precision; trimesh 5.2.0 {} to {} times.",
      *span(of("peers/distance.csv", RATIO, by="open3d (single precision)")),
      *span(of("peers/distance.csv", RATIO, by="trimesh")))
SUMS = [float(row[RATIO]) for row in table("peers/minkowski.csv")
        if row["by"] != "PhongPD" and re.fullmatch(r"[\d.e+-]*\d", row[RATIO])]
LOST = [ratio for ratio in SUMS if ratio < 1]
claim("docs/choosing.md", "manifold3d 3.5.4 takes {} to {} times PhongPD's time, but {} "
      "of it for convex bodies", *span([r for r in SUMS if r > 1]), *map(two, LOST))


# Motions in time.
def beside(by):
    """Of a peer: all rows; ratios of those that are free and in limits."""
    rows = where("trajectories/peers.csv", by=by)
    return rows, [float(r["duration / PhongPD"]) for r in rows
                  if r["free"] == r["in limits"] == "True"]


STOPS, WIDE = beside("Ruckig, stops"), beside("Drake KTO, path, wide")
PAIRS = len(beside("PhongPD")[0])
assert len(STOPS[0]) == len(STOPS[1]) == PAIRS == len(WIDE[0])
claim("docs/choosing.md", "Motions in time, on {} pairs of ends in {} scenes "
      "(`results/trajectories`, `scripts/bench.sh trajectories`), PhongPD's all "
      "certified: Ruckig, at rest in each corner of the same path, takes {:.2g} times "
      "their time in the median. TOPP-RA's spline through the corners is free and in "
      "its limits, of which none is of jerk, in {}. Drake's optimiser from the same "
      "path is in {}, with a margin of 0.01 D at its samples in {}, and there takes "
      "{:.3f} times PhongPD's time in the median, less than it in {}, more in {}.",
      PAIRS, len({r["scene"] for r in STOPS[0]}), statistics.median(STOPS[1]),
      len(beside("TOPP-RA")[1]), len(beside("Drake KTO, path")[1]), len(WIDE[1]),
      statistics.median(WIDE[1]), sum(r < 0.999 for r in WIDE[1]),
      sum(r > 1.001 for r in WIDE[1]))

# Motions that turn.
JUDGES = table("rigid/judge.csv")
PROOF_MS = {(r["scene"], r["kind"]): float(r["ms"]) for r in JUDGES
            if r["method"] == "certified"}


def judged(method, key, **cells):
    return total("rigid/judge.csv", key, method=method, **cells)


def of_proof(method):
    """Its time over the proof's, median over scenes and kinds of motions."""
    return statistics.median(
        float(r["ms"]) / PROOF_MS[r["scene"], r["kind"]]
        for r in where("rigid/judge.csv", method=method))


def ompl_runs(check, key):
    return sum(int(r[key]) for r in where("rigid/planners.csv", check=check)
               if r["planner"] != "phongpd")


claim("docs/choosing.md", "Of {:,} motions between free poses in {} scenes {:,} collide; "
      "it left {} undecided. FCL at OMPL's default of 1 % takes {:.2g} of its time and "
      "calls {} of those that collide free, {} of them motions made to graze; at 0.1 % it "
      "takes {:.2g} times its time and misses {}; FCL's continuous collision {:.2g} times, "
      "and misses {:,}", judged("certified", "motions"), len({r["scene"] for r in JUDGES}),
      judged("certified", "colliding"), judged("certified", "undecided"),
      of_proof("FCL at 1 %"), judged("FCL at 1 %", "misses"),
      judged("FCL at 1 %", "misses", kind="grazing"), of_proof("FCL at 0.1 %"),
      judged("FCL at 0.1 %", "misses"), of_proof("FCL continuous"),
      judged("FCL continuous", "misses"))
claim("docs/choosing.md", "OMPL's planners find paths in {} of {} short runs with samples "
      "at 1 %, of which {} are proved to collide, and in {} of {} with proof, of which {} "
      "do", ompl_runs("0.01", "solved"), ompl_runs("0.01", "runs"),
      ompl_runs("0.01", "wrong"), ompl_runs("proof", "solved"),
      ompl_runs("proof", "runs"), ompl_runs("proof", "wrong"))


def ours(scene, limit):
    return cell("rigid/planners.csv", "solved", planner="phongpd", scene=scene,
                **{"limit, s": limit})


claim("docs/choosing.md", "PhongPD's own planner (`rigid_plan.h`) solves {} of {} runs on "
      "an easy window and {} on a loose peg in 2 s, where RRTConnect is faster, and of "
      "the alpha of gap 1.5 {} in 5 s and {} in 20 s; KPIECE1 with samples at 1 % gives "
      "{} paths there in 20 s, {} of them proved to collide",
      ours("window:4", "2"),
      cell("rigid/planners.csv", "runs", planner="phongpd", scene="window:4"),
      ours("peg:1.5", "2"), ours("alpha:1.5", "5"), ours("alpha:1.5", "20"),
      *(cell("rigid/planners.csv", key, planner="KPIECE1", scene="alpha:1.5",
             check="0.01", **{"limit, s": "20"}) for key in ("solved", "wrong")))


def planner(scene, name, key, limit="2", **cells):
    return cell("rigid/planners.csv", key, scene=scene, planner=name,
                **{"limit, s": limit}, **cells)


def proved(scene):
    """Seconds of tuned RRTConnect and of ours, with proof, medians."""
    return (float(planner(scene, "RRTConnect", "seconds, median", check="proof",
                          tuning="tuned")),
            float(planner(scene, "phongpd", "seconds, median")))


claim("docs/choosing.md", "an easy window in {:.5f} s of processor time, median, against "
      "{:.2g} s of PhongPD's planner; a loose peg in {:.2g} s against {:.2g} s",
      *proved("window:4"), *proved("peg:1.5"))
claim("docs/choosing.md", "alpha of gap 1.5: proved in {} of {} runs within 20 s, in "
      "{:.2g} s, median; KPIECE1 by samples in {:.2g} s, {} of its {} paths wrong",
      planner("alpha:1.5", "phongpd", "solved", "20"),
      planner("alpha:1.5", "phongpd", "runs", "20"),
      float(planner("alpha:1.5", "phongpd", "seconds, median", "20")),
      *(float(planner("alpha:1.5", "KPIECE1", key, "20", check="0.01"))
        if key == "seconds, median" else
        planner("alpha:1.5", "KPIECE1", key, "20", check="0.01")
        for key in ("seconds, median", "wrong", "solved")))
