# SPDX-License-Identifier: GPL-3.0-or-later
"""results/rigid/README.md and its tables."""
import datetime
import math
import statistics
import textwrap

import rigid_peers_report as others
from python_report import cell, machine, write_csv, write_tables

QUESTION = """\
Question: what does it cost to prove that a motion that turns is free, what do
samples and FCL's continuous collision miss, and what do planners of OMPL make of
proof instead of samples?
"""
JUDGE_HEADER = ["scene", "robot triangles", "world triangles", "kind", "method",
                "motions", "free", "colliding", "ms", "undecided", "misses",
                "contradictions", "seed"]
RUN_HEADER = ["scene", "planner", "check", "tuning", "limit", "seed", "solved",
              "seconds", "answer_seconds", "poses", "length", "wrong", "undecided",
              "by", "error"]
SUM_HEADER = ["scene", "planner", "check", "tuning", "limit, s", "runs",
              "solved", "wrong", "errors", "seconds, median",
              "answer, median s", "length, median"]
# Motions are told apart by the triangles of robot and world together.
SIZES = ((0, 3_000), (3_000, 30_000))
NOTES = """\
## What is measured

- Scenes: made by `problems/scenes/rigid_scenes.h`, closed solids with exact
  clearances; `peg:0.1` is the family and its knob. OMPL.app's own problems:
  [ompl_app.md](ompl_app.md).
- Motions, both ends proved free: random between uniform poses; contact between
  poses just before a contact; grazing in pairs, one free and one colliding, whose
  ends are 1e-6 of the way apart.
- Samples: FCL's collision of triangles, at as many poses as OMPL's
  DiscreteMotionValidator looks at on an SE3StateSpace. Continuous: FCL's
  conservative advancement, told the point it turns about.
- A miss: called free, proved to collide. A contradiction: called colliding, proved
  free. Undecided counts as not free.
- "refined 3": each triangle of robot and world in four, three times over; the
  motions are drawn anew, FCL's continuous collision is not asked.
- Planners: OMPL's with their own defaults, or tuned by one rule for all scenes (the
  object norm as metric, the robot's reach as range). Without a path a run counts
  as longer than its limit. Wrong: a path with a motion that is proved to collide,
  by our judge. Where it is tight OMPL's have three seeds, but ten on alpha:1.5 and
  alpha:1.2, where most of them find paths; rows with fewer were cut short by
  `--minutes`. How long straight steps are tried first was chosen on seeds 1 to 40 of
  peg:1.5, of which 1 to 10 are published: not fresh there.
- Seconds and limits of planners are processor seconds of all threads of the run's
  process, milliseconds of judges those of their thread: other jobs shared the machine.
  Until a path is there; of PhongPD also of the whole answer, which is shortened,
  judged a second time and has its clearance. OMPL's path is as found: none is
  simplified. Lengths are in the object norm.
"""


def judge_table(found):
    return [[r[key.replace(" ", "_")] for key in JUDGE_HEADER]
            for one in found for r in one.get("rows", [])]


def run_table(found):
    return [[r.get(key, "") for key in RUN_HEADER] for r in found]


def median(values):
    """Of seconds, infinite where no path was found."""
    middle = statistics.median(values)
    return middle if math.isfinite(middle) else "more"


def seconds(row, which="seconds"):
    return row[which] if row.get("solved") else math.inf


def sums(found):
    """A row a scene, planner, check, tuning and limit, in their order."""
    groups = {}
    for r in found:
        if "error" in r:
            parts = r["key"].rsplit(" ", 1)[0].split(" ")
            key = (*parts[:4], float(parts[4]))
        else:
            key = (r["scene"], r["planner"], r["check"], r["tuning"],
                   float(r["limit"]))
        groups.setdefault(key, []).append(r)
    return [[*key, len(of), sum(bool(r.get("solved")) for r in of),
             sum(r.get("wrong", 0) > 0 for r in of),
             sum("error" in r for r in of), median([seconds(r) for r in of]),
             median([seconds(r, "answer_seconds") for r in of]),
             median([r["length"] for r in of if r.get("solved")] or [math.inf])]
            for key, of in groups.items()]


def judged_by_method(table):
    """Of each method: motions, colliding ones, misses, contradictions,
    undecided, the median of ms over scenes and kinds, and of its ratio to the
    certified judge's."""
    certified = {(r[0], r[3]): r[8] for r in table if r[4] == "certified"}
    for method in dict.fromkeys(r[4] for r in table):
        of = [r for r in table if r[4] == method and r[5] > 0]
        yield [method, *(sum(r[k] for r in of) for k in (5, 7, 10, 11, 9)),
               statistics.median(r[8] for r in of),
               statistics.median(r[8] / certified[r[0], r[3]] for r in of)]


def _judge_lines(table):
    yield ("| method | motions | colliding | misses | contradictions | "
           "undecided | ms, median | ms over the judge's, median |")
    yield "|---|---:|---:|---:|---:|---:|---:|---:|"
    for row in judged_by_method(table):
        yield "| " + " | ".join(cell(v) for v in row) + " |"


def _share(table, method, kind):
    of = [r for r in table if r[4] == method and r[3] == kind]
    return sum(r[10] for r in of), sum(r[7] for r in of)


def _judge_findings(table):
    for method in ("FCL at 1 %", "FCL at 0.1 %", "FCL continuous"):
        said = ["{} of {} {}".format(*_share(table, method, kind), kind)
                for kind in ("random", "contact", "grazing")]
        yield f"- {method} misses {', '.join(said)} motions that collide."
    certified = {(r[0], r[3]): r[8] for r in table if r[4] == "certified"}
    for method in ("FCL at 1 %", "FCL at 0.1 %"):
        of = [r for r in table if r[4] == method and r[5] > 0]
        wins = sum(certified[r[0], r[3]] < r[8] for r in of)
        yield (f"- Time: the proof is cheaper than {method} in {wins} of "
               f"{len(of)} scenes and kinds, and dearer in {len(of) - wins}.")
    for least, most in SIZES:
        yield from _size_findings(table, least, most)


def of_size(table, least, most):
    return [r for r in table if least < r[1] + r[2] <= most and r[5] > 0]


def _size_findings(table, least, most):
    """Milliseconds a motion of the proof and of samples, by size of the meshes."""
    of = of_size(table, least, most)
    proof = [r for r in of if r[4] == "certified"]
    if not proof:
        return
    said = []
    for method in ("certified", "FCL at 1 %"):
        ms = [r[8] for r in of if r[4] == method]
        said.append(f"{cell(statistics.median(ms))} ms a motion in the median, "
                    f"{cell(max(ms))} at most")
    samples = [r for r in of if r[4] == "FCL at 1 %"]
    within = "up to" if least == 0 else f"{least:,} to"
    yield (f"- Meshes of {within} {most:,} triangles together, {len(proof)} scenes and "
           f"kinds: the proof takes {said[0]}, and leaves "
           f"{sum(r[9] for r in proof)} of {sum(r[5] for r in proof)} undecided; FCL at "
           f"1 % {said[1]}, and misses {sum(r[10] for r in samples)} of "
           f"{sum(r[7] for r in samples)}.")


def _plan_findings(found):
    for check, name in (("0.01", "samples at 1 %"), ("0.001", "samples at 0.1 %"),
                        ("proof", "proof")):
        of = [r for r in found if r.get("check") == check
              and r.get("planner") != "phongpd"]
        if not of:
            continue
        solved = [r for r in of if r["solved"]]
        wrong = sum(r["wrong"] > 0 for r in solved)
        yield (f"- OMPL with {name}: {len(solved)} of {len(of)} runs end with a "
               f"path, {wrong} of these are proved to collide.")
    ours = [r for r in found if r.get("planner") == "phongpd"]
    if ours:
        yield (f"- PhongPD's planner: {sum(r['solved'] for r in ours)} of "
               f"{len(ours)} runs, {sum(r['wrong'] > 0 for r in ours)} wrong.")
    errors = sum("error" in r for r in found)
    if errors:
        yield f"- {errors} runs ended with an error."


def _duels(table):
    """Proof against samples at 1 %, the same planner and scene: medians."""
    by = {(r[0], r[1], r[3], r[4]): {} for r in table}
    for r in table:
        by[r[0], r[1], r[3], r[4]][r[2]] = (r[6] - r[7], r[9])
    wins, losses, ties = [], [], 0
    for key, of in by.items():
        if not {"proof", "0.01"} <= of.keys():
            continue
        a, b = ((-right, math.inf if time == "more" else time)
                for right, time in (of["proof"], of["0.01"]))
        name = f"{key[0]} {key[1]}" + (", tuned" if key[2] == "tuned" else "")
        if a < b:
            wins.append(name)
        elif b < a:
            losses.append(name)
        else:
            ties += 1
    yield (f"- Proof against samples at 1 %, by right paths, then the median "
           f"time: {len(wins)} wins, {len(losses)} losses, {ties} ties. Losses: "
           f"{'; '.join(losses) or 'none'}.")


def _said(row):
    return f"{row[6] - row[7]} of {row[5]} right, " + (
        "longer" if row[9] == "more" else f"{cell(row[9])} s")


def _ours(table):
    """Our planner beside the best of OMPL's on each scene and limit."""
    def order(row):
        return (row[7] - row[6], math.inf if row[9] == "more" else row[9])
    for row in [r for r in table if r[1] == "phongpd"]:
        whole = ("" if row[10] == "more" else
                 f" (the whole answer {cell(row[10])} s, length {cell(row[11])})")
        ours = f"- {row[0]}, {row[4]:g} s: PhongPD {_said(row)}{whole}"
        others = [r for r in table if r[1] != "phongpd" and r[0] == row[0]
                  and r[4] == row[4]]
        if not others:
            yield ours + "; OMPL was not asked for so long."
            continue
        best = min(others, key=order)
        if best[6] == best[7]:
            yield (f"{ours}; OMPL's planners 0 of {sum(r[5] for r in others)} runs "
                   "right.")
            continue
        check = ("proof" if best[2] == "proof"
                 else f"samples at {100 * float(best[2]):g} %")
        tuned = ", tuned" if best[3] == "tuned" else ""
        length = "" if best[11] == "more" else f", length {cell(best[11])}"
        yield (f"{ours}; best of OMPL {_said(best)} ({best[1]}{tuned}, "
               f"{check}{length}).")


def proved(table, scene, planner):
    """Its row with proof; of OMPL's the tuned one.  None: there is none."""
    tuning = "default" if planner == "phongpd" else "tuned"
    return next((r for r in table if r[:4] == [scene, planner, "proof", tuning]),
                None)


def _beside_proof(table):
    """Both with proof: the first path of ours and of tuned RRTConnect."""
    found = []
    for scene in dict.fromkeys(r[0] for r in table):
        ours, its = (proved(table, scene, name)
                     for name in ("phongpd", "RRTConnect"))
        if ours and its and "more" not in (ours[9], its[9]):
            found.append(f"{scene} {cell(ours[9] / its[9])} and "
                         f"{cell(ours[10] / its[9])} ({its[5]})")
    if found:
        yield ("- With proof, PhongPD's first path and its whole answer over the first "
               f"path of RRTConnect, tuned, medians (its runs): {'; '.join(found)}.")


def _wrapped(lines):
    for line in lines:
        yield "\n".join(textwrap.wrap(
            line, 86, subsequent_indent="  " if line.startswith("- ") else "",
            break_on_hyphens=False, break_long_words=False))


def write_report(folder, how, commit, judged, planned, peers=(), newer=()):
    """`peers`: rows of rigid_peers.py; `newer`: of rigid_ompl2.py."""
    folder.mkdir(parents=True, exist_ok=True)
    judge, runs, table = judge_table(judged), run_table(planned), sums(planned)
    beside, ompl2 = others.peers_table(peers), others.newer_table(newer)
    write_csv(folder / "runs.csv", RUN_HEADER, runs)
    where = write_tables(folder, "Bodies that turn", [
        ("judge.csv", "Judges", JUDGE_HEADER, judge,
         "Motions between free ends. ms: a motion."),
        ("planners.csv", "Planners", SUM_HEADER, table,
         "Solved: paths, wrong ones included. more: than the limit, in more "
         "than half of the runs. check: share of the extent between samples, or "
         "proof."),
        ("peers.csv", "Judges of others", others.PEERS_HEADER, beside,
         "Asked from Python. ms: a motion, the call included."),
        ("ompl2.csv", "OMPL 2.0", others.NEWER_HEADER, ompl2,
         "From its wheel, each pose judged by a Python function.")])
    seeds = sorted({r["seed"] for r in planned if "seed" in r})
    text = ["# Bodies that turn: a proof beside samples", "", QUESTION,
            "## Judges", "", *_judge_lines(judge), "",
            *_wrapped(_judge_findings(judge)), "", "## Judges of others", "",
            *others.peers_lines(beside), "",
            *_wrapped(others.peers_findings(beside)), "", "## Planners", "",
            *_wrapped([*_plan_findings(planned), *_duels(table),
                       *_beside_proof(table), *_ours(table),
                       *others.newer_findings(newer, planned),
                       *others.failures(peers, newer)]),
            "", NOTES + others.NOTES, where, "Each run: [runs.csv](runs.csv).", "",
            *_wrapped([
                f"Command: {how}; with `--long` every planner on every scene, 10 "
                f"seeds, 60 s and 600 s. Date: {datetime.date.today()}. Seeds: "
                f"{', '.join(map(str, seeds))} of planners, 1 of motions. "
                f"Machine: {machine()}, shared. PhongPD of commit {commit}, OMPL "
                f"1.5, FCL 0.7."]), ""]
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")
