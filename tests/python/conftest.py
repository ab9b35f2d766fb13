# SPDX-License-Identifier: GPL-3.0-or-later
import os

import numpy as np
import phongpd
import pytest

# Corners by x, y, z as bits; two triangles a face, seen from outside.
BOX_FACES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
             [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]


def box_arrays(low, high):
    ends = np.array([low, high], dtype=float)
    vertices = np.array([[ends[i >> 2, 0], ends[i >> 1 & 1, 1], ends[i & 1, 2]]
                         for i in range(8)])
    return vertices, np.array(BOX_FACES)


def make_box(low, high, name="box"):
    return phongpd.Solid(*box_arrays(low, high), name)


def make_torus(major, minor, around, across, name="torus"):
    """Turns about z; `around` times `across` quads, in two triangles each."""
    u, v = np.meshgrid(np.arange(around) * (2 * np.pi / around),
                       np.arange(across) * (2 * np.pi / across), indexing="ij")
    ring = major + minor * np.cos(v)
    vertices = np.stack([ring * np.cos(u), ring * np.sin(u),
                         minor * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = (k.ravel() for k in np.indices((around, across)))
    a, b = i * across + j, (i + 1) % around * across + j
    right = (j + 1) % across - j
    triangles = np.vstack([np.stack([a, b, b + right], axis=1),
                           np.stack([a, b + right, a + right], axis=1)])
    return phongpd.Solid(vertices, triangles, name)


@pytest.fixture
def program():
    """The command line; a wheel has none."""
    path = os.environ.get("PHONGPD_PROGRAM")
    if not path:
        pytest.skip("PHONGPD_PROGRAM names no program to compare with")
    return path


@pytest.fixture
def robot():
    return make_box((0, 0, 0), (1, 1, 1), "robot")


@pytest.fixture
def obstacle():
    return make_box((0.8, 0, 0), (2, 1, 1), "obstacle")


@pytest.fixture
def space(robot, obstacle):
    return phongpd.ContactSpace.build(robot, obstacle)


@pytest.fixture
def world(robot, obstacle):
    return phongpd.World(robot, {"obstacle": obstacle},
                         bounds=[[-3, -3, -3], [4, 4, 4]])


@pytest.fixture(scope="module")
def processes(tmp_path_factory):
    """A scheduler of Dask and two workers, each a process of its own."""
    from cluster_processes import Processes  # not all that is tested has Dask
    with Processes(tmp_path_factory.mktemp("dask")) as all_of_them:
        all_of_them.start_scheduler()
        for _ in range(2):
            all_of_them.start_worker()
        yield all_of_them


@pytest.fixture
def client(processes):
    from distributed import Client
    with Client(processes.address, set_as_default=False) as one:
        one.wait_for_workers(2, timeout=60)
        yield one
