# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs that PhongPD and its peers are given alike."""

import itertools

import numpy as np
import phongpd

L = [((0, 0, 0), (2, 0.5, 1)), ((0, 0, 0), (0.5, 2, 1))]
U = [((0, 0, 0), (3, 0.4, 1)), ((0, 0, 0), (0.4, 2, 1)), ((2.6, 0, 0), (3, 2, 1))]
CUBE = [((0, 0, 0), (1, 1, 1))]


def _cells(boxes):
    """Planes by axis, and which cells between them the boxes fill."""
    ends = np.array(boxes, dtype=float)
    planes = [np.unique(ends[:, :, k]) for k in range(3)]
    middles = [(p[1:] + p[:-1]) / 2 for p in planes]
    x, y, z = np.meshgrid(*middles, indexing="ij")
    full = np.zeros(x.shape, dtype=bool)
    for low, high in ends:
        full |= ((low[0] < x) & (x < high[0]) & (low[1] < y) & (y < high[1])
                 & (low[2] < z) & (z < high[2]))
    return planes, full


def union_volume(boxes):
    """Of axis-parallel boxes: exact but for rounding, no mesh in it."""
    planes, full = _cells(boxes)
    a, b, c = (np.diff(p) for p in planes)
    return float(np.einsum("i,j,k,ijk->", a, b, c, full))


def sum_of_boxes(one, other):
    """The Minkowski sum of two unions of boxes, as boxes."""
    return [(np.add(p[0], q[0]), np.add(p[1], q[1]))
            for p, q in itertools.product(one, other)]


def solid_of(boxes, name):
    """The boundary of a union of boxes as a closed mesh."""
    planes, full = _cells(boxes)
    padded = np.pad(full, 1)
    corners, triangles = {}, []

    def corner(*index):
        return corners.setdefault(index, len(corners))

    for axis, side in itertools.product(range(3), (0, 1)):
        step = np.zeros(3, dtype=int)
        step[axis] = 1 if side else -1
        for cell in np.argwhere(full):
            if padded[tuple(cell + 1 + step)]:
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            loop = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = cell.copy()
                at[axis] += side
                at[u] += du
                at[v] += dv
                loop.append(corner(*at))
            a, b, c, d = loop if side else loop[::-1]
            triangles += [(a, b, c), (a, c, d)]
    points = [[planes[k][index[k]] for k in range(3)] for index in corners]
    return phongpd.Solid(points, triangles, name)


def turned(solid, seed):
    """By a random rotation about the origin."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    q[:, 0] *= np.linalg.det(q)
    return phongpd.Solid(solid.vertices @ q.T, solid.triangles, solid.name)


def of_scene(name):
    """Robot and first obstacle."""
    world = phongpd.World.load(name)
    return world.robot, world.obstacles[0]


def arrays(solid):
    return np.array(solid.vertices), np.array(solid.triangles)
