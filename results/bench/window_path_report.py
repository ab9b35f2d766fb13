# SPDX-License-Identifier: GPL-3.0-or-later
"""results/lazy/window_path.md: paths optimised with a metric from windows around
them beside the whole contact space, from the rows of window_path_benchmark."""

from python_report import Table, read_dicts, read_measured, rounded, \
    tables_and_figures
from report_statistics import median

MOST_SHARE = 0.3  # of the whole's time: what was aimed at, on 5 of 7 pairs
SAME = 1e-9       # of D: two paths that are one but for rounding


def groups_of(rows):
    """By start and metric, and in these by pair, in the order of the rows."""
    groups = {}
    for row in rows:
        pairs = groups.setdefault((row["start"], row["metric"]), {})
        pairs.setdefault(row["pair"], []).append(row)
    return groups


def share(rows, of):
    """The ratio of the sums over problems: differences of two runs are small
    where little is modelled."""
    sums = {name: sum(float(row[name]) for row in rows)
            for name in ("whole, CPU s", "whole: modelling", "windows, CPU s",
                         "windows: modelling")}
    whole, windows = {"modelling": ("whole: modelling", "windows: modelling"),
                      "all": ("whole, CPU s", "windows, CPU s")}[of]
    return sums[windows] / sums[whole]


def is_same(row):
    return float(row["farthest apart / D"]) <= SAME


def gained(rows):
    """Of the objective in windows over that of the whole, median."""
    return median([float(row["windows: objective"]) / float(row["whole: objective"])
                   for row in rows])


def summary_of(groups):
    table = []
    for (start, metric), pairs in groups.items():
        for pair, rows in pairs.items():
            table.append([
                pair, start, metric, share(rows, "modelling"), share(rows, "all"),
                f"{sum(map(is_same, rows))} of {len(rows)}", gained(rows),
                sum(row["whole: status"] == row["windows: status"] for row in rows)])
    return Table(
        "window_path.csv", "Each pair",
        "Windows over the whole: processor time of what was modelled, and of all, "
        "sums over the problems; paths that are the same to 1e-9 of D; the objective, "
        "median ratio; problems with the same status.",
        ["pair", "start", "metric", "modelling", "all", "same path", "objective",
         "same status"], table)


def sentences_of(groups):
    for (start, metric), pairs in groups.items():
        modelling = {pair: share(rows, "modelling") for pair, rows in pairs.items()}
        whole = {pair: share(rows, "all") for pair, rows in pairs.items()}
        rows = [row for of_pair in pairs.values() for row in of_pair]
        worst = max(modelling, key=modelling.get)
        yield (
            f"- {start}, {metric}: all of it takes at most {MOST_SHARE} of the whole's "
            f"time on {sum(s <= MOST_SHARE for s in whole.values())} of {len(whole)} "
            f"pairs (median {rounded(median(list(whole.values())))}), what was modelled "
            f"on {sum(s <= MOST_SHARE for s in modelling.values())} (median "
            f"{rounded(median(list(modelling.values())))}, worst {worst}, "
            f"{rounded(modelling[worst])}); the path is the same in "
            f"{sum(map(is_same, rows))} of {len(rows)} problems, and the objective "
            f"at most {rounded(max(map(gained, pairs.values())))} times the whole's.")


def losses_of(folder):
    """Of older rows: what windows cost where they are no help."""
    volume = [row for row in read_dicts(folder / "volume.csv")
              if row["level"] == "window"]
    most = max(volume, key=lambda row: float(row["cost, share"]))
    phong = read_dicts(folder / "phong.csv")
    worst = max(phong, key=lambda row: float(row["most"]) / float(row["whole, CPU s"]))
    missed = sum(int(row["answers"]) - int(row["from windows"]) for row in phong)
    asked = sum(int(row["answers"]) for row in phong)
    return (
        f"A window that is asked for everything costs {most['cost, share']} times the "
        f"whole ({most['pair']}). Of PhongPD's answers (ℓ = 0) {missed} of {asked} fell "
        f"back to the whole, and the dearest cost "
        f"{rounded(float(worst['most']) / float(worst['whole, CPU s']))} times the "
        f"whole ({worst['pair']}).")


def write_page(folder):
    groups = groups_of(read_dicts(folder / "window_path.csv"))
    text = (
        "# Paths optimised from windows\n\n`optimize` with model `window` and a metric "
        "that windows can give, beside model `full`: free ends drawn around C_cont "
        "whose line collides. From the line (start `straight`) Ipopt alone, so that "
        "paths can be compared; from a repaired start the pipeline as it is by "
        "default, where rrt-connect finds the start in a window and the planner on the "
        "surface in the whole. Each world answers twice: what the first answer takes "
        "longer is the modelling.\n\n" + "\n".join(sentences_of(groups)) +
        "\n\nA smoothed direction depends on all of C_cont within 2ℓD: at ℓ = 0.2, the "
        "default, that is nearly everything, and windows can only lose. A line deep "
        "through a body loses too, as all that is nearer than the surface has to be "
        "looked at.\n\n## What windows cost elsewhere\n\n" + losses_of(folder) + "\n\n" +
        tables_and_figures([summary_of(groups)]) + "\n" +
        read_measured(folder, "window_path_measured.txt") + "\n")
    (folder / "window_path.md").write_text(text, encoding="utf-8")
