# SPDX-License-Identifier: GPL-3.0-or-later
"""Continuous penetration depth on exact contact spaces.

How deep is a robot in an obstacle, and which way is out?

>>> import phongpd
>>> world = phongpd.World.load("ball_wrench")  # or World("a.stl", "b.stl")
>>> tool, part = world.robot, world.obstacles[0]  # or Solid.read("tool.stl")
>>> print(phongpd.depth(tool, part, at=(0.3, 0, 0.1)))  # exact, nothing built
penetrating, depth 0.55 along (0, 0, 1)

The same at many positions, with a direction that turns and does not flip:

>>> space = phongpd.ContactSpace.build(tool, part)  # boundary of part + (-tool)
>>> points = [(0.3, 0, 0.1), (0.3, 0, 0)]  # N x 3; answered on all cores
>>> phongpd.PhongMetric(space).query(points).statuses
['ok', 'ok']

A motion for a machine, within limits of velocity, acceleration and jerk, free
for all t, proved; and where there is no way, the proof of that:

>>> cell = phongpd.World.load("u_axis")
>>> motion = cell.optimize(limits=(1, 2, 10))  # start, goal: the scene's own
>>> motion.certified
True
>>> phongpd.World.load("tunnel:delta=0.001,twin=1").plan().infeasible
True

A robot translates among fixed obstacles, all closed triangle meshes; RigidWorld
and RigidJudge are for one that turns. Lengths are in the user's unit throughout,
or, where a docstring says so, a share of D, the world's one length. Answers
print in a line, have `to_row()` for pandas, most `plot()` for matplotlib, and in
a notebook they show themselves. What cannot be used raises InputError, a
ValueError of one line: what, where, expected, found.
"""

from ._answers import Plan, Trajectory
from ._compare import Comparison, compare
from ._contact import ContactSpace, minkowski
from ._curve import CurveCheck
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
from ._room import Diagnosis
from ._rows import NonPenetrationRows
from ._solid import Solid
from ._tracker import PenetrationTracker, TrackedMotion
from ._view import View, view
from ._world import World

# What the native module has no words for.
InputError.__doc__ = """What was given cannot be used; a ValueError of one line:
what, where, expected, found."""
BuildRefusal.__doc__ = """An InputError: a model would pass the limits of memory
or time that it was given, max_mib or max_seconds; nothing was built."""
BuildCancelled.__doc__ = """A build or a search was interrupted, by Ctrl-C as a
rule; what is there already stays usable."""

__all__ = [
    "BuildCancelled", "BuildRefusal", "Comparison", "ContactSpace",
    "ContactSpacePiece", "CurveCheck",
    "Depth", "DepthQuery", "Diagnosis", "Disassembly", "EuclideanMetric",
    "Fleet", "InputError", "Motion", "NonPenetrationRows", "Penetration",
    "PenetrationTracker", "PhongMetric", "Plan", "QueryResult", "Removal",
    "RigidCheck", "RigidClearance", "RigidFirstHit", "RigidJudge",
    "RigidOptimum", "RigidPlan", "RigidWorld",
    "Roadmap", "SmoothedMetric", "Solid", "TrackedMotion", "Trajectory",
    "View", "World", "__version__", "compare", "depth", "disassemble", "minkowski",
    "optimize_fleet", "remove", "view",
]
