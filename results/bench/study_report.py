# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of results/study from its rows: python3 -B study_report.py FOLDER
[--rows rows.jsonl rows.csv ...], which first makes rows.csv of those: seeds that were
made later join those that are published."""
import argparse
import csv
import json
import math
import pathlib
from collections import defaultdict

from report_statistics import holm
from study_statistics import interval, p_of_flips, verdict

PROTOCOLS = ("straight-monotone", "straight-adaptive", "repaired-monotone",
             "repaired-adaptive")
HYPOTHESES = (
    ("H1", "smoothed@0.2", "euclidean"), ("H2", "smoothed@0.2", "phong@0.2"),
    ("H3", "phong@0.2", "euclidean"), ("H4", "placebo@0.2", "euclidean"),
    ("H5", "smoothed@0.2", "placebo@0.2"),
    ("H6", "smoothed-foot@0.2", "smoothed@0.2"),
    ("H7", "diffused@0.2", "phong@0.2"))
COLUMNS = ("scene", "protocol", "method", "seed", "status", "status_class",
           "collision_free", "iterations", "restoration_iterations", "objective")


def rows_of(name):
    """Its rows as texts of COLUMNS, from the program's JSON Lines or a rows.csv."""
    with open(name, newline="") as file:
        if pathlib.Path(name).suffix == ".csv":
            yield from ([row[column] for column in COLUMNS]
                        for row in csv.DictReader(file))
            return
        for line in file:
            row = json.loads(line)
            row["collision_free"] = str(row["collision_free"]).lower()
            yield [str(row[column]) for column in COLUMNS]


def write_csv(folder, files):
    """All rows of the files; a run that is there twice must have the same answer both
    times, and is written once."""
    found = {}
    for name in files:
        for row in rows_of(name):
            key = tuple(row[:4])
            if found.setdefault(key, row) != row:
                raise SystemExit(f"{name}: expected the answer that another file has of "
                                 f"{' '.join(key)}, {found[key]}, found {row}; were "
                                 "they made by the same program?")
    rows = sorted(found.values(), key=lambda row: (
        row[0], PROTOCOLS.index(row[1]), int(row[3]), row[2]))
    with open(folder / "rows.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


def read_csv(folder):
    with open(folder / "rows.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row["family"] = row["scene"].split(":")[0]
        row["iterations"] = int(row["iterations"])
        row["free"] = row["collision_free"] == "true"
        row["converged"] = row["status_class"] in ("solved", "polished") and \
            row["status"] != "User_Requested_Stop"
        row["stalled"] = row["free"] and not row["converged"] and \
            row["status"] == "User_Requested_Stop"
    return rows


def paired(rows, protocol, a, b):
    """{(scene, seed): (row of a, row of b)}; throws where one is missing."""
    own = {method: {(row["scene"], row["seed"]): row for row in rows
                    if row["protocol"] == protocol and row["method"] == method}
           for method in (a, b)}
    if own[a].keys() != own[b].keys():
        raise SystemExit(f"rows.csv: {protocol}: expected {a} and {b} on the same "
                         "problems; a block is incomplete")
    return {key: (own[a][key], own[b][key]) for key in own[a]}


def by_family(pairs, value):
    """Means of value(a, b) over the problems of each family, where it has one."""
    values = defaultdict(list)
    for row_a, row_b in pairs.values():
        x = value(row_a, row_b)
        if x is not None:
            values[row_a["family"]].append(x)
    return [sum(x) / len(x) for _, x in sorted(values.items())]


def log_ratio(a, b):
    if not (a["converged"] and b["converged"]):
        return None
    return math.log(max(1, a["iterations"]) / max(1, b["iterations"]))


def hypotheses(rows):
    """A dictionary for each comparison, all corrected together."""
    found = []
    for name, a, b in HYPOTHESES:
        for protocol in PROTOCOLS:
            pairs = paired(rows, protocol, a, b)
            shares = by_family(pairs, lambda x, y: float(x["converged"])
                               - float(y["converged"]))
            ratios = by_family(pairs, log_ratio)
            found.append({
                "name": name, "a": a, "b": b, "protocol": protocol,
                "differences": shares, "difference": sum(shares) / len(shares),
                "interval": interval(shares, 0.95), "p": p_of_flips(shares),
                "ratio": math.exp(sum(ratios) / len(ratios)) if ratios else None,
                "ratio_interval": [math.exp(x) for x in interval(ratios, 0.95)]
                if ratios else None})
    for one, corrected in zip(found, holm([one["p"] for one in found])):
        one["corrected"] = corrected
        one["verdict"] = verdict(one["differences"], corrected)
    return found


def percent(x):
    return f"{100 * x:+.1f}"


def counts_table(rows):
    lines = ["| metric | " + " | ".join(PROTOCOLS) + " |",
             "|---|" + "---|" * len(PROTOCOLS)]
    methods = sorted({row["method"] for row in rows},
                     key=lambda m: (m != "euclidean", m))
    for method in methods:
        cells = []
        for protocol in PROTOCOLS:
            own = [row for row in rows
                   if row["method"] == method and row["protocol"] == protocol]
            cells.append(" / ".join(str(sum(row[key] for row in own)) for key in
                                    ("converged", "stalled", "free"))
                         + f" of {len(own)}")
        lines.append(f"| `{method}` | " + " | ".join(cells) + " |")
    return lines


def hypotheses_table(found):
    lines = ["| | protocol | converged, points (95 %) | p, corrected | | "
             "iterations (95 %) |", "|---|---|---|---|---|---|"]
    for one in found:
        low, high = one["interval"]
        ratio = "–" if one["ratio"] is None else (
            f"{one['ratio']:.2f} ({one['ratio_interval'][0]:.2f} … "
            f"{one['ratio_interval'][1]:.2f})")
        word = one["verdict"]
        lines.append(
            f"| {one['name']}: `{one['a']}` against `{one['b']}` | "
            f"{one['protocol']} | {percent(one['difference'])} "
            f"({percent(low)} … {percent(high)}) | {one['corrected']:.3f} | "
            f"{'**' + word + '**' if word in ('win', 'loss') else word} | "
            f"{ratio} |")
    return lines


def scenes_table(rows):
    methods = [m for m in ("euclidean", "phong@0.2", "smoothed@0.2",
                           "smoothed-foot@0.2", "diffused@0.2", "placebo@0.2")]
    lines = ["| scene | " + " | ".join(f"`{m}`" for m in methods) + " |",
             "|---|" + "---|" * len(methods)]
    for scene in sorted({row["scene"] for row in rows}):
        cells = []
        for method in methods:
            own = [row for row in rows
                   if row["scene"] == scene and row["method"] == method]
            cells.append(f"{sum(row['converged'] for row in own)} of {len(own)}")
        lines.append(f"| {scene} | " + " | ".join(cells) + " |")
    return lines


def conclusion(found):
    def words(name):
        return {one["protocol"]: one["verdict"] for one in found
                if one["name"] == name}
    first, second = words("H1"), words("H2")
    holds = ("win" in first.values() and "loss" not in first.values()
             and "loss" not in second.values())
    return ("By the rule of the protocol `smoothed` becomes the default."
            if holds else "By the rule of the protocol the default stays.")


def report(folder, how):
    rows = read_csv(folder)
    found = hypotheses(rows)
    seeds = sorted({int(row["seed"]) for row in rows})
    problems = len({(row["scene"], row["seed"]) for row in rows})
    families = len({row["family"] for row in rows})
    text = [
        "# Which direction helps a solver", "",
        f"{problems} problems: {len({row['scene'] for row in rows})} scenes of "
        f"{families} families, seeds {seeds[0]} to {seeds[-1]},",
        "on none of which anything was developed. What was asked, how it is counted "
        "and what",
        "follows from it was written down before: [protocol.md](protocol.md). All rows:",
        "[rows.csv](rows.csv).", "",
        f"Of {len(found)} comparisons " + ", ".join(
            f"{sum(one['verdict'] == word for one in found)} {name}"
            for word, name in (("win", "are wins"), ("loss", "losses"),
                               ("tie", "ties within ±3 points"),
                               ("open", "open"))) + ".", conclusion(found), "",
        "## Converged / stalled / exactly free", "", *counts_table(rows), "",
        "## The 28 comparisons", "",
        "Points of a share, as the mean over families; *win* and *loss* by p < 0.05 "
        "after",
        "the correction for all 28, *tie* only where the 90 % interval lies within ±3 "
        "points,",
        "else *open*. Iterations: the ratio where both converged; below 1 the first is "
        "quicker.", "",
        *hypotheses_table(found), "",
        "## Converged, scene by scene, over all protocols", "",
        *scenes_table(rows), "", how, ""]
    (folder / "README.md").write_text("\n".join(text))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rows", nargs="+", default=[])
    parser.add_argument("--how", default="")
    arguments = parser.parse_args()
    if arguments.rows:
        write_csv(arguments.folder, arguments.rows)
    report(arguments.folder, arguments.how)


if __name__ == "__main__":
    main()
