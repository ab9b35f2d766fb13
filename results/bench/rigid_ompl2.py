# SPDX-License-Identifier: GPL-3.0-or-later
"""OMPL 2.0 from its wheel, for a robot that turns; see `--help`.

A Python function judges each pose, by phongpd.RigidJudge, at OMPL's samples of 1 %;
its time is told apart.  So what counts is how many runs end with a path, and how many
of these paths are proved to collide between the samples: no times are compared.  The
wheel has neither STRIDE nor EST, and its PRM waits for ever, as its second thread
cannot call Python while the first one solves.  Planners keep their defaults."""
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import NamedTuple

import kept_rows as rows
import numpy as np
import phongpd
from rigid_benchmark import EASY, TIGHT
from rigid_peers_judges import matrix
from scipy.spatial.transform import Rotation

PLANNERS = ["RRTConnect", "KPIECE1", "BKPIECE1", "BITstar"]
LIMIT = 60  # processor seconds, Python's included
RESOLUTION = 0.01


class Planned(NamedTuple):
    scene: str
    planner: str
    pair: int  # the seed

    @property
    def key(self):
        return f"{self.scene} {self.planner} {RESOLUTION} {LIMIT} {self.pair}"


def matrix_of(state):
    pose, q = np.eye(4), state.rotation()
    pose[:3, :3] = matrix((q.w, q.x, q.y, q.z))
    pose[:3, 3] = state.getX(), state.getY(), state.getZ()
    return pose


class Checker:
    """Is a pose within bounds and free?  Counts poses and seconds."""

    def __init__(self, information, judge):
        self._information, self._judge = information, judge
        self.poses, self.seconds = 0, 0.0

    def __call__(self, state):
        begin = time.process_time()
        free = self._information.satisfiesBounds(state)
        if free:
            pose = matrix_of(state)
            free = self._judge.check(pose, pose).free
        self.poses += 1
        self.seconds += time.process_time() - begin
        return free


def state_of(space, pose):
    state, turn = space.allocState(), Rotation.from_matrix(pose[:3, :3]).as_rotvec()
    angle = float(np.linalg.norm(turn))
    axis = turn / angle if angle > 0 else np.array([0.0, 0.0, 1.0])
    state.setXYZ(*map(float, pose[:3, 3]))
    state.rotation().setAxisAngle(*map(float, axis), angle)
    return state


def setup_of(world, judge):
    """What to solve, and what counts its poses."""
    from ompl import base, geometric
    space, box = base.SE3StateSpace(), base.RealVectorBounds(3)
    for axis in range(3):
        box.setLow(axis, float(world.bounds[0, axis]))
        box.setHigh(axis, float(world.bounds[1, axis]))
    space.setBounds(box)
    information = base.SpaceInformation(space)
    setup, checker = geometric.SimpleSetup(information), Checker(information, judge)
    setup.setStateValidityChecker(checker)
    information.setStateValidityCheckingResolution(RESOLUTION)
    # BIT* stops at its first path, like the others.
    length = base.PathLengthOptimizationObjective(information)
    length.setCostThreshold(length.infiniteCost())
    setup.setOptimizationObjective(length)
    setup.setStartAndGoalStates(state_of(space, world.start),
                                state_of(space, world.goal))
    return setup, checker


def measure(one):
    from ompl import base, geometric, util
    util.setLogLevel(util.LOG_ERROR)
    util.RNG.setSeed(one.pair)
    world = phongpd.RigidWorld.load(one.scene)
    judge = phongpd.RigidJudge(world.robot, world.obstacles)
    setup, checker = setup_of(world, judge)
    setup.setPlanner(
        getattr(geometric, one.planner)(setup.getSpaceInformation()))
    setup.setup()
    begin = time.process_time()
    status = setup.getPlanner().solve(base.PlannerTerminationCondition(
        lambda: time.process_time() - begin > LIMIT))
    seconds = time.process_time() - begin
    solved = status.getStatus() == base.PlannerStatus.EXACT_SOLUTION
    path = [] if not solved else [
        matrix_of(state) for state in setup.getSolutionPath().getStates()]
    wrong = 0 if not path else sum(
        check.status == "collides" for check in judge.check_path(path))
    return {"key": one.key, "scene": one.scene, "planner": one.planner,
            "seed": one.pair, "limit": LIMIT, "solved": solved, "wrong": wrong,
            "seconds": seconds, "in_python": checker.seconds,
            "checked": checker.poses}


def measure_alone(one):
    """In a process of its own: OMPL takes a seed before its first number only."""
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        return pool.submit(measure, one).result()


def wanted(seeds):
    """Where there is room, seed by seed, then where it is tight."""
    for scenes, count in ((EASY, seeds), (TIGHT, 1)):
        for seed in range(1, count + 1):
            for planner in PLANNERS:
                for scene in scenes:
                    yield Planned(scene, planner, seed)


def main():
    parser = rows.parser_for(__doc__, "rigid_ompl2.py", ["ompl2"])
    parser.add_argument("--seeds", type=int, default=5,
                        help="where there is room; 1 where it is tight")
    arguments = parser.parse_args()
    rows.run_part(arguments, "ompl2", wanted(arguments.seeds), measure_alone,
                  rows.deadline_of(arguments), "runs of OMPL 2.0", arguments.jobs)


if __name__ == "__main__":
    main()
