#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the certificate of a motion in time; shares nothing with PhongPD.

    phongpd optimize SCENE --limits V,A,J --output t.json
    check_trajectory.py t.json robot.off obstacle.off [obstacle.off ...]

For all t: does the robot touch no obstacle, and are the limits kept?  Nothing
is sampled or rounded: numbers are integers times a power of two.  A part of a
curve lies in the hull of its Bezier points.  It is free if some axis parts each
triangle of an obstacle from each of the robot's moved through that hull, and no
solid holds the other; else it is halved.  Meshes are closed and stand as in the
scene, whose bounds are not looked at.  Exit code 0: certified; 1: not; 2: input.
"""
import functools
import json
import random
import sys
from fractions import Fraction

MAX_HALVINGS = 48  # of a piece
MOST = 10**6  # velocity, acceleration jump at joints by 1/MOST of the limit

def read_off(path):
    """Points and triangles of a closed surface."""
    words = iter(" ".join(l.split("#")[0] for l in open(path)).split())
    head, n, m, _ = [next(words) for _ in range(4)]
    points = [tuple(float(next(words)) for _ in "xyz") for _ in range(int(n))]
    faces, edges = [], []
    for _ in range(int(m)):
        f = [int(next(words)) for _ in range(int(next(words)))]
        faces += [(f[0], f[i], f[i + 1]) for i in range(1, len(f) - 1)]
        edges += zip(f, f[1:] + f[:1])
    is_closed = faces and sorted(edges) == sorted((b, a) for a, b in edges)
    if head != "OFF" or not is_closed:
        raise ValueError(f"{path}: expected a closed surface, as OFF")
    return points, faces

def add(a, b): return a[0] + b[0], a[1] + b[1], a[2] + b[2]
def sub(a, b): return a[0] - b[0], a[1] - b[1], a[2] - b[2]
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0])
def box(points): return [(min(c), max(c)) for c in zip(*points)]
def scaled(points, bits): return [tuple(int(Fraction(x) * 2**bits) for x in p)
                                  for p in points]

def split(points):
    """Both halves, by de Casteljau, times 2^degree."""
    left, right = [], []
    for k in range(len(points) - 1, -1, -1):
        left.append(tuple(x * 2**k for x in points[0]))
        right.insert(0, tuple(x * 2**k for x in points[-1]))
        points = [add(points[i], points[i + 1]) for i in range(k)]
    return left, right

class Mesh:
    def __init__(self, points, faces, bits):
        points = scaled(points, bits)
        triangles = [[points[i] for i in f] for f in faces]
        # The points of a flat triangle belong to its neighbours.
        self.triangles = [t for t in triangles
                          if any(cross(sub(t[1], t[0]), sub(t[2], t[0])))]
        self.boxes, self.box = [box(t) for t in self.triangles], box(points)
        parts = {i: {i} for f in faces for i in f}  # of each vertex
        for f in faces:
            part = set().union(*(parts[i] for i in f))
            parts.update(dict.fromkeys(part, part))
        parts = {id(part): part for part in parts.values()}.values()
        self.seeds = [points[min(part)] for part in parts]

    def holds(self, x):
        """Is x, not on the surface, inside?  By the winding number."""
        while True:  # until the ray meets no edge
            ray = tuple(random.randint(-10**6, 10**6) for _ in range(3))
            winding, is_clear = 0, True
            for t in self.triangles:
                r = [sub(p, x) for p in t]
                sides = [dot(ray, cross(r[i - 1], r[i])) for i in range(3)]
                volume = dot(r[0], cross(r[1], r[2]))
                if all(side * volume > 0 for side in sides):
                    winding += 1 if volume > 0 else -1
                is_clear &= 0 not in sides or min(sides) < 0 < max(sides)
            if is_clear:
                return winding > 0

class Judge:
    def __init__(self, robot, obstacle):
        self.a, self.b = robot, obstacle
        self.axes = functools.lru_cache(100000)(self.find_axes)

    def slab(self, n, i, j):
        """n, and the n.q for which the projections of the pair overlap."""
        a, b = [[dot(n, p) for p in t]
                for t in (self.a.triangles[i], self.b.triangles[j])]
        return n, min(b) - max(a), max(b) - min(a)

    def find_axes(self, i, j):
        """One of them parts the pair, if it is apart at one place."""
        a, b = self.a.triangles[i], self.b.triangles[j]
        ea, eb = [[sub(t[k], t[k - 1]) for k in range(3)] for t in (a, b)]
        normals = [cross(ea[0], ea[1]), cross(eb[0], eb[1])]
        axes = normals + [cross(e, f) for e in ea for f in eb]
        axes += [cross(n, e) for n in normals for e in ea + eb]
        return [self.slab(n, i, j) for n in axes if any(n)], ea + eb

    def meet(self, pair, points, shift):
        """False: some axis parts the pair for all q of the hull."""
        slabs, edges = self.axes(*pair)
        chord = sub(points[-1], points[0])
        for k in range(len(slabs) + len(edges)):
            n, low, high = slabs[k] if k < len(slabs) else self.slab(
                cross(edges[k - len(slabs)], chord), *pair)
            at = [dot(n, p) for p in points]
            if max(at) < low << shift or min(at) > high << shift:
                return False
        return True

    def pairs(self, points):
        """Whose boxes meet while the first moves through the hull's box."""
        def near(one, other):
            return all(a[0] + h[0] <= b[1] and a[1] + h[1] >= b[0]
                       for a, h, b in zip(one, hull, other))
        hull, a, b = box(points), self.a, self.b
        return [(i, j) for j, of in enumerate(b.boxes) if near(a.box, of)
                for i, mine in enumerate(a.boxes) if near(mine, of)]

    def check(self, points, pairs, start, time, halvings=0):
        """None if free; else what, and when."""
        halves, degree = split(points), len(points) - 1
        pairs = [p for p in pairs if self.meet(p, points, degree * halvings)]
        if not pairs:
            return None
        halvings, middle = halvings + 1, start + time / 2
        if any(self.meet(p, halves[0][-1:], degree * halvings) for p in pairs):
            return "collides", middle
        if halvings > MAX_HALVINGS:
            return "undecided", middle
        return (self.check(halves[0], pairs, start, time / 2, halvings) or
                self.check(halves[1], pairs, middle, time / 2, halvings))

def keeps(points, limit, by, halvings=10):  # coordinates or norm: proved
    fits = [dot(p, p) <= limit[0]**2 if by == "norm" else
            all(abs(x) <= m for x, m in zip(p, limit)) for p in points]
    if all(fits) or halvings == 0 or not (fits[0] and fits[-1]):
        return all(fits)
    limit = [m * 2**(len(points) - 1) for m in limit]
    return all(keeps(half, limit, by, halvings - 1) for half in split(points))

def broken_limit(pieces, limits):
    before, by = {}, limits.get("by", "axis")
    for number, (points, h) in enumerate(pieces):
        points = [tuple(map(Fraction, p)) for p in points]
        for name in ("velocity", "acceleration", "jerk"):
            limit, n = list(map(Fraction, limits[name])), len(points) - 1
            points = [tuple(x * n / h for x in sub(b, a))
                      for a, b in zip(points, points[1:])] or [(0, 0, 0)]
            if not keeps(points, limit, by):
                return f"{name}, in piece {number}"
            jump = [MOST * x for x in sub(points[0], before.get(name, points[0]))]
            if name != "jerk" and not keeps([jump], limit, by):
                return f"{name} jumps where piece {number} begins"
            before[name] = points[-1]

def main(file, *paths):
    row = json.load(open(file))
    pieces = [([tuple(map(float, p)) for p in one["points"]],
               Fraction(one["duration"])) for one in row["pieces"]]
    if not pieces or any(h <= 0 for _, h in pieces) or any(
            p[-1] != q[0] for (p, _), (q, _) in zip(pieces, pieces[1:])):
        raise ValueError(f"{file}: expected pieces that take time, and join")
    meshes = [read_off(path) for path in paths]
    bits = max(Fraction(x).denominator.bit_length() - 1
               for points, _ in pieces + meshes for p in points for x in p)
    robot, first, *others = [Mesh(*mesh, bits) for mesh in meshes]
    for path, obstacle in zip(paths[1:], [first] + others):
        judge, start, found = Judge(robot, obstacle), Fraction(0), None
        for points, h in pieces:
            points = scaled(points, bits)
            found = found or judge.check(points, judge.pairs(points), start, h)
            start += h
        # While surfaces stay apart, what holds what does not change.
        if not found and (
                any(obstacle.holds(add(x, points[0])) for x in robot.seeds) or
                any(robot.holds(sub(x, points[0])) for x in obstacle.seeds)):
            found = "collides", Fraction(0)
        if found:
            print(f"{found[0]} at {float(found[1])} s: {path}")
            return 1
    broken = broken_limit(pieces, row["limits"])
    print(f"limit broken: {broken}" if broken else
          "certified: free and within the limits for all t")
    return bool(broken)

if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except Exception as error:
        print(f"check_trajectory: {error!r}\n{__doc__}", file=sys.stderr)
        sys.exit(2)
