# SPDX-License-Identifier: GPL-3.0-or-later
"""A world for OMPL's own Python bindings::

    from phongpd.for_ompl import simple_setup, state_of

    setup = simple_setup(world)
    setup.setStartAndGoalStates(state_of(setup, start), state_of(setup, goal))
    setup.setPlanner(ompl.geometric.RRTConnect(setup.getSpaceInformation()))
    setup.solve(5.0)
    path = path_of(setup.getSolutionPath())

Motions are judged exactly, as a whole: no step width, nothing between two
samples that is not seen.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from ompl import base, geometric

from ._arguments import Floats, point
from ._native import InputError
from ._room import as_room
from ._world import World


class ExactValidityChecker(base.StateValidityChecker):  # type: ignore[misc]
    """Is a position free?  Exact, by the world's contact space."""

    def __init__(self, information: Any, world: World) -> None:
        super().__init__(information)
        self._world = as_room(world)

    def isValid(self, state: Any) -> bool:
        return bool(self._world.is_free(_position(state))[0])

    def clearance(self, state: Any) -> float:
        """Distance to contact and bounds; user's unit."""
        return float(self._world.clearance(_position(state))[0])


class ExactMotionValidator(base.MotionValidator):  # type: ignore[misc]
    """Is every point of a straight motion free?  Exact, without sampling."""

    def __init__(self, information: Any, world: World) -> None:
        super().__init__(information)
        self._world = as_room(world)

    def checkMotion(self, a: Any, b: Any) -> bool:
        return bool(
            self._world.is_motion_free(_position(a), _position(b))[0])


def simple_setup(world: World) -> Any:
    """An ompl.geometric.SimpleSetup of a world with bounds, with both checks
    above in place.  Builds the contact space, if that is not there."""
    bounds = as_room(world).bounds
    if bounds is None:
        raise InputError("world: expected bounds, which OMPL samples in, "
                         "found none; give World(..., bounds=)")
    space = base.RealVectorStateSpace(3)
    box = base.RealVectorBounds(3)
    for axis in range(3):
        box.setLow(axis, float(bounds[0, axis]))
        box.setHigh(axis, float(bounds[1, axis]))
    space.setBounds(box)
    setup = geometric.SimpleSetup(space)
    information = setup.getSpaceInformation()
    world.is_free(bounds[0])  # builds before anybody's time limit runs
    information.setStateValidityChecker(ExactValidityChecker(information, world))
    information.setMotionValidator(ExactMotionValidator(information, world))
    return setup


def state_of(setup: Any, q: ArrayLike) -> Any:
    """A position as a state."""
    state = setup.getStateSpace().allocState()
    for axis, x in enumerate(point(q, "q")):
        state[axis] = x
    return state


def path_of(path: Any) -> Floats:
    """(K, 3): an ompl.geometric.PathGeometric's states."""
    return np.array([[state[0], state[1], state[2]]
                     for state in path.getStates()]).reshape(-1, 3)


def _position(state: Any) -> Floats:
    return np.array([[state[0], state[1], state[2]]])
