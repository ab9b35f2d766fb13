# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows as JSON Lines, each written when it is there: a run that was interrupted
goes on where it was."""
import json


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
                       "error": f"{type(error).__name__}: "
                       + " ".join(str(error).split())[:300]}
            file.write(json.dumps(row) + "\n")
            file.flush()
    return read(path)
