# SPDX-License-Identifier: GPL-3.0-or-later
# What programs do to objects: many threads, forks, objects that go while they
# work.  Truth: the same question asked alone.
import gc
import json
import os
import signal
import threading
import time
import weakref

import numpy as np
import phongpd
import pytest
from conftest import box_arrays, make_box
from phongpd import _native

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)
POINTS = np.random.default_rng(11).uniform(-1, 2, (5000, 3))


def in_threads(work, count=4):
    """What work(i) returned, or raised."""
    results = [None] * count

    def one(i):
        try:
            results[i] = work(i)
        except Exception as error:
            results[i] = error

    threads = [threading.Thread(target=one, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results


def test_objects_may_go_while_a_query_runs(robot, obstacle):
    truth = phongpd.PhongMetric(
        phongpd.ContactSpace.build(robot, obstacle)).query(POINTS)

    def ask(i):
        # Nobody but the call itself holds space, metric and points.
        return phongpd.PhongMetric(
            phongpd.ContactSpace.build(robot, obstacle)).query(POINTS.copy())

    collecting = threading.Event()

    def collect():
        while not collecting.is_set():
            gc.collect()

    thread = threading.Thread(target=collect)
    thread.start()
    for answer in in_threads(ask):
        assert (answer.contact == truth.contact).all()
    collecting.set()
    thread.join()


def test_answers_outlive_what_was_asked(robot, obstacle):
    space = phongpd.ContactSpace.build(robot, obstacle)
    metric = phongpd.PhongMetric(space)
    gone = weakref.ref(space)
    alone, answer = metric.at((0.3, 0, 0)), metric.query(POINTS)
    before = answer.contact.copy(), alone.contact
    world = phongpd.World(robot, obstacle)
    plan, roadmap = world.plan(START, GOAL), world.roadmap()
    del space, metric, world
    gc.collect()
    assert gone() is None
    assert (answer.contact == before[0]).all()
    assert (alone.contact == before[1]).all()
    assert roadmap.plan(START, GOAL).solved
    assert plan.world.is_free([START])[0]


def test_arrays_may_change_once_the_call_is_over(space):
    vertices, faces = box_arrays((0, 0, 0), (1, 1, 1))
    solid = phongpd.Solid(vertices, faces)
    vertices[:] = np.nan
    assert solid.volume == 1
    path = np.array([START, (0, 2, 0), GOAL], dtype=float)
    picture = phongpd.view(solid, way=path)
    page = picture.html()
    path[:] = 7
    assert picture.html() == page


def test_threads_may_share_a_world(world, robot, obstacle):
    alone = phongpd.World(robot, {"obstacle": obstacle},
                          bounds=[[-3, -3, -3], [4, 4, 4]])
    path = alone.optimize(START, GOAL).path
    free = alone.is_free(POINTS)

    def ask(i):  # the first to come builds
        if i == 0:
            return world.optimize(START, GOAL).path.tolist() == path.tolist()
        if i == 1:
            return world.plan(START, GOAL).solved
        return (world.is_free(POINTS) == free).all()

    assert in_threads(ask) == [True] * 4


def test_threads_may_share_rows_and_depth_queries(world, robot, obstacle):
    rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=4)
    u = np.linspace(START, GOAL, 6)[1:-1]
    shifts = [np.array((0, 0.01 * i, 0)) for i in range(4)]
    truth = [rows.value(u + shift) for shift in shifts]
    fresh = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=4)
    fresh.start(u)

    def ask(i):
        return all((fresh.value(u + shifts[i]) == truth[i]).all()
                   for _ in range(200))

    assert in_threads(ask) == [True] * 4
    query = phongpd.DepthQuery(robot, obstacle)
    turns = [(1, 0, 0, 0), (0.6, 0.8, 0, 0), (0.6, 0, 0.8, 0), (0.6, 0, 0, 0.8)]
    alone = [query.at((0, 0, 0), turn).depth for turn in turns]
    assert in_threads(
        lambda i: [query.at((0, 0, 0), turns[i]).depth for _ in range(20)]
    ) == [[depth] * 20 for depth in alone]


def comparison_row(study, seed):
    row = json.loads(study.row(seed, "straight-adaptive", "phong@0.2"))
    return [row[name] for name in ("seed", "status", "iterations", "objective",
                                   "collision_free")]


def test_threads_may_share_a_comparison():
    alone = [comparison_row(_native.Comparison("u_axis", 0.0, False), seed)
             for seed in (1, 2, 3)]
    shared = _native.Comparison("u_axis", 0.0, False)
    found = in_threads(lambda i: [comparison_row(shared, seed)
                                  for seed in np.roll((1, 2, 3), i).tolist()])
    assert found == [np.roll(np.array(alone, dtype=object), i, axis=0).tolist()
                     for i in range(4)]


def test_a_comparison_may_go_while_it_works():
    truth = comparison_row(_native.Comparison("u_axis", 0.0, False), 1)
    found = in_threads(lambda i: comparison_row(
        _native.Comparison("u_axis", 0.0, False), 1))
    gc.collect()
    assert found == [truth] * 4


def test_other_threads_run_while_a_row_is_made():
    study = _native.Comparison("plate:thickness=0.02", 0.0, False)
    ticks, is_over = [], threading.Event()

    def tick():
        while not is_over.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    study.row(1, "straight-adaptive", "euclidean")
    is_over.set()
    thread.join()
    # A row of a tenth of a second at the least; with the lock held: one tick.
    assert len(ticks) > 5


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_fork_amid_a_row_is_refused_in_one_line():
    study = _native.Comparison("u_axis", 0.0, False)
    is_over = threading.Event()

    def work():
        seed = 1
        while not is_over.is_set():
            study.row(seed, "straight-adaptive", "euclidean")
            seed += 1

    thread = threading.Thread(target=work)
    thread.start()
    time.sleep(0.05)
    other = _native.Comparison("u_axis", 0.0, False)
    # Between two rows the fork is as good as any other.
    said = {child(lambda: comparison_row(other, 1)[0]) for _ in range(5)}
    is_over.set()
    thread.join()
    refused = said - {"1"}
    assert len(refused) == 1
    assert refused.pop().startswith(
        "InputError: phongpd: this process was forked while")
    assert child(lambda: comparison_row(other, 1)[0]) == "1"


def test_a_tracker_is_for_one_thread(space):
    tracker = phongpd.PenetrationTracker(space)
    steps = np.linspace((0.1, 0, 0), (0.4, 0.2, 0), 200000)
    found = in_threads(lambda i: tracker.follow(steps), 2)
    refused = [f for f in found if isinstance(f, phongpd.InputError)]
    assert len(refused) == 1
    assert "tracker: expected one thread" in str(refused[0])
    assert len(tracker.follow(steps[:3])) == 3


def child(work, patience=30):
    """work() in a fork: what it printed; fails if it hangs or crashes."""
    inbox, outbox = os.pipe()
    process = os.fork()
    if process == 0:
        signal.alarm(patience)
        try:
            text = str(work())
        except Exception as error:
            text = f"{type(error).__name__}: {error}"
        os.write(outbox, text.encode())
        os._exit(0)
    os.close(outbox)
    with os.fdopen(inbox) as pipe:
        text = pipe.read()
    assert os.waitpid(process, 0)[1] == 0, "hung or crashed"
    return text


def test_a_fork_goes_on_as_if_nothing_had_happened(world, space, robot, obstacle):
    metric = phongpd.PhongMetric(space)
    truth = metric.query(POINTS).signed_distance
    path = world.plan(START, GOAL).path
    assert child(lambda: (metric.query(POINTS).signed_distance
                          == truth).all()) == "True"
    assert child(lambda: (world.plan(START, GOAL).path == path).all()) == "True"
    assert child(lambda: world.optimize(START, GOAL).free) == "True"
    assert child(lambda: phongpd.depth(robot, obstacle).certified) == "True"
    assert child(lambda: phongpd.ContactSpace.build(
        robot, obstacle).report["triangles"]) == "12"
    # A fork of the fork, and the parent afterwards.
    assert child(lambda: child(lambda: world.is_free([START]).all())) == "True"
    assert (metric.query(POINTS).signed_distance == truth).all()


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_fork_amid_a_computation_is_refused_in_one_line(space):
    # Locks that the other thread holds would never open in the child.
    tracker = phongpd.PenetrationTracker(space)
    steps = np.linspace((0.1, 0, 0), (0.4, 0.2, 0), 2000000)
    thread = threading.Thread(target=tracker.follow, args=(steps,))
    thread.start()
    time.sleep(0.05)
    metric = phongpd.PhongMetric(space)
    said = child(lambda: metric.query(POINTS).signed_distance)
    assert thread.is_alive()
    thread.join()
    assert said.startswith("InputError: phongpd: this process was forked while")
    assert "\n" not in said
    assert child(lambda: len(metric.query(POINTS))) == "5000"


@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int8, np.uint64,
                                   bool, ">f8"])
def test_numbers_of_any_kind_are_taken_as_what_they_are(space, dtype):
    points = np.array([[0, 1, 0], [1, 1, 0]]).astype(dtype)
    metric = phongpd.EuclideanMetric(space)
    truth = metric.query([[0.0, 1, 0], [1.0, 1, 0]]).signed_distance
    assert (metric.query(points).signed_distance == truth).all()
    assert metric.at(points[0]).signed_distance == truth[0]


@pytest.mark.parametrize("dtype", ["U3", "S3", object, "M8[s]", complex])
def test_what_is_no_number_is_refused(space, world, dtype):
    points = np.zeros((2, 3)).astype("i8").astype(dtype)
    for call in (phongpd.EuclideanMetric(space).query, world.is_free,
                 phongpd.PenetrationTracker(space).follow):
        with pytest.raises(phongpd.InputError, match="expected real numbers"):
            call(points)


def test_not_finite_and_empty_and_frozen_arrays_of_every_call(world, robot,
                                                              obstacle, space):
    empty = np.empty((0, 3))
    assert len(world.is_free(empty)) == len(world.clearance(empty)) == 0
    assert len(world.is_motion_free(empty, empty)) == 0
    assert len(phongpd.PenetrationTracker(space).follow(empty)) == 0
    assert phongpd.DepthQuery(robot, obstacle).at(empty) == []
    bad = [[np.nan, 0, 0], [0, np.inf, 0]]
    assert world.is_free(bad).tolist() == [False, False]
    assert world.clearance(bad).tolist() == [0, 0]
    assert world.is_motion_free(bad, [GOAL, GOAL]).tolist() == [False, False]
    assert set(phongpd.PenetrationTracker(space).follow(bad).statuses) == {
        "invalid"}
    for call in (lambda: world.diagnose(bad[0]),
                 lambda: phongpd.depth(robot, obstacle, at=bad[0]),
                 lambda: phongpd.NonPenetrationRows(
                     world, START, GOAL, waypoints=2).value(bad)):
        with pytest.raises(phongpd.InputError):
            call()
    wide = np.zeros((10, 6))
    wide[:, ::2] = POINTS[:10]
    view = wide[:, ::2]
    view.flags.writeable = False
    assert not view.flags.c_contiguous
    assert (world.is_free(view) == world.is_free(POINTS[:10])).all()
    assert (world.clearance(view) == world.clearance(POINTS[:10])).all()
    corners, faces = box_arrays((0, 0, 0), (1, 1, 1))
    frozen = np.asfortranarray(corners)
    frozen.flags.writeable = False
    assert phongpd.Solid(frozen, np.asfortranarray(faces.astype("u1"))).volume == 1
