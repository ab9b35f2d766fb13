# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions in time: hundreds of PhongPD's, certified or not, and peers beside
them; see `--help`."""
import argparse
import time
from pathlib import Path

import trajectories_beside
import trajectories_rows as rows
import trajectories_run
from trajectories_duels import version
from trajectories_instances import FAMILIES, instances, peer_instances
from trajectories_report import write_report

PACKAGES = ["numpy", "python-fcl", "ruckig", "toppra", "ompl", "drake"]
TINY = ["u_axis", "tunnel:delta=1e-6"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, required=True,
                        help="folder for README.md and the tables")
    parser.add_argument("--rows", type=Path, required=True,
                        help="folder of rows; those that are there stay")
    parser.add_argument("--tiny", action="store_true",
                        help="a few instances, to see whether it runs")
    parser.add_argument("--part", choices=["own", "peers", "report", "all"],
                        default="all")
    parser.add_argument("--minutes", type=float,
                        help="nothing new begins after so many")
    parser.add_argument("--how", default="results/bench/trajectories_benchmark.py",
                        help="the command that README.md names")
    parser.add_argument("--commit", default="unknown",
                        help="that PhongPD was built of, for README.md")
    arguments = parser.parse_args()
    deadline = (None if arguments.minutes is None
                else time.monotonic() + 60 * arguments.minutes)
    if arguments.part in ("own", "all"):
        wanted = (instances(TINY, [1], {"forest50": 1}) if arguments.tiny
                  else instances(FAMILIES))
        found = rows.fill(arguments.rows / "own.jsonl", wanted,
                          trajectories_run.measure, deadline, time.monotonic)
        print(f"{len(found)} motions measured", flush=True)
    if arguments.part in ("peers", "all"):
        wanted = (peer_instances(TINY[:1], 1) if arguments.tiny
                  else peer_instances())
        found = rows.fill(arguments.rows / "peers.jsonl", wanted,
                          trajectories_beside.measure, deadline, time.monotonic)
        print(f"peers measured on {len(found)} pairs", flush=True)
    if arguments.part in ("report", "all"):
        write_report(arguments.output, arguments.how, arguments.commit,
                     rows.read(arguments.rows / "own.jsonl"),
                     rows.read(arguments.rows / "peers.jsonl"),
                     [p for p in PACKAGES if version(p)])


if __name__ == "__main__":
    main()
