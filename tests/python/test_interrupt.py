# SPDX-License-Identifier: GPL-3.0-or-later
# Ctrl-C reaches Python whatever the library is building.
import os
import signal
import subprocess
import sys
import time

import pytest

# Minutes of work: a torus of 20,000 triangles full of dents in itself.
PROGRAM = """
import numpy as np, phongpd
from phongpd import _native
n, m = 100, 100
t, p = np.meshgrid(np.linspace(0, 2 * np.pi, n, endpoint=False),
                   np.linspace(0, 2 * np.pi, m, endpoint=False), indexing="ij")
r = 1 + 0.3 * np.cos(p) * (1 + 0.5 * np.sin(9 * t))
v = np.stack([r * np.cos(t), r * np.sin(t), 0.3 * np.sin(p)], -1).reshape(-1, 3)
i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
a, b = i * m + j, (i + 1) % n * m + j
c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
f = np.vstack([np.stack([x.ravel() for x in k], -1)
               for k in ((a, b, c), (a, c, d))])
knot = phongpd.Solid(v, f)
world = phongpd.World(knot, knot)
START, GOAL = (9, 0, 0), (-9, 0.1, 0)
def row():
    knot.write("knot.off")
    with open("scene.json", "w") as file:
        file.write('{"robot": {"mesh": "knot.off"}, "obstacles": [{"id": "o", '
                   '"mesh": "knot.off"}], "start": [9, 0, 0], "goal": '
                   '[-9, 0.1, 0]}')
    study = _native.Comparison("scene.json", 0.0, False)
    study.row(1, "straight-adaptive", "euclidean")
print("begin", flush=True)
try:
    CALL
    print("done", flush=True)
except KeyboardInterrupt:
    print("stopped", flush=True)
# What was stopped can be asked again.
print(phongpd.depth(knot, knot, at=(9, 0, 0)).status, world.diagnose(START).free)
"""


def started(program, folder):
    """As somebody's, at a terminal: what a shell runs in the background, these tests
    with it, has SIGINT ignored, and so have all that it starts."""
    return subprocess.Popen(
        [sys.executable, "-c", program], cwd=folder, stdout=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))


@pytest.mark.parametrize("call", [
    "phongpd.ContactSpace.build(knot, knot)",
    "phongpd.ContactSpacePiece.build(knot, knot, 0, 1)",
    "phongpd.minkowski(knot, knot)",
    "world.plan(START, GOAL)",
    "world.optimize(START, GOAL)",
    "world.optimize(START, GOAL, limits=(1, 2, 10))",
    "world.is_free([START])",
    "world.contact_spaces()",
    "world.roadmap()",
    "phongpd.NonPenetrationRows(world, START, GOAL)",
    "row()",
])
def test_ctrl_c_stops_a_build(call, tmp_path):
    process = started(PROGRAM.replace("CALL", call), tmp_path)
    try:
        assert process.stdout.readline() == "begin\n"
        time.sleep(1)
        os.kill(process.pid, signal.SIGINT)
        out, _ = process.communicate(timeout=120)
    finally:
        process.kill()
    assert out == "stopped\nseparate True\n"
    assert process.returncode == 0


# A search of many seconds for a faster curve through a thousand places.
SEARCH = """
import numpy as np, phongpd
box = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * 1.0
faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
         [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
cube = phongpd.Solid(box, faces)
world = phongpd.World(cube, cube)
path = [(-3, 9 * (-1) ** i, 0.1 * i) for i in range(1000)]
def search(**more):
    return world.retime(path, via=path[1:-1], limits=(1, 2, 10), preset="tight",
                        **more)
some = search(max_seconds=1.5)
assert some.certified and some.status == "time_limit", some
print("begin", flush=True)
try:
    search()
    print("done", flush=True)
except KeyboardInterrupt:
    print("stopped", flush=True)
"""


def test_ctrl_c_stops_a_search(tmp_path):
    process = started(SEARCH, tmp_path)
    try:
        assert process.stdout.readline() == "begin\n"
        time.sleep(1)
        os.kill(process.pid, signal.SIGINT)
        out, _ = process.communicate(timeout=120)
    finally:
        process.kill()
    assert out == "stopped\n"
