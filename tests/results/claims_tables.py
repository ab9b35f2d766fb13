# SPDX-License-Identifier: GPL-3.0-or-later
"""Published tables, as claims.py asks of them.  Names of tables are below
results/.  An empty answer is an error: a claim on nothing holds always."""
import csv
import functools
import json
import pathlib
import re

SOURCE = pathlib.Path(__file__).resolve().parents[2]


@functools.lru_cache(None)
def table(name):
    with open(SOURCE / "results" / name, newline="", encoding="utf-8") as file:
        rows = ([json.loads(line) for line in file] if name.endswith(".jsonl")
                else list(csv.DictReader(file)))
    if not rows:
        raise ValueError(f"results/{name}: expected rows, found none")
    return rows


def where(name, **cells):
    rows = [row for row in table(name)
            if all(row[key] == value for key, value in cells.items())]
    if not rows:
        raise ValueError(f"results/{name}: expected rows with {cells}, found none")
    return rows


def cell(name, column, **cells):
    """Of the only row with those cells."""
    rows = where(name, **cells)
    if len(rows) > 1:
        raise ValueError(f"results/{name}: expected one row with {cells}, found "
                         f"{len(rows)}")
    return rows[0][column]


def column(name, key, **cells):
    return [float(row[key]) for row in where(name, **cells)]


def total(name, key, **cells):
    return sum(int(row[key]) for row in where(name, **cells))


def jumps(rule, key):
    """Over all spaces and motions that were run."""
    return total("queries/continuity.csv", key, rule=rule)


def said(page, pattern):
    """What a page or a header says, where no table does; it must say it once."""
    found = re.findall(pattern, (SOURCE / page).read_text(encoding="utf-8"))
    if len(found) != 1:
        raise ValueError(f"{page}: expected {pattern} once, found {len(found)}")
    return found[0]
