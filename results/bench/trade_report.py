# SPDX-License-Identifier: GPL-3.0-or-later
"""What each knob buys and costs, from the rows that trade_benchmark and other
suites published: one figure a consumer, and which choices no other beats in
both.  Measures nothing itself."""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from python_report import read_dicts as read
from python_report import parser_of, read_measured, write_tables
from report_statistics import sign_test

# phong_field.h, kDefaultSmoothingLength.
DEFAULT = "0.2"
# Points that lie upon each other or at the same loss: the table says it all.
NOT_DRAWN = {"planning", "model"}


@dataclass
class Choice:
    """Less of `cost` is better, and less of `loss`."""
    name: str
    cost: float
    loss: float
    aside: str  # another figure, told beside the name

    def is_beaten(self, by):
        return any(other.cost <= self.cost and other.loss <= self.loss and
                   (other.cost < self.cost or other.loss < self.loss)
                   for other in by)


@dataclass
class Consumer:
    """Who trades speed for accuracy, and between what."""
    file: str
    title: str
    note: str
    cost: str
    loss: str
    aside: str
    logarithmic: bool  # cost
    panels: dict[str, list[Choice]]


def grouped(rows, column):
    groups = {}
    for row in rows:
        groups.setdefault(row[column], []).append(row)
    return groups


def numbers(rows, column):
    return [float(row[column]) for row in rows]


def missing(solved, runs):
    return 100 * (1 - solved / runs)


def queries(results):
    """Metrics along motions: depth against jumps."""
    return Consumer(
        "query", "Query", "Jumps (of more than 5 % of D) against depth along "
        "motions through 12 contact spaces, the hollow box apart; beside each "
        "the median time of a step. The tracker has no gradient for a solver. "
        "Rows: `results/queries/totals.csv`.", "mean depth / Euclidean depth",
        "jumps in 1000 frames", "time of a step", True,
        {"": [Choice(row["metric"], float(row["mean ratio"]),
                     1e3 * float(row["jumps"]) / float(row["frames inside"]),
                     f"{row['µs, median']} µs")
              for row in read(results / "queries/totals.csv")]})


def trajectories(results):
    """Metrics in the optimiser: iterations against runs that are not solved."""
    rows = read(results / "convergence/summary.csv")
    panels = {}
    for protocol in "straight-adaptive", "straight-monotone":
        # The study's own metrics are no choice of users; where Jacobians are
        # compared there are fewer seeds.
        methods = grouped([row for row in rows if row["protocol"] == protocol and
                           (row["method"] == "euclidean" or
                            row["method"].startswith("phong@")) and
                           "/" not in row["method"]], "method")
        panels[protocol] = [
            Choice(method, median(numbers(cells, "median_iterations")),
                   missing(sum(numbers(cells, "solved")),
                           sum(numbers(cells, "runs"))),
                   f"{1e3 * median(numbers(cells, 'median_seconds')):.3g} ms")
            for method, cells in sorted(methods.items())]
    return Consumer(
        "trajectory", "Trajectory", "Ipopt from the straight, colliding line, 20 "
        "scenes of 50 seeds: runs that are not solved against the median over "
        "scenes of their median iterations; beside each the same of seconds. "
        "Where runs that are not solved differ by a point or two, that may be "
        "chance: the paired tests are in `results/convergence/verdicts.csv`. "
        "Rows: `results/convergence/summary.csv`.", "median iterations",
        "runs not solved, %", "time of a run", False, panels)


def planning(results):
    """Planners on narrow passages: time against runs that are not solved."""
    choices = []
    samplers = grouped(read(results / "planning/samplers.csv"), "planner")
    for planner, rows in sorted(samplers.items()):
        counts = [tuple(map(float, row["solved"].split("/"))) for row in rows]
        # Passed: most runs have an answer.
        passed = sum(2 * solved > runs for solved, runs in counts)
        choices.append(Choice(
            planner, median(numbers(rows, "median s")),
            missing(sum(solved for solved, _ in counts),
                    sum(runs for _, runs in counts)), f"{passed}/{len(rows)}"))
    exact = [row for row in read(results / "planning/exact.csv")
             if row["answer"] == "solved"]
    right = sum(row["right"] == "yes" for row in exact)
    choices.append(Choice(
        "contact-surface", median(
            1e-3 * (float(row["query ms"]) + float(row["tables ms"]))
            for row in exact), missing(right, len(exact)),
        f"{right}/{len(exact)}"))
    return Consumer(
        "planning", "Planning", "Narrow passages with a path: runs without an "
        "answer in time against the median over scenes of their median time, "
        "that of a run without an answer being its limit; beside each on how "
        "many scenes most runs were solved. The contact space is there before "
        "either starts. `contact-surface` was run on more scenes, once each: it "
        "is deterministic. Rows: `results/planning/samplers.csv` and "
        "`exact.csv`.", "median seconds", "runs not solved, %", "scenes", True,
        {"": choices})


def knobs(results, file, title, of, consumers):
    """Presets and knobs that trade_benchmark measured."""
    rows = grouped(read(results / "trade/knobs.csv"), "consumer")
    return Consumer(
        file, title, "Processor time over that of the default on the same "
        f"instance, its median; {of} over the least that any choice found "
        "there, its mean, runs with an answer. Rows: `results/trade/knobs.csv`.",
        "time over that of the default", "excess, %", "answered", True,
        {name if len(consumers) > 1 else "": [
            Choice(row["choice"], float(row["time"]),
                   float(row["mean excess, %"]),
                   f"{row['answered']}/{row['instances']}")
            for row in rows[name]] for name in consumers})


def approximations(results):
    """Operands simplified before the contact space is built."""
    choices = grouped(read(results / "trade/approximations.csv"), "choice")

    def mean(rows, column):
        return sum(numbers(rows, column)) / len(rows)

    return Consumer(
        "approximation", "Approximated operands", "Processor time of a build "
        "over that of the exact one, median of six pairs, and the mean error of "
        "the Euclidean depth inside; beside each how many colliding points are "
        "told free. Rows, pair by pair and with the bound that the report "
        "proves: `results/trade/approximations.csv`.",
        "time of the build over that of the exact one",
        "mean error of depth, % of D", "missed", True,
        {"": [Choice(choice, median(numbers(rows, "time of build")),
                     mean(rows, "mean error, % of D"),
                     f"{mean(rows, 'missed, %'):.3g} %")
              for choice, rows in choices.items()]})


def labels(choices):
    """Names in the margin, in the order of the points, each led to its own."""
    script = "unset label\nunset arrow\n"
    ordered = sorted(choices, key=lambda one: (one.loss, -one.cost))
    for i, one in enumerate(ordered):
        height = (i + 0.5) / len(ordered)
        color = "#606060" if one.is_beaten(choices) else "#0060B0"
        script += (
            f"set arrow from {one.cost:g},{one.loss:g} to graph 1.03, graph "
            f"{height:g} nohead lc rgb '#CCCCCC' lw 0.7\nset label \"{one.name}, "
            f"{one.aside}\" at graph 1.04, graph {height:g} left font ',11' tc "
            f"rgb '{color}'\n")
    return script


def svg(consumer):
    """Filled where no other is better in both."""
    panels = consumer.panels
    width = 860 if len(panels) == 1 else 1240
    script = (f"set encoding utf8\nset terminal svg size {width},460 dynamic "
              "enhanced font 'sans-serif,13' background rgb 'white'\n")
    for p, choices in enumerate(panels.values()):
        for name, beaten in ("a", False), ("b", True):
            points = "".join(f"{one.cost:g} {one.loss:g}\n" for one in choices
                             if one.is_beaten(choices) == beaten)
            script += f"$p{p}{name} << EOD\n{points}EOD\n"
    script += (
        f"set multiplot layout 1,{len(panels)}\nunset key\n"
        "set termoption noenhanced\nset grid lc rgb '#DDDDDD'\n"
        "set offsets graph 0.08,graph 0.05,graph 0.08,graph 0.05\n"
        f"set xlabel '{consumer.cost}'\nset ylabel '{consumer.loss}'\n"
        f"set format x '%g'\nset rmargin {38 if len(panels) == 1 else 24}\n")
    if consumer.logarithmic:
        script += "set logscale x\n"
    for p, (title, choices) in enumerate(panels.items()):
        script += (
            f"{labels(choices)}set title '{title}'\nplot $p{p}b using 1:2 with "
            f"points pt 6 ps 0.8 lc rgb '#606060', $p{p}a using 1:2 with points "
            "pt 7 ps 0.8 lc rgb '#0060B0'\n")
    return subprocess.run(["gnuplot"], input=script + "unset multiplot\n",
                          check=True, text=True, capture_output=True).stdout


def table(consumer):
    """Its file, title, header, rows and note."""
    return (f"{consumer.file}.csv", consumer.title, ["choice", "of", consumer.cost, consumer.loss, consumer.aside,
             "beaten"],
            [[one.name, title or "all", f"{one.cost:.3g}", f"{one.loss:.3g}",
              one.aside, "yes" if one.is_beaten(choices) else "no"]
             for title, choices in consumer.panels.items() for one in choices],
            consumer.note)


def findings(consumers):
    text = ""
    for consumer in consumers:
        for title, choices in consumer.panels.items():
            best = ", ".join(f"`{one.name}` ({one.cost:.3g}, {one.loss:.3g})"
                             for one in choices if not one.is_beaten(choices))
            of = f", {title}" if title else ""
            text += (f"- **{consumer.title}{of}**: no other choice is better in "
                     f"both {consumer.cost} and {consumer.loss} than {best}.\n")
    return text


def preset_sentences(results):
    """`fast` takes 0.46 of the time of `balanced` and is 0.9 % longer ..."""
    rows = read(results / "trade/knobs.csv")
    text = ""
    for consumer, what in ("optimize", "energy"), ("plan", "length"):
        for preset in "fast", "balanced", "tight":
            for row in rows:
                if (row["consumer"], row["choice"]) != (consumer, preset):
                    continue
                text += (
                    f"- `{consumer} --preset {preset}`: {row['time']} of "
                    f"balanced's processor time, {what} {row['mean excess, %']} "
                    "% above the least that anything tried found (worst "
                    f"{row['worst excess, %']} %), exactly free paths "
                    f"{row['answered']} of {row['instances']}.\n")
    return text


def duel(rows, protocol, a, b):
    """Two smoothing lengths seed by seed: who alone solves, who takes fewer
    iterations where both do."""
    runs = {}
    for row in rows:
        if row["protocol"] == protocol:
            runs.setdefault((row["scene"], row["seed"]), {})[row["method"]] = (
                row["solved"] == "true", float(row["iterations"]))
    pairs = [(of[a], of[b]) for of in runs.values() if a in of and b in of]
    both = [(x[1], y[1]) for x, y in pairs if x[0] and y[0]]

    def told(m, n):
        return f"{m} : {n} (p = {sign_test(m, n):.2g})"

    alone = told(sum(x[0] and not y[0] for x, y in pairs),
                 sum(y[0] and not x[0] for x, y in pairs))
    fewer = told(sum(x < y for x, y in both), sum(y < x for x, y in both))
    return (f"- {protocol}, {a} : {b}: solved alone {alone}, fewer iterations "
            f"{fewer}.\n")


def decisions(results):
    """What was decided by these rows."""
    rows = read(results / "convergence/rows.csv")
    duels = "".join(duel(rows, protocol, f"phong@{other}", f"phong@{DEFAULT}")
                    for protocol in ("straight-adaptive", "straight-monotone")
                    for other in ("0", "0.05", "0.1"))
    return (
        "\nQueries and motions have no preset. What one could set is how finely "
        "the field resolves its smoothing length: [fields.csv](fields.csv) has "
        "edges of ℓ/4, ℓ/2 (the default), ℓ and as they are, and what they "
        "change in jumps and depth is of the order of chance.\n\nOne smoothing "
        f"length for all, ℓ = {DEFAULT} D (`kDefaultSmoothingLength`), by the "
        "published seeds (`results/convergence/rows.csv`; sign test, "
        "uncorrected) and by the motions of fields.csv, where the lengths that "
        "smooth differ little in jumps and ℓ = 0 jumps more:\n\n" + duels +
        "\nRetraction keeps ℓ = 0: it takes all branches, and smoothing changes "
        "nothing there (`planners/retraction/contact_model.h`).\n")


def default_sentences(results):
    """What defaults_benchmark found, a line each challenger."""
    text = ("\nDefaults against challengers on the scenes of the studies, paired "
            "([defaults.md](defaults.md)):\n\n")
    for row in read(results / "trade/defaults.csv"):
        verdicts = row["time is a"], row["length or energy is a"]
        verdict = ("the default is right" if any("loss" in v for v in verdicts)
                   else "no worse in either and better in one"
                   if "win" in verdicts else "it does not matter")
        text += (f"- {row['consumer']}, {row['challenger']} instead of "
                 f"{row['default']}: time {row['time']} ({verdicts[0]}), length "
                 f"or energy {row['length or energy']} ({verdicts[1]}), exactly "
                 f"free {row['exactly free']} of {row['instances']}: {verdict}.\n")
    return text + (
        "\nDecided: the planner's spacing stays; so little time, and no length, "
        "is no reason to change every published path. Of rows the optimiser "
        "takes one a sample from free starts, too, where it took three until "
        "this table spoke for one. The second start stays as well: no path is "
        "longer for it, and who wants the time takes `--preset fast`.\n")


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"),
                        help="where the published rows are")
    args = parser.parse_args()
    results = args.results
    consumers = [
        queries(results), trajectories(results), planning(results),
        knobs(results, "optimize", "Presets and knobs of optimize",
              "energy of the path", ["optimize"]),
        knobs(results, "plan", "Presets and knobs of contact-surface",
              "length of the path", ["plan"]),
        knobs(results, "model", "Level of the model",
              "what is built included; energy or length",
              ["model: plan", "model: optimize"]),
        approximations(results)]
    found = findings(consumers)
    title, figures = "Speed against accuracy", ""
    for consumer in consumers:
        if consumer.file in NOT_DRAWN:
            continue
        (args.output / f"{consumer.file}.svg").write_text(svg(consumer),
                                                          encoding="utf-8")
        figures += (f"**{consumer.title}**\n\n![{consumer.file}]"
                    f"({consumer.file}.svg)\n\n")
    tables = write_tables(args.output, title,
                          [table(consumer) for consumer in consumers])
    (args.output / "README.md").write_text(
        f"# {title}\n\nWhat the choice of metric, smoothing "
        "length, planner, preset, model and approximation buys and costs, one "
        "table a consumer: from the rows that the other suites published, and "
        "from those of `build/trade_benchmark`.\n\n## Presets\n\n"
        f"{preset_sentences(results)}{decisions(results)}"
        f"{default_sentences(results)}\n## Findings\n\n{found}\n{tables}\n\n"
        f"## Figures\n\nFilled where no other choice is better in both.\n\n"
        f"{figures}\nCommand: scripts/bench.sh trade. Seed and machine: those of "
        "the rows; of what is measured here: "
        f"{read_measured(results / 'trade')}\n", encoding="utf-8")
    print(found, end="")


if __name__ == "__main__":
    sys.exit(main())
