#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""figures.py DIR: the pages' figures as SVG.  What they show is computed, in the
plane: contact spaces as convolutions, Phong projections as roots of the quadratic
that the cubic becomes there, corridors from closest points.  The colours are
readable on light and on dark."""
import pathlib
import sys

import numpy as np

EUCLID, PHONG, OBSTACLE, FREE, TEXT = (
    "#2f7fd0", "#e0662a", "#8a94a0", "#1f9e77", "#76808c")


class Drawing:
    """Shapes of a plane whose y points up, `scale` pixels a unit."""

    def __init__(self, width, height, scale=60.0):
        self.size = (width, height)
        self.scale = scale
        self.parts = []

    def at(self, p):
        return (self.scale * p[0], self.scale * (self.size[1] - p[1]))

    def _points(self, points):
        return " ".join("{:.1f},{:.1f}".format(*self.at(p)) for p in points)

    def area(self, points, fill="none", stroke="none", width=1.5, opacity=0.25,
             dash=""):
        self.parts.append(
            f'<polygon points="{self._points(points)}" fill="{fill}" '
            f'fill-opacity="{opacity}" stroke="{stroke}" stroke-width="{width}" '
            f'stroke-dasharray="{dash}"/>')

    def line(self, points, stroke, width=1.5, dash=""):
        self.parts.append(
            f'<polyline points="{self._points(points)}" fill="none" '
            f'stroke="{stroke}" stroke-width="{width}" stroke-linecap="round" '
            f'stroke-dasharray="{dash}"/>')

    def arrow(self, a, b, stroke, width=1.8):
        a, b = np.array(a, float), np.array(b, float)
        along = (b - a) / max(1e-9, np.linalg.norm(b - a))
        across = np.array([-along[1], along[0]])
        head = 8.0 / self.scale
        self.line([a, b - 0.7 * head * along], stroke, width)
        self.area([b, b - head * along + 0.4 * head * across,
                   b - head * along - 0.4 * head * across], stroke, opacity=1)

    def dot(self, p, fill, radius=4.0):
        x, y = self.at(p)
        self.parts.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{fill}"/>')

    def circle(self, p, radius, stroke, dash=""):
        x, y = self.at(p)
        self.parts.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius * self.scale:.1f}" '
            f'fill="none" stroke="{stroke}" stroke-width="1.5" '
            f'stroke-dasharray="{dash}"/>')

    def text(self, p, words, fill=TEXT, anchor="start", size=15):
        x, y = self.at(p)
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" fill="{fill}" '
            f'text-anchor="{anchor}" font-size="{size}" '
            f'font-family="system-ui, sans-serif">{words}</text>')

    def svg(self):
        w, h = (self.scale * s for s in self.size)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{w:.0f}" '
                f'height="{h:.0f}" viewBox="0 0 {w:.0f} {h:.0f}">\n'
                + "\n".join(self.parts) + "\n</svg>\n")


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def polygon(*points):
    return np.array(points, float)


def edges(shape):
    return [(shape[i], shape[(i + 1) % len(shape)]) for i in range(len(shape))]


def normal(a, b):
    d = b - a
    return np.array([d[1], -d[0]]) / np.linalg.norm(d)


# --- Contact space -----------------------------------------------------------

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


L_SHAPE = polygon((3.2, 0.9), (6.4, 0.9), (6.4, 1.8), (4.1, 1.8), (4.1, 3.6),
                  (3.2, 3.6))
# Its slot is too narrow for the robot.
U_SHAPE = polygon((2.4, 0.9), (6.2, 0.9), (6.2, 3.4), (4.5, 3.4), (4.5, 2.0),
                  (3.8, 2.0), (3.8, 3.4), (2.4, 3.4))
ROBOT = polygon((-0.35, -0.3), (0.45, -0.3), (-0.1, 0.5))


def contact_space():
    d = Drawing(8.6, 4.9)
    pieces = contact_pieces(L_SHAPE, ROBOT)
    d.area(L_SHAPE, OBSTACLE, opacity=0.5)
    for a, b, is_free in pieces:
        if is_free:
            d.line([a, b], EUCLID, 2.5)
    on = next((a + 0.4 * (b - a)) for a, b, f in pieces
              if f and abs(normal(a, b)[0] + 1) < 1e-9)
    for q, name, where in ((on, "touches", (-0.55, 0.6)),
                           (np.array([4.6, 1.7]), "overlaps", (0.55, 0.45)),
                           (np.array([5.9, 3.4]), "apart", (0.55, 0.2))):
        d.area(ROBOT + q, PHONG, PHONG, opacity=0.35)
        d.dot(q, PHONG)
        d.text(q + where, name, PHONG,
               "end" if where[0] < 0 else "start")
    d.text((5.9, 1.2), "B", TEXT)
    d.text((6.95, 0.55), "C_cont", EUCLID)
    d.text((0.15, 4.6), "dot: the configuration q of the robot A", TEXT)
    return d


def motion_check():
    d = Drawing(8.6, 4.9)
    d.area(U_SHAPE, OBSTACLE, opacity=0.35)
    for a, b, is_free in contact_pieces(U_SHAPE, ROBOT):
        d.line([a, b], EUCLID, 2.6 if is_free else 1.2, "" if is_free else "4 3")
    start, end = np.array([7.9, 3.5]), np.array([3.6, 2.0])
    hits = []
    for a, b in convolution(U_SHAPE, -ROBOT):
        if segments_meet(start, end, a, b):
            hits.append(cross(a - start, b - a) / cross(end - start, b - a))
    first = start + min(hits) * (end - start)
    d.line([start, first], FREE, 2.5)
    d.line([first, end], TEXT, 1.2, "3 4")
    for t in sorted(hits)[1:]:
        d.dot(start + t * (end - start), TEXT, 3)
    d.dot(start, FREE)
    d.dot(first, PHONG, 5)
    d.text(start + (-0.3, 0.2), "a, free", FREE)
    d.text(first + (0.3, -0.35), "first hit", PHONG)
    d.text((0.15, 4.6), "thick: C_cont; dashed: the rest of the convolution, "
           "inside C_obj", TEXT)
    return d


# --- Phong -------------------------------------------------------------------

class Field:
    """A polygon's boundary, cut finely, with normals diffused over it."""

    def __init__(self, shape, ell, steps=60):
        points = []
        for a, b in edges(shape):
            for k in range(steps):
                points.append(a + (k / steps) * (b - a))
        self.p = np.array(points)
        n = len(points)
        length = np.linalg.norm(np.roll(self.p, -1, 0) - self.p, axis=1)
        facet = np.array([normal(self.p[i], self.p[(i + 1) % n])
                          for i in range(n)])
        mass = 0.5 * (length + np.roll(length, 1))
        mean = 0.5 * (length[:, None] * facet
                      + np.roll(length[:, None] * facet, 1, 0))
        matrix = np.diag(mass)
        for i in range(n):
            j = (i + 1) % n
            w = ell * ell / length[i]
            matrix[i, i] += w
            matrix[j, j] += w
            matrix[i, j] -= w
            matrix[j, i] -= w
        found = np.linalg.solve(matrix, mean)
        self.n = found / np.linalg.norm(found, axis=1)[:, None]

    def projections(self, q):
        """(place along the boundary, point, depth) of all, from inside."""
        p, n = self.p, self.n
        e, d = np.roll(p, -1, 0) - p, np.roll(n, -1, 0) - n
        x = q - p
        c0, c1, c2 = cross(x, n), cross(x, d) - cross(e, n), -cross(e, d)
        found = []
        for i in range(len(p)):
            roots = (np.roots([c2[i], c1[i], c0[i]]) if abs(c2[i]) > 1e-14
                     else np.array([-c0[i] / c1[i]]))
            for t in roots:
                if abs(t.imag) > 1e-12 or not 0 <= t.real < 1:
                    continue
                t = t.real
                on, up = p[i] + t * e[i], n[i] + t * d[i]
                s = np.dot(q - on, up) / np.dot(up, up)
                if s < 0:
                    found.append((i + t, on, -s * np.linalg.norm(up)))
        return found

    def follow(self, path):
        """One branch from the least depth on, as far as it goes."""
        branch = [min(self.projections(path[0]), key=lambda r: r[2])]
        for q in path[1:]:
            near = min(self.projections(q), default=None,
                       key=lambda r: np.linalg.norm(r[1] - branch[-1][1]))
            if near is None or np.linalg.norm(near[1] - branch[-1][1]) > 0.25:
                break
            branch.append(near)
        return branch


def nearest(q, shape):
    best = None
    for a, b in edges(shape):
        t = np.clip(np.dot(q - a, b - a) / np.dot(b - a, b - a), 0, 1)
        p = a + t * (b - a)
        if best is None or np.linalg.norm(p - q) < np.linalg.norm(best - q):
            best = p
    return best


BAR = polygon((0, 0), (4.2, 0), (4.2, 2.4), (0, 2.4))
BAR_LENGTH = float(np.linalg.norm([4.2, 2.4]))


def phong():
    d = Drawing(10.6, 3.9)
    path = [np.array([0.5, 0.12 + 2.16 * t])
            for t in np.linspace(0, 1, 121)]
    field = Field(BAR, 0.2 * BAR_LENGTH)
    branch = field.follow(path)
    for offset, name, colour in ((0.4, "Euclidean: the nearest point jumps",
                                  EUCLID),
                                 (5.9, "PhongPD, ℓ = 0.2: it turns", PHONG)):
        move = np.array([offset, 0.9])
        d.area(BAR + move, OBSTACLE, OBSTACLE, opacity=0.15)
        for corner in ((0, 0), (0, 2.4)):
            d.line([np.array(corner) + move, np.array([1.2, 1.2]) + move,
                    np.array([3.0, 1.2]) + move], TEXT, 1, "3 4")
        d.line([path[0] + move, path[-1] + move], TEXT, 1.2)
        for i in range(0, len(branch), 8):
            to = nearest(path[i], BAR) if colour == EUCLID else branch[i][1]
            d.dot(path[i] + move, TEXT, 2.5)
            d.arrow(path[i] + move, to + move, colour)
        d.text(np.array([0, -0.42]) + move, name, colour)
    d.text((0.4 + 2.6, 0.9 + 1.28), "medial axis", TEXT, size=13)
    return d


def branch():
    d = Drawing(10.6, 4.3)
    move = np.array([0.5, 1.2])
    d.area(BAR + move, OBSTACLE, OBSTACLE, opacity=0.15)
    field = Field(BAR, 0.2 * BAR_LENGTH)
    path = [np.array([x, 0.9]) for x in np.linspace(0.02, 3.5, 349)]
    along = field.follow(path)
    d.arrow(path[0] + move, path[-1] + move, TEXT)
    d.text(np.array([2.0, 1.1]) + move, "q moves", TEXT)
    for i in range(0, len(along), 18):
        d.line([path[i] + move, along[i][1] + move], PHONG, 1.2)
    # Depths over height: all projections, the branch, the Euclidean.
    origin, span, tall = np.array([5.8, 0.8]), 4.4, 1.25
    place = lambda i, depth: origin + (span * i / len(path), tall * depth)
    d.line([origin + (0, 3.0), origin, origin + (span, 0)], TEXT, 1.2)
    for i, q in enumerate(path):
        for _, _, depth in field.projections(q):
            if depth < 2.6:
                d.dot(place(i, depth), OBSTACLE, 1.3)
    d.line([place(i, np.linalg.norm(nearest(q, BAR) - q))
            for i, q in enumerate(path)], EUCLID, 2, "6 4")
    d.line([place(i, r[2]) for i, r in enumerate(along)], PHONG, 3)
    end = place(len(along) - 1, along[-1][2])
    if len(along) < len(path):
        d.dot(end, PHONG, 5)
        d.text(end + (-0.12, 0.45), "fold:", PHONG, "end", 13)
        d.text(end + (-0.12, 0.2), "branch_ended", PHONG, "end", 13)
    d.text(origin + (0, 3.1), "depth", TEXT)
    d.text(origin + (span, -0.28), "way of q", TEXT, "end")
    d.text(origin + (1.9, 0.35), "Euclidean", EUCLID)
    d.text(origin + (1.0, 0.75), "one branch", PHONG)
    d.text((0.5, 0.55), "grey: every Phong projection of q", TEXT)
    return d


def smoothing():
    d = Drawing(12.2, 3.3, 52.0)
    small = 0.62 * BAR
    for k, ell in enumerate((0.0, 0.05, 0.2)):
        move = np.array([0.75 + 4.0 * k, 1.0])
        d.area(small + move, OBSTACLE, OBSTACLE, opacity=0.2)
        field = Field(BAR, ell * BAR_LENGTH)
        for i in range(0, len(field.p), 6):
            a = 0.62 * field.p[i] + move
            d.line([a, a + 0.38 * field.n[i]], PHONG, 1.4)
        d.text(move + (1.3, -0.75), f"ℓ = {ell:g}", PHONG, "middle")
    return d


# --- Windows -----------------------------------------------------------------

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


def window():
    d = Drawing(11.2, 4.9)
    pieces = contact_pieces(L_SHAPE, ROBOT)
    free = [(a, b) for a, b, is_free in pieces if is_free]
    for a, b in free:
        d.line([a, b], OBSTACLE, 1.5, "2 5")
    q = np.array([4.55, 1.5])
    candidates = [(np.linalg.norm(c - q), c)
                  for c in (nearest(q, np.array([a, b])) for a, b in free)]
    depth, contact = min(candidates, key=lambda c: c[0])
    for half, dash in ((0.55, "4 4"), (1.15, "")):
        low, high = q - half, q + half
        d.area([low, (high[0], low[1]), high, (low[0], high[1])], EUCLID, TEXT,
               1.5, 0.06, dash)
        for a, b in free:
            part = clip_segment(a, b, low, high)
            if part:
                d.line(part, EUCLID, 2.8)
    d.circle(q, depth, PHONG)
    d.arrow(q, contact, PHONG, 2.2)
    d.dot(q, PHONG)
    d.text(q + (0.1, -0.25), "q", PHONG)
    d.text((7.0, 3.0), "second window: it holds a point", TEXT)
    d.text((7.0, 2.7), "of C_cont that is nearer", TEXT)
    d.text((7.0, 2.4), "than its walls: certified", TEXT)
    d.text((0.15, 4.6), "dotted: what of C_cont is never built", TEXT)
    return d


# --- Corridors and cells -----------------------------------------------------

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


def corridor():
    d = Drawing(8.6, 4.4)
    blocks = [polygon((1.6, 0.3), (3.4, 0.3), (3.4, 1.9), (1.6, 1.5)),
              polygon((4.6, 2.3), (6.4, 2.0), (6.6, 4.1), (4.6, 4.1))]
    path = [np.array(p, float) for p in ((0.6, 0.9), (2.4, 2.5), (5.2, 1.2),
                                         (7.9, 2.2))]
    box = polygon((0.2, 0.2), (8.4, 0.2), (8.4, 4.2), (0.2, 4.2))
    for a, b in zip(path, path[1:]):
        cell = box
        for block in blocks:
            on, of = closest_pair(a, b, block)
            n = (of - on) / np.linalg.norm(of - on)
            cell = clip(cell, n, np.dot(n, of))
        d.area(cell, FREE, FREE, 1.2, 0.13)
    for block in blocks:
        d.area(block, OBSTACLE, EUCLID, 2.2, 0.4)
    d.line(path, PHONG, 2.5)
    for p in path:
        d.dot(p, PHONG)
    d.text(blocks[0].mean(0) + (0, -0.1), "C_obj", TEXT, "middle")
    d.text(blocks[1].mean(0), "C_obj", TEXT, "middle")
    return d


def cells():
    d = Drawing(8.6, 4.2)
    ring = polygon((2.2, 0.5), (6.6, 0.5), (6.6, 3.7), (2.2, 3.7))
    hole = polygon((3.2, 1.3), (5.5, 1.3), (5.5, 2.9), (3.2, 2.9))
    d.parts.append(
        f'<path d="M{d._points(ring)}Z M{d._points(hole[::-1])}Z" '
        f'fill="{OBSTACLE}" fill-opacity="0.4" stroke="{EUCLID}" '
        'stroke-width="2.2" fill-rule="evenodd"/>')
    start, goal = np.array([1.0, 2.6]), np.array([4.2, 2.1])
    for p, to in ((start, (8.3, 2.6)), (goal, (8.3, 2.1))):
        d.arrow(p, to, TEXT, 1.2)
        d.dot(p, PHONG)
    for x, y in ((2.2, 2.6), (3.2, 2.6), (5.5, 2.6), (6.6, 2.6), (5.5, 2.1),
                 (6.6, 2.1)):
        d.dot((x, y), EUCLID, 3.5)
    d.text(start + (-0.1, 0.2), "start", PHONG)
    d.text(goal + (-0.1, -0.35), "goal", PHONG)
    d.text((2.3, 0.15), "outer shell", EUCLID)
    d.text((4.35, 1.4), "cavity", EUCLID, "middle")
    return d


FIGURES = (contact_space, motion_check, phong, branch, smoothing, window,
           corridor, cells)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for draw in FIGURES:
        (folder / f"{draw.__name__}.svg").write_text(draw().svg(), "utf-8")


if __name__ == "__main__":
    main()
