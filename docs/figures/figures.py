#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""figures.py DIR: the pages' figures as SVG.  What they show is computed, in the
plane: contact spaces as convolutions, Phong projections as roots of the quadratic
that the cubic becomes there, corridors from closest points."""
import pathlib
import sys

import numpy as np

from drawing import CONTACT, EUCLID, FREE, MOVES, OBSTACLE, PHONG, TEXT, Drawing
from phong_field import Field
from plane import (clip, clip_segment, closest_pair, contact_pieces, convolution,
                   cross, nearest, normal, polygon, segments_meet)

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
            d.line([a, b], CONTACT, 2.5)
    on = next((a + 0.4 * (b - a)) for a, b, f in pieces
              if f and abs(normal(a, b)[0] + 1) < 1e-9)
    for q, name, where in ((on, "touches", (-0.55, 0.6)),
                           (np.array([4.6, 1.7]), "overlaps", (0.55, 0.45)),
                           (np.array([5.9, 3.4]), "apart", (0.55, 0.2))):
        d.area(ROBOT + q, MOVES, MOVES, opacity=0.35)
        d.dot(q, MOVES)
        d.text(q + where, name, MOVES,
               "end" if where[0] < 0 else "start")
    d.text((5.9, 1.2), "B", TEXT)
    d.text((6.95, 0.55), "C_cont", CONTACT)
    d.text((0.15, 4.6), "dot: the configuration q of the robot A", TEXT)
    return d


def motion_check():
    d = Drawing(8.6, 4.9)
    d.area(U_SHAPE, OBSTACLE, opacity=0.35)
    for a, b, is_free in contact_pieces(U_SHAPE, ROBOT):
        d.line([a, b], CONTACT, 2.6 if is_free else 1.2, "" if is_free else "4 3")
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
    d.dot(first, MOVES, 5)
    d.text(start + (-0.3, 0.2), "a, free", FREE)
    d.text(first + (0.3, -0.35), "first hit", MOVES)
    d.text((0.15, 4.6), "thick: C_cont; dashed: the rest of the convolution, "
           "inside C_obj", TEXT)
    return d


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
        d.area([low, (high[0], low[1]), high, (low[0], high[1])], CONTACT, TEXT,
               1.5, 0.06, dash)
        for a, b in free:
            part = clip_segment(a, b, low, high)
            if part:
                d.line(part, CONTACT, 2.8)
    d.circle(q, depth, EUCLID)
    d.arrow(q, contact, EUCLID, 2.2)
    d.dot(q, EUCLID)
    d.text(q + (0.1, -0.25), "q", EUCLID)
    d.text((7.0, 3.0), "second window: it holds a point", TEXT)
    d.text((7.0, 2.7), "of C_cont that is nearer", TEXT)
    d.text((7.0, 2.4), "than its walls: certified", TEXT)
    d.text((0.15, 4.6), "dotted: what of C_cont is never built", TEXT)
    return d


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
        d.area(block, OBSTACLE, CONTACT, 2.2, 0.4)
    d.line(path, MOVES, 2.5)
    for p in path:
        d.dot(p, MOVES)
    d.text(blocks[0].mean(0) + (0, -0.1), "C_obj", TEXT, "middle")
    d.text(blocks[1].mean(0), "C_obj", TEXT, "middle")
    return d


def cells():
    d = Drawing(8.6, 4.2)
    ring = polygon((2.2, 0.5), (6.6, 0.5), (6.6, 3.7), (2.2, 3.7))
    hole = polygon((3.2, 1.3), (5.5, 1.3), (5.5, 2.9), (3.2, 2.9))
    d.parts.append(
        f'<path d="M{d._points(ring)}Z M{d._points(hole[::-1])}Z" '
        f'fill="{OBSTACLE}" fill-opacity="0.4" stroke="{CONTACT}" '
        'stroke-width="2.2" fill-rule="evenodd"/>')
    start, goal = np.array([1.0, 2.6]), np.array([4.2, 2.1])
    for p, to in ((start, (8.3, 2.6)), (goal, (8.3, 2.1))):
        d.arrow(p, to, TEXT, 1.2)
        d.dot(p, MOVES)
    for x, y in ((2.2, 2.6), (3.2, 2.6), (5.5, 2.6), (6.6, 2.6), (5.5, 2.1),
                 (6.6, 2.1)):
        d.dot((x, y), CONTACT, 3.5)
    d.text(start + (-0.1, 0.2), "start", MOVES)
    d.text(goal + (-0.1, -0.35), "goal", MOVES)
    d.text((2.3, 0.15), "outer shell", CONTACT)
    d.text((4.35, 1.4), "cavity", CONTACT, "middle")
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
