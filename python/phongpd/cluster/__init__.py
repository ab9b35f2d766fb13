# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps of many rows on Dask: this machine's cores, or a cluster.

::

    from phongpd import cluster

    if __name__ == "__main__":                    # workers import this file
        sweep = cluster.convergence(
            ["u_axis", "plate:thickness=0.02"], seeds=range(1, 51),
            metrics=["euclidean", "phong@0.2"], output="rows.jsonl")
        for row in sweep.read():
            print(row["scene"], row["seed"], row["method"], row["status_class"])

Every function takes a `client`, any `dask.distributed.Client`; without one it
starts workers on this machine's cores.  What all of them do:

- A row is a task (`batch` of them one task), with a key that follows from the
  scene's contents, the options, the seed and phongpd's version.
- Rows are in OUTPUT.partial as they come, and in OUTPUT, in the order of the
  sweep, when all are there.  A call that was stopped, whatever by, does the
  rows that are missing when it is made again; so does one that asks for more.
- Rows are the same, and OUTPUT to the byte but for TIMING_FIELDS, however many
  workers there are and whatever happened to them; except where a time limit
  stops a sampling planner.
- `max_mib` limits what a build may take, as ContactSpace.build has it; None: a
  thread's share of 0.7 of the worker's memory limit.  A build that is refused
  is a row with `"outcome": "refused"` and the `reason`; solids that cannot be
  used one with `"invalid"`; all others have `"done"`.
- Wrong arguments raise InputError before anything runs.  Rows that could not be
  made, because every worker that tries dies of them for example, raise
  SweepError in the end, when all others are there.

write_parquet makes columns of rows, whenever asked.

contact_space is no sweep: it builds one contact space by pieces, which are files
in a folder, and joins them.

Scene files must be readable on the workers by the same path.
"""

try:
    import distributed as _distributed  # noqa: F401
except ImportError as error:
    raise ImportError("phongpd.cluster: expected Dask's package distributed, "
                      "found none; pip install 'phongpd[cluster]'") from error

from ._parquet import write_parquet
from ._pieces import PieceBuild, contact_space
from ._rows import TIMING_FIELDS, without_timing
from ._run import Sweep
from ._sweeps import contact_spaces, convergence, depth, planning
from ._work import SweepError

__all__ = ["PieceBuild", "Sweep", "SweepError", "TIMING_FIELDS",
           "contact_space", "contact_spaces", "convergence", "depth",
           "planning", "without_timing", "write_parquet"]
