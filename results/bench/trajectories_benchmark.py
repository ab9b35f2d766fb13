# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions in time: hundreds of PhongPD's, certified or not, and peers beside
them; see `--help`."""

import kept_rows as rows
import trajectories_beside
import trajectories_gcs
import trajectories_growth
import trajectories_moving
import trajectories_run
from trajectories_duels import version
from trajectories_instances import FAMILIES, instances, peer_instances
from trajectories_report import write_report

PACKAGES = ["numpy", "python-fcl", "ruckig", "toppra", "ompl", "drake"]
PARTS = ["own", "peers", "gcs", "moving", "growth"]
TINY = ["u_axis", "tunnel:delta=1e-6"]


def main():
    parser = rows.parser_for(__doc__, "trajectories_benchmark.py", PARTS)
    parser.add_argument("--tiny", action="store_true",
                        help="a few instances, to see whether it runs")
    arguments = parser.parse_args()
    deadline = rows.deadline_of(arguments)
    rows.run_part(arguments, "own",
                  instances(TINY, [1], {"forest50": 1}) if arguments.tiny
                  else instances(FAMILIES),
                  trajectories_run.measure, deadline, "motions measured")
    rows.run_part(arguments, "peers",
                  peer_instances(TINY[:1], 1) if arguments.tiny
                  else peer_instances(),
                  trajectories_beside.measure, deadline,
                  "pairs with peers measured")
    rows.run_part(arguments, "gcs",
                  trajectories_gcs.instances(0, 1) if arguments.tiny
                  else trajectories_gcs.instances(),
                  trajectories_gcs.measure, deadline,
                  "pairs with graphs of convex sets measured")
    rows.run_part(arguments, "moving",
                  trajectories_moving.instances(3) if arguments.tiny
                  else trajectories_moving.instances(),
                  trajectories_moving.measure, deadline,
                  "motions among moving obstacles measured")
    rows.run_part(arguments, "growth",
                  trajectories_growth.instances((4, 6), (12,), 1)
                  if arguments.tiny else trajectories_growth.instances(),
                  trajectories_growth.measure, deadline,
                  "motions of growing size measured")
    if arguments.part in ("report", "all"):
        write_report(arguments.output, arguments.how, arguments.commit,
                     {part: rows.read(arguments.rows / f"{part}.jsonl")
                      for part in PARTS},
                     [p for p in PACKAGES if version(p)])


if __name__ == "__main__":
    main()
