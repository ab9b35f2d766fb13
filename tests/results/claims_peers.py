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
      "path is in {}, with a margin of 0.01 D at its samples in {}. There it takes "
      "{:.3f} times PhongPD's time in the median, less than it in {}, more in {}.",
      PAIRS, len({r["scene"] for r in STOPS[0]}), statistics.median(STOPS[1]),
      len(beside("TOPP-RA")[1]), len(beside("Drake KTO, path")[1]), len(WIDE[1]),
      statistics.median(WIDE[1]), sum(r < 0.999 for r in WIDE[1]),
      sum(r > 1.001 for r in WIDE[1]))

# In worlds whose free space is made of boxes.
def of_graphs(scene):
    """Of Drake's graphs: pairs, good answers, their ratios of durations, and of
    processor time in the median."""
    rows = where("trajectories/gcs.csv", scene=scene, by="Drake GCS")
    good = [float(r["duration / PhongPD"]) for r in rows
            if r["free"] == r["in limits"] == "True"]
    cpu = [statistics.median(of("trajectories/gcs.csv", "CPU s", scene=scene, by=by))
           for by in ("Drake GCS", "PhongPD")]
    return len(rows), len(good), good, cpu[0] / cpu[1]


ROOMS, MAZES = of_graphs("building"), of_graphs("maze50")
assert ROOMS[0] == ROOMS[1] and MAZES[0] == MAZES[1]
claim("docs/choosing.md", "Where free space is made of boxes and velocity alone is "
      "limited, Drake's graphs of convex sets take {:.3f} times PhongPD's time in the "
      "median of {} buildings ({:.2f} to {:.2f}), less than it in {}. On {} ways through a "
      "maze of 2,500 cells they take {:.3f} times it. The processor time is {:.0f} and "
      "{:.0f} times PhongPD's.", statistics.median(ROOMS[2]), ROOMS[0], min(ROOMS[2]),
      max(ROOMS[2]), sum(r < 0.999 for r in ROOMS[2]), MAZES[0],
      statistics.median(MAZES[2]), ROOMS[3], MAZES[3])

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


claim("docs/choosing.md", "Of {:,} motions between free poses in {} scenes {:,} collide; "
      "it left {} undecided.", judged("certified", "motions"),
      len({r["scene"] for r in JUDGES}), judged("certified", "colliding"),
      judged("certified", "undecided"))
claim("docs/choosing.md", "| samples at 1 %, OMPL's default | {:.2g} | {}, of which {} "
      "were made to graze |", of_proof("FCL at 1 %"), judged("FCL at 1 %", "misses"),
      judged("FCL at 1 %", "misses", kind="grazing"))
claim("docs/choosing.md", "| samples at 0.1 % | {:.2g} | {} |", of_proof("FCL at 0.1 %"),
      judged("FCL at 0.1 %", "misses"))
claim("docs/choosing.md", "| continuous collision | {:.2g} | {:,} of {:,} |",
      of_proof("FCL continuous"), judged("FCL continuous", "misses"),
      judged("FCL continuous", "colliding"))

# Judges of others: sets of motions that were all asked about, from Python.
MANY = max(int(r["motions"]) for r in table("rigid/peers.csv"))


def many(method):
    return [r for r in where("rigid/peers.csv", method=method)
            if int(r["motions"]) >= MANY]


def hpp(method):
    """Sums of motions, misses, colliding, contradictions and free ones, and its time
    over PhongPD's, median over scenes and kinds."""
    ours = {(r["scene"], r["kind"]): float(r["ms"]) for r in many("PhongPD")}
    return (*(sum(int(r[key]) for r in many(method)) for key in
              ("motions", "misses", "colliding", "contradictions", "free")),
            statistics.median(float(r["ms"]) / ours[r["scene"], r["kind"]]
                              for r in many(method)))


STRICT, LOOSE = (hpp(f"hpp-core {name}") for name in
                 ("Dichotomy", "Progressive, 0.001"))
claim("docs/choosing.md", "hpp-core's continuous validation (Dichotomy) proves as well: "
      "of {} of these motions it misses {} of {} that collide, calls {} of {} free ones "
      "colliding, and takes {:.0f} times PhongPD's time, both asked from Python; with a "
      "penetration of 0.001 (Progressive) it misses {}, in {:.0f} times", *STRICT,
      LOOSE[1], LOOSE[-1])

EASY_SCENES = ("window:4", "peg:1.5", "alpha:2.5")


def sized(method, least, most):
    """Rows of motions of meshes of so many triangles, robot and world together."""
    return [r for r in where("rigid/judge.csv", method=method) if least
            < int(r["robot triangles"]) + int(r["world triangles"]) <= most]


def by_size(least, most):
    """Median and most ms of the proof, median ms and misses of FCL at 1 %."""
    proof, samples = (sized(name, least, most) for name in ("certified", "FCL at 1 %"))
    ms = [float(r["ms"]) for r in proof]
    return (statistics.median(ms), max(ms),
            statistics.median(float(r["ms"]) for r in samples),
            sum(int(r["misses"]) for r in samples),
            sum(int(r["colliding"]) for r in samples))


for SIZE, LEAST, MOST in (("up to 3,000", 0, 3_000), ("3,000 to 30,000", 3_000, 30_000)):
    claim("docs/choosing.md", "| " + SIZE + " | {:.2g} | {:.2g} | {:.2g} | {} of {} |",
          *by_size(LEAST, MOST))


def planner(scene, name, key, **cells):
    return cell("rigid/planners.csv", key, scene=scene, planner=name, **cells)


def tight(name, key, **cells):
    """Over the scenes where it is tight."""
    return sum(int(r[key]) for r in where("rigid/planners.csv", planner=name, **cells)
               if r["scene"] not in EASY_SCENES)


def proved(scene):
    """Seconds to a first path, ours and of tuned RRTConnect, and of our whole
    answer, with proof, medians."""
    return (float(planner(scene, "phongpd", "seconds, median")),
            float(planner(scene, "RRTConnect", "seconds, median", check="proof",
                          tuning="tuned")),
            float(planner(scene, "phongpd", "answer, median s")))


for SCENE, NAME in zip(EASY_SCENES, ("an easy window", "a loose peg",
                                    "an alpha of gap 2.5")):
    claim("docs/choosing.md", "| " + NAME + " | {:.2g} | {:.2g} | {:.2g} |",
          *proved(SCENE))
ALPHAS = ("alpha:1.5", "alpha:1.2")


def of_ompl(key, **cells):
    """Sums of its planners where it is tight, alphas apart, within a minute."""
    return sum(int(r[key]) for r in where("rigid/planners.csv", **{"limit, s": "60"},
                                          **cells)
               if r["planner"] != "phongpd" and r["scene"] not in ALPHAS)


claim("docs/choosing.md", "{} of {} runs in {} tight scenes within 60 s of the processor. "
      "In {} of these KPIECE1, RRTConnect, STRIDE and BIT* with samples at 1 % find one in "
      "{} of {} runs, {} of them wrong, and RRTConnect, tuned and proving, in {} of {}",
      tight("phongpd", "solved"), tight("phongpd", "runs"),
      len({r["scene"] for r in where("rigid/planners.csv", planner="phongpd")}
          - set(EASY_SCENES)),
      len({r["scene"] for r in where("rigid/planners.csv", planner="phongpd")}
          - set(EASY_SCENES) - set(ALPHAS)),
      *(of_ompl(key, check="0.01") for key in ("solved", "runs", "wrong")),
      *(of_ompl(key, check="proof") for key in ("solved", "runs")))


APP = table("rigid/ompl_app.csv")
EDGE = ("alpha-1.1", "spirelli")


def of_the_app(*problems):
    """Runs of these problems with a certified path, and all of them."""
    of = [r for r in APP if r["problem"] in problems]
    return sum(r["certified"] == "yes" for r in of), len(of)


def seconds_of_the_app(problem):
    return statistics.median(float(r["seconds"]) for r in APP
                             if r["problem"] == problem and r["certified"] == "yes")


WITHIN = {r["problem"] for r in APP} - {*EDGE, "escape"}
claim("docs/choosing.md", "certified path in {} of {} runs of {} problems within 60 s of "
      "the processor: the bug trap in {:.2g} s, alpha 1.5 in {:.2g}, Twistycooler in "
      "{:.2g}, alpha 1.2 in {:.2g}, medians. Of alpha 1.1 it finds one in {} of {}, of "
      "the spirals in {} of {}", *of_the_app(*WITHIN), len(WITHIN),
      *(seconds_of_the_app(problem) for problem in (
          "bugtrap", "alpha-1.5", "Twistycooler", "alpha-1.2")),
      *(count for problem in EDGE for count in of_the_app(problem)))


def on_two_threads(*problems):
    """Wall seconds of the runs with a path."""
    return [float(r["wall_seconds"]) for r in APP
            if r["problem"] in problems and r["wall_seconds"]]


claim("docs/choosing.md", "within 60 s of the clock: in {} of {}, alpha 1.2 in {:.2g}, the "
      "spirals in {} of {}", len(on_two_threads(*WITHIN)), of_the_app(*WITHIN)[1],
      statistics.median(on_two_threads("alpha-1.2")),
      len(on_two_threads("spirelli")), of_the_app("spirelli")[1])
claim("results/README.md", "Of {} all {} runs end with a certified path within a minute on "
      "two threads, {} on one", len(WITHIN), len(on_two_threads(*WITHIN)),
      of_the_app(*WITHIN)[0])
assert len(on_two_threads(*WITHIN)) == of_the_app(*WITHIN)[1]


SAMPLED = ("KPIECE1", "RRTConnect", "STRIDE")


def alphas(key):
    """Of alphas that are tight, with samples at 1 % and a limit of a minute."""
    return sum(int(r[key]) for r in where("rigid/planners.csv", check="0.01",
                                          **{"limit, s": "60"})
               if r["planner"] in SAMPLED and r["scene"] in ALPHAS)


def soonest(scene):
    """Median seconds to a first path of the soonest of OMPL's by samples, of RRTConnect
    with proof, and of ours."""
    rows = where("rigid/planners.csv", scene=scene, **{"limit, s": "60"})
    seconds = {(r["planner"], r["check"]): float(r["seconds, median"]) for r in rows
               if r["seconds, median"] != "more"}
    return (min(seconds[name, "0.01"] for name in SAMPLED if (name, "0.01") in seconds),
            seconds["RRTConnect", "proof"], seconds["phongpd", "proof"])


claim("docs/choosing.md", "KPIECE1, RRTConnect and STRIDE with samples at 1 % find a "
      "path in {} of {} runs on alphas of gap 1.5 and 1.2, {} of them wrong, the soonest in "
      "{:.2g} and {:.2g} s in the median, RRTConnect with proof in {:.2g} and {:.2g}, PhongPD "
      "in {:.2g} and {:.2g}", *(alphas(key) for key in ("solved", "runs", "wrong")),
      *(soonest(scene)[side] for side in (0, 1, 2) for scene in ALPHAS))
