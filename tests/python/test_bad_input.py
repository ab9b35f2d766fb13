# SPDX-License-Identifier: GPL-3.0-or-later
# Every function that takes arrays or options, with what users may give it: an
# answer that is right, or one line that says what is wrong.  Truth: the same
# call with plain doubles.
import warnings

import numpy as np
import phongpd
import pytest
from conftest import box_arrays, make_box

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)
ROWS = np.array([[0.25, 0.5, 0], [0.5, 0.25, 1], [-0.75, 0, 0.5]])


class Things:
    """Made once; nothing in here changes."""

    robot = make_box((0, 0, 0), (1, 1, 1), "robot")
    obstacle = make_box((0.8, 0, 0), (2, 1, 1), "obstacle")
    space = phongpd.ContactSpace.build(robot, obstacle)
    world = phongpd.World(robot, {"obstacle": obstacle},
                          bounds=[[-3, -3, -3], [4, 4, 4]])
    roadmap = world.roadmap()
    phong = phongpd.PhongMetric(space)
    euclid = phongpd.EuclideanMetric(space)
    query = phongpd.DepthQuery(robot, obstacle)
    rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=3)
    judge = phongpd.RigidJudge(robot, obstacle)
    turning = phongpd.RigidWorld(robot, obstacle)


T = Things
# By name: what they make of an (N, 3) array, as arrays.
BATCHES = {
    "phong query": lambda p: T.phong.query(p).signed_distance,
    "phong tracked": lambda p: T.phong.query(p, tracked=True).contact,
    "euclid query": lambda p: T.euclid.query(p).gradient,
    "tracker": lambda p: phongpd.PenetrationTracker(T.space).follow(p).depth,
    "depth": lambda p: np.array([one.depth for one in T.query.at(p)]),
    "is_free": lambda p: T.world.is_free(p),
    "is_motion_free": lambda p: T.world.is_motion_free(p, p),
    "clearance": lambda p: T.world.clearance(p),
}
FIXED = {  # of exactly as many numbers as ROWS or a row of it has
    "rows value": lambda p: T.rows.value(p),
    "rows jacobian": lambda p: T.rows.jacobian(p),
}
SINGLE = {
    "phong at": lambda q: T.phong.at(q).signed_distance,
    "depth at": lambda q: phongpd.depth(T.robot, T.obstacle, at=q).depth,
    "diagnose": lambda q: T.world.diagnose(q).free,
    "plan": lambda q: T.world.plan(q, GOAL).status,
    "roadmap": lambda q: T.roadmap.plan(q, GOAL).status,
    "optimize": lambda q: T.world.optimize(q, q, waypoints=1).status,
}
ODD = {
    "fortran": np.asfortranarray,
    "strided": lambda a: np.repeat(a, 2, axis=0)[::2],
    "columns": lambda a: np.repeat(a, 2, axis=1)[:, ::2],
    "backwards": lambda a: a[::-1].copy()[::-1],
    "big endian": lambda a: a.astype(">f8"),
    "float32": lambda a: a.astype(np.float32),
    "list": lambda a: a.tolist(),
    "tuple": lambda a: tuple(map(tuple, a.tolist())),
    "memory": lambda a: memoryview(np.ascontiguousarray(a)),
    "masked": lambda a: np.ma.masked_array(a),
}
BAD = {
    "two columns": np.zeros((3, 2)), "four columns": np.zeros((3, 4)),
    "three axes": np.zeros((1, 3, 3)), "a number": 1.0, "none": None,
    "text": "abc", "texts": np.array([["a", "b", "c"]]),
    "objects": np.array([[object()] * 3]), "ragged": [[1, 2, 3], [4]],
    "complex": np.zeros((3, 3), dtype=complex), "dates": np.zeros(
        (3, 3), dtype="M8[s]"), "a dict": {"x": 1}, "a set": {1.0, 2.0, 3.0},
    "record": np.zeros(3, dtype=[("x", "f8"), ("y", "f8"), ("z", "f8")]),
}


def refused(call):
    with pytest.raises(phongpd.InputError) as error:
        call()
    text = str(error.value)
    assert "\n" not in text and "found" in text and len(text) < 300
    return text


def frozen(array):
    array = np.array(array)
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("odd", [*ODD, "read-only"])
def test_arrays_of_any_layout_are_taken_as_what_they_are(odd):
    make = ODD.get(odd, frozen)
    for name, call in {**BATCHES, **FIXED}.items():
        truth, found = call(ROWS.copy()), call(make(ROWS))
        assert np.array_equal(truth, found), name
    for name, call in SINGLE.items():
        if odd in ("fortran", "columns", "strided", "backwards"):
            place = make(ROWS)[0]
        elif odd == "tuple":
            place = tuple(ROWS[0].tolist())
        else:
            place = make(ROWS[0]) if odd != "memory" else memoryview(ROWS[0])
        assert call(place) == call(ROWS[0]), name


@pytest.mark.parametrize("bad", BAD)
def test_what_is_no_array_of_rows_is_said(bad):
    calls = {**BATCHES, **FIXED, **SINGLE}
    if bad == "three axes":  # of waypoints only the number counts
        calls = {**BATCHES, **SINGLE}
    for call in calls.values():
        refused(lambda: call(BAD[bad]))  # noqa: B023
    vertices, triangles = box_arrays((0, 0, 0), (1, 1, 1))
    refused(lambda: phongpd.Solid(BAD[bad], triangles))
    refused(lambda: phongpd.Solid(vertices, BAD[bad]))
    refused(lambda: phongpd.view(T.space, way=BAD[bad]))
    if bad != "none":
        refused(lambda: phongpd.World(T.robot, T.obstacle, bounds=BAD[bad]))


def test_no_rows_no_answers():
    for name, call in BATCHES.items():
        for empty in (np.empty((0, 3)), [], np.empty((0, 3), dtype=int)):
            assert len(call(empty)) == 0, name
    for call in {**FIXED, **SINGLE}.values():
        refused(lambda: call([]))  # noqa: B023
    refused(lambda: phongpd.Solid(np.empty((0, 3)), np.empty((0, 3), dtype=int)))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e308, -1e308])
def test_no_number_breaks_anything(value):
    rows = ROWS.copy()
    rows[1, 2] = value
    for name in ("phong query", "euclid query", "is_free", "clearance"):
        found, truth = BATCHES[name](rows), BATCHES[name](ROWS)
        # The others are what they were.
        assert np.array_equal(found[[0, 2]], truth[[0, 2]]), name
    if not np.isfinite(value):
        for name in ("rows value", "rows jacobian"):
            refused(lambda: FIXED[name](rows))  # noqa: B023
        for name, call in SINGLE.items():
            if name != "phong at":
                refused(lambda: call(rows[1]))  # noqa: B023
        assert T.phong.at(rows[1]).status == "invalid"
        vertices, triangles = box_arrays((0, 0, 0), (1, 1, 1))
        vertices[3, 1] = value
        refused(lambda: phongpd.Solid(vertices, triangles))


# Options that are numbers, truths or texts, each with values of other kinds.
OPTIONS = {
    "build robot_hull": (lambda v: phongpd.ContactSpace.build(
        T.robot, T.obstacle, robot_hull=v), [1, "yes", None, [True]]),
    "build wrap": (lambda v: phongpd.ContactSpace.build(
        T.robot, T.obstacle, wrap=v), ["wide", None, [1, 2], -1, np.nan]),
    "build target_faces": (lambda v: phongpd.ContactSpace.build(
        T.robot, T.obstacle, target_faces=v), [-1, 1.5, "a", 2 ** 80, True]),
    "build max_mib": (lambda v: phongpd.ContactSpace.build(
        T.robot, T.obstacle, max_mib=v), ["much", None, 1j]),
    "build cache": (lambda v: phongpd.ContactSpace.build(
        T.robot, T.obstacle, cache=v), ["no", 2]),
    "piece": (lambda v: phongpd.ContactSpacePiece.build(
        T.robot, T.obstacle, 0, 1, max_seconds=v), ["long", None]),
    "sum difference": (lambda v: phongpd.minkowski(
        T.robot, T.obstacle, difference=v), [3, "a"]),
    "sum operand": (lambda v: phongpd.minkowski(T.robot, v), [3, None, [1]]),
    "smoothing_length": (lambda v: phongpd.PhongMetric(T.space, v),
                         ["long", [1, 2], -1, 2, np.nan]),
    "smoothed length": (lambda v: phongpd.SmoothedMetric(T.space, v),
                        ["long", [1, 2], 0, 2, np.nan]),
    "smoothed at_contact": (lambda v: phongpd.SmoothedMetric(
        T.space, at_contact=v), ["a", 7]),
    "metric of": (phongpd.EuclideanMetric, [3, None, T.robot]),
    "tracked": (lambda v: T.phong.query(ROWS, tracked=v), ["a", 7]),
    "after": (lambda v: T.phong.at(ROWS[0], after=v), [3, "a"]),
    "tracker of": (lambda v: phongpd.PenetrationTracker(v), [3, T.robot]),
    "tracker ratio": (lambda v: phongpd.PenetrationTracker(T.space, ratio=v),
                      ["a", None, 0, np.nan]),
    "depth max_radius": (lambda v: phongpd.DepthQuery(
        T.robot, T.obstacle, max_radius=v), ["a", None, -1, np.nan]),
    "depth orientation": (lambda v: T.query.at(ROWS, v),
                          [[1, 0, 0], [[1, 0, 0, 0]] * 2, "a", [0, 0, 0, 0],
                           [np.nan, 0, 0, 0], [2, 0, 0, 0]]),
    "world name": (lambda v: phongpd.World(T.robot, T.obstacle, name=v),
                   [3, None]),
    "world max_mib": (lambda v: phongpd.World(T.robot, T.obstacle, max_mib=v),
                      ["a", None]),
    "load": (phongpd.World.load, [3, None, "no such family"]),
    "load seed": (lambda v: phongpd.World.load("u_axis", seed=v),
                  [-1, 1.5, "a", 2 ** 64]),
    "optimize metric": (lambda v: T.world.optimize(START, GOAL, metric=v),
                        [3, None, "other"]),
    "optimize seed": (lambda v: T.world.optimize(START, GOAL, seed=v),
                      [-1, 0.5, 2 ** 64]),
    "optimize waypoints": (lambda v: T.world.optimize(START, GOAL, waypoints=v),
                           [-1, 2 ** 31, "a"]),
    "optimize straight": (lambda v: T.world.optimize(START, GOAL, straight=v),
                          ["a", 3]),
    "optimize margin": (lambda v: T.world.optimize(START, GOAL, margin=v),
                        [[1], "wide", np.nan]),
    "optimize max_seconds": (
        lambda v: T.world.optimize(START, GOAL, max_seconds=v),
        ["a", 0, -1, np.nan]),
    "plan planner": (lambda v: T.world.plan(START, GOAL, planner=v),
                     [3, None, "other"]),
    "plan preset": (lambda v: T.world.plan(START, GOAL, preset=v),
                    [3, "other"]),
    "roadmap of": (phongpd.Roadmap, [3, T.space]),
    "rows of": (lambda v: phongpd.NonPenetrationRows(v, START, GOAL),
                [3, T.space]),
    "rows metric": (lambda v: phongpd.NonPenetrationRows(
        T.world, START, GOAL, metric=v), [3, "other"]),
    "rows waypoints": (lambda v: phongpd.NonPenetrationRows(
        T.world, START, GOAL, waypoints=v), [0, 2 ** 31, 1.5]),
    "remove part": (lambda v: phongpd.remove(v, [T.obstacle]), [3, None]),
    "remove rest": (lambda v: phongpd.remove(T.robot, v), [3, None, [3], "a.stl"]),
    "remove tolerance": (
        lambda v: phongpd.remove(T.robot, [T.obstacle], tolerance=v),
        ["2mm", None, -1, np.nan, True, "1"]),
    "remove verify": (lambda v: phongpd.remove(T.robot, [T.obstacle], verify=v),
                      ["a", 3]),
    "disassemble": (phongpd.disassemble, [3, [T.robot, 3]]),
    "first_hit resolution": (lambda v: T.judge.first_hit(
        np.eye(4), np.eye(4), resolution=v), ["1mm", None, True, b"1"]),
    "rigid time_limit": (lambda v: T.turning.plan(np.eye(4), np.eye(4),
                                                  time_limit=v), ["3s", -1, True, "1"]),
    "rigid seed": (lambda v: T.turning.plan(np.eye(4), np.eye(4), seed=v),
                   [-1, 1.5, "a", 2 ** 64]),
}
UNITS = {  # what the number would have been
    "a share of D": lambda v: phongpd.PhongMetric(T.space, smoothing_length=v),
    "in the solids' unit": lambda v: phongpd.remove(T.robot, [T.obstacle],
                                                    tolerance=v),
    "seconds": lambda v: phongpd.DepthQuery(T.robot, T.obstacle, max_seconds=v),
    "a share of the way": lambda v: T.judge.first_hit(np.eye(4), np.eye(4),
                                                      resolution=v)}


@pytest.mark.parametrize("option", OPTIONS)
def test_options_of_other_kinds_are_said(option):
    call, values = OPTIONS[option]
    for value in values:
        refused(lambda: call(value))  # noqa: B023


@pytest.mark.parametrize("unit", UNITS)
def test_a_number_with_a_unit_is_told_which_unit_it_has(unit):
    with pytest.raises(phongpd.InputError) as error:
        UNITS[unit]("2mm")
    assert f"expected a number ({unit}), found '2mm'" in str(error.value)


# Each with its one sentence.
SENTENCES = {
    "limits without a key": (
        lambda: T.world.optimize(START, GOAL,
                                 limits={"velocity": 1, "acceleration": 2}),
        "limits: jerk: expected a number or one of x, y and z, found none"),
    "limits with another key": (
        lambda: T.world.optimize(START, GOAL, limits={"speed": 1}),
        "limits: expected the keys velocity, acceleration, jerk, found 'speed'"),
    "limits of a text": (
        lambda: T.world.optimize(START, GOAL, limits={
            "velocity": "fast", "acceleration": 1, "jerk": 1}),
        "limits: velocity: expected real numbers, found 'fast'"),
    "limits by": (
        lambda: T.world.optimize(START, GOAL, limits={
            "velocity": 1, "acceleration": 1, "jerk": 1, "by": "axes"}),
        "limits: by: expected 'axis' or 'norm', found 'axes'"),
    "tolerance without via": (
        lambda: T.world.optimize(START, GOAL, limits=(1, 2, 10), tolerance=0.01),
        "tolerance: expected the places of via with it, found via None"),
    "dwell without via": (
        lambda: T.world.optimize(START, GOAL, limits=(1, 2, 10), dwell=2),
        "dwell: expected the places of via with it, found via None"),
    "a length in a place": (
        lambda: phongpd.depth(T.robot, T.obstacle, at=("1mm", 2, 3)),
        "at: expected real numbers, found ('1mm', 2, 3)"),
    "read of a number": (
        lambda: phongpd.Solid.read(3),
        "path: expected a file of a mesh, found int"),
    "a fleet in a list": (
        lambda: phongpd.optimize_fleet([]),
        "robots: expected a dict {name: (world, start, goal)} or a scene file, "
        "found list"),
    "a contact space's file": (
        lambda: phongpd.PhongMetric("c.pcs"),
        "space: expected a ContactSpace, found str; ContactSpace.read(file) "
        "reads one"),
    "obstacles in a list": (
        lambda: phongpd.World(T.robot, ["part.stl"]),
        "obstacles: expected one, or several in a dict by name, found list; "
        "write {\"part\": \"part.stl\"}, or for arrays "
        "Solid(vertices, triangles)"),
    "unit": (
        lambda: phongpd.World(T.robot, T.obstacle, unit="mmm"),
        "unit: expected one of nm, um, mm, cm, dm, m, km, in, ft or \"\", found "
        "'mmm'; did you mean mm?"),
    "a unit that has no name": (
        lambda: T.world.plan(START, GOAL, clearance="5mm"),
        "clearance: expected a length >= 0 as 0.01 or 0.01D (a share of the "
        "world's diagonal D) or 0.5unit (the user's unit), found '5mm': the "
        "user's unit has no name; write 5unit, or name it (in a scene \"unit\": "
        "\"mm\", of Python's World unit=\"mm\")"),
    "metric": (
        lambda: T.world.optimize(START, GOAL, metric="euclid"),
        "metric: expected euclidean, phong[@LENGTH], phong@LENGTH/exact, "
        "phong@LENGTH/tangent-plane, smoothed[@LENGTH] or "
        "smoothed-foot[@LENGTH], found 'euclid'; did you mean euclidean?"),
    "preset": (
        lambda: T.world.optimize(START, GOAL, preset="balance"),
        "preset: expected one of fast, balanced, tight, found 'balance'; did "
        "you mean balanced?"),
    "model": (
        lambda: T.world.optimize(START, GOAL, model="windw"),
        "model: expected auto, window or full, found 'windw'; did you mean "
        "window?"),
    "depth's metric": (
        lambda: phongpd.depth(T.robot, T.obstacle, metric="euclid"),
        "metric: expected one of phong, euclidean, smoothed, smoothed-foot, "
        "found 'euclid'; did you mean euclidean?"),
    "depth's smoothing length": (
        lambda: phongpd.depth(T.robot, T.obstacle, metric="euclidean",
                              smoothing_length=0.1),
        "smoothing_length: expected None with metric 'euclidean', found 0.1"),
}


@pytest.mark.parametrize("mistake", SENTENCES)
def test_a_mistake_is_answered_with_its_sentence(mistake):
    call, sentence = SENTENCES[mistake]
    with pytest.raises(phongpd.InputError) as error:
        call()
    assert str(error.value) == sentence


def test_a_keyword_that_is_none_is_refused_in_the_name_of_world():
    with pytest.raises(TypeError, match=r"^World\.__init__\(\)"):
        phongpd.World(T.robot, T.obstacle, bound=None)


def test_metres_beside_millimetres_are_warned_of_where_it_is_asked():
    large = make_box((-400, -400, -400), (400, 400, 400), "hall")
    told = (r"diagonals 1\.73 and 1\.39e\+03, 800 times apart; is one in metres "
            r"and the other in millimetres\?$")
    for name, call in {
            "hall": lambda: phongpd.World(T.robot, {"hall": large}),
            "the obstacle": lambda: phongpd.depth(T.robot, large),
            "obstacle": lambda: phongpd.RigidWorld(T.robot, large)}.items():
        with pytest.warns(UserWarning, match=f"the robot and {name}: {told}") as w:
            call()
        assert [one.filename for one in w] == [__file__], name
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        phongpd.World(T.robot, T.obstacle)
        phongpd.depth(T.robot, T.obstacle)
        phongpd.RigidWorld(T.robot, T.obstacle)


def test_limits_may_be_named_as_scenes_name_them():
    named = {"velocity": 1, "acceleration": [2, 2, 2], "jerk": 10}
    truth = T.world.optimize(START, GOAL, limits=(1, 2, 10), preset="fast")
    found = T.world.optimize(START, GOAL, limits=named, preset="fast")
    assert np.array_equal(found.points, truth.points)
    by_norm = T.world.optimize(START, GOAL, preset="fast", limits={
        "velocity": 1, "acceleration": 2, "jerk": 10, "by": "norm"})
    assert by_norm.row["limits"]["by"] == "norm"


def test_a_world_is_told_what_its_unit_is_called():
    world = phongpd.World(T.robot, T.obstacle, unit="mm")
    assert world.unit == "mm"
    row = world.plan(START, GOAL, clearance="0.2mm").row
    assert row["lengths"]["asked_clearance"]["unit"] == pytest.approx(0.2)


def test_a_metric_stands_beside_the_depth():
    at = (0.1, 0.2, 0.3)
    found = phongpd.depth(T.robot, T.obstacle, at, metric="phong")
    truth = phongpd.PhongMetric(T.space).at(at)
    assert found.depth == phongpd.depth(T.robot, T.obstacle, at).depth
    assert found.beside.signed_distance == truth.signed_distance
    assert phongpd.depth(T.robot, T.obstacle, at,
                         metric="euclidean").beside is None
    half = np.sqrt(0.5)
    turned = phongpd.depth(T.robot, T.obstacle, (1.2, 0.2, 0.3),
                           (half, 0, 0, half), metric="smoothed",
                           smoothing_length=0.05)
    assert turned.depth > 0.3
    assert turned.beside.signed_distance == pytest.approx(-turned.depth)


@pytest.mark.parametrize("named", [
    phongpd.Roadmap.plan, phongpd.InputError, phongpd.BuildRefusal,
    phongpd.BuildCancelled])
def test_what_is_exported_says_what_it_is(named):
    assert len(named.__doc__.split()) > 8


def test_a_clearance_that_is_asked_for_is_kept_where_there_is_room():
    world = phongpd.World.load("hole:delta=0.05")
    free = world.plan()
    assert free.clearance > 0.015  # of 0.025 in the middle of the hole
    for asked in (0.01, 0.015, 0.02, 0.024):
        plan = world.plan(clearance=f"{asked}unit", require=True)
        assert plan.status == "solved", asked
        assert plan.clearance >= asked * (1 - 1e-6)
