# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._answers import Plan
from ._arguments import point
from ._room import Room, native_world


class Roadmap:
    """ContactSurfacePlanner for many queries: as complete, and with the same
    proofs.  Thread-safe."""

    def __init__(self, world: Room) -> None:
        self._native = _native.Roadmap(native_world(world))
        self._world = world

    @property
    def nodes(self) -> int:
        return self._native.nodes

    @property
    def edges(self) -> int:
        return self._native.edges

    def plan(self, start: ArrayLike, goal: ArrayLike) -> Plan:
        """The best path that the roadmap has from start to goal, (3,) each,
        free by exact tests, or why there is none; as World.plan, but with an
        empty `row`."""
        ends = point(start, "start"), point(goal, "goal")
        found = self._native.plan(*ends)
        return Plan(
            status=found["status"], reason=found["reason"],
            solved=found["status"] == "solved",
            infeasible=found["status"] == "infeasible_proved",
            path=found["path"], length=found["length"],
            clearance=found["clearance"], seconds=found["seconds"], row={},
            world=self._world, ends=np.array(ends))

    def __repr__(self) -> str:
        return f"<Roadmap: {self.nodes} nodes, {self.edges} edges>"
