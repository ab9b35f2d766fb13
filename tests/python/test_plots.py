# SPDX-License-Identifier: GPL-3.0-or-later
# What answers draw by matplotlib.  Truth: the answers' own arrays and the exact
# judge, asked at the places that were drawn; angles by how the robot was turned.
import pickle
import sys

import numpy as np
import phongpd
import pytest
from conftest import make_box

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)


@pytest.fixture(autouse=True)
def pyplot(monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot
    yield pyplot
    pyplot.close("all")


def drawn(one):
    """Lines of an axis that are no limit, as (x, y)."""
    return [line.get_xydata() for line in one.get_lines()
            if line.get_linestyle() == "-"]


@pytest.mark.parametrize("answer", ["run", "plan", "roadmap"])
def test_a_path_is_drawn_with_its_corners_and_the_room_it_has(world, answer):
    found = {"run": lambda: world.optimize(START, GOAL),
             "plan": lambda: world.plan(START, GOAL),
             "roadmap": lambda: world.roadmap().plan(START, GOAL)}[answer]()
    axes = found.plot()
    places = np.stack([line[:, 1] for line in drawn(axes[0])], axis=1)
    for corner in found.path:
        assert np.linalg.norm(places - corner, axis=1).min() < 1e-12
    way, room = drawn(axes[1])[0].T
    steps = np.linalg.norm(np.diff(found.path, axis=0), axis=1)
    assert way[0] == 0 and way[-1] == pytest.approx(steps.sum())
    assert len(way) >= 400
    assert (room == world.clearance(places)).all()
    assert room.min() == pytest.approx(found.clearance, rel=0.05, abs=1e-3)


def test_what_came_through_pickle_has_a_way_and_no_room(world):
    run = pickle.loads(pickle.dumps(world.optimize(START, GOAL)))
    axes = run.plot()
    assert len(axes) == 1 and len(drawn(axes[0])) == 3


def test_an_answer_without_a_path_is_an_empty_figure(robot):
    wall = make_box((1.5, -9, -9), (2, 9, 9))
    shut = phongpd.World(robot, wall, bounds=[[-3, -3, -3], [4, 3, 3]])
    proof = shut.plan((-1, 0, 0), (3, 0, 0))
    assert proof.infeasible
    assert all(len(line) == 0 for line in drawn(proof.plot()[0]))


def test_a_motion_is_drawn_on_the_axes_it_is_given(world, pyplot):
    motion = world.optimize(START, GOAL, limits=(1, 2, 10))
    _, mine = pyplot.subplots(4, 1)
    assert list(motion.plot(mine)) == list(mine)
    t, y = drawn(mine[1])[1].T
    assert (y == motion.at(t, 1)[:, 1]).all() and t[-1] == motion.duration
    assert np.abs(y).max() <= 1 + 1e-9
    for axes in (mine[:3], mine[0], [1, 2, 3, 4], []):
        with pytest.raises(phongpd.InputError, match="axes: expected 4"):
            motion.plot(axes)


def test_a_rigid_plan_is_drawn_with_its_turn(robot, obstacle):
    start, goal = np.eye(4), np.eye(4)
    start[:3, 3], goal[:3, 3] = (-4, 0, 0), (5, 0, 0)
    goal[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]  # a quarter about z
    plan = phongpd.RigidWorld(robot, obstacle).plan(start, goal)
    assert plan.solved
    axes = plan.plot()
    x = drawn(axes[0])[0][:, 1]
    assert (x == plan.poses[:, 0, 3]).all()
    turn = drawn(axes[1])[0][:, 1]
    assert turn[0] == 0 and turn[-1] == pytest.approx(90.0)
    stuck = phongpd.RigidWorld(robot, robot).plan(np.eye(4), goal)
    assert not stuck.solved
    assert len(drawn(stuck.plot()[1])) == 0


@pytest.mark.parametrize("what", ["path", "motion", "rigid"])
def test_without_matplotlib_one_line_names_it(world, robot, obstacle, what,
                                              monkeypatch):
    run = {"path": lambda: world.plan(START, GOAL),
           "motion": lambda: world.optimize(START, GOAL, limits=(1, 2, 10)),
           "rigid": lambda: phongpd.RigidWorld(robot, robot).plan(
               np.eye(4), np.eye(4))}[what]()
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError) as error:
        run.plot()
    assert str(error.value) == ("plot: expected the package matplotlib, found "
                                "none; pip install matplotlib")
