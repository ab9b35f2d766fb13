# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of results/study from its rows: python3 -B study_report.py FOLDER
[--block models] [--rows rows.jsonl rows.csv ...], which first makes rows.csv (of the
block of others' meshes models.csv, of the second block further.csv) of those: seeds
that were made later join those that are published."""
import argparse
import csv
import json
import math
import pathlib
from collections import Counter, defaultdict
from dataclasses import dataclass
from typing import Callable

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
# Of the second block, without claims: each beside Euclid, and beside the first block's of
# its kind.
FURTHER = (
    ("phong@0", "phong@0.2"), ("phong@0.1", "phong@0.2"),
    ("phong@0.2/exact", "phong@0.2"), ("followed", None),
    ("smoothed@0.1", "smoothed@0.2"), ("smoothed@0.4", "smoothed@0.2"))
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


def write_csv(folder, files, name="rows.csv"):
    """All rows of the files, as that one; a run that is there twice must have the same
    answer both times, and is written once."""
    found = {}
    for file_name in files:
        for row in rows_of(file_name):
            key = tuple(row[:4])
            if found.setdefault(key, row) != row:
                raise SystemExit(f"{file_name}: expected the answer that another file "
                                 f"has of {' '.join(key)}, {found[key]}, found {row}; "
                                 "were they made by the same program?")
    rows = sorted(found.values(), key=lambda row: (
        row[0], PROTOCOLS.index(row[1]), int(row[3]), row[2]))
    with open(folder / name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


def read_csv(folder, name="rows.csv"):
    with open(folder / name, newline="") as file:
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
        raise SystemExit(f"rows: {protocol}: expected {a} and {b} on the same "
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


def comparison(rows, protocol, a, b):
    """A dictionary of how a does beside b."""
    pairs = paired(rows, protocol, a, b)
    shares = by_family(pairs, lambda x, y: float(x["converged"])
                       - float(y["converged"]))
    ratios = by_family(pairs, log_ratio)
    return {
        "a": a, "b": b, "protocol": protocol,
        "differences": shares, "difference": sum(shares) / len(shares),
        "interval": interval(shares, 0.95),
        "ratio": math.exp(sum(ratios) / len(ratios)) if ratios else None,
        "ratio_interval": [math.exp(x) for x in interval(ratios, 0.95)]
        if ratios else None}


def hypotheses(rows):
    """A dictionary for each comparison, all corrected together."""
    found = []
    for name, a, b in HYPOTHESES:
        for protocol in PROTOCOLS:
            one = comparison(rows, protocol, a, b)
            found.append({**one, "name": name, "p": p_of_flips(one["differences"])})
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


def cells_of(one):
    """Difference of the shares and ratio of the iterations, with intervals."""
    low, high = one["interval"]
    ratio = "–" if one["ratio"] is None else (
        f"{one['ratio']:.2f} ({one['ratio_interval'][0]:.2f} … "
        f"{one['ratio_interval'][1]:.2f})")
    return (f"{percent(one['difference'])} ({percent(low)} … {percent(high)})", ratio)


def hypotheses_table(found):
    lines = ["| | protocol | converged, points (95 %) | p, corrected | | "
             "iterations (95 %) |", "|---|---|---|---|---|---|"]
    for one in found:
        difference, ratio = cells_of(one)
        word = one["verdict"]
        lines.append(
            f"| {one['name']}: `{one['a']}` against `{one['b']}` | "
            f"{one['protocol']} | {difference} | {one['corrected']:.3f} | "
            f"{'**' + word + '**' if word in ('win', 'loss') else word} | "
            f"{ratio} |")
    return lines


def further_table(found):
    lines = ["| | protocol | converged, points (95 %) | iterations (95 %) |",
             "|---|---|---|---|"]
    for one in found:
        lines.append(f"| `{one['a']}` against `{one['b']}` | {one['protocol']} | "
                     + " | ".join(cells_of(one)) + " |")
    return lines


def scenes_table(rows, title="scene"):
    methods = [m for m in ("euclidean", "phong@0.2", "smoothed@0.2",
                           "smoothed-foot@0.2", "diffused@0.2", "placebo@0.2")]
    lines = [f"| {title} | " + " | ".join(f"`{m}`" for m in methods) + " |",
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
    def verdicts(name):
        return {one["protocol"]: one["verdict"] for one in found
                if one["name"] == name}
    first, second = verdicts("H1"), verdicts("H2")
    holds = ("win" in first.values() and "loss" not in first.values()
             and "loss" not in second.values())
    return ("By the rule of the protocol `smoothed` becomes the default."
            if holds else "By the rule of the protocol the default stays.")


def asked(rows):
    """Problems, scenes, families and seeds of the rows, in words."""
    seeds = sorted({int(row["seed"]) for row in rows})
    problems = len({(row["scene"], row["seed"]) for row in rows})
    return (f"{problems} problems: {len({row['scene'] for row in rows})} scenes of "
            f"{len({row['family'] for row in rows})} families, " +
            (f"seeds {seeds[0]} to {seeds[-1]}," if len(seeds) > 1 else
             f"seed {seeds[0]},"))


def words(found):
    return f"Of {len(found)} comparisons " + ", ".join(
        f"{sum(one['verdict'] == word for one in found)} {name}"
        for word, name in (("win", "are wins"), ("loss", "losses"),
                           ("tie", "ties within ±3 points"),
                           ("open", "open"))) + "."


def first_head(folder, rows, found):
    return [
        "# Which direction helps a solver", "", asked(rows),
        "on none of which anything was developed. What was asked, how it is counted "
        "and what",
        "follows from it was written down before: [protocol.md](protocol.md). "
        "All rows:",
        "[rows.csv](rows.csv).", "", words(found), conclusion(found), ""]


def read_meshes(folder):
    with open(folder / "models_meshes.csv", newline="") as file:
        return list(csv.DictReader(file))


def kind(scene, scans):
    """Of a scene of study_models.py."""
    if scene.startswith("several"):
        return "several obstacles"
    if scene.endswith(":robot"):
        return "the robot"
    return "a scan as the obstacle" if scene in scans else "the obstacle"


def beside_first(folder, found):
    """What is decided here, and what the first block said of it."""
    first = {(one["name"], one["protocol"]): one["verdict"]
             for one in hypotheses(read_csv(folder))}
    return "; ".join(
        f"{one['name']}, {one['protocol']}: {one['verdict']}, there "
        f"{first[one['name'], one['protocol']]}"
        for one in found if one["verdict"] in ("win", "loss")) or "none"


def models_head(folder, rows, found):
    scans = {mesh["mesh"] for mesh in read_meshes(folder) if mesh["scan"]}
    kinds = [dict(row, scene=kind(row["scene"], scans)) for row in rows]
    return [
        "# Which direction helps a solver among others' meshes", "",
        "Scanned meshes and scenes with several obstacles, a block of the",
        "[study](README.md): " + asked(rows),
        "on none of which anything was developed. Scenes, seeds and hypotheses were "
        "written down",
        "before: [protocol.md](protocol.md#block-of-others-meshes). All rows:",
        "[models.csv](models.csv).", "", words(found),
        f"Decided here, beside the first block: {beside_first(folder, found)}. A tie of "
        "+0.0 … +0.0",
        "says that no family's share differs, of these few runs and no others.", "",
        "## Converged, by what the mesh of others is, over all protocols", "",
        *scenes_table(kinds, "it is"), ""]


def models_tail(folder):
    meshes = read_meshes(folder)
    taken = [mesh for mesh in meshes if not mesh["left out because"]]
    reasons = Counter(
        "the shape of another" if reason.startswith("the shape of") else
        reason.split(";")[0] for reason in
        (mesh["left out because"] for mesh in meshes) if reason)
    return [
        "", "## The meshes", "",
        f"{len(taken)} of the {len(meshes)} OFF files of Debian's package libcgal-demo "
        "(5.5.1-2). Scan: known to be one;",
        "of the others the package does not tell. Left out: " + ", ".join(
            f"{count} ({reason})" for reason, count in reasons.most_common()) + ";",
        "one by one: [models_meshes.csv](models_meshes.csv).", "",
        "| mesh | triangles | scan |", "|---|---|---|",
        *(f"| {mesh['mesh']} | {mesh['triangles']} | {mesh['scan']} |"
          for mesh in taken)]


@dataclass(frozen=True)
class Block:
    """A page, the rows that it is of, and what it has around the tables of all."""
    rows: str
    page: str
    head: Callable  # of folder, rows and comparisons
    tail: Callable  # of the folder


BLOCKS = {
    "first": Block("rows.csv", "README.md", first_head, lambda folder: []),
    "models": Block("models.csv", "models.md", models_head, models_tail)}


def report(folder, how, block=BLOCKS["first"]):
    rows = read_csv(folder, block.rows)
    found = hypotheses(rows)
    text = [
        *block.head(folder, rows, found),
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
        *scenes_table(rows), *block.tail(folder), "", how, ""]
    (folder / block.page).write_text("\n".join(text))


def apart_from_zero(found):
    """Of comparisons those whose interval leaves 0 out, in words."""
    return "; ".join(
        f"`{one['a']}` against `{one['b']}`, {one['protocol']}: "
        + percent(one["difference"]) for one in found
        if not one["interval"][0] <= 0.0 <= one["interval"][1]) or "none"


def further_report(folder, how):
    """The page of the second block."""
    rows = read_csv(folder, "further.csv")
    found = [comparison(rows, protocol, a, b)
             for a, kin in FURTHER for b in ("euclidean", kin) if b
             for protocol in PROTOCOLS]
    text = [
        "# Further metrics, on the problems of the study", "",
        asked(rows),
        "with the first block's metrics once more, by the same program. The second block "
        "of the",
        "[protocol](protocol.md#runs), without claims: nothing here was asked "
        "beforehand, and nothing",
        "follows from it. All rows: [further.csv](further.csv).", "",
        f"Of {len(found)} intervals (95 %, not corrected: one in twenty is expected to "
        "leave 0 out where",
        f"nothing differs) these leave 0 out: {apart_from_zero(found)}.", "",
        "## Converged / stalled / exactly free", "", *counts_table(rows), "",
        "## Beside Euclid, and beside the first block's of the kind", "",
        "Points of a share, as the mean over families. Iterations: the ratio where both "
        "converged;",
        "below 1 the first is quicker.", "",
        *further_table(found), "", how, ""]
    (folder / "further.md").write_text("\n".join(text))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--block", choices=[*BLOCKS, "further"], default="first")
    parser.add_argument("--rows", nargs="+", default=[])
    parser.add_argument("--how", default="")
    arguments = parser.parse_args()
    if arguments.block == "further":
        if arguments.rows:
            write_csv(arguments.folder, arguments.rows, "further.csv")
        further_report(arguments.folder, arguments.how)
        return
    block = BLOCKS[arguments.block]
    if arguments.rows:
        write_csv(arguments.folder, arguments.rows, block.rows)
    report(arguments.folder, arguments.how, block)


if __name__ == "__main__":
    main()
