# SPDX-License-Identifier: GPL-3.0-or-later
"""Is a motion free?  At many samples, by FCL, which shares nothing with PhongPD
but the meshes, and by the exact kernel; exactly and throughout, as what it is or
as a polyline."""
import functools

import numpy as np

try:
    import fcl
except ImportError:  # said in the report
    fcl = None

SAMPLES = 10_000  # of a curve
FINE = 2_000  # segments at whose ends a peer is looked at


def _model(vertices, triangles):
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(triangles))
    model.addSubModel(vertices, triangles)
    model.endModel()
    return model


@functools.lru_cache(1 << 6)
def _bodies(world):
    """Robot, and all obstacles as one: surfaces that meet are what is sought, a
    motion that begins outside enters none without that."""
    offset, vertices, triangles = 0, [], []
    for solid in world.obstacles:
        vertices.append(np.array(solid.vertices))
        triangles.append(np.array(solid.triangles) + offset)
        offset += len(vertices[-1])
    robot = world.robot
    return (fcl.CollisionObject(_model(np.array(robot.vertices),
                                       np.array(robot.triangles))),
            fcl.CollisionObject(_model(np.vstack(vertices),
                                       np.vstack(triangles))))


def fcl_hits(world, points):
    """Indices at which FCL has robot and obstacles touch; None without FCL."""
    if fcl is None:
        return None
    robot, obstacles = _bodies(world)
    request, found = fcl.CollisionRequest(), []
    for k, q in enumerate(points):
        robot.setTranslation(q)
        if fcl.collide(robot, obstacles, request, fcl.CollisionResult()):
            found.append(k)
    return found


def exact_hits(world, points):
    return int((~world.is_free(points)).sum())


def is_polyline_free(world, points):
    return bool(world.is_motion_free(points[:-1], points[1:]).all())


def is_place_free(world, place):
    """Of corners, or a spline as scipy has it: what is undecided is not free."""
    if isinstance(place, np.ndarray):
        return is_polyline_free(world, place)
    return world.check_curve(place).free
