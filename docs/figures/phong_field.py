# SPDX-License-Identifier: GPL-3.0-or-later
"""Phong projections in the plane, where the cubic becomes a quadratic."""
import numpy as np

from plane import cross, edges, normal


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
