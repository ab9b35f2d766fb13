#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""demo_sentences.py [--table] trap|tunnel|turning FILE...: what rows of optimize or
plan say, in sentences for the page of scripts/demo_page.sh, or as its table.  Both
are of the same rows.  A row that finds no path says so, whatever was expected of
it."""
import html
import json
import sys

MU = {"monotone": "With monotone mu, which is Ipopt's own rule for its steps",
      "adaptive": "With adaptive mu"}


def metric(row):
    return "Euclidean depth" if row["metric"] == "euclidean" else "PhongPD"


def why(row):
    return row["reason"].replace("_", " ")


def trap(rows):
    """The runs from the straight line by mu, then those with a repaired start."""
    groups = {}
    for row in rows:
        name = (MU[row["mu_strategy"]] if row["start"] == "straight" else
                "The default pipeline, which first mends the line")
        count = f"{row['iterations']} iterations"
        groups.setdefault(name, []).append(
            f"{metric(row)} gets out in {count}" if row["collision_free"] else
            f"{metric(row)} does not get out ({why(row)}; {count})")
    return [f"{name}: {'; '.join(said)}." for name, said in groups.items()]


def tunnel(rows):
    """A planner and a channel each."""
    said = []
    for row in rows:
        channel = ("the closed channel" if "twin=1" in row["scene"] else
                   "the open channel")
        seconds = f"{row['seconds']['solve']:.2g} s"
        if row["solved"]:
            does = f"finds a path through {channel} in {seconds}"
        elif row["infeasible_proved"]:
            does = f"proves in {seconds} that there is none through {channel}"
        else:
            does = (f"finds none through {channel} in {seconds} and proves "
                    f"nothing ({row['status'].replace('_', ' ')})")
        said.append(f"{row['planner']} {does}.")
    return said


def turning(rows):
    """Of a robot that turns, a row each."""
    said = []
    for row in rows:
        seconds = f"{row['seconds']['solve']:.2g} s"
        said.append(
            f"{row['planner']} finds a way of {len(row['path'])} poses in {seconds}."
            if row["solved"] else
            f"{row['planner']} finds none in {seconds} ({why(row)}).")
    return said


def number(value):
    """As the page has it: four digits; nothing where there is none."""
    return "" if value is None else f"{value:.4g}"


# Columns of a table: what stands above, and what a row has there.
SOLVER = (("mu", lambda row: row["mu_strategy"]),
          ("metric", metric),
          ("start", lambda row: row["start"]),
          ("status", lambda row: row["status_class"].replace("_", " ")),
          ("iterations", lambda row: str(row["iterations"])),
          ("energy", lambda row: number(row["objective"])),
          ("room", lambda row: number(row["clearance"])),
          ("seconds", lambda row: f"{row['seconds']['total']:.2g}"))
PLANNER = (("planner", lambda row: row["planner"]),
           ("status", lambda row: row["status"].replace("_", " ")),
           ("seconds", lambda row: f"{row['seconds']['solve']:.2g}"),
           ("points", lambda row: str(len(row["path"]))),
           ("length", lambda row: number(row["path_length"])))
COLUMNS = {
    "trap": SOLVER,
    "tunnel": (("channel", lambda row: "closed" if "twin=1" in row["scene"]
                else "open"), *PLANNER,
               ("room", lambda row: number(row["clearance"]))),
    "turning": PLANNER,
}


def table(kind, rows):
    """Rows of HTML; why there is no answer stands below the row."""
    columns = COLUMNS[kind]

    def line(tag, cells):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell, quote=False)}</{tag}>"
                                for cell in cells) + "</tr>"

    lines = [line("th", [name for name, _ in columns])]
    for row in rows:
        lines.append(line("td", [of(row) for _, of in columns]))
        if row.get("reason"):
            lines.append(f'<tr class="why"><td colspan="{len(columns)}">' +
                         html.escape(why(row), quote=False) + "</td></tr>")
    return lines


def main(*arguments):
    is_table = arguments[0] == "--table"
    kind, *files = arguments[1:] if is_table else arguments
    rows = []
    for file in files:
        with open(file, encoding="utf-8") as lines:
            rows += [json.loads(line) for line in lines]
    if is_table:
        print("\n".join(table(kind, rows)))
        return
    sentences = {"trap": trap, "tunnel": tunnel, "turning": turning}[kind]
    for sentence in sentences(rows):
        print(html.escape(sentence, quote=False))


if __name__ == "__main__":
    main(*sys.argv[1:])
