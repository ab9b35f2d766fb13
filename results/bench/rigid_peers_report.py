# SPDX-License-Identifier: GPL-3.0-or-later
"""What rigid_report.py says of judges of others, asked from Python, and of OMPL 2.0."""
import statistics

from python_report import cell

PEERS_HEADER = ["scene", "kind", "method", "motions", "free", "colliding", "ms",
                "undecided", "misses", "contradictions"]
NEWER_HEADER = ["scene", "planner", "limit, s", "runs", "solved", "wrong",
                "poses judged, median", "share of time in Python"]
NOTES = """\
- Judges of others: from their wheels, asked from Python, PhongPD's too, on the first
  motions of each scene and kind; milliseconds include the call. A motion that takes
  longer than 10 s is stopped: undecided. hpp-core 9.0.2: a body that flies among fixed
  ones, whose straight paths are these motions; continuous validation of no penetration
  (Dichotomy) or of at most 0.001 (Progressive). The wheel hpp-python does not find its
  libraries by itself: `LD_LIBRARY_PATH` names their folder.
- ipctk 1.6.1: its nonlinear continuous collision, pair by pair of its broad phase; of
  small scenes, as each point is a Python function. It looks for a safe step: colliding
  means that a pair comes nearer than a share of its distance at the start, by default
  (0.8) a fifth, with 0.999 a thousandth.
- OMPL 2.0.1, from its wheel, at samples of 1 %: a Python function asks PhongPD's judge
  about each pose, within the limit too, so times are not compared. The wheel's Python
  has neither STRIDE nor EST; its PRM waits for ever, as a second thread of it asks
  Python while the first one solves.
"""


def peers_table(found):
    return [[r[key] for key in PEERS_HEADER]
            for one in found for r in one.get("rows", [])]


def by_method(table):
    """Of each method and number of motions a kind: scenes, sums, medians of ms over
    scenes and kinds, and of its ratio to PhongPD's on the same motions."""
    ours = {(*r[:2], r[3]): r[6] for r in table if r[2] == "PhongPD"}
    for few in sorted({r[3] for r in table}, reverse=True):
        for method in dict.fromkeys(r[2] for r in table if r[3] == few):
            of = [r for r in table if r[2] == method and r[3] == few]
            yield [method, len({r[0] for r in of}),
                   *(sum(r[k] for r in of) for k in (3, 5, 8, 9, 7)),
                   statistics.median(r[6] for r in of), max(r[6] for r in of),
                   statistics.median(r[6] / ours[(*r[:2], r[3])] for r in of)]


def peers_lines(table):
    yield ("| method | scenes | motions | colliding | misses | contradictions | "
           "undecided | ms, median | ms, most | ms over PhongPD's, median |")
    yield "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    for row in by_method(table):
        yield "| " + " | ".join(cell(v) for v in row) + " |"


def peers_findings(table):
    """Times against PhongPD's on the same motions, and what kind of motion it is that
    is judged wrongly."""
    ours = {(*r[:2], r[3]): r[6] for r in table if r[2] == "PhongPD"}
    for method in dict.fromkeys(r[2] for r in table if r[2] != "PhongPD"):
        of = [r for r in table if r[2] == method]
        wins = sum(ours[(*r[:2], r[3])] < r[6] for r in of)
        wrong = {kind: sum(r[8] + r[9] for r in of if r[1] == kind)
                 for kind in dict.fromkeys(r[1] for r in of)}
        yield (f"- {method}: PhongPD is cheaper in {wins} of {len(of)} sets of "
               "motions. Misses and contradictions: "
               + ", ".join(f"{count} {kind}" for kind, count in wrong.items()) + ".")


def newer_table(found):
    """A row a scene and planner of OMPL 2.0."""
    groups = {}
    for r in found:
        if "error" not in r:
            groups.setdefault((r["scene"], r["planner"], r["limit"]), []).append(r)
    return [[*key, len(of), sum(r["solved"] for r in of),
             sum(r["wrong"] > 0 for r in of),
             statistics.median(r["checked"] for r in of),
             sum(r["in_python"] for r in of) / sum(r["seconds"] for r in of)]
            for key, of in groups.items()]


def newer_findings(newer, older):
    """OMPL 2.0 beside 1.5 on the same scenes, planners and seeds, samples at 1 %."""
    def key(r):
        return r["scene"], r["planner"], r["seed"]

    def said(of):
        return (f"{sum(r['solved'] for r in of)} of {len(of)} with a path, "
                f"{sum(r['wrong'] > 0 for r in of)} wrong, within "
                f"{max(r['limit'] for r in of):g} s")
    old = {key(r): r for r in older if r.get("check") == "0.01"
           and r["tuning"] == "default"}
    pairs = [(r, old[key(r)]) for r in newer if "error" not in r and key(r) in old]
    for planner in dict.fromkeys(r["planner"] for r, _ in pairs):
        of = [pair for pair in pairs if pair[0]["planner"] == planner]
        yield (f"- {planner}, same scenes and seeds: OMPL 2.0 "
               f"{said([a for a, _ in of])}; OMPL 1.5 {said([b for _, b in of])}.")


def failures(*campaigns):
    """What did not run, each error once."""
    errors = {}
    for one in (r for found in campaigns for r in found if "error" in r):
        errors.setdefault(one["error"], []).append(one["key"])
    for error, keys in errors.items():
        yield f"- Did not run: {len(keys)} as {keys[0]}: {error}."
