# SPDX-License-Identifier: GPL-3.0-or-later
"""Which motions are asked for: scenes, pairs of ends, limits."""
import functools
from typing import NamedTuple

import phongpd
import trajectories_worlds as worlds

LIMITS = (1.0, 2.0, 8.0)  # velocity, acceleration, jerk; families are of size 2 to 5
FOREST_LIMITS = (2.0, 3.0, 8.0)
# Families, with knobs that make them narrow or large.
FAMILIES = [
    "u_trap", "u_axis", "l", "plate", "plate:thickness=0.02", "thin_wall",
    "long_plate", "ball_convex", "cube_vessel", "plate_hole",
    "plate_hole:clearance=0.001", "torus_hole", "ball_cone", "cone_axes",
    "ball_wrench", "peg_tunnel", "peg_tunnel:clearance=0.1",
    "peg_tunnel:clearance=1e-6", "clutter", "clutter:layout=2",
    "clutter:boxes=60", "knot", "gap", "gap:delta=1e-4", "hole",
    "hole:delta=1e-6", "tunnel", "tunnel:delta=0.1", "tunnel:delta=1e-4",
    "tunnel:delta=1e-6", "tunnel:delta=1e-6,rotation_seed=1",
    "tunnel:delta=1e-6,bends=5", "keyhole", "keyhole:delta=1e-6", "comb",
    "comb:delta=1e-4", "snake", "snake:delta=1e-6", "bugtrap",
    "bugtrap:delta=1e-6", "clutter_hole", "maze", "maze:delta=0.001,n=4"]
# Where peers run, too: nine, from open to narrow.
PEER_SCENES = ["u_trap", "u_axis", "plate", "clutter", "knot", "tunnel", "maze",
               "forest50", "forest200"]
SEEDS = range(1, 7)  # of ends in a family
PAIRS = {"forest50": 30, "forest200": 20, "maze50": 5}


class Instance(NamedTuple):
    scene: str
    pair: int
    limits: tuple
    by_norm: bool

    @property
    def key(self):
        return f"{self.scene}|{self.pair}|{'norm' if self.by_norm else 'axis'}"


def instances(families=FAMILIES, pairs=SEEDS, forests=None):
    """Pairs before scenes, so that a run that is cut off has seen all scenes;
    what takes longest is last."""
    forests = PAIRS if forests is None else forests
    found = [Instance(scene, pair, LIMITS, by_norm) for pair in pairs
             for scene in families for by_norm in (False, True)]
    for name, count in forests.items():
        limits = LIMITS if name == "maze50" else FOREST_LIMITS
        # A motion through the large maze takes as long as a hundred others.
        found += [Instance(name, pair, limits, by_norm) for pair in range(count)
                  for by_norm in ((False,) if name == "maze50"
                                  else (False, True))]
    return found


def peer_instances(scenes=PEER_SCENES, pairs=5):
    return [Instance(scene, pair,
                     FOREST_LIMITS if scene in worlds.FORESTS else LIMITS, False)
            for scene in scenes for pair in range(1, pairs + 1)]


@functools.lru_cache(1 << 6)
def world_of(scene):
    """Once for all pairs of ends; its contact space is built when first asked."""
    if scene in worlds.FORESTS:
        return worlds.forest(scene)
    if scene == "maze50":
        return worlds.maze()
    return phongpd.World.load(scene, seed=SEEDS[0])


@functools.lru_cache(None)
def _pairs(scene):
    if scene == "maze50":
        return worlds.maze_pairs(worlds.CELLS, PAIRS[scene], seed=1)
    return worlds.random_pairs(world_of(scene), PAIRS[scene], 15.0, seed=1)


def ends_of(instance):
    if instance.scene in PAIRS:
        return _pairs(instance.scene)[instance.pair]
    loaded = phongpd.World.load(instance.scene, seed=instance.pair)
    return loaded.start, loaded.goal
