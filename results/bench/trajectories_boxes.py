# SPDX-License-Identifier: GPL-3.0-or-later
"""Worlds whose free space is known as boxes, which graphs of convex sets need: the
large maze, and buildings for a flying robot, rebuilt from the sizes that are
published with them (3 × 3 rooms of 5 m, one building a seed)."""
import random
from typing import NamedTuple

import numpy as np
import phongpd
import trajectories_worlds as worlds

ROOMS, SIDE, HEIGHT = 3, 5.0, 3.0  # of a building; metres
THICK = 0.2  # of its walls
HALF = np.array([0.2, 0.2, 0.1])  # of the flying robot, a box
POST = 0.3  # half of its side
DOOR = ((-0.5, 0.0), (0.5, 2.1))  # along the wall from its middle, and up
WINDOW = ((-0.7, 1.0), (0.7, 2.0))


class BoxWorld(NamedTuple):
    """A world, and boxes (low, high) of places that are free; where two of them
    meet one may change from one to the other."""
    world: phongpd.World
    low: np.ndarray   # (n, 3)
    high: np.ndarray  # (n, 3)

    def links(self):
        """Pairs i < j of boxes that overlap in more than a face."""
        wide = ((np.minimum(self.high[:, None], self.high[None])
                 - np.maximum(self.low[:, None], self.low[None])) > 1e-9)
        return [(int(i), int(j)) for i, j in np.argwhere(wide.all(axis=2))
                if i < j]

    def containing(self, point):
        return [int(i) for i in np.flatnonzero(
            ((self.low <= point) & (point <= self.high)).all(axis=1))]


def maze():
    """One box for two cells that no wall parts.  At the ends of walls the robot,
    an octahedron, could come nearer by a part of its size than boxes say."""
    world = worlds.maze()
    walls = {frozenset(wall) for wall in worlds.maze_walls(
        worlds.CELLS, worlds.OPENED, 4)}
    half = 0.05 + 0.05  # of a wall, of the robot
    (x0, y0, bottom), (x1, y1, top) = world.bounds
    low, high = [], []
    for x in range(worlds.CELLS):
        for y in range(worlds.CELLS):
            for u, v in ((x + 1, y), (x, y + 1)):
                if max(u, v) == worlds.CELLS \
                        or frozenset([(x, y), (u, v)]) in walls:
                    continue
                low.append((max(x + half, x0), max(y + half, y0), bottom))
                high.append((min(u + 1 - half, x1), min(v + 1 - half, y1), top))
    return BoxWorld(world, np.array(low), np.array(high))


def _walls_of(chance):
    """How rooms that are neighbours are parted: nothing, a door, a window, or a
    wall; each room can be reached."""
    rooms = [(x, y) for x in range(ROOMS) for y in range(ROOMS)]
    sides = [(a, b) for a in rooms for b in ((a[0] + 1, a[1]), (a[0], a[1] + 1))
             if b in rooms]
    group = {room: room for room in rooms}

    def root(room):
        while group[room] != room:
            room = group[room]
        return room
    kinds = {}
    for a, b in chance.sample(sides, len(sides)):
        joins = root(a) != root(b)
        group[root(a)] = root(b)
        kinds[a, b] = chance.choice(
            ("open", "door", "window") if joins
            else ("open", "door", "window", "wall", "wall", "wall"))
    return dict(sorted(kinds.items()))


def _oriented(axis, at, along, up):
    """(x, y, z) of a place in or beside a wall across x or y."""
    return (at, along, up) if axis == 0 else (along, at, up)


def building(seed):
    """Rooms side by side, some with a post in the middle; from the first to the
    last."""
    chance = random.Random(seed)
    solids, low, high = {}, [], []

    def solid(a, b):
        solids[f"part {len(solids)}"] = worlds.box(a, b)

    def free(a, b):
        low.append(a)
        high.append(b)
    kinds = _walls_of(chance)
    half, top = THICK / 2, HEIGHT
    for (a, b), kind in kinds.items():
        axis = 0 if b[0] > a[0] else 1
        at, begin = b[axis] * SIDE, a[1 - axis] * SIDE
        end, middle = begin + SIDE, begin + SIDE / 2
        if kind == "open":  # as wide as the rooms are free
            s0, s1 = begin + half + HALF[1 - axis], end - half - HALF[1 - axis]
            z0, z1 = HALF[2], top - HALF[2]
        else:
            (p0, q0), (p1, q1) = WINDOW if kind == "window" else DOOR
            parts = ([((begin, 0.0), (end, top))] if kind == "wall" else
                     [((begin, 0.0), (middle + p0, top)),
                      ((middle + p1, 0.0), (end, top)),
                      ((middle + p0, q1), (middle + p1, top)),
                      ((middle + p0, 0.0), (middle + p1, q0))])
            for (s, z), (t, w) in parts:
                if w > z:
                    solid(_oriented(axis, at - half, s, z),
                          _oriented(axis, at + half, t, w))
            if kind == "wall":
                continue
            s0, s1 = middle + p0 + HALF[1 - axis], middle + p1 - HALF[1 - axis]
            z0, z1 = max(q0, 0.0) + HALF[2], q1 - HALF[2]
        reach = half + HALF[axis] + 0.5  # into both rooms
        free(_oriented(axis, at - reach, s0, z0), _oriented(axis, at + reach, s1, z1))
    for x in range(ROOMS):
        for y in range(ROOMS):
            a = np.array([x * SIDE + half, y * SIDE + half, 0.0]) + HALF
            b = np.array([(x + 1) * SIDE - half, (y + 1) * SIDE - half, top]) - HALF
            has_post = (x, y) not in ((0, 0), (ROOMS - 1, ROOMS - 1)) \
                and chance.random() < 0.4
            if not has_post:
                free(a, b)
                continue
            c = np.array([(x + 0.5) * SIDE, (y + 0.5) * SIDE])
            solid((*(c - POST), 0.0), (*(c + POST), top))
            for axis in (0, 1):
                past, before = b.copy(), a.copy()
                past[axis] = c[axis] - POST - HALF[axis]
                before[axis] = c[axis] + POST + HALF[axis]
                free(a, past)
                free(before, b)
    bounds = [[half + HALF[0], half + HALF[1], HALF[2]],
              [ROOMS * SIDE - half - HALF[0], ROOMS * SIDE - half - HALF[1],
               top - HALF[2]]]
    robot = worlds.box(-HALF, HALF)
    return BoxWorld(phongpd.World(robot, solids, name=f"building{seed}",
                                  bounds=bounds), np.array(low), np.array(high))


def building_ends():
    return (np.array([0.5 * SIDE, 0.5 * SIDE, 1.0]),
            np.array([(ROOMS - 0.5) * SIDE, (ROOMS - 0.5) * SIDE, 1.0]))
