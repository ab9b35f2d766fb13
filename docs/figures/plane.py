# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry of the plane: polygons, (n, 2), counterclockwise; and contact spaces as
convolutions."""
import numpy as np


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def polygon(*points):
    return np.array(points, float)


def edges(shape):
    return [(shape[i], shape[(i + 1) % len(shape)]) for i in range(len(shape))]


def normal(a, b):
    d = b - a
    return np.array([d[1], -d[0]]) / np.linalg.norm(d)


def nearest(q, shape):
    best = None
    for a, b in edges(shape):
        t = np.clip(np.dot(q - a, b - a) / np.dot(b - a, b - a), 0, 1)
        p = a + t * (b - a)
        if best is None or np.linalg.norm(p - q) < np.linalg.norm(best - q):
            best = p
    return best


def clip_segment(a, b, low, high):
    t0, t1 = 0.0, 1.0
    for k in (0, 1):
        step = b[k] - a[k]
        for bound, sign in ((low[k], -1), (high[k], 1)):
            room = sign * (bound - a[k])
            if abs(step) < 1e-12:
                if room < 0:
                    return None
            elif sign * step > 0:
                t1 = min(t1, room / (sign * step))
            else:
                t0 = max(t0, room / (sign * step))
    return (a + t0 * (b - a), a + t1 * (b - a)) if t0 < t1 else None


def clip(shape, n, c):
    """The part of a convex polygon with n·x ≤ c."""
    out = []
    for a, b in edges(np.array(shape)):
        fa, fb = np.dot(n, a) - c, np.dot(n, b) - c
        if fa <= 0:
            out.append(a)
        if (fa < 0) != (fb < 0):
            out.append(a + fa / (fa - fb) * (b - a))
    return np.array(out)


def closest_pair(a, b, shape):
    """Of a segment and a polygon apart from it."""
    pairs = [(p, nearest(p, shape)) for p in (a, b)]
    pairs += [(nearest(v, np.array([a, b])), v) for v in shape]
    return min(pairs, key=lambda s: np.linalg.norm(s[0] - s[1]))


def _touched(n, shape, turn):
    """Convex vertices with n between the normals of their edges; of equal ones
    one is, as if the shape were turned a little."""
    found = []
    for i, v in enumerate(shape):
        before, after = shape[i - 1], shape[(i + 1) % len(shape)]
        if cross(v - before, after - v) <= 0:
            continue
        low, high = cross(normal(before, v), n), cross(n, normal(v, after))
        if min(low, high) > 1e-12 or (
                min(low, high) > -1e-12 and (low if turn > 0 else high) > 1e-12):
            found.append(v)
    return found


def convolution(p, q):
    """The segments of the reduced convolution of two polygons."""
    parts = [(a + v, b + v) for a, b in edges(p)
             for v in _touched(normal(a, b), q, 1)]
    return parts + [(a + v, b + v) for a, b in edges(q)
                    for v in _touched(normal(a, b), p, -1)]


def inside(x, shape):
    count = 0
    for a, b in edges(shape):
        if (a[1] > x[1]) != (b[1] > x[1]):
            count += cross(b - a, x - a) * (1 if b[1] > a[1] else -1) > 0
    return count % 2 == 1


def segments_meet(a, b, c, d):
    return (cross(b - a, c - a) * cross(b - a, d - a) < 0
            and cross(d - c, a - c) * cross(d - c, b - c) < 0)


def overlap(p, q):
    return (inside(p[0], q) or inside(q[0], p)
            or any(segments_meet(a, b, c, d)
                   for a, b in edges(p) for c, d in edges(q)))


def contact_pieces(obstacle, robot):
    """The convolution cut where it crosses itself, and which pieces the robot can
    touch along without overlapping."""
    whole = convolution(obstacle, -robot)
    pieces = []
    for a, b in whole:
        cuts = [0.0, 1.0]
        for c, d in whole:
            below = cross(b - a, d - c)
            if abs(below) > 1e-12:
                t = cross(c - a, d - c) / below
                u = cross(c - a, b - a) / below
                if 0 < t < 1 and -1e-9 <= u <= 1 + 1e-9:
                    cuts.append(t)
        cuts.sort()
        for s, t in zip(cuts, cuts[1:]):
            if t - s < 1e-9:
                continue
            middle = a + 0.5 * (s + t) * (b - a)
            is_free = not overlap(
                robot + middle + 1e-6 * normal(a, b), obstacle)
            pieces.append((a + s * (b - a), a + t * (b - a), is_free))
    return pieces
