# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows as JSON Lines, each written when it is there: a run that was interrupted
goes on where it was.  And the options of programs that write such rows, part by
part."""
import json
import threading
import time
from concurrent.futures import ThreadPoolExecutor
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


def fill(path, wanted, measure, deadline=None, clock=None, jobs=1):
    """Those of `wanted` (each with a key) that the file lacks, so many at a time:
    more than one suits runs that are processes and whose times are the processor's.
    An error is a row: it is counted, not hidden.  Nothing new begins after the
    deadline.  Returns all rows, in the order of `wanted`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    wanted = list(wanted)
    have = {row["key"] for row in read(path)}
    writing = threading.Lock()

    def make(one):
        if deadline is not None and clock() > deadline:
            return
        try:
            row = measure(one)
        except Exception as error:
            row = {"key": one.key, "scene": one.scene, "pair": one.pair,
                   "error": told(error, 300)}
        with writing:
            file.write(json.dumps(row) + "\n")
            file.flush()

    with open(path, "a", encoding="utf-8") as file, ThreadPoolExecutor(jobs) as pool:
        try:
            list(pool.map(make, [one for one in wanted if one.key not in have]))
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return in_order(read(path), wanted)


def in_order(rows, wanted):
    """That of `wanted`, then those not wanted."""
    place = {one.key: i for i, one in enumerate(wanted)}
    return sorted(rows, key=lambda row: place.get(row["key"], len(place)))


def parser_for(doc, program, parts):
    """The options that every such program has."""
    parser = parser_of(doc, program)
    parser.add_argument("--rows", type=Path, required=True,
                        help="folder of rows; those that are there stay")
    parser.add_argument("--part", choices=[*parts, "report", "all"],
                        default="all")
    parser.add_argument("--minutes", type=float,
                        help="nothing new begins after so many")
    parser.add_argument("--jobs", type=int, default=1,
                        help="runs at a time, where processor seconds are told")
    parser.add_argument("--commit", default="unknown",
                        help="that PhongPD was built of, for README.md")
    return parser


def run_part(arguments, part, wanted, measure, deadline, what, jobs=1):
    """`deadline` as of time.monotonic(), or None.  Returns the rows there are."""
    path = arguments.rows / f"{part}.jsonl"
    if arguments.part not in (part, "all"):
        return in_order(read(path), wanted)
    found = fill(path, wanted, measure, deadline, time.monotonic, jobs)
    print(f"{len(found)} {what}", flush=True)
    return found


def deadline_of(arguments):
    return (None if arguments.minutes is None
            else time.monotonic() + 60 * arguments.minutes)
