# SPDX-License-Identifier: GPL-3.0-or-later
"""Claims of claims.py on how solvers end: from colliding starts, from free ones, and
in the pipeline."""
import functools
import math

from claims_tables import said, table, total, where

E_PD, PHONG = "euclidean", "phong@0.2"
CLAIMS = []


def claim(page, sentence, *figures):
    CLAIMS.append((page, sentence, figures))


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
      "iterations in {} against {}, p = {:.2g}.", SHARED, ALONE[0], *FEWER, P)
(MINE, THEIRS) = (ends("straight-adaptive", m) for m in (PHONG, E_PD))
claim("docs/choosing.md", "{:,} published runs each, {} iterations a round and {} rounds at "
      "most. From colliding starts with Ipopt's adaptive mu (the default) {} against {} "
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
      "at the cap, all exactly free. Of all scenes {} against {} of {:,} converge, {} "
      "against {} stall.",
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
claim("docs/limits.md", "path for all {:,} published runs, {:,} with each of three metrics. "
      "In {:.0f} % of them it is within 2 % of the best one known that keeps as clear",
      sum(e[3] for e in PIPELINE), PIPELINE[0][3],
      100 * total("convergence/summary.csv", "within_2_percent", protocol="pipeline")
      / sum(e[3] for e in PIPELINE))

# In solvers of others.
OTHERS = where("study/solvers.csv", metric=E_PD, solver="snopt")


def both(solver):
    """Says solved and is free, by metric."""
    return [sum(row["says"] == row["free"] == "true" for row in
                where("study/solvers.csv", solver=solver, metric=metric))
            for metric in (E_PD, PHONG, "smoothed@0.2")]


claim("docs/choosing.md", "Of {} problems SNOPT solves {} with Euclid's direction, {} with "
      "PhongPD's and {} with the smoothed one, Drake's KTO {}, {} and {}; a CHOMP, along "
      "longer paths, {}, {} and {}", len(OTHERS), *both("snopt"), *both("kto"),
      *both("chomp"))
assert said("results/study/solvers.md", r"comparisons (\d+) are wins, 0 losses") == "0"

# "by intervals below zero" (results/README.md)
for solver in ("snopt", "kto"):
    assert said("results/study/solvers.md", r"S1: `smoothed@0\.2` against `euclidean` \| "
                + solver + r" \| -[\d.]+ \(-[\d.]+ … (.)") == "-"

# What a page plans by itself.
claim("docs/viewer.md", "at most {:,} triangles",
      int(said("viewer/display_mesh.h", r"kMaxSolverTriangles = (\d+);")))
claim("docs/viewer.md", "proved free, twice; {} s at most",
      int(said("viewer/solver.js", r"kSolverSeconds = (\d+);")))
