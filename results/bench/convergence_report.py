# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables, figures and README of results/convergence, from rows.csv, summary.csv
(both of phongpd compare) and excess.csv (convergence_benchmark) in the folder."""

from bisect import bisect_right

from convergence_duels import COLUMNS, NOTE, Arena, correct
from convergence_study import (GROUPS, PRESET, PROTOCOLS, RIVAL, Study, belongs,
                               solved_text)
from python_report import (Figure, Table, line, parse_folder, read_measured,
                           read_table, rounded, tables_and_figures,
                           write_report)
from report_statistics import median
from step_figure import BASELINE, MAIN, Curve, step_figure

INTRODUCTION = """\
# Convergence of the trajectory optimiser: PhongPD beside Euclidean PD

Only the metric inside obstacles differs between the columns of a table: the
same contact spaces, the same rows outside (Euclidean distance), the same seeds,
the same Ipopt. "Solved" always means exactly free by the segment test on the
contact space, whatever the solver claims; it adds up what converged and what
ended in a stall stop (the s of the tables), which the lines below tell apart. A
round of Ipopt is stopped after 200 iterations, a run after 4 rounds. Seeds draw
start and goal such that the straight line collides. Code was written on other
seeds, but ℓ, the rows a sample and when to polish were chosen by what these
scenes and seeds showed.

All raw rows: [rows.csv](rows.csv); per scene and method: [summary.csv](summary.csv).
The pipeline with each metric, and its time before and after it was condensed:
[pipeline.md](pipeline.md).

"""
KEY = (" Solved / runs; s: of them by a stall stop, exactly free but not proved "
       "optimal; +f: exactly free, not solved; c: claimed solved but collides.")
EXACT = f"{PRESET}/exact"
# Of what-helps.csv: first and second.
PAIRS = [(PRESET, RIVAL), ("followed", RIVAL), ("mixed@0.2", RIVAL),
         ("faded@0.2", RIVAL), (PRESET, "followed"), ("mixed@0.2", PRESET),
         ("faded@0.2", PRESET), ("faded@0.2", "mixed@0.2")]
# Name, column, on the axis, in words.  From repaired starts all curves lie upon
# each other: no profile shows anything there.
PROFILED = ("straight-monotone", "straight-adaptive", "pipeline")
MEASURES = [("iterations", "iterations", "iterations", "iterations"),
            ("jacobians", "jacobian_evaluations", "evaluations/jacobian",
             "Jacobians"),
            ("seconds", "seconds_total", "seconds/total", "seconds")]


def matrix(study, protocol, what, note, text):
    """Scenes by methods of one protocol."""
    methods = study.methods(protocol)
    rows = []
    for scene in study.scenes:
        cells = [study.cell(scene, protocol, method) for method in methods]
        if any(cells):
            rows.append([scene, *(text(c) if c else "–" for c in cells)])
    return Table(f"{protocol}-{what}.csv", f"{protocol}: {what}", note,
                 ["scene", *methods], rows)


def effort_text(cell):
    return (f"{rounded(cell.iterations, 4)} · "
            f"{rounded(100 * cell.restoration_share, 2)} % · "
            f"{rounded(1e3 * cell.seconds)} ms")


def scene_duels(study):
    """PRESET against RIVAL, scene by scene: ((scene, protocol), duel)."""
    arena = Arena(study.rows)
    duels = [((scene, protocol), arena.fight(protocol, PRESET, RIVAL, [scene]))
             for protocol in PROTOCOLS for scene in study.scenes]
    duels = [(of, duel) for of, duel in duels if duel.problems]
    correct(duel for _, duel in duels)
    return duels


def group_duels(study):
    """Scenes of a group together: ((first, second, protocol, group), duel)."""
    arena = Arena(study.rows)
    groups = {"all": study.scenes,
              **{name: [s for s in study.scenes if belongs(s, name)]
                 for name in GROUPS}}
    duels = [((own, rival, protocol, name),
              arena.fight(protocol, own, rival, scenes))
             for own, rival in PAIRS for protocol in PROTOCOLS
             for name, scenes in groups.items()]
    duels = [(of, duel) for of, duel in duels if duel.problems]
    correct(duel for _, duel in duels)
    return duels


def verdict_table(duels):
    return Table("verdicts.csv",
                 "PhongPD (ℓ = 0.2) against Euclidean PD, paired by seed", NOTE,
                 ["scene", "protocol", *COLUMNS],
                 [[*of, *duel.cells()] for of, duel in duels])


def what_helps_table(duels):
    return Table(
        "what-helps.csv", "What of PhongPD helps: memory, depth or direction",
        "`followed`: Euclid's local minimum, followed along accepted iterates, its "
        "exact gradient. `mixed`: Euclid's value, Phong's direction as the "
        "derivative. `faded`: the same, its direction fading to Euclid's where "
        "less than ℓ of free way is left beyond the contact. First against second, "
        f"scenes of a group together. {NOTE}",
        ["first", "second", "protocol", "scenes", "runs", *COLUMNS],
        [[*of, str(duel.problems), *duel.cells()] for of, duel in duels])


def lost_cells(study, scene, protocol):
    """Of the seeds that RIVAL alone solved."""
    pairs = [(runs[PRESET], runs[RIVAL])
             for runs in study.runs(scene, protocol)
             if PRESET in runs and RIVAL in runs
             and runs[PRESET]["solved"] == "false"
             and runs[RIVAL]["solved"] == "true"]

    def restoring(k):
        part, all_of = (sum(int(pair[k][key]) for pair in pairs)
                        for key in ("restoration_iterations", "iterations"))
        return f"{rounded(100 * part / max(1, all_of), 2)} %"

    return [str(sum(own["collision_free"] == "true" for own, _ in pairs)),
            rounded(median(float(own["branch_ends"]) for own, _ in pairs)),
            f"{restoring(0)}, {restoring(1)}",
            rounded(median(float(own["objective"]) / float(rival["objective"])
                           for own, rival in pairs))]


def loss_table(study, duels):
    return Table(
        "losses.csv", "Where Euclidean PD solves more, and why",
        "Where PhongPD is behind by more than 5 % of the seeds, by chance or not "
        "(the tests are above): the seeds that only Euclidean PD solved. Exactly "
        "free: PhongPD ended free all the same, but unconverged. Branch ends: of "
        "PhongPD, median; inside a solid its continuous branches end, and where a "
        "path dips into the walls on both sides of a channel again and again each "
        "end is a jump like Euclid's. Restoration: share of the iterations, PhongPD "
        "and Euclid. Objective: PhongPD's over Euclid's, median; below 1 the "
        "unconverged path goes the shorter way.",
        ["scene", "protocol", "lost", "exactly free", "branch ends", "restoration",
         "objective"],
        [[*of, str(duel.only_rival), *lost_cells(study, *of)]
         for of, duel in duels
         if 20 * (duel.only_rival - duel.only_own) > duel.problems])


def profile(study, protocol, measure, axis):
    """Dolan and Moré: the share of all problems that a method solves within a
    factor of the least that any took."""
    problems = {}
    for row in study.rows:
        if row["protocol"] == protocol:
            problems.setdefault((row["scene"], row["seed"]), {})[row["method"]] = (
                max(1e-9, float(row[measure])) if row["solved"] == "true" else None)
    asked, curves = {}, []
    for method in study.methods(protocol):
        own = [values for values in problems.values() if method in values]
        asked[method] = len(own)
        ratios = sorted(v[method] / min(filter(None, v.values()))
                        for v in own if v[method])
        curves.append((method, [(x, bisect_right(ratios, x) / len(own))
                                for x in ratios]))
    most = max(asked.values())
    return step_figure(
        [Curve(method if asked[method] == most else f"{method} ({asked[method]})",
               {RIVAL: BASELINE, PRESET: MAIN}.get(method), points)
         for method, points in curves],
        f"{protocol}, {most} problems; higher and further left is better",
        f"{axis} over the least of all methods'", "share of problems solved")


def figures(study):
    return [Figure(
        f"profile-{protocol}-{name}.svg",
        f"Performance profile (Dolan and Moré), {protocol}: the share of all "
        f"problems solved with at most x times the fewest {words} of any metric.",
        profile(study, protocol, column, axis), name != "iterations")
        for protocol in PROFILED if len(study.methods(protocol)) > 1
        for name, column, axis, words in MEASURES]


def straight_targets(study):
    for protocol in "straight-monotone", "straight-adaptive":
        for prefix in ("u_axis", "plate:thickness=0.1", "plate:thickness=0.02",
                       "long_plate"):
            for scene in study.scenes:
                own = study.cell(scene, protocol, PRESET)
                if not own or not scene.startswith(prefix):
                    continue
                rival = study.cell(scene, protocol, RIVAL)
                beside = f" (Euclid {solved_text(rival)})" if rival else ""
                yield line(f"{protocol}, {scene}, Phong ℓ = 0.2 ≥ 95 %",
                           solved_text(own) + beside,
                           20 * own.solved >= 19 * own.runs)
    for scene in "u_axis", "u_trap", "l":
        own = study.cell(scene, "straight-monotone", PRESET)
        rival = study.cell(scene, "straight-monotone", RIVAL)
        if own and rival:
            yield line(f"straight-monotone, {scene}, median iterations ≤ 1/3 of "
                       "Euclid's", f"{rounded(own.iterations, 4)} against "
                       f"{rounded(rival.iterations, 4)}",
                       3 * own.iterations <= rival.iterations)


def pipeline_targets(study):
    """Scenes that meet one are counted, the others named."""
    cells = [study.cell(scene, "pipeline", PRESET) for scene in study.scenes]
    cells = [c for c in cells if c]
    for target, is_met in (
            ("exactly free ≥ 99 %",
             lambda c: 100 * (c.solved + c.free_only) >= 99 * c.runs),
            ("converged ≥ 95 %", lambda c: 20 * c.solved >= 19 * c.runs),
            ("within 2 % of the best ≥ 90 %",
             lambda c: 10 * c.within_2_percent >= 9 * c.runs),
            ("callbacks ≤ 25 % of the time", lambda c: c.callback_share <= 0.25)):
        others = ", ".join(c.scene for c in cells if not is_met(c))
        met = sum(map(is_met, cells))
        if cells:
            yield line(f"pipeline, {target}", f"{met} of {len(cells)} scenes"
                       + (f"; not {others}" if others else ""), not others)
    claims = any(c.claims_only for c in study.cells if c.protocol == "pipeline")
    yield line("pipeline, Ipopt claims a solution that collides (the pipeline "
               "never returns it)", "some" if claims else "none", not claims)


def ends_text(study, protocol, method):
    """Converged, stalled and else exactly free runs of all scenes."""
    cells = [c for c in study.cells
             if (c.protocol, c.method) == (protocol, method)]
    return (f"{method} {sum(c.solved - c.stalled for c in cells)} converged, "
            f"{sum(c.stalled for c in cells)} stalled, "
            f"{sum(c.free_only for c in cells)} else free of "
            f"{sum(c.runs for c in cells)}")


def duel_lines(study, duels):
    for (own, rival, protocol, where), duel in duels:
        if (own, rival, where) == (PRESET, RIVAL, "all"):
            yield (f"- {own} against {rival}, {protocol}: solved alone "
                   f"{duel.alone()} ({duel.solved_verdict()}), fewer iterations "
                   f"{duel.quicker()}, median ratio {duel.iterations_effect()} "
                   f"({duel.iterations_verdict()}). Ends: "
                   f"{ends_text(study, protocol, own)}; "
                   f"{ends_text(study, protocol, rival)}.\n")
    # No part of the tables' family of tests.
    protocol = "straight-adaptive"
    duel = Arena(study.rows).fight(protocol, EXACT, RIVAL, study.scenes)
    if duel.problems:
        yield (f"- {EXACT} (the exact gradient, not the direction) against {RIVAL}, "
               f"{protocol}, {duel.problems} runs of each: solved alone "
               f"{duel.alone()}, fewer iterations {duel.quicker()} (p = "
               f"{rounded(duel.p_iterations, 2)}, uncorrected). Ends: "
               f"{ends_text(study, protocol, EXACT)}.\n")


def main():
    folder = parse_folder(__doc__)
    study = Study(folder)
    of_scenes, of_groups = scene_duels(study), group_duels(study)
    tables = []
    for protocol, meaning in PROTOCOLS.items():
        if study.methods(protocol):
            tables += [
                matrix(study, protocol, "solved", f"Protocol: {meaning}.{KEY}",
                       solved_text),
                matrix(study, protocol, "effort", "Median iterations · share of "
                       "them in restoration · median time without the contact "
                       "space.", effort_text)]
    tables += [verdict_table(of_scenes), what_helps_table(of_groups),
               loss_table(study, of_scenes),
               read_table(folder, "excess.csv", "What smoothing costs",
                          "PhongPD over Euclidean PD at random interior points, and "
                          "the angle between the Jacobian `direction` and the exact "
                          "gradient.")]
    drawn = figures(study)
    write_report(
        folder, INTRODUCTION + study.gaps() + "## Targets\n\n"
        + "".join([*straight_targets(study), *pipeline_targets(study)])
        + "\n## Won and lost\n\n" + "".join(duel_lines(study, of_groups))
        + "\nWhich part of PhongPD it is that helps, its memory, depth or "
        "direction, and each scene by itself: [what-helps.csv](what-helps.csv), "
        "[verdicts.csv](verdicts.csv), [losses.csv](losses.csv).\n\n"
        + tables_and_figures(tables, drawn) + f"\n{read_measured(folder)}\n",
        tables, drawn)


if __name__ == "__main__":
    main()
