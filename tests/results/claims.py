# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said in figures, and the tables that say so: CLAIMS is a list of
(page, sentence, figures...).  The figures go to the sentence's {}, whose words are
those of the page; a page that says another thing fails claims_test.py.  How to
add a sentence: write it here with {} for each figure, and how each comes from a
table of results/."""
import math
import re
import statistics

from claims_fleets import FLEET_CLAIMS
from claims_lazy import LAZY_CLAIMS
from claims_peers import CLAIMS as PEER_CLAIMS
from claims_solvers import CLAIMS as SOLVER_CLAIMS
from claims_study import STUDY_CLAIMS
from claims_tables import cell, jumps, table, where
from claims_tables import column as of

CLAIMS = [*STUDY_CLAIMS, *SOLVER_CLAIMS, *PEER_CLAIMS, *LAZY_CLAIMS, *FLEET_CLAIMS]
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
      "run. Through one of 0.005 `{}` alone goes, in {} of {} runs, through 0.001 none. "
      "Retraction goes through {} in every run", max(NARROWEST), min(NARROWEST),
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

FLOWN = table("trajectories/moving.csv")
KEPT_OFF = [r for r in FLOWN if r["certified"] == "True"]
claim("results/trajectories/README.md", "Found, each of them certified: {} of {}",
      len(KEPT_OFF), len(FLOWN))
claim("results/trajectories/README.md", "by their sides alone: {}.",
      sum(int(r["hits at samples"]) for r in KEPT_OFF))
claim("results/trajectories/README.md", "1.2 times the time without flyers: {} of {}",
      sum(float(r["duration / alone"]) <= 1.2 for r in KEPT_OFF), len(KEPT_OFF))
claim("results/trajectories/README.md", "Processor time, {:.1f} ms in the median",
      statistics.median(1e3 * float(r["CPU s"]) for r in KEPT_OFF))


def power_of(what, column):
    """Exponent of the power law: the slope of logarithms."""
    rows = where("trajectories/growth.csv", of=what)
    return statistics.linear_regression(
        *zip(*((math.log(int(r[what])), math.log(float(r[column])))
               for r in rows))).slope


GROWN = table("trajectories/growth.csv")
claim("results/trajectories/README.md", "{} motions, {} certified: through mazes",
      len(GROWN), sum(r["certified"] == "True" for r in GROWN))
for what in ("pieces", "triangles"):
    sizes = [int(r[what]) for r in where("trajectories/growth.csv", of=what)]
    claim("results/trajectories/README.md", "{:,} to {:,} " + what + ": time grows "
          "with exponent {:.3g}", min(sizes), max(sizes),
          power_of(what, "CPU s, first to refined"))
large = {}
for row in where("trajectories/growth.csv", of="triangles"):
    size = int(row["contact triangles"])
    if size >= 10_000:
        large[size] = max(large.get(size, 0.0),
                          float(row["judge, CPU us a piece"]))
claim("results/trajectories/README.md", "at most: {:.1f} us of {:,}",
      large[min(large)], min(large))
