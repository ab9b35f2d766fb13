# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions in time: hundreds of PhongPD's, certified or not, and peers beside
them; see `--help`."""

import kept_rows as rows
import trajectories_beside
import trajectories_gcs as gcs
import trajectories_growth as growth
import trajectories_moving as moving
import trajectories_run
from trajectories_duels import version
from trajectories_instances import instances, peer_instances
from trajectories_report import write_report

PACKAGES = ["numpy", "python-fcl", "ruckig", "toppra", "ompl", "drake"]
TINY = ["u_axis", "tunnel:delta=1e-6"]
# Of each: what is measured, a few of it, how, and in words.
PARTS = {
    "own": (instances(), instances(TINY, [1], {"forest50": 1}),
            trajectories_run.measure, "motions measured"),
    "peers": (peer_instances(), peer_instances(TINY[:1], 1),
              trajectories_beside.measure, "pairs with peers measured"),
    "gcs": (gcs.instances(), gcs.instances(0, 1), gcs.measure,
            "pairs with graphs of convex sets measured"),
    "moving": (moving.instances(), moving.instances(3), moving.measure,
               "motions among moving obstacles measured"),
    "growth": (growth.instances(), growth.instances((4, 6), (12,), 1),
               growth.measure, "motions of growing size measured")}


def main():
    parser = rows.parser_for(__doc__, "trajectories_benchmark.py", PARTS)
    parser.add_argument("--tiny", action="store_true",
                        help="a few instances, to see whether it runs")
    arguments = parser.parse_args()
    deadline = rows.deadline_of(arguments)
    for part, (whole, few, measure, what) in PARTS.items():
        rows.run_part(arguments, part, few if arguments.tiny else whole, measure,
                      deadline, what)
    if arguments.part in ("report", "all"):
        write_report(arguments.output, arguments.how, arguments.commit,
                     {part: rows.read(arguments.rows / f"{part}.jsonl")
                      for part in PARTS},
                     [p for p in PACKAGES if version(p)])


if __name__ == "__main__":
    main()
