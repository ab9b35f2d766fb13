# SPDX-License-Identifier: GPL-3.0-or-later
"""PhongPD beside its peers in one run, each from its own wheel; see `--help`."""

import importlib

import peers_depth
import peers_distance
import peers_minkowski
import peers_solvers
from peers_report import write_report
from python_report import parser_of, told

SEED = 1
# Import name, and the package it comes in.
PEERS = [("manifold3d", "manifold3d"), ("coal", "coal"), ("fcl", "python-fcl"),
         ("mujoco", "mujoco"), ("trimesh", "trimesh"), ("open3d", "open3d-cpu"),
         ("scipy", "scipy"), ("casadi", "casadi"), ("pydrake", "drake")]


def load_all():
    """Packages that load, and one line for each that does not."""
    there, missing = [], []
    for module, package in PEERS:
        try:
            importlib.import_module(module)
            there.append(package)
        except Exception as error:
            missing.append(f"{package} does not load: {told(error, 200)}")
    return there, missing


def main():
    arguments = parser_of(__doc__, "peers_benchmark.py").parse_args()
    packages, failures = load_all()
    depth, failed = peers_depth.run(SEED)
    failures += failed
    print("depth measured", flush=True)
    distance, failed = peers_distance.run(SEED)
    failures += failed
    print("distances measured", flush=True)
    solvers, failed = peers_solvers.run(range(SEED, SEED + 3))
    failures += failed
    print("solvers measured", flush=True)
    sums = peers_minkowski.run()
    write_report(arguments.output, arguments.how, SEED, packages, failures,
                 sums, depth, distance, solvers)


if __name__ == "__main__":
    main()
