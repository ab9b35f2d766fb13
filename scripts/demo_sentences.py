#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""demo_sentences.py trap|tunnel FILE...: what rows of optimize or plan say, in
sentences for the page of scripts/demo_page.sh.  A row that finds no path says
so, whatever was expected of it."""
import html
import json
import sys

MU = {"monotone": "With monotone mu, the strategy of the comparison",
      "adaptive": "With adaptive mu"}


def metric(row):
    return "Euclidean depth" if row["metric"] == "euclidean" else "PhongPD"


def trap(rows):
    """The runs from the straight line by mu, then those with a repaired start."""
    groups = {}
    for row in rows:
        name = (MU[row["mu_strategy"]] if row["start"] == "straight" else
                "The default pipeline, which repairs the start first")
        count = f"{row['iterations']} iterations"
        groups.setdefault(name, []).append(
            f"{metric(row)} gets out in {count}" if row["collision_free"] else
            f"{metric(row)} does not get out ({row['reason']}; {count})")
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


def main(kind, *files):
    rows = []
    for file in files:
        with open(file, encoding="utf-8") as lines:
            rows += [json.loads(line) for line in lines]
    for sentence in {"trap": trap, "tunnel": tunnel}[kind](rows):
        print(html.escape(sentence, quote=False))


if __name__ == "__main__":
    main(*sys.argv[1:])
