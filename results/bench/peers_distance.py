# SPDX-License-Identifier: GPL-3.0-or-later
"""Signed distance to a closed mesh, queries a second: PhongPD's metrics beside
trimesh and Open3D."""

import time

import numpy as np
import phongpd
from peers_shapes import arrays, of_scene
from python_report import told

HEADER = ["mesh", "triangles", "by", "points", "CPU us a query", "ratio to PhongPD",
          "worst error / diagonal", "wrong signs"]
POINTS, SLOW_POINTS, CHECKED = 100_000, 300, 300


def brute_force(vertices, triangles, points):
    """Unsigned distances to all triangles, in NumPy (Ericson's regions), and
    the sign by the winding number."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    distance, winding = [], []
    for q in points:
        distance.append(np.sqrt(min(
            _to_segments(q, a, b).min(), _to_segments(q, b, c).min(),
            _to_segments(q, c, a).min(), _to_planes(q, a, b, c).min())))
        u, v, w = a - q, b - q, c - q
        lu, lv, lw = (np.linalg.norm(x, axis=1) for x in (u, v, w))
        above = np.einsum("ij,ij->i", u, np.cross(v, w))
        below = (lu * lv * lw + np.einsum("ij,ij->i", u, v) * lw
                 + np.einsum("ij,ij->i", v, w) * lu
                 + np.einsum("ij,ij->i", w, u) * lv)
        winding.append(np.arctan2(above, below).sum() / (2 * np.pi))
    return np.where(np.array(winding) > 0.5, -1, 1) * np.array(distance)


def _to_segments(q, a, b):
    d = b - a
    t = np.clip(np.einsum("ij,ij->i", q - a, d) / (d * d).sum(axis=1), 0, 1)
    return ((a + t[:, None] * d - q) ** 2).sum(axis=1)


def _to_planes(q, a, b, c):
    """To triangles above whose inside q lies; infinite for the others."""
    n = np.cross(b - a, c - a)
    size = (n * n).sum(axis=1)
    inside = np.ones(len(a), dtype=bool)
    for p, r in ((a, b), (b, c), (c, a)):
        inside &= np.einsum("ij,ij->i", np.cross(r - p, q - p), n) >= 0
    height = np.einsum("ij,ij->i", q - a, n)
    return np.where(inside, height ** 2 / size, np.inf)


def _phong(vertices, triangles):
    space = phongpd.ContactSpace.take(phongpd.Solid(vertices, triangles))
    metric = phongpd.PhongMetric(space)
    return lambda points: metric.query(points).signed_distance


def _euclid(vertices, triangles):
    space = phongpd.ContactSpace.take(phongpd.Solid(vertices, triangles))
    metric = phongpd.EuclideanMetric(space)
    return lambda points: metric.query(points).signed_distance


def _open3d(vertices, triangles):
    import open3d
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(vertices.astype(np.float32),
                        triangles.astype(np.uint32))
    return lambda points: scene.compute_signed_distance(
        points.astype(np.float32)).numpy()


def _trimesh(vertices, triangles):
    import trimesh
    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    query = trimesh.proximity.ProximityQuery(mesh)
    return lambda points: -query.signed_distance(points)


WAYS = [("PhongPD, Euclidean", _euclid, POINTS),
        ("PhongPD, Phong (not the distance)", _phong, POINTS // 20),
        ("open3d (single precision)", _open3d, POINTS),
        ("trimesh", _trimesh, SLOW_POINTS)]


def run(seed):
    """Rows of HEADER, and what failed."""
    rows, failures = [], []
    robot, wrench = of_scene("ball_wrench")
    for name, mesh in (("wrench", wrench), (
            "its contact space", phongpd.ContactSpace.build(robot, wrench))):
        vertices, triangles = arrays(mesh)
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        margin = 0.1 * (high - low)
        points = np.random.default_rng(seed).uniform(
            low - margin, high + margin, (POINTS, 3))
        truth = brute_force(vertices, triangles, points[:CHECKED])
        base = None
        for by, make, count in WAYS:
            try:
                ask = make(vertices, triangles)
                ask(points[:10])  # what is made on first use
                times = []
                for _ in range(3):
                    begin = time.process_time()
                    found = ask(points[:count])
                    times.append(time.process_time() - begin)
            except Exception as error:
                failures.append(f"{by}: {told(error)}")
                continue
            micros = 1e6 * sorted(times)[1] / count
            base = base or micros
            error = np.abs(np.abs(found[:CHECKED]) - np.abs(truth)).max()
            wrong = int((np.sign(found[:CHECKED]) != np.sign(truth)).sum())
            rows.append((name, len(triangles), by, count, micros, micros / base,
                         float(error / np.linalg.norm(high - low)), wrong))
    return rows, failures
