# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said in figures, and the tables that say so: CLAIMS is a list of
(page, sentence, figures...).  The figures go to the sentence's {}, whose words are
those of the page; a page that says another thing fails claims_test.py.  How to
add a sentence: write it here with {} for each figure, and how each comes from a
table of results/."""
import functools
import math
import re
import statistics

from claims_lazy import LAZY_CLAIMS
from claims_study import STUDY_CLAIMS
from claims_tables import cell, jumps, total, where
from claims_tables import column as of
from claims_tables import said, table

CLAIMS = [*STUDY_CLAIMS, *LAZY_CLAIMS]
E_PD, PHONG = "euclidean", "phong@0.2"


def claim(page, sentence, *figures):
    CLAIMS.append((page, sentence, figures))


# The paper's motions.
def paper(metric, column):
    return [int(row[column]) for row in table("paper/random_motions.csv")
            if row["metric"] == metric]


claim("docs/limits.md", "the paper's three benchmarks {}, {} and {} announced jumps "
      "against {}, {} and {} silent ones", *paper("PhongPD, ℓ = 0.1", "flagged"),
      *paper("Euclidean PD", "silent"))
assert sum(paper("PhongPD, ℓ = 0.1", "silent")) == 0

# Continuity, over every space that was run.
SPACES = len({row["contact space"] for row in table("queries/continuity.csv")})
FRAMES = jumps(E_PD, "frames inside")
TRACKED = jumps("tracker", "jumps")
assert TRACKED == jumps("tracker", "exit elsewhere")


def depth_ratio(rule):
    rows = where("queries/continuity.csv", rule=rule)
    return (sum(int(r["frames inside"]) * float(r["mean ratio"]) for r in rows)
            / jumps(rule, "frames inside"))


claim("docs/choosing.md", "{} jumps in {:,} frames on {} spaces, all where the robot "
      "left elsewhere, at {:.2g} times the Euclidean depth", TRACKED, FRAMES, SPACES,
      depth_ratio("tracker"))
claim("docs/choosing.md", "{} in {:,} frames on {} spaces against {}, at {:.2g} "
      "times the depth, where a rule that is at most twice as deep as Euclid needs {}",
      jumps(PHONG, "jumps"), FRAMES, SPACES, jumps(E_PD, "jumps"),
      depth_ratio(PHONG), jumps("any rule, c = 2", "jumps"))

# Solvers.  Converged, stalled and free are three numbers, never one.
TUNNELS = {"peg_tunnel"}
TRAPS_AND_PLATES = {"u_axis", "u_trap", "l", "plate", "long_plate"}


@functools.lru_cache(None)
def runs(protocol, method):
    return {(row["scene"], row["seed"]): row
            for row in where("convergence/rows.csv", protocol=protocol,
                             method=method)}


def family(scene):
    return scene.partition(":")[0]


def ends(protocol, method, families=None, scene=None, like=None):
    """Converged, stalled, else free, all: of the families, the scene, or of the
    seeds that another method ran."""
    rows = [row for key, row in runs(protocol, method).items()
            if (families is None or family(row["scene"]) in families)
            and scene in (None, row["scene"])
            and (like is None or key in runs(protocol, like))]
    converged = sum(row["status_class"] in ("solved", "polished")
                    and row["solved"] == "true" for row in rows)
    stalled = sum(row["solved"] == "true" for row in rows) - converged
    free = sum(row["collision_free"] == "true" for row in rows)
    return converged, stalled, free - converged - stalled, len(rows)


def duel(protocol, own, rival):
    """Solved alone by either, fewer iterations of either (a run that is not
    solved took more than any), p of the sign test of the latter."""
    alone, fewer, shared = [0, 0], [0, 0], 0
    for key, one in runs(protocol, own).items():
        other = runs(protocol, rival).get(key)
        if other is None:
            continue
        shared += 1
        took = [int(row["iterations"]) if row["solved"] == "true" else math.inf
                for row in (one, other)]
        for mine in (0, 1):
            alone[mine] += took[1 - mine] == math.inf > took[mine]
            fewer[mine] += took[mine] < took[1 - mine]
    n = sum(fewer)
    tail = sum(math.comb(n, k) for k in range(min(fewer) + 1)) / 2 ** n
    return shared, alone, fewer, min(1.0, 2 * tail)


def medians(protocol, method, families):
    found = [float(row["median_iterations"])
             for row in where("convergence/summary.csv", protocol=protocol,
                              method=method)
             if family(row["scene"]) in families and "edge=" not in row["scene"]]
    return min(found), max(found)


SHARED, ALONE, FEWER, P = duel("straight-adaptive", "phong@0.2/exact", E_PD)
assert ALONE[0] == ALONE[1]
claim("docs/choosing.md", "of {} runs from colliding starts either solved {} alone; fewer "
      "iterations in {} against {}, p = {:.2g})", SHARED, ALONE[0], *FEWER, P)
(MINE, THEIRS) = (ends("straight-adaptive", m) for m in (PHONG, E_PD))
claim("docs/choosing.md", "{:,} published runs each, {} iterations a round and {} rounds at "
      "most: from colliding starts with Ipopt's adaptive mu (the default) {} against {} "
      "converge, {} against {} end in a stall stop, exactly free, and {} against {} "
      "exactly free at the cap.", MINE[3],
      said("planners/trajectory/ipopt_solve.h", r"max_iterations = (\d+);"),
      said("planners/trajectory/ipopt_optimizer.h", r"max_rounds = (\d+);"),
      *(count for pair in zip(MINE[:3], THEIRS[:3]) for count in pair))
claim("docs/choosing.md", "{} and {} of {:,} from colliding starts, {} and {} more "
      "stall exactly free", THEIRS[0], MINE[0], MINE[3], THEIRS[1], MINE[1])
CAP = max(int(row["iterations"]) for row in table("convergence/rows.csv"))
assert CAP == 200 * 4, CAP
MEDIANS = [medians("straight-adaptive", m, TRAPS_AND_PLATES) for m in (PHONG, E_PD)]
claim("docs/choosing.md", "on traps and plates (medians of {:g} to {:g} against {:g} to "
      "{:g})", *MEDIANS[0], *MEDIANS[1])
claim("docs/choosing.md", "(medians of {:g} to {:g} against {:g} to {:g} with adaptive "
      "mu)", *MEDIANS[0], *MEDIANS[1])
WIDEST = [ends("straight-adaptive", m, scene="peg_tunnel:clearance=0.1")
          for m in (PHONG, E_PD)]
assert WIDEST[0][0] == WIDEST[1][0] == 0
claim("docs/choosing.md", "In the widest tunnel none of the {} converges with either; {} "
      "against {} stall.", WIDEST[0][3], WIDEST[0][1], WIDEST[1][1])
claim("scripts/demo_page.sh", "none of {} runs from a colliding start converges with "
      "either; with Euclidean PD {} end in a stall stop, exactly free, with PhongPD {}.",
      WIDEST[0][3], WIDEST[1][1], WIDEST[0][1])
claim("docs/choosing.md", "none of {} converges with either, {} end exactly free in a "
      "stall stop against {}", WIDEST[0][3], WIDEST[1][1], WIDEST[0][1])
MONOTONE = {m: [ends("straight-monotone", m, scene=s)[0]
                for s in sorted({row["scene"] for row in
                                 table("convergence/summary.csv")})
                if family(s) in {"u_axis", "plate", "long_plate"}
                and "edge=" not in s] for m in (PHONG, E_PD)}
assert set(MONOTONE[PHONG]) == {50}
claim("docs/choosing.md", "With monotone mu all {} converge on `u_axis` and on each plate, of "
      "Euclidean PD's {} to {}.", MONOTONE[PHONG][0], min(MONOTONE[E_PD]),
      max(MONOTONE[E_PD]))

# From a free start.
MONO = [ends("repaired-monotone", m, TUNNELS) for m in (PHONG, E_PD)]
assert MONO[0][0] + MONO[0][2] == MONO[0][3] and MONO[1][0] + MONO[1][2] == 150
ADAPTIVE = [ends("repaired-adaptive", m, TUNNELS) for m in (PHONG, E_PD)]
ALL = [ends("repaired-adaptive", m) for m in (PHONG, E_PD)]
claim("docs/limits.md", "With a monotone mu {} of {} runs converge there against Euclid's "
      "{}, the others are exactly free.", MONO[0][0], MONO[0][3], MONO[1][0])
claim("docs/limits.md", "{} against {}; {} against {} end in a stall stop and {} against {} "
      "at the cap, all exactly free (of all scenes {} against {} of {:,} converge, {} "
      "against {} stall).",
      *(count for pair in zip(ADAPTIVE[0][:3], ADAPTIVE[1][:3]) for count in pair),
      ALL[0][0], ALL[1][0], ALL[0][3], ALL[0][1], ALL[1][1])
FADED = {(p, m): ends("repaired-" + p, m, TUNNELS, like="faded@0.2")
         for p in ("monotone", "adaptive") for m in ("faded@0.2", E_PD)}
claim("docs/limits.md", "converges in {} and {} of {}, Euclidean PD in {} and {} of the "
      "same, and stalls in {} against {} with the adaptive mu",
      FADED["monotone", "faded@0.2"][0], FADED["adaptive", "faded@0.2"][0],
      FADED["monotone", E_PD][3], FADED["monotone", E_PD][0],
      FADED["adaptive", E_PD][0], FADED["adaptive", "faded@0.2"][1],
      FADED["adaptive", E_PD][1])

# The pipeline.
METRICS = ("euclidean", "phong@0", "phong@0.2")
for METRIC in METRICS:
    claim("docs/choosing.md", "it converges in {} of {} with each metric",
          total("convergence/pipeline-metrics.csv", "converged", metric=METRIC),
          sum(int(row["exactly free"].partition("/")[2]) for row in
              where("convergence/pipeline-metrics.csv", metric=METRIC)))
TIME = float(said("results/convergence/pipeline.md",
                  r"median of all \d+ pairs ([\d.]+)"))
claim("docs/choosing.md", "It takes {:.2g} of the time it took before several changes",
      TIME)
claim("CHANGELOG.md", "Trajectories take {:.2g} of the time "
      "(`results/convergence/pipeline.md`)", TIME)
PIPELINE = [ends("pipeline", metric) for metric in METRICS]
assert all(e[0] == e[3] for e in PIPELINE)
claim("docs/limits.md", "path for all {:,} published runs, {:,} with each of three metrics, "
      "within 2 % of the best one known that keeps as clear in {:.0f} % of them",
      sum(e[3] for e in PIPELINE), PIPELINE[0][3],
      100 * total("convergence/summary.csv", "within_2_percent", protocol="pipeline")
      / sum(e[3] for e in PIPELINE))

# Planning.
OMPL = {"rrt-connect", "prm", "prm-obstacle-based", "prm-gaussian", "prm-bridge"}


def widths(delta, planners):
    return [(row["planner"], row["60 s"], row["runs"]) for row in
            where("planning/widths.csv", δ=delta)
            if row["planner"].partition(" ")[0] in planners and row["60 s"] != "–"]


def narrowest(planner):
    """δ at which every run of every scene or of some was solved, least first."""
    return min(float(row["δ"]) for row in
               where("planning/widths.csv", planner=planner)
               if row["60 s"] == row["runs"] != "0")


NARROWEST = [narrowest(planner) for planner in sorted(OMPL)]
THROUGH = [w for w in widths("0.005", OMPL) if w[1] != "0"]
assert len(THROUGH) == 1 and all(w[1] == "0" for w in widths("0.001", OMPL))
claim("docs/command-line.md", "go through channels of {:g} to {:g} of a world of size 2 in every "
      "run; through one of 0.005 `{}` alone goes, in {} of {} runs, through 0.001 none; "
      "retraction through {}, in every run", max(NARROWEST), min(NARROWEST),
      *THROUGH[0],
      {f"{narrowest(p):.0e}".replace("e-0", "e-") for p in
       ("retraction-rrt phong", "retraction-forest phong")}.pop())


def outcomes(baseline):
    rows = where("planning/baselines.csv", baseline=baseline)
    count = [sum(row["Phong"] == word for row in rows) for word in ("win", "tie")]
    assert sum(count) == len(rows)
    return count, len(rows)


claim("docs/limits.md", "({} wins, {} ties on {} scenes)", *outcomes("euclidean")[0],
      outcomes("euclidean")[1])
claim("docs/limits.md", "{} wins and {} ties against all local Euclidean projections, {} "
      "and {} against as many random contact points", *outcomes("euclidean-all")[0],
      *outcomes("contact-points")[0])
SHARES = of("lazy/free_space.csv", "share")
claim("docs/command-line.md", "ready in {:.2f} to {:.2f} of the time", min(SHARES), max(SHARES))
claim("docs/command-line.md", "(the hull of a star against an organic body: {:.2g} of the time)",
      float(cell("trade/approximations.csv", "time of build",
                 pair="star + organic body", choice="--robot-hull")))


# Queries.
def micros(triangles, sequence, kind):
    return sorted(float(cell("queries/queries.csv", "µs", **{
        "contact space": "torus", "triangles": triangles, "sequence": sequence,
        "query": f"{kind}@{ell}"})) for ell in ("0", "0.2"))


SMALL, LARGE = (micros(n, "step 0.001", "warm") for n in ("1024", "1000000"))
COLD = [micros(n, "random", "cold") for n in ("1024", "1000000")]
assert {f"{us:.2g}" for us in SMALL} == {"0.22"}
claim("docs/from-cpp.md", "in steps of 0.001 D, one takes {:.2g} µs on 10³ triangles and "
      "{:.3g} to {:.3g} µs on 10⁶, without, at random points, {:.2g} to {:.2g} and "
      "{:.2g} to {:.2g} µs", SMALL[0], *LARGE, *COLD[0], *COLD[1])

# Presets and peers.
KNOBS = [tuple(float(cell("trade/knobs.csv", column, consumer=c, choice=p))
               for c in ("optimize", "plan") for column in ("time", "mean excess, %"))
         for p in ("fast", "balanced", "tight")]
for PRESET, (T, X, PT, PX) in zip(("fast", "balanced", "tight"), KNOBS):
    claim("docs/choosing.md", "| `%s` | {:g}, {:g} %% | {:g}, {:g} %% |"
          % PRESET, T, X, PT, PX)
ROWS = float(cell("trade/defaults.csv", "time", challenger="rows 3"))
claim("docs/choosing.md", "three take {:.2g} times the time and have more energy, "
      "paired over {} instances", ROWS,
      cell("trade/defaults.csv", "instances", challenger="rows 3"))
claim("CHANGELOG.md", "(three before, which take {} times the time", ROWS)


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

# Building.
claim("CHANGELOG.md", "a star and a knot build in {:.2g} of the time, two tubes that "
      "fill space in {:.2g}", *(float(cell("lazy/culling.csv",
                                           "by default / without", pair=pair))
                                for pair in ("star + knot",
                                             "turned tube + tube of 900")))
claim("CHANGELOG.md", "star and knot within walls take {:.1g} of the time",
      float(cell("lazy/culling.csv", "by default / without",
                 pair="star + knot in bounds")))
GUARD = table("lazy/guard_boxes.csv")
claim("core/README.md", "{:.2g} of it for builds below 64 MiB, {:.2g} from 256 MiB on, "
      "in {:.2g} to {:.3g} of the time", float(GUARD[0]["memory"]),
      float(GUARD[-1]["memory"]), min(of("lazy/guard_boxes.csv", "time")),
      max(of("lazy/guard_boxes.csv", "time")))
assert re.match("below 64", GUARD[0]["of"]) and re.match("from 256", GUARD[-1]["of"])


# Campaigns.
def refused(item):
    """How many of how many, none of which failed."""
    rows = where("extremes/rows.jsonl", item=item, failures=0)
    assert len(rows) == 1
    return (int(re.search(r"(\d+) (?:refused|proofs)", rows[0]["subject"]).group(1)),
            rows[0]["cases"])


claim("core/README.md", "{} of {:,} random pairs, all of them", *refused("pieces"))
claim("docs/cluster.md", "({} of {:,} random ones)", *refused("pieces"))
claim("docs/promises.md", "{} of {:,} random pairs, in boxes", *refused("boxes"))
claim("planners/README.md", "Of {1:,} plans on random pairs each has the full planner's "
      "status; {0} are proofs", *refused("window planner"))


# Motions in time.
OWN = table("trajectories/own.csv")
ASKED = [r for r in OWN if r["plan"] == "solved" or r["certified"] == "True"]
CURVES = [r for r in OWN if r["samples"] not in ("-", "0")]
assert {r["samples"] for r in CURVES} == {"10000"}


def hits(by):
    return sum(int(r[by]) for r in CURVES if r[by] not in ("", "-"))


claim("results/trajectories/README.md", "Certified: {} of {} motions that have a path",
      sum(r["certified"] == "True" for r in ASKED), len(ASKED))
claim("results/trajectories/README.md", "10,000 samples a curve: FCL {} hits in {} "
      "curves, the exact kernel {} in {}.", hits("FCL hits"),
      sum(r["FCL hits"] not in ("", "-") for r in CURVES), hits("exact hits"),
      len(CURVES))


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
