# SPDX-License-Identifier: GPL-3.0-or-later
"""What collision libraries answer for the depth of two bodies, beside the exact
depth: coal, python-fcl and MuJoCo."""

import statistics
import time

import numpy as np
import phongpd
from peers_shapes import L, U, arrays, of_scene, solid_of, turned
from python_report import told

POSES = 100
HEADER = ["pair", "by", "found overlapping, %", "answer / exact, median",
          "within 1 % of exact, %", "free after moving by it, %",
          "CPU us a query, median", "ratio to PhongPD"]


class Coal:
    """coal: all contacts of two BVHs, the deepest one; or two convex hulls."""

    def __init__(self, a, b, is_convex):
        import coal
        self._coal = coal
        self._a, self._b = (self._shape(s, is_convex) for s in (a, b))
        self._request = coal.CollisionRequest()
        self._request.enable_contact = True
        self._request.num_max_contacts = 100000
        self._there = coal.Transform3s.Identity()

    def _shape(self, solid, is_convex):
        model = self._coal.BVHModelOBBRSS()
        vertices, triangles = arrays(solid)
        model.beginModel(len(triangles), len(vertices))
        model.addVertices(vertices)
        for t in triangles:
            model.addTriangle(*(vertices[i] for i in t))
        model.endModel()
        if not is_convex:
            return model
        model.buildConvexHull(True, "Qt")
        return model.convex

    def depth(self, q):
        coal = self._coal
        result = coal.CollisionResult()
        here = coal.Transform3s(np.eye(3), q)
        coal.collide(self._a, here, self._b, self._there, self._request, result)
        contacts = [result.getContact(i) for i in range(result.numContacts())]
        if not contacts:
            return 0.0, None
        # Version 3 has signed distances: negative in penetration.
        deepest = max(contacts, key=lambda c: abs(c.penetration_depth))
        return abs(deepest.penetration_depth), np.array(deepest.normal)


class Fcl:
    """python-fcl, in the same way."""

    def __init__(self, a, b, is_convex):
        import fcl
        self._fcl = fcl
        self._a, self._b = (self._shape(s, is_convex) for s in (a, b))
        self._request = fcl.CollisionRequest(num_max_contacts=100000,
                                             enable_contact=True)
        self._there = fcl.CollisionObject(self._b, fcl.Transform())

    def _shape(self, solid, is_convex):
        vertices, triangles = arrays(solid)
        if is_convex:
            faces = np.column_stack([np.full(len(triangles), 3), triangles])
            return self._fcl.Convex(vertices, len(triangles), faces.ravel())
        model = self._fcl.BVHModel()
        model.beginModel(len(vertices), len(triangles))
        model.addSubModel(vertices, triangles)
        model.endModel()
        return model

    def depth(self, q):
        fcl = self._fcl
        here = fcl.CollisionObject(self._a, fcl.Transform(np.array(q)))
        result = fcl.CollisionResult()
        fcl.collide(here, self._there, self._request, result)
        if not result.contacts:
            return 0.0, None
        deepest = max(result.contacts, key=lambda c: abs(c.penetration_depth))
        return abs(deepest.penetration_depth), np.array(deepest.normal)


class Mujoco:
    """MuJoCo, which takes every mesh for its convex hull; tolerance 1e-9."""

    XML = """<mujoco><option ccd_tolerance="1e-9" ccd_iterations="200"/>
      <asset><mesh name="a" vertex="{a}" face="{fa}"/>
             <mesh name="b" vertex="{b}" face="{fb}"/></asset>
      <worldbody><geom type="mesh" mesh="b" margin="0"/>
        <body><freejoint/><geom type="mesh" mesh="a"/></body></worldbody>
      </mujoco>"""

    def __init__(self, a, b, is_convex):
        del is_convex
        import mujoco
        self._mujoco = mujoco
        text = {}
        for name, solid in (("a", a), ("b", b)):
            vertices, triangles = arrays(solid)
            text[name] = " ".join(map(repr, vertices.ravel().tolist()))
            text["f" + name] = " ".join(map(str, triangles.ravel().tolist()))
        self._model = mujoco.MjModel.from_xml_string(self.XML.format(**text))
        self._data = mujoco.MjData(self._model)

    def depth(self, q):
        self._data.qpos[:] = [*q, 1, 0, 0, 0]
        self._mujoco.mj_kinematics(self._model, self._data)
        self._mujoco.mj_comPos(self._model, self._data)
        self._mujoco.mj_collision(self._model, self._data)
        contacts = [self._data.contact[i] for i in range(self._data.ncon)]
        if not contacts:
            return 0.0, None
        deepest = min(contacts, key=lambda c: c.dist)
        return -float(deepest.dist), np.array(deepest.frame[:3])


def cases():
    yield "ball + cone (convex)", *of_scene("ball_cone"), True
    yield "cone + axes", *of_scene("cone_axes"), False
    yield "ball + wrench", *of_scene("ball_wrench"), False
    yield ("turned L + U", turned(solid_of(L, "L"), 1), solid_of(U, "U"), False)


def overlapping_poses(robot, obstacle, seed):
    """Random ones, and their exact depth."""
    space = phongpd.ContactSpace.build(robot, obstacle)
    random = np.random.default_rng(seed)
    low, high = space.vertices.min(axis=0), space.vertices.max(axis=0)
    points = random.uniform(low, high, (100 * POSES, 3))
    answer = phongpd.EuclideanMetric(space).query(points)
    chosen = np.flatnonzero(answer.inside)[:POSES]
    return points[chosen], -answer.signed_distance[chosen]


def _row(pair, by, ask, poses, exact, judge, base):
    answers, micros = [], []
    for q in poses:
        begin = time.process_time()
        answers.append(ask(q))
        micros.append(1e6 * (time.process_time() - begin))
    found = [(d, n, e, q) for (d, n), e, q in zip(answers, exact, poses)
             if n is not None]
    ratios = [d / e for d, _, e, _ in found]
    # Whichever way the library's normal is meant to point.
    freed = max(sum(judge.at(q + s * d * (1 + 1e-6) * n).status != "penetrating"
                    for d, n, _, q in found) for s in (1, -1))
    share = 100.0 / len(poses)
    near = sum(bool(abs(r - 1) <= 0.01) for r in ratios)
    median = statistics.median(micros)
    return (pair, by, share * len(found),
            float(statistics.median(ratios)) if ratios else "-",
            share * near, share * freed,
            median, median / base if base else 1.0)


def run(seed):
    """Rows of HEADER; PhongPD is asked as they are, pose by pose, with nothing
    built before, and once more with its contact space."""
    rows, failures = [], []
    for pair, robot, obstacle, is_convex in cases():
        poses, exact = overlapping_poses(robot, obstacle, seed)
        query = phongpd.DepthQuery(robot, obstacle)
        metric = phongpd.EuclideanMetric(
            phongpd.ContactSpace.build(robot, obstacle))

        def by_query(q):
            answer = query.at(q)
            return answer.depth, answer.direction

        def by_space(q):
            answer = metric.query(q)
            return -answer.signed_distance[0], answer.direction[0]

        first = _row(pair, "PhongPD, DepthQuery", by_query, poses, exact, query, 0)
        rows.append(first)
        rows.append(_row(pair, "PhongPD, contact space", by_space, poses, exact,
                         query, first[-2]))
        for name, peer in (("coal", Coal), ("python-fcl", Fcl),
                           ("mujoco", Mujoco)):
            try:
                ask = peer(robot, obstacle, is_convex).depth
                rows.append(_row(pair, name, ask, poses, exact, query, first[-2]))
            except Exception as error:
                failures.append(f"{name}, {pair}: {told(error)}")
    return rows, failures
