# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: overlap of boxes in closed form, brute force over their contact space.
import numpy as np
import phongpd
import pytest
from conftest import make_box


def box_depth(low_a, high_a, low_b, high_b):
    """Of axis-parallel boxes; minus the distance where they are apart."""
    overlap = np.minimum(np.asarray(high_a) - low_b, np.asarray(high_b) - low_a)
    if (overlap >= 0).all():
        return overlap.min()
    return -np.linalg.norm(np.maximum(-overlap, 0))


def test_depth_of_boxes_is_their_least_overlap():
    random = np.random.default_rng(1)
    for _ in range(30):
        low, size = random.uniform(-1, 1, 3), random.uniform(0.2, 1.5, 3)
        answer = phongpd.depth(make_box((0, 0, 0), (1, 1, 1)),
                               make_box(low, low + size))
        truth = box_depth((0, 0, 0), (1, 1, 1), low, low + size)
        assert answer.certified
        assert answer.depth == pytest.approx(max(truth, 0), abs=1e-10)
        assert answer.clearance == pytest.approx(max(-truth, 0), abs=1e-10)


def test_many_poses_answer_like_one_each(robot, obstacle):
    query = phongpd.DepthQuery(robot, obstacle)
    places = np.random.default_rng(2).uniform(-1, 1.5, (20, 3))
    together = query.at(places)
    for place, answer in zip(places, together):
        alone = query.at(place)
        assert answer.depth == alone.depth
        assert answer.status == alone.status
        assert (answer.direction == alone.direction).all()


def test_a_quarter_turn_is_that_of_the_turned_mesh(obstacle):
    bar = make_box((0, 0, 0), (1, 0.2, 0.3))
    half = np.sqrt(0.5)
    turned = phongpd.depth(bar, obstacle, at=(1, 0.1, 0.1),
                           orientation=(half, 0, 0, half))
    # z by 90 degrees: (x, y, z) -> (-y, x, z).
    truth = box_depth((0.8, 0.1, 0.1), (1, 1.1, 0.4), (0.8, 0, 0), (2, 1, 1))
    assert turned.depth == pytest.approx(truth, abs=1e-10)


def test_moving_by_the_answer_parts_the_solids(robot, obstacle):
    query = phongpd.DepthQuery(robot, obstacle)
    first = query.at((0.3, 0.2, 0.1))
    assert first.status == "penetrating"
    moved = np.array((0.3, 0.2, 0.1)) + first.direction * (first.depth + 1e-6)
    after = query.at(moved)
    assert after.status == "separate"
    assert after.clearance == pytest.approx(1e-6, rel=1e-3)


def test_statuses_and_words(robot, obstacle):
    assert str(phongpd.depth(robot, obstacle)).startswith("penetrating, depth 0.2")
    assert phongpd.depth(robot, obstacle, at=(-0.2, 0, 0)).status == "touching"
    apart = phongpd.depth(robot, obstacle, at=(-1.2, 0, 0))
    assert str(apart) == "separate, clearance 1"


@pytest.mark.parametrize("orientation", [(1, 0, 0, 1e-3), (np.nan, 0, 0, 0),
                                         (0, 0, 0, 0)])
def test_quaternions_that_are_not_unit_are_refused(robot, obstacle, orientation):
    with pytest.raises(phongpd.InputError):
        phongpd.depth(robot, obstacle, orientation=orientation)


def test_numbers_of_poses_must_agree(robot, obstacle):
    query = phongpd.DepthQuery(robot, obstacle)
    with pytest.raises(phongpd.InputError, match="expected one or 3"):
        query.at(np.zeros((3, 3)), np.tile([1, 0, 0, 0], (2, 1)))
    assert query.at(np.zeros((0, 3))) == []


def test_sum_of_boxes_is_the_box_of_sums(robot, obstacle):
    total = phongpd.minkowski(robot, obstacle)
    assert total.vertices.min(axis=0) == pytest.approx([0.8, 0, 0])
    assert total.vertices.max(axis=0) == pytest.approx([3, 2, 2])
    assert total.report["volume"] == pytest.approx(2.2 * 2 * 2)
    difference = phongpd.minkowski(robot, obstacle, difference=True)
    assert difference.vertices.min(axis=0) == pytest.approx([-0.2, -1, -1])
