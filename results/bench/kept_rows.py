# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows as JSON Lines, each written when it is there: a run that was interrupted
goes on where it was.  And the options of programs that write such rows, part by
part."""
import json
import time
from pathlib import Path

from python_report import parser_of, told


def read(path):
    """What was there; a last line that was cut off is dropped, from the file
    too."""
    if not path.exists():
        return []
    rows, good = [], 0
    with open(path, "rb+") as file:
        for line in file:
            if not line.endswith(b"\n"):
                break
            rows.append(json.loads(line))
            good += len(line)
        file.truncate(good)
    return rows


def fill(path, wanted, measure, deadline=None, clock=None):
    """Those of `wanted` (each with a key) that the file lacks.  An error is a
    row: it is counted, not hidden.  Nothing new begins after the deadline."""
    path.parent.mkdir(parents=True, exist_ok=True)
    have = {row["key"] for row in read(path)}
    with open(path, "a", encoding="utf-8") as file:
        for one in wanted:
            if one.key in have:
                continue
            if deadline is not None and clock() > deadline:
                break
            try:
                row = measure(one)
            except Exception as error:
                row = {"key": one.key, "scene": one.scene, "pair": one.pair,
                       "error": told(error, 300)}
            file.write(json.dumps(row) + "\n")
            file.flush()
    return read(path)


def parser_for(doc, program, parts):
    """The options that every such program has."""
    parser = parser_of(doc, program)
    parser.add_argument("--rows", type=Path, required=True,
                        help="folder of rows; those that are there stay")
    parser.add_argument("--part", choices=[*parts, "report", "all"],
                        default="all")
    parser.add_argument("--minutes", type=float,
                        help="nothing new begins after so many")
    parser.add_argument("--commit", default="unknown",
                        help="that PhongPD was built of, for README.md")
    return parser


def run_part(arguments, part, wanted, measure, deadline, what):
    """`deadline` as of time.monotonic(), or None."""
    if arguments.part in (part, "all"):
        found = fill(arguments.rows / f"{part}.jsonl", wanted, measure, deadline,
                     time.monotonic)
        print(f"{len(found)} {what}", flush=True)


def deadline_of(arguments):
    return (None if arguments.minutes is None
            else time.monotonic() + 60 * arguments.minutes)
