# SPDX-License-Identifier: GPL-3.0-or-later
"""Which planner and which model docs/choosing.md says to take, from the tables of
results/planning and results/trade."""
from claims_tables import cell, column, table

PAGE = "docs/choosing.md"
EXACT = table("planning/exact.csv")
CLOSED = [row for row in EXACT if row["answer"] == "infeasible_proved"]
assert all(row["right"] == "yes" for row in EXACT)
assert all("twin=1" in row["scene"] for row in CLOSED)


def roadmap(by, key):
    return column("planning/multi_query.csv", key, **{"answered by": by})


def sampler(choice, key):
    return cell("trade/planning.csv", key, choice=choice)


def budget(flags, key, use="plan", triangles="1000"):
    """"7 of 8 (53 – 98 %)" is "7 of 8"."""
    found = cell("trade/budget_shares.csv", key, use=use, triangles=triangles,
                 flags=flags)
    return found.partition(" (")[0]


MISSED = "runs not solved, %"
FOREST = "retraction-forest phong"
SCENES, OF = sampler(FOREST, "scenes").split("/")
assert SCENES == OF and float(sampler(FOREST, MISSED)) == 0.0
RRT, WINDOW = "--planner rrt-connect --model window", "--model window --preset balanced"
FULL = "--model full --preset balanced"
FAST = "--model window --preset fast --metric euclidean"
SHORTENED, PLANNER = roadmap("roadmap, shortened", "median ms"), roadmap("planner", "median ms")
OPTIMIZE = {"use": "optimize"}

CLAIMS = [
    (PAGE, "| {} of {} problems right, {} of them closed, which it proved; median of "
     "a query {:.1f} ms at most |", (len(EXACT), len(EXACT), len(CLOSED),
                          max(float(row["query ms"]) for row in EXACT))),
    (PAGE, "| median of {:.2g} to {:.2g} ms a query, of the planner {:.2g} to {:.2g}, "
     "after {:.2g} to {:.3g} ms for the roadmap |",
     (min(SHORTENED), max(SHORTENED), min(PLANNER), max(PLANNER),
      min(roadmap("roadmap, shortened", "build ms")),
      max(roadmap("roadmap, shortened", "build ms")))),
    (PAGE, "| on {} narrow scenes in every run, median of {:.2g} ms, when the contact "
     "space is there; its paths are not shortened |",
     (SCENES, 1e3 * float(sampler(FOREST, "median seconds")))),
    (PAGE, "| {} problems of about 1,000 triangles within 0.1 s, paths {} % longer than "
     "the best; in narrow scenes {} % of its runs find none in a second |",
     (budget(RRT, "100 ms"), budget(RRT, "excess, %"),
      sampler("rrt-connect", MISSED))),
    (PAGE, "| {} problems of about 10,000 triangles within 1 s, paths {} % longer than "
     "the best; with `full` {}, {} % |",
     tuple(budget(f, k, triangles="10000") for f in (WINDOW, FULL)
           for k in ("1 s", "excess, %"))),
    (PAGE, "| {} problems of about 1,000 triangles within 0.1 s, paths {} % longer than "
     "the best; with `--preset balanced` {} within 1 s, {} % |",
     (budget(FAST, "100 ms", **OPTIMIZE), budget(FAST, "excess, %", **OPTIMIZE),
      budget(FAST.replace("fast", "balanced"), "1 s", **OPTIMIZE),
      budget(FAST.replace("fast", "balanced"), "excess, %", **OPTIMIZE))),
]
