# SPDX-License-Identifier: GPL-3.0-or-later
# Curves of whoever made them.  Truth: scipy's own values of its splines, the
# world's exact test of places, a parabola that touches in closed form.
import json

import numpy as np
import phongpd
import pytest
from conftest import make_box
from phongpd._curve import curve_of
from scipy.interpolate import BPoly, BSpline, CubicSpline, PPoly, \
    make_interp_spline

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)
LIMITS = (1, 2, 10)


@pytest.fixture(scope="module")
def boxes():
    """Contact: x in [-0.2, 2], y and z in [-1, 1]."""
    return phongpd.World(make_box((0, 0, 0), (1, 1, 1)),
                         make_box((0.8, 0, 0), (2, 1, 1)))


def parabola(lift):
    """z = 1 + (x - 1)^2 + lift, for 2 s: it touches at x = 1 without."""
    points = np.array([[(-1, 0, 5), (1, 0, -3), (3, 0, 5)]], dtype=float)
    points[..., 2] += lift
    return [2.0], points


def test_a_motion_is_confirmed(world):
    motion = world.optimize(START, GOAL, limits=LIMITS)
    check = world.check_curve(motion, limits=LIMITS)
    assert check.free and check.status == "free"
    assert check.free_until == motion.duration
    assert (check.time, check.piece) == (0, -1)
    assert check.limits_used == motion.row["limits_used"]
    assert max(check.limits_used.values()) <= 1
    assert max(check.jumps) < 1e-9
    assert world.check_curve((motion.durations, motion.points)).limits_used == {}
    assert str(check).startswith("free; of the limits: velocity ")
    assert check.to_row()["jerk_used"] == check.limits_used["jerk"]


def test_it_tells_when_and_where_a_curve_collides(boxes):
    check = boxes.check_curve(parabola(-0.5))
    assert check.status == "collides" and not check.free
    assert not boxes.is_free([check.position])[0]
    x, z = -1 + 2 * check.time, 0.5 + (2 * check.time - 2) ** 2
    assert check.position == pytest.approx((x, 0, z))
    # z = 1 at 1 - 1/(2 sqrt 2) s.
    assert 0 < check.free_until <= 1 - 0.5 ** 1.5 <= check.time <= 1 + 0.5 ** 1.5
    assert "collides at" in str(check) and "in piece 0" in str(check)


@pytest.mark.parametrize("lift, free", [(0, False), (-1e-12, False),
                                        (1e-9, True), (1e-3, True)])
def test_what_touches_is_not_free(boxes, lift, free):
    assert boxes.check_curve(parabola(lift)).free == free


@pytest.mark.parametrize("seed", range(40))
def test_splines_of_scipy_are_judged_as_they_are(boxes, seed):
    random = np.random.default_rng(seed)
    times = np.cumsum(random.uniform(0.1, 2, 7))
    spline = CubicSpline(times, random.uniform(-2.5, 3.5, (7, 3)))
    check = boxes.check_curve(spline, limits=(100, 1e4, 1e6))
    samples = np.linspace(times[0], times[-1], 3001)
    free = boxes.is_free(spline(samples))
    assert check.status in ("free", "collides")
    assert not (check.free and not free.all())
    if not check.free:
        assert not boxes.is_free([check.position])[0]
        assert check.position == pytest.approx(spline(times[0] + check.time))
    assert free[samples < times[0] + check.free_until].all()
    for order, (name, limit) in enumerate(
            zip(("velocity", "acceleration", "jerk"), (100, 1e4, 1e6)), 1):
        most = np.abs(spline(samples, order)).max() / limit
        assert most <= check.limits_used[name] * (1 + 1e-9)
        assert check.limits_used[name] < 1.05 * most + 1e-9
    assert max(check.jumps) < 1e-6  # of class C2


def test_both_answers_occur_among_those_splines(boxes):
    answers = set()
    for seed in range(40):
        random = np.random.default_rng(seed)
        times = np.cumsum(random.uniform(0.1, 2, 7))
        answers.add(boxes.check_curve(
            CubicSpline(times, random.uniform(-2.5, 3.5, (7, 3)))).status)
    assert answers == {"free", "collides"}


@pytest.mark.parametrize("degree", range(1, 8))
def test_powers_become_points_to_the_rounding_that_is_told(degree):
    random = np.random.default_rng(degree)
    points = random.normal(size=(degree + 1, 9, 3)) * 100
    breaks = np.cumsum(random.uniform(0.1, 3, 10))
    spline = PPoly.from_bernstein_basis(BPoly(points, breaks))
    durations, found, blur = curve_of(spline, "curve")
    assert (durations == np.diff(breaks)).all()
    assert 0 < blur < 1e-7
    # scipy's own conversion rounds as well.
    assert np.abs(found - points.transpose(1, 0, 2)).max() < 10 * blur


@pytest.mark.parametrize("degree", range(1, 8))
def test_knots_become_points_to_the_rounding_that_is_told(degree):
    random = np.random.default_rng(degree)
    knots = np.cumsum(random.uniform(0.1, 3, degree + 12))
    knots[degree + 4] = knots[degree + 3]  # an empty span
    spline = BSpline(knots, random.normal(size=(11, 3)) * 100, degree)
    durations, points, blur = curve_of(spline, "curve")
    ends = np.unique(knots[degree:12])
    assert (durations == np.diff(ends)).all() and len(points) == len(durations)
    assert 0 < blur < 1e-10
    for s in np.linspace(0.001, 0.999, 17):
        way = points
        while way.shape[1] > 1:  # de Casteljau
            way = (1 - s) * way[:, :-1] + s * way[:, 1:]
        truth = spline(ends[:-1] + s * durations)
        assert np.abs(way[:, 0] - truth).max() < 1e-9


@pytest.mark.parametrize("degree", range(2, 6))
def test_splines_of_knots_are_judged_as_they_are(boxes, degree):
    answers = set()
    for seed in range(20):
        random = np.random.default_rng(seed)
        spline = make_interp_spline(np.cumsum(random.uniform(0.1, 2, 7)),
                                    random.uniform(-2.5, 3.5, (7, 3)), degree)
        check = boxes.check_curve(spline)
        begin, end = spline.t[degree], spline.t[-degree - 1]
        free = boxes.is_free(spline(np.linspace(begin, end, 2001)))
        assert not (check.free and not free.all())
        if not check.free:
            assert check.position == pytest.approx(spline(begin + check.time))
        answers.add(check.status)
    assert answers == {"free", "collides"}


def test_jumps_are_told(boxes):
    corner = ([1, 2], [[(-2, 2, 0), (0, 2, 0)], [(0, 2, 0), (0, 2, 4)]])
    check = boxes.check_curve(corner, limits=(2, 1, 1))
    assert check.free and check.limits_used["acceleration"] == 0
    assert check.limits_used["velocity"] == pytest.approx(1)
    assert check.jumps == pytest.approx((8 ** 0.5, 0))


def test_limits_of_the_norm_and_of_the_scene(boxes):
    line = ([1], [[(-2, 2, 0), (1, 6, 0)]])
    assert boxes.check_curve(line, limits=(4, 1, 1)).limits_used["velocity"] == \
        pytest.approx(1)
    assert boxes.check_curve(line, limits=(4, 1, 1), by_norm=True
                             ).limits_used["velocity"] == pytest.approx(1.25)


def test_it_joins_to_rounding_and_no_farther(boxes):
    a, b, c = (-2, 2, 0), (0.1 + 0.2, 2, 0), (4, 2, 1)
    assert boxes.check_curve(([1, 1], [[a, b], [(0.3, 2, 0), c]])).free
    with pytest.raises(phongpd.InputError, match="piece 1 does not begin where"):
        boxes.check_curve(([1, 1], [[a, b], [(0.3001, 2, 0), c]]))


def test_bounds_are_kept_for_all_t(world):
    beyond = ([1], [[(-2, -2, 2), (0, -7, 2), (2, -2, 2)]])
    assert world.check_curve(beyond).status == "collides"


CUBE = make_box((0, 0, 0), (1, 1, 1))


def along(begin, end, duration):
    return [duration], np.array([[begin, end]], dtype=float)


def among(boxes, curve, **motions):
    return boxes.check_curve(curve, moving={
        name: (CUBE, motion) for name, motion in motions.items()})


def test_obstacles_that_move_are_met_when_they_are(boxes):
    # Far from what rests.  They are 6 apart, sides 1, and near by 3 a second.
    robot = along((-3, 10, 0), (3, 10, 0), 3.0)
    met = among(boxes, robot, cart=along((3, 10, 0), (0, 10, 0), 3.0),
                far=along((3, 20, 0), (0, 20, 0), 3.0))
    assert (met.status, met.obstacle, met.piece) == ("collides", "cart", 0)
    assert met.free_until <= 5 / 3 <= met.time < 7 / 3
    assert met.position == pytest.approx((-3 + 2 * met.time, 10, 0))
    assert str(met).startswith(f"collides at {met.time:.6g} s, in piece 0, with c")
    assert met.to_row()["obstacle"] == "cart"
    assert boxes.check_curve(robot).free
    # Where the cart was, but later.
    after = among(boxes, robot, cart=along((0, 10, 0), (0, 20, 0), 0.5))
    assert after.free and after.obstacle == ""


@pytest.mark.parametrize("apart, free", [(1, False), (1 + 1e-9, True),
                                         (1 - 1e-9, False)])
def test_who_passes_may_not_touch(boxes, apart, free):
    robot = along((-3, 10, 0), (3, 10, 0), 3.0)
    cart = along((3, 10 + apart, 0), (-3, 10 + apart, 0), 3.0)
    assert among(boxes, robot, cart=cart).free == free


def test_it_rests_at_its_end_until_they_rest(boxes):
    robot = ([0.5, 0.5], [[(-3, 10, 0), (0, 10, 0)], [(0, 10, 0), (3, 10, 0)]])
    late = among(boxes, robot, cart=along((3, 15, 0), (3, 10, 0), 10.0))
    assert (late.status, late.piece) == ("collides", 1)
    assert late.free_until <= 8 <= late.time
    assert late.position == pytest.approx((3, 10, 0))


def test_what_rests_is_met_first_if_it_is_first(boxes):
    robot = along((-3, 0, 0), (3, 0, 0), 6.0)  # contact from x = -0.2 on
    met = among(boxes, robot, cart=along((2, 0, 0), (1.9, 0, 0), 6.0))
    assert (met.status, met.obstacle) == ("collides", "")
    assert met.free_until <= 2.8 <= met.time


@pytest.mark.parametrize("seed", range(20))
def test_splines_among_splines_are_what_intervals_say(boxes, seed):
    random = np.random.default_rng(seed)
    times = np.linspace(0, 4, 5)
    robot, cart = (CubicSpline(times, random.uniform(-2, 2, (5, 3)) + (0, 10, 0))
                   for _ in range(2))
    check = among(boxes, robot, cart=cart)

    def gap(t):  # of unit boxes: below 0 where they overlap
        return (np.abs(robot(t) - cart(t)) - 1).max(axis=-1)
    dense = np.linspace(0, 4, 20_001)
    before = dense[dense < check.free_until]
    assert (gap(before) > 0).all()
    assert check.free == (gap(dense) > 0).all()
    if not check.free:
        assert check.status == "collides" and gap(check.time) <= 1e-9


def test_obstacles_of_the_scene_move(tmp_path):
    box = {"type": "box", "size": [1, 1, 1]}
    scene = {"robot": {"shape": box}, "start": [-3, 0, 0], "goal": [3, 0, 0],
             "obstacles": [{"id": "post", "shape": box, "position": [0, 5, 0]}],
             "moving": [{"id": "cart", "shape": box, "motion": [
                 {"duration": 1, "points": [[0, 0, 0], [1, 0, 0]]}]}]}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    through = along((-3, 0, 0), (3, 0, 0), 1.0)
    # 5 a second: the difference is 3 - 5 t, contact from 1 on.
    met = phongpd.World.load(path).check_curve(through)
    assert (met.status, met.obstacle) == ("collides", "cart")
    assert met.free_until <= 0.4 <= met.time < 0.8
    del scene["moving"]
    path.write_text(json.dumps(scene))
    assert phongpd.World.load(path).check_curve(through).free


@pytest.mark.parametrize("moving, says", [
    ({"cart": CUBE}, "moving: cart: expected .solid, motion."),
    ({"cart": (CUBE, None)}, "moving: cart: expected a Motion, .* found NoneType"),
    ({"cart": (CUBE, ([0.0], [[(0, 0, 0), (1, 0, 0)]]))},
     "moving: cart: .*expected a duration above 0"),
    ({"cart": (CUBE, ([1, 1], [[(0, 0, 0), (1, 0, 0)], [(2, 0, 0), (3, 0, 0)]]))},
     "moving: cart: .*piece 1 does not begin where"),
    ({"obstacle": (CUBE, along((0, 0, 0), (1, 0, 0), 1.0))},
     'found "obstacle", which another obstacle has')])
def test_moving_obstacles_that_are_none_are_refused(boxes, moving, says):
    with pytest.raises(phongpd.InputError, match=says):
        boxes.check_curve(along((-3, 10, 0), (3, 10, 0), 1.0), moving=moving)


def test_obstacles_move_along_splines(world):
    cart = make_box((0, -2, 0), (0.5, -1.5, 0.5))
    spline = CubicSpline([0, 2, 4], [(0, 0, 0), (1, 1, 0), (2, 0, 1)])
    durations, points, _ = curve_of(spline, "curve")
    points[1, 0] = points[0, -1]
    both = [world.optimize(START, GOAL, limits=LIMITS,
                           moving={"cart": (cart, motion)})
            for motion in (spline, (durations, points))]
    assert both[0].certified
    assert (both[0].points == both[1].points).all()


LINE = [[(-2, 2, 0), (1, 2, 0)]]


@pytest.mark.parametrize("curve, limits, says", [
    (None, None, "expected a Motion, .* found NoneType"),
    ("abc", None, "expected a Motion"),
    (([], np.empty((0, 2, 3))), None, "expected durations"),
    (([1, 2], LINE), None, r"found \(2,\) and \(1, 2, 3\)"),
    (([0], LINE), None, "expected a duration above 0"),
    (([np.nan], LINE), None, "expected a duration above 0"),
    (([1], [[(0, 0, np.inf), (0, 0, 1)]]), None, "expected finite points"),
    (([1], np.zeros((1, 1, 3))), None, "expected 2 to 8 points a piece, found 1"),
    (([1], np.zeros((1, 9, 3))), None, "expected 2 to 8 points a piece, found 9"),
    (([1], np.zeros((1, 0, 3))), None, "expected 2 to 8 points a piece, found 0"),
    (PPoly(np.zeros((2, 1)), [0, 1]), None, r"expected c \(K, N, 3\)"),
    (PPoly(np.zeros((2, 1, 3)), [1, 0]), None, "expected a duration above 0"),
    (BSpline(np.arange(6.0), np.zeros((4, 2)), 1), None, r"expected c \(N, 3\)"),
    (BSpline(np.arange(18.0), np.zeros((9, 3)), 8), None, "2 to 8 points"),
    (([1], LINE), (1, 2), "limits"),
    (([1], LINE), (1, 0, 2), "limits: acceleration"),
    (([1], LINE), "none", "limits"),
])
def test_what_is_no_curve_is_refused(boxes, curve, limits, says):
    with pytest.raises(phongpd.InputError, match=says) as error:
        boxes.check_curve(curve, limits=limits)
    assert "\n" not in str(error.value)
