# SPDX-License-Identifier: GPL-3.0-or-later
"""Minkowski sums: PhongPD beside manifold3d, its own and by its hulls."""

import multiprocessing
import time

import numpy as np
import phongpd
from peers_shapes import CUBE, L, U, arrays, of_scene, solid_of, \
    sum_of_boxes, turned, union_volume

LIMIT = 200.0  # seconds of wall time
HEADER = ["pair", "triangles", "by", "CPU s", "ratio to PhongPD", "volume error",
          "genus", "triangles of the sum"]


def _manifold(solid):
    import manifold3d
    vertices, triangles = arrays(solid)
    found = manifold3d.Manifold(manifold3d.Mesh64(
        vert_properties=vertices, tri_verts=triangles.astype(np.uint64)))
    if found.status() != manifold3d.Error.NoError:
        raise ValueError(f"manifold3d: {found.status()}")
    return found


def _own(a, b, is_convex):
    del is_convex
    return _manifold(a).minkowski_sum(_manifold(b))


def _hulls(a, b, is_convex):
    """The union of hulls of facet + a (of facet + facet where a is not convex),
    and of b and a moved to a vertex of the other."""
    from manifold3d import Manifold, OpType
    (va, ta), (vb, tb) = arrays(a), arrays(b)
    tools = [va] if is_convex else [va[t] for t in ta]
    parts = [Manifold.hull_points((tool[:, None] + vb[t]).reshape(-1, 3))
             for t in tb for tool in tools]
    parts.append(_manifold(b).translate(va[0]))
    if not is_convex:
        parts.append(_manifold(a).translate(vb[0]))
    return Manifold.batch_boolean(parts, OpType.Add)


def _peer(way, a, b, is_convex, pipe):
    try:
        import manifold3d  # noqa: F401: not what is measured
        solids = phongpd.Solid(*a), phongpd.Solid(*b)
        answers = []
        while not answers or (len(answers) < 3 and answers[0][0] < 1.0):
            begin = time.process_time()
            found = {"own": _own, "hulls": _hulls}[way](*solids, is_convex)
            volume = found.volume()  # manifold works when it is asked
            answers.append((time.process_time() - begin, volume, found.genus(),
                            found.num_tri()))
        pipe.send(sorted(answers)[len(answers) // 2])
    except Exception as error:
        pipe.send(f"{type(error).__name__}: {error}")


def _run_peer(way, a, b, is_convex):
    """In a process of its own, which is ended at the limit."""
    context = multiprocessing.get_context("spawn")
    near, far = context.Pipe()
    process = context.Process(
        target=_peer, args=(way, arrays(a), arrays(b), is_convex, far))
    process.start()
    far.close()
    try:
        answer = near.recv() if near.poll(LIMIT) else f"more than {LIMIT:g} s"
    except EOFError:
        answer = "the process died"
    process.kill()
    process.join()
    return answer


def _ours(a, b):
    begin = time.process_time()
    report = phongpd.minkowski(a, b).report
    return (time.process_time() - begin, report["volume"], report["genus"],
            report["triangles"])


def cases():
    """Name, a, b, is a convex, and the volume where it is known otherwise."""
    cube, l_bar, u_bar = (solid_of(boxes, name) for boxes, name in (
        (CUBE, "cube"), (L, "L"), (U, "U")))
    yield "cube + L", cube, l_bar, True, union_volume(sum_of_boxes(CUBE, L))
    yield "L + U", l_bar, u_bar, False, union_volume(sum_of_boxes(L, U))
    yield "turned L + U", turned(l_bar, 1), u_bar, False, None
    for scene, name in (("cone_axes", "cone + axes"), ("ball_cone", "ball + cone"),
                        ("ball_wrench", "ball + wrench")):
        yield (name, *of_scene(scene), True, None)


def run():
    """Rows of HEADER; medians of three, of long ones one.  The peers' times
    include making their solids."""
    rows = []
    for name, a, b, is_convex, volume in cases():
        count = f"{len(a.triangles)} + {len(b.triangles)}"
        ours = sorted((_ours(a, b) for _ in range(3)))[1]
        truth = ours[1] if volume is None else volume
        answers = [("PhongPD", ours)] + [
            (f"manifold3d, {way}", _run_peer(way, a, b, is_convex))
            for way in ("own", "hulls")]
        for by, answer in answers:
            if isinstance(answer, str):
                rows.append((name, count, by, answer, "-", "-", "-", "-"))
                continue
            seconds, found, genus, triangles = answer
            error = abs(found - truth) / truth
            is_own = volume is None and by == "PhongPD"
            rows.append((name, count, by, seconds, seconds / ours[0],
                         "-" if is_own else float(error), genus, triangles))
    return rows
