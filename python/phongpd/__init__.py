# SPDX-License-Identifier: GPL-3.0-or-later
"""Continuous penetration depth on exact contact spaces.

A robot that translates among fixed obstacles, all closed triangle meshes.
Lengths are in the user's unit throughout, or, where a docstring says so, a
share of D, the world's one length::

    import phongpd

    part = phongpd.Solid.read("part.stl")
    tool = phongpd.Solid.read("tool.stl")
    print(phongpd.depth(tool, part))               # exact, as they lie
    space = phongpd.ContactSpace.build(tool, part)
    phong = phongpd.PhongMetric(space)
    answers = phong.query(points)                  # an N x 3 array

    world = phongpd.World(tool, {"part": part})
    run = world.optimize(start, goal)              # Ipopt, exactly judged
    plan = world.plan(start, goal)                 # or a proof that there is none
    motion = world.optimize(start, goal, limits=(1, 2, 10))
    fleet = phongpd.optimize_fleet("robots.json")  # several in one room

    judge = phongpd.RigidJudge(tool, part)         # of motions that turn, too
    judge.check(start_pose, goal_pose).free        # for all t, proved
    phongpd.RigidWorld(tool, part).plan(start_pose, goal_pose)  # a path of poses

Whatever cannot be used raises InputError, a ValueError of one line: what,
where, expected, found.
"""

from ._answers import Diagnosis, Plan, Trajectory
from ._contact import ContactSpace, minkowski
from ._depth import Depth, DepthQuery, depth
from ._fleet import Fleet, optimize_fleet
from ._metrics import (EuclideanMetric, Penetration, PhongMetric, QueryResult,
                       SmoothedMetric)
from ._motion import Motion
from ._native import BuildCancelled, BuildRefusal, InputError, __version__
from ._piece import ContactSpacePiece
from ._removal import Disassembly, Removal, disassemble, remove
from ._rigid import RigidCheck, RigidClearance, RigidFirstHit, RigidJudge
from ._rigid_plan import RigidOptimum, RigidPlan, RigidWorld
from ._roadmap import Roadmap
from ._rows import NonPenetrationRows
from ._solid import Solid
from ._tracker import PenetrationTracker, TrackedMotion
from ._view import View, view
from ._world import World

__all__ = [
    "BuildCancelled", "BuildRefusal", "ContactSpace", "ContactSpacePiece",
    "Depth", "DepthQuery", "Diagnosis", "Disassembly", "EuclideanMetric",
    "Fleet", "InputError", "Motion", "NonPenetrationRows", "Penetration",
    "PenetrationTracker", "PhongMetric", "Plan", "QueryResult", "Removal",
    "RigidCheck", "RigidClearance", "RigidFirstHit", "RigidJudge",
    "RigidOptimum", "RigidPlan", "RigidWorld",
    "Roadmap", "SmoothedMetric", "Solid", "TrackedMotion", "Trajectory",
    "View", "World", "__version__", "depth", "disassemble", "minkowski",
    "optimize_fleet", "remove", "view",
]
