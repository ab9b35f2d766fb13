# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: the contact space of two boxes in closed form; one query a point.
import gc
import threading

import numpy as np
import phongpd
import pytest
from conftest import box_arrays, make_box


def signed_distance_to_box(points, low, high):
    outside = np.maximum(np.maximum(low - points, points - high), 0)
    inside = np.minimum(points - low, high - points).min(axis=1)
    return np.where(inside > 0, -inside, np.linalg.norm(outside, axis=1))


def test_euclid_is_the_distance_to_the_box(space):
    points = np.random.default_rng(3).uniform(-2, 4, (2000, 3))
    answer = phongpd.EuclideanMetric(space).query(points)
    truth = signed_distance_to_box(points, np.array([-0.2, -1, -1]),
                                   np.array([2, 1, 1]))
    assert np.abs(answer.signed_distance - truth).max() < 1e-10
    assert (answer.inside == (truth < 0)).all()
    assert (answer.penetration[~answer.inside] == 0).all()


@pytest.mark.parametrize("ell", [0.0, 0.1, 0.2])
def test_phong_has_euclids_sign_and_is_never_shallower(space, ell):
    points = np.random.default_rng(4).uniform(-1, 2, (2000, 3))
    phong = phongpd.PhongMetric(space, ell).query(points)
    euclid = phongpd.EuclideanMetric(space).query(points)
    assert (phong.inside == euclid.inside).all()
    assert (phong.signed_distance[phong.inside]
            <= euclid.signed_distance[phong.inside] + 1e-12).all()
    lengths = np.linalg.norm(phong.direction, axis=1)
    assert np.abs(lengths - 1).max() < 1e-12


@pytest.mark.parametrize("at_contact", [False, True])
def test_smoothed_has_euclids_depth_and_a_direction_across_its_jump(
        space, at_contact):
    points = np.random.default_rng(4).uniform(-1, 2, (2000, 3))
    smoothed = phongpd.SmoothedMetric(space, 0.1, at_contact=at_contact)
    answer = smoothed.query(points)
    euclid = phongpd.EuclideanMetric(space).query(points)
    for name in ("inside", "signed_distance", "contact", "gradient",
                 "triangle"):
        assert (getattr(answer, name) == getattr(euclid, name)).all()
    assert (answer.direction == euclid.direction)[~answer.inside].all()
    assert np.abs(np.linalg.norm(answer.direction, axis=1) - 1).max() < 1e-12
    known = answer.inside & (answer.status == 0)
    assert known.sum() > 100
    # The planes y = 1 and z = 1 of the box are as near; so is no other.
    ridge = smoothed.at([0.9, 0.9, 0.9])
    if not at_contact:
        assert np.allclose(ridge.direction[1], ridge.direction[2], atol=1e-12)
    deep = phongpd.SmoothedMetric(space, 0.01).at([0.9, 0.0, 0.0])
    assert deep.status == "euclidean_fallback"


def test_a_batch_is_one_query_a_point_to_the_byte(space):
    metric = phongpd.PhongMetric(space)
    points = np.random.default_rng(5).uniform(-1, 2, (9000, 3))
    together = metric.query(points)
    for i in range(0, 9000, 300):
        alone = metric.query(points[i])
        assert alone.signed_distance[0] == together.signed_distance[i]
        assert (alone.contact[0] == together.contact[i]).all()


def test_tracked_answers_continue_a_branch(space):
    metric = phongpd.PhongMetric(space)
    line = np.linspace([0.0, 0.1, 0.2], [1.9, 0.1, 0.2], 400)
    tracked = metric.query(line, tracked=True)
    steps = np.linalg.norm(np.diff(tracked.penetration, axis=0), axis=1)
    jumps = steps > 0.05 * space.length
    ended = np.array(tracked.statuses[1:]) == "branch_ended"
    assert not (jumps & ~ended).any()


def test_the_tracker_never_jumps(space):
    random = np.random.default_rng(9)
    walk = np.cumsum(random.normal(scale=0.02, size=(5000, 3)), axis=0)
    walk = 0.4 + np.clip(walk, -0.9, 0.9)
    tracker = phongpd.PenetrationTracker(space, speed=5)
    motion = tracker.follow(walk)
    assert set(motion.statuses) <= {"following", "sliding", "outside"}
    stays = motion.inside[1:] & motion.inside[:-1]
    steps = np.linalg.norm(np.diff(walk, axis=0), axis=1)[stays]
    changes = np.linalg.norm(np.diff(motion.penetration, axis=0), axis=1)[stays]
    assert (changes <= 6 * steps + 1e-12).all()
    euclid = phongpd.EuclideanMetric(space).query(walk).signed_distance
    inside = motion.inside
    assert np.abs(motion.euclidean_depth[inside] + euclid[inside]).max() < 1e-10
    # In two calls as in one, and anew after restart.
    again = phongpd.PenetrationTracker(space, speed=5)
    parts = [again.follow(walk[:2000]), again.follow(walk[2000:])]
    assert (np.vstack([p.penetration for p in parts])
            == motion.penetration).all()
    again.restart()
    assert (again.follow(walk).penetration == motion.penetration).all()


def test_points_that_are_not_finite_are_invalid(space):
    for metric in (phongpd.PhongMetric(space), phongpd.EuclideanMetric(space),
                   phongpd.SmoothedMetric(space)):
        answer = metric.query([[np.nan, 0, 0], [np.inf, 0, 0], [0, 0, 0]])
        assert answer.statuses[:2] == ["invalid", "invalid"]
        assert (answer.contact[:2] == 0).all()
        assert np.isfinite(answer.signed_distance).all()


def test_any_layout_of_points_gives_the_same(space):
    metric = phongpd.EuclideanMetric(space)
    points = np.random.default_rng(6).uniform(-1, 2, (50, 3))
    truth = metric.query(points).signed_distance
    frozen = points.copy()
    frozen.flags.writeable = False
    for other in (np.asfortranarray(points), points.tolist(), frozen,
                  np.repeat(points, 2, axis=0)[::2]):
        assert (metric.query(other).signed_distance == truth).all()
    whole = metric.query(np.ones((2, 3), dtype=np.int64))
    assert whole.signed_distance[0] == metric.query((1, 1, 1)).signed_distance[0]


@pytest.mark.parametrize("points", [np.zeros((3, 2)), np.zeros((2, 3, 1)), 1.0,
                                    "abc", [[1, 2], [3]], [None, None, None],
                                    np.zeros((1, 3), dtype=complex)])
def test_points_of_other_shape_are_refused(space, points):
    with pytest.raises(phongpd.InputError, match="points: expected"):
        phongpd.EuclideanMetric(space).query(points)


def test_no_points_no_answers(space):
    answer = phongpd.PhongMetric(space).query(np.empty((0, 3)))
    assert len(answer) == 0
    assert answer.contact.shape == (0, 3)


def test_views_outlive_what_they_are_of_and_cannot_be_written():
    solid = make_box((0, 0, 0), (1, 2, 3))
    vertices = solid.vertices
    del solid
    gc.collect()
    assert vertices.max() == 3
    with pytest.raises(ValueError):
        vertices[0, 0] = 5


def test_threads_may_share_a_metric(space):
    metric = phongpd.PhongMetric(space)
    points = np.random.default_rng(7).uniform(-1, 2, (3000, 3))
    truth = metric.query(points).signed_distance
    wrong = []

    def work():
        for _ in range(5):
            if not (metric.query(points).signed_distance == truth).all():
                wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_options_are_checked(space):
    for smoothing in (-1, 2, np.nan):
        with pytest.raises(phongpd.InputError, match="smoothing_length"):
            phongpd.PhongMetric(space, smoothing)
    with pytest.raises(phongpd.InputError, match="field"):
        phongpd.PhongMetric(space, field="other")
    with pytest.raises(phongpd.InputError, match="ContactSpace"):
        phongpd.PhongMetric("space")


@pytest.mark.parametrize("vertices, triangles", [
    ([[0, 0, 0]], [[0, 1, 2]]),                 # no such vertices
    (box_arrays((0, 0, 0), (1, 1, 1))[0], [[0, 1, 3]]),  # open
    (np.full((8, 3), np.nan), box_arrays((0, 0, 0), (1, 1, 1))[1]),
    ([[0, 0], [1, 1]], [[0, 1, 0]]),
    (box_arrays((0, 0, 0), (1, 1, 1))[0], [[0.5, 1, 3]]),
    (box_arrays((0, 0, 0), (1, 1, 1))[0], [[-1, 1, 3]]),
    ([], []),
])
def test_what_is_no_solid_is_refused_in_one_line(vertices, triangles):
    with pytest.raises(phongpd.InputError) as error:
        phongpd.Solid(vertices, triangles, "part")
    assert "part" in str(error.value)
    assert "\n" not in str(error.value)


def test_solids_come_from_files_and_from_meshes_of_others(tmp_path):
    solid = make_box((0, 0, 0), (1, 2, 3))
    solid.write(tmp_path / "box.off")
    assert phongpd.Solid.read(tmp_path / "box.off").volume == 6

    class Mesh:  # as trimesh has it
        vertices = solid.vertices
        faces = solid.triangles

    assert phongpd.Solid.from_trimesh(Mesh()).volume == 6
    assert phongpd.depth(Mesh(), tmp_path / "box.off").depth == 1
