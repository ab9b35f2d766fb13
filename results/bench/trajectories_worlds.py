# SPDX-License-Identifier: GPL-3.0-or-later
"""Worlds of others, rebuilt here from the parameters that they publish: forests
of cylinders as EGO-Planner and Fast-Planner fly through them, a large maze as
graphs of convex sets are shown on.  No file and no line of theirs is used, so
that size, counts and seeds agree, but not where each tree or wall stands."""
import random

import numpy as np
import phongpd

SIDES = 12  # of a cylinder
HEIGHT = 3.0
# Sides of the ground and count of cylinders.
FORESTS = {"forest50": (36.0, 20.0, 50), "forest200": (50.0, 50.0, 200)}
CELLS, OPENED = 50, 100  # of the maze: cells a side, walls taken away


def prism(corners, bottom, top):
    """Vertices and outward triangles over a convex polygon, anticlockwise."""
    n = len(corners)
    vertices = [(x, y, z) for z in (bottom, top) for x, y in corners]
    triangles = [(0, k + 1, k) for k in range(1, n - 1)]
    triangles += [(n, n + k, n + k + 1) for k in range(1, n - 1)]
    for k in range(n):
        after = (k + 1) % n
        triangles += [(k, after, n + after), (k, n + after, n + k)]
    return np.array(vertices, dtype=float), np.array(triangles)


def box(least, most):
    (x, y, z), (u, v, w) = least, most
    return phongpd.Solid(*prism([(x, y), (u, y), (u, v), (x, v)], z, w))


def octahedron(radius):
    vertices = radius * np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0),
                                  (0, 0, 1), (0, 0, -1)], dtype=float)
    ring = [0, 2, 1, 3]
    triangles = [(ring[k], ring[(k + 1) % 4], 4) for k in range(4)]
    triangles += [(ring[(k + 1) % 4], ring[k], 5) for k in range(4)]
    return phongpd.Solid(vertices, np.array(triangles))


def forest(name, seed=1, sides=SIDES):
    """Radii 0.5 to 1, 3 m high; the robot is 0.5 m across."""
    width, depth, count = FORESTS[name]
    chance = np.random.default_rng(seed)
    angles = 2 * np.pi * np.arange(sides) / sides
    trees = {}
    for k in range(count):
        x, y = chance.uniform((-width / 2, -depth / 2), (width / 2, depth / 2))
        radius = chance.uniform(0.5, 1.0)
        around = np.column_stack([x + radius * np.cos(angles),
                                  y + radius * np.sin(angles)])
        trees[f"tree {k}"] = phongpd.Solid(*prism(around, -1.0, HEIGHT + 1.0))
    half = np.array([width / 2, depth / 2])
    return phongpd.World(octahedron(0.25), trees, name=name,
                         bounds=[[*-half, 0.0], [*half, HEIGHT]])


def maze_walls(cells, opened, seed):
    """Walls that stand, ((x, y), (u, v)) between neighbouring cells, of a
    perfect maze by a random walk that turns back at dead ends, less some."""
    chance = random.Random(seed)
    sides = ((1, 0), (0, 1), (-1, 0), (0, -1))
    gone, seen, stack = set(), {(0, 0)}, [(0, 0)]
    while stack:
        x, y = stack[-1]
        new = [(x + a, y + b) for a, b in sides
               if 0 <= x + a < cells and 0 <= y + b < cells
               and (x + a, y + b) not in seen]
        if not new:
            stack.pop()
            continue
        cell = chance.choice(new)
        gone.add(frozenset([stack[-1], cell]))
        seen.add(cell)
        stack.append(cell)
    walls = [((x, y), (x + a, y + b)) for x in range(cells)
             for y in range(cells) for a, b in sides[:2]
             if x + a < cells and y + b < cells
             and frozenset([(x, y), (x + a, y + b)]) not in gone]
    chance.shuffle(walls)
    return sorted(walls[opened:])


def maze(cells=CELLS, opened=OPENED, seed=4, thickness=0.1):
    """Cells of side 1 in a plane: the robot, 0.1 across, has no room to rise.
    Walls in a line are one box."""
    half, boxes, runs = thickness / 2, {}, {}
    for (x, y), (u, _) in maze_walls(cells, opened, seed):
        key = ("x", x + 1) if u > x else ("y", y + 1)
        runs.setdefault(key, []).append(y if u > x else x)
    for (axis, at), places in sorted(runs.items()):
        begin = previous = None
        for place in [*sorted(places), None]:
            if begin is not None and place != previous + 1:
                low, high = begin - half, previous + 1 + half
                ends = (((at - half, low), (at + half, high)) if axis == "x"
                        else ((low, at - half), (high, at + half)))
                boxes[f"wall {len(boxes)}"] = box((*ends[0], -1.0),
                                                  (*ends[1], 1.0))
                begin = None
            begin, previous = (place if begin is None else begin), place
            if place is None:
                break
    return phongpd.World(octahedron(0.05), boxes, name="maze50",
                         bounds=[[0.06, 0.06, -0.2],
                                 [cells - 0.06, cells - 0.06, 0.2]])


def random_pairs(world, count, least, seed):
    """Free ends, at least that far from each other."""
    chance, (low, high) = np.random.default_rng(seed), world.bounds
    found = []
    while len(found) < count:
        ends = chance.uniform(low, high, (2, 3))
        if np.linalg.norm(ends[1] - ends[0]) >= least \
                and world.is_free(ends).all():
            found.append((ends[0], ends[1]))
    return found


def maze_pairs(cells, count, seed):
    """Corner to corner, then centres of random cells."""
    chance = random.Random(seed)
    found = [((0.5, 0.5, 0.0), (cells - 0.5, cells - 0.5, 0.0))]
    while len(found) < count:
        a, b = (tuple(chance.randrange(cells) + 0.5 for _ in "xy") + (0.0,)
                for _ in "ab")
        if a != b:
            found.append((a, b))
    return found
