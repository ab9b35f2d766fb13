# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges of motions that turn, asked from Python: phongpd.RigidJudge, hpp-core's and
ipctk's, each made of a phongpd.RigidWorld.  Poses are x, y, z and w, x, y, z of the
orientation.

hpp-core: a free-flying body among fixed ones, whose straight paths are our motions;
its continuous validations allow a penetration up to a tolerance.  ipctk: its nonlinear
continuous collision of points and triangles, edges and edges, among the candidates of
its own broad phase, until the first that collides."""
import math
import tempfile
from pathlib import Path

import numpy as np
import phongpd


def joined(meshes):
    """Their vertices and triangles as one."""
    first = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (np.concatenate([v for v, _ in meshes]),
            np.concatenate([t + k for k, (_, t) in zip(first, meshes)]))


def matrix(q):
    """Of w, x, y, z."""
    w, a, b, c = q
    return np.array([
        [1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w)],
        [2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w)],
        [2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b)]])


class Ours:
    """phongpd.RigidJudge."""

    def __init__(self, world):
        self._judge = phongpd.RigidJudge(world.robot, world.obstacles)

    def is_free(self, start, end):
        return self._judge.check(self._pose(start), self._pose(end)).free

    @staticmethod
    def _pose(row):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = matrix(row[3:]), row[:3]
        return pose


class Hpp:
    """A continuous path validation of hpp-core."""

    def __init__(self, world, kind, tolerance):
        import pinocchio
        from pyhpp import core
        from pyhpp.pinocchio import Device, urdf
        robot = Device("robot")
        with tempfile.TemporaryDirectory() as folder:
            for name, root, meshes in (("part", "freeflyer", world.robot),
                                       ("wall", "anchor", world.obstacles)):
                file = Path(folder) / f"{name}.obj"
                self._write(file, *joined(meshes))
                urdf.loadModelFromString(robot, 0, name, root,
                                         self._urdf(name, file),
                                         f"<robot name='{name}'/>",
                                         pinocchio.SE3.Identity())
        # Files are read as floats of 32 bits: these are the meshes as judged.
        objects = robot.geomModel().geometryObjects
        objects[0].geometry = self._mesh(*joined(world.robot))
        objects[1].geometry = self._mesh(*joined(world.obstacles))
        robot.setJointBounds("part/root_joint", [
            *np.asarray(world.bounds).T.ravel().tolist(), *[-1.01, 1.01] * 4])
        self._keep = robot, core.Problem(robot)
        self._steer = core.Straight(self._keep[1])
        self._validation = getattr(core, kind)(robot, tolerance)

    def is_free(self, start, end):
        path = self._steer(self._configuration(start), self._configuration(end))
        return self._validation.validate(path, False)[0]

    @staticmethod
    def _configuration(row):
        return np.array([*row[:3], *row[4:], row[3]])

    @staticmethod
    def _write(file, vertices, triangles):
        file.write_text("".join(
            [f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()]
            + [f"f {a} {b} {c}\n" for a, b, c in (triangles + 1).tolist()]))

    @staticmethod
    def _urdf(name, file):
        return (f'<robot name="{name}"><link name="body"><inertial><mass value="1"/>'
                '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
                f'<collision><geometry><mesh filename="file://{file}"/></geometry>'
                '</collision></link></robot>')

    @staticmethod
    def _mesh(vertices, triangles):
        import coal
        mesh = coal.BVHModelOBBRSS()
        mesh.beginModel(len(triangles), len(vertices))
        mesh.addVertices(np.ascontiguousarray(vertices))
        mesh.addTriangles(np.ascontiguousarray(triangles).astype(np.int64))
        mesh.endModel()
        return mesh


class Turn:
    """A motion as functions of t in [0, 1], point by point."""

    def __init__(self, start, end):
        a, b = np.array(start), np.array(end)
        self.q, self.way, self._first = a[:3], b[:3] - a[:3], matrix(a[3:])
        w = a[3:] @ b[3:]
        axis = a[3] * b[4:] - b[3] * a[4:] - np.cross(b[4:], a[4:])
        if w < 0:
            w, axis = -w, -axis
        length = np.linalg.norm(axis)
        self.angle = 2 * math.atan2(length, w)
        self._axis = axis / length if length > 0 else np.array([0.0, 0.0, 1.0])

    def parts(self, point):
        """Along the axis, and the two that turn about it."""
        p = self._first @ point
        along = (p @ self._axis) * self._axis
        return along, p - along, np.cross(self._axis, p)


def trajectory_classes(ipctk):
    class Still(ipctk.NonlinearTrajectory):
        def __init__(self, point):
            super().__init__()
            self._point = point

        def __call__(self, t):
            return self._point

        def max_distance_from_linear(self, begin, end):
            return 0.0

    class Turning(ipctk.NonlinearTrajectory):
        def __init__(self, turn, point):
            super().__init__()
            self._turn = turn
            self._along, self._x, self._y = turn.parts(point)
            self._radius = float(np.linalg.norm(self._x))

        def __call__(self, t):
            turn, angle = self._turn, self._turn.angle * t
            return (turn.q + t * turn.way + self._along
                    + math.cos(angle) * self._x + math.sin(angle) * self._y)

        def max_distance_from_linear(self, begin, end):
            """|f - chord| ≤ (end - begin)² max |f''| / 8."""
            return self._radius * (self._turn.angle * (end - begin)) ** 2 / 8
    return Still, Turning


class Ipctk:
    """rescaling: a pair that comes nearer than 1 - rescaling of its distance at the
    start is called colliding."""

    def __init__(self, world, rescaling):
        import ipctk
        ipctk.set_num_threads(1)
        self._ipctk = ipctk
        self._ccd = ipctk.NonlinearCCD(conservative_rescaling=rescaling)
        self._still, self._turning = trajectory_classes(ipctk)
        (self._robot, robot), (obstacles, fixed) = map(
            joined, (world.robot, world.obstacles))
        faces = np.concatenate([robot, fixed + len(self._robot)]).astype(np.int32)
        self._mesh = ipctk.CollisionMesh(np.concatenate([self._robot, obstacles]),
                                         ipctk.edges(faces), faces)
        self._fixed = [self._still(p) for p in obstacles]

    def is_free(self, start, end):
        turn = Turn(start, end)
        moving = [self._turning(turn, p) for p in self._robot]
        points = moving + self._fixed
        near = self._ipctk.Candidates()
        near.build(self._mesh, *(np.array([p(t) for p in points]) for t in (0., 1.)),
                   max(p.max_distance_from_linear(0.0, 1.0) for p in moving))
        return not (
            any(self._hits(self._ccd.point_triangle_ccd, points, pair.vertex_id,
                           *self._mesh.faces[pair.face_id])
                for pair in near.fv_candidates)
            or any(self._hits(self._ccd.edge_edge_ccd, points,
                              *self._mesh.edges[pair.edge0_id],
                              *self._mesh.edges[pair.edge1_id])
                   for pair in near.ee_candidates))

    def _hits(self, ccd, points, *ids):
        # Its filter of pairs, in Python, waits for itself: this is ours.
        ours = [i < len(self._robot) for i in (ids[0], ids[-1])]
        return ours[0] != ours[1] and ccd(*(points[i] for i in ids))[0]


METHODS = {
    "PhongPD": Ours,
    "hpp-core Dichotomy": lambda world: Hpp(world, "Dichotomy", 0.0),
    "hpp-core Progressive, 0.001": lambda world: Hpp(world, "Progressive", 0.001),
    "ipctk, 0.8": lambda world: Ipctk(world, 0.8),
    "ipctk, 0.999": lambda world: Ipctk(world, 0.999)}
