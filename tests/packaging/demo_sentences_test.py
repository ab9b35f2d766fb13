#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""demo_sentences_test.py SCRIPT: what the demo's page says follows the rows, for
every outcome that a row can have."""
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SCRIPT = sys.argv[1]


def said(*kind, rows):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "rows.jsonl")
        file.write_text("".join(json.dumps(row) + "\n" for row in rows))
        return subprocess.run([sys.executable, SCRIPT, *kind, str(file)],
                              check=True, capture_output=True,
                              text=True).stdout.splitlines()


def run(metric, mu, free, start="straight"):
    return {"metric": metric, "mu_strategy": mu, "start": start, "iterations": 7,
            "collision_free": free, "reason": "" if free else "limit < 8"}


for first in (False, True):
    for second in (False, True):
        lines = said("trap", rows=[run("euclidean", "monotone", first),
                              run("phong", "monotone", second),
                              run("euclidean", "adaptive", second),
                              run("phong", "adaptive", first),
                              run("phong", "adaptive", True, "repaired")])
        assert len(lines) == 3, lines
        for line, name, outcomes in zip(
                lines, ("With monotone mu", "With adaptive mu",
                        "The default pipeline"),
                ((first, second), (second, first), (True,))):
            assert line.startswith(name), line
            assert "limit <" not in line
            parts = html.unescape(line).split(": ", 1)[1]
            parts = parts.replace("; 7", ", 7").split("; ")
            assert len(parts) == len(outcomes), parts
            for part, free in zip(parts, outcomes):
                assert ("gets out in 7 iterations" in part) == free, part
                assert ("does not get out (limit < 8" in part) != free, part


def plan(planner, scene, status):
    return {"planner": planner, "scene": scene, "status": status,
            "solved": status == "solved",
            "infeasible_proved": status == "infeasible_proved",
            "seconds": {"solve": 0.00041}}


for status, word in (("solved", "finds a path through"),
                     ("infeasible_proved", "that there is none"),
                     ("time_limit", "(time limit)"), ("failed", "(failed)")):
    for scene, channel in (("t:d=1", "open"), ("t:d=1,twin=1", "closed")):
        (line,) = said("tunnel", rows=[plan("rrt-connect", scene, status)])
        assert word in line and f"the {channel} channel" in line, line
        assert "0.00041 s" in line and line.startswith("rrt-connect "), line
        assert ("proves nothing" in line) == ("(" in word), line


def cells(kind, rows):
    """The table of the rows: each as what stands above to what stands there."""
    lines = said("--table", kind, rows=rows)
    table = [re.findall("<t[hd]>(.*?)</t[hd]>", line) for line in lines
             if "colspan" not in line]
    return [dict(zip(table[0], map(html.unescape, line))) for line in table[1:]]


# Sentence and table say the same of one row.
for free in (False, True):
    for name in ("euclidean", "phong"):
        row = {**run(name, "monotone", free), "objective": 1.23456,
               "clearance": 0.0123456, "seconds": {"total": 0.5},
               "status_class": "solved" if free else "time_limit"}
        (line,), (of,) = said("trap", rows=[row]), cells("trap", [row])
        assert of["metric"] in line and f"{of['iterations']} iterations" in line
        assert ("gets out in" in line) == (of["status"] == "solved"), (line, of)
        assert of["mu"] == "monotone" and of["energy"] == "1.235", of
        assert of["room"] == "0.01235" and of["seconds"] == "0.5", of
for status in ("solved", "infeasible_proved", "time_limit"):
    for scene in ("t:d=1", "t:d=1,twin=1"):
        row = {**plan("rrt-connect", scene, status), "path": [[0, 0, 0]] * 3,
               "path_length": 2.5, "clearance": None, "reason": "a < b"}
        (line,), (of,) = said("tunnel", rows=[row]), cells("tunnel", [row])
        assert line.startswith(of["planner"]) and of["channel"] in line, (line, of)
        assert f"{of['seconds']} s" in line and of["points"] == "3", (line, of)
        assert ("finds a path" in line) == (of["status"] == "solved"), (line, of)
        assert ("proves in" in line) == (of["status"] == "infeasible proved")
        assert of["room"] == "", of
        assert "a &lt; b" in said("--table", "tunnel", rows=[row])[-1]
row = {**plan("two trees", "t", "solved"), "path": [[0] * 7] * 4,
       "path_length": 2.5, "reason": ""}
(line,), (of,) = said("turning", rows=[row]), cells("turning", [row])
assert f"{of['points']} poses" in line and f"{of['seconds']} s" in line, (line, of)
print("demo sentences: all follow the rows")
