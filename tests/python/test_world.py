# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: boxes in closed form, the exact planner against itself, differences of
# values, a solver of SciPy's.
import json

import numpy as np
import phongpd
import pytest
from conftest import make_box

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)


def test_length_is_that_of_the_contact_space(world, space):
    assert world.length == pytest.approx(space.length)
    assert world.contact_spaces()[0].length == pytest.approx(space.length)


def test_diagnosis_names_obstacle_and_bound(world):
    blocked = world.diagnose((0.5, 0, 0))
    assert not blocked.free
    assert blocked.contacts[0]["obstacle"] == "obstacle"
    assert blocked.contacts[0]["depth_at_most"] >= 0.7 - 1e-9
    out = world.diagnose((5, 0, 0))
    assert out.excesses[0]["axis"] == 0 and out.excesses[0]["by"] == 1
    assert world.diagnose(START).free


def test_motions_are_judged_whole(world):
    # Both ends are free, the middle is not.
    assert world.is_free([START, GOAL]).tolist() == [True, True]
    assert world.is_motion_free([START], [GOAL]).tolist() == [False]
    assert world.is_motion_free([(-1, 1.5, 0)], [(3, 1.5, 0)]).tolist() == [True]
    assert world.clearance([(-1.2, 0, 0)])[0] == pytest.approx(1)


def test_a_trajectory_is_free_and_keeps_its_margin(world):
    run = world.optimize(START, GOAL, margin="0.02unit")
    assert run.free
    assert run.status in ("solved", "polished")
    assert run.path.shape == (42, 3)
    assert run.path[0] == pytest.approx(START)
    assert world.is_motion_free(run.path[:-1], run.path[1:]).all()
    assert run.clearance > 0.019
    assert run.row["verified"] == "confirmed"
    json.dumps(run.row)
    assert "trajectory" in run._repr_html_()


def test_same_seed_same_path(world):
    one = world.optimize(START, GOAL, seed=3)
    other = world.optimize(START, GOAL, seed=3)
    assert (one.path == other.path).all()


def test_a_plan_is_free_and_a_wall_is_a_proof(robot):
    wall = make_box((1.5, -9, -9), (2, 9, 9))
    world = phongpd.World(robot, {"wall": wall},
                          bounds=[[-3, -3, -3], [4, 3, 3]])
    proof = world.plan((-1, 0, 0), (3, 0, 0))
    assert proof.infeasible and not proof.solved
    assert proof.row["verified"] == "confirmed"
    way = world.plan((-1, 0, 0), (0, 1, 1))
    assert way.solved
    assert world.is_motion_free(way.path[:-1], way.path[1:]).all()


def test_a_plan_in_the_window_is_as_sure_as_one_in_the_whole(robot):
    wall = make_box((1.5, -9, -9), (2, 9, 9))
    world = phongpd.World(robot, {"wall": wall},
                          bounds=[[-3, -3, -3], [4, 3, 3]])
    proof = world.plan((-1, 0, 0), (3, 0, 0), model="window")
    assert proof.infeasible and proof.row["model"] == "window"
    assert proof.row["verified"] == "confirmed"
    assert proof.row["explored_boxes"] > 0
    assert proof.row["contact_triangles"] == 0
    way = world.plan((-1, 0, 0), (0, 1, 1), model="window")
    assert way.solved
    assert world.is_motion_free(way.path[:-1], way.path[1:]).all()
    with pytest.raises(phongpd.InputError, match="model: expected auto"):
        world.plan((-1, 0, 0), (0, 1, 1), model="half")


def test_a_trajectory_in_the_window_follows_what_windows_know(world):
    run = world.optimize(START, GOAL, model="window")
    assert run.free and run.row["model"] == "window"
    assert run.row["metric"] == "none" and "windows" not in run.row
    run = world.optimize(START, GOAL, model="window", metric="euclidean")
    assert run.free and run.row["metric"] == "euclidean"
    assert run.row["windows"]["boxes"] > 0
    with pytest.raises(phongpd.InputError, match="metric: expected euclidean"):
        world.optimize(START, GOAL, model="window", metric="phong")


def test_a_roadmap_answers_like_the_planner(world):
    roadmap = world.roadmap()
    random = np.random.default_rng(8)
    for _ in range(20):
        start, goal = random.uniform(-2.9, 3.9, (2, 3))
        from_map, planned = roadmap.plan(start, goal), world.plan(start, goal)
        assert from_map.solved == planned.solved
        assert from_map.infeasible == planned.infeasible
        if from_map.solved:
            path = from_map.path
            assert world.is_motion_free(path[:-1], path[1:]).all()


def test_scenes_of_the_library_load():
    world = phongpd.World.load("u_axis", seed=1)
    assert world.optimize().free
    with pytest.raises(phongpd.InputError):
        phongpd.World.load("no_such_scene")


# The second ended the interpreter.
@pytest.mark.parametrize("option, value", [
    ("output_file", "precious.txt"),
    ("nlp_scaling_method", "equilibration-based"),
    ("linear_solver", "ma97"),
])
def test_scenes_set_numbers_of_ipopt_only(tmp_path, option, value):
    box = {"shape": {"type": "box", "size": [1, 1, 1]}}
    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps({
        "robot": box, "obstacles": [box], "start": [-2, 0, 0],
        "goal": [2, 0, 0], "trajectory": {"ipopt": {option: value}}}))
    with pytest.raises(phongpd.InputError, match=option):
        phongpd.World.load(str(scene)).optimize()


def test_phong_alone_is_by_the_length_that_holds(world):
    alone, by_default = (world.optimize(START, GOAL, limits="none", metric=name)
                         for name in ("phong", "phong@0.2"))
    assert np.array_equal(alone.path, by_default.path)


def test_rows_are_the_signed_metric_and_their_jacobian_its_slope(world):
    rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=6,
                                      samples_per_segment=3, metric="euclidean")
    u = np.linspace(START, GOAL, 8)[1:-1] + [0.0, 1.3, 0.2]
    d = rows.value(u)
    assert rows.shape == (6 + 7 * 3, 18)
    # Sampled in the order of the path: the first segment's inner points first.
    metric = phongpd.EuclideanMetric(world.contact_spaces()[0])
    path = np.vstack([[START], u, [GOAL]])
    first = np.array(START) + (u[0] - START) * 0.25
    assert d[0] == pytest.approx(metric.query(first).signed_distance[0])
    assert min(d) >= metric.query(path).signed_distance.min() - 1
    slope = rows.jacobian(u)
    for k in range(18):
        step = np.zeros(18)
        step[k] = 1e-6
        change = rows.value(u.ravel() + step) - rows.value(u.ravel() - step)
        assert np.abs(change / 2e-6 - slope[:, k]).max() < 1e-5


def test_scipy_solves_with_the_rows(world):
    optimize = pytest.importorskip("scipy.optimize")
    rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=8,
                                      margin="0.05unit")

    def energy(u):
        steps = np.diff(np.vstack([[START], u.reshape(-1, 3), [GOAL]]), axis=0)
        slope = np.zeros((10, 3))
        slope[1:] += 2 * steps
        slope[:-1] -= 2 * steps
        return (steps ** 2).sum(), slope[1:-1].ravel()

    u = np.linspace(START, GOAL, 10)[1:-1].ravel()
    found = optimize.minimize(
        energy, u, jac=True, method="SLSQP", callback=rows.accept,
        options={"maxiter": 200},
        constraints={"type": "ineq", "fun": lambda u: rows.value(u) - rows.margin,
                     "jac": rows.jacobian})
    path = rows.path(found.x)
    assert rows.value(found.x).min() > rows.margin - 1e-6
    assert world.is_motion_free(path[:-1], path[1:]).all()


@pytest.mark.parametrize("call", [
    lambda w: w.optimize((0, 0), GOAL),
    lambda w: w.optimize((np.nan, 0, 0), GOAL),
    lambda w: w.optimize(START, GOAL, margin=-1),
    lambda w: w.optimize(START, GOAL, margin="wide"),
    lambda w: w.optimize(START, GOAL, metric="other"),
    lambda w: w.optimize(START, GOAL, waypoints=2.5),
    lambda w: w.optimize(START, GOAL, max_seconds=0),
    lambda w: w.plan(START, GOAL, planner="other"),
    lambda w: w.plan(START, GOAL, planner="rrt-connect", clearance=0.01),
    lambda w: w.is_motion_free([START], [GOAL, GOAL]),
    lambda w: phongpd.World(5, {}),
    lambda w: phongpd.World(w.robot, {}),
    lambda w: phongpd.World(w.robot, w.robot, bounds=[[0, 0, 0]]),
    lambda w: phongpd.NonPenetrationRows(w, START, GOAL, waypoints=0),
    lambda w: phongpd.NonPenetrationRows(w, START, GOAL, waypoints=2).value([1]),
])
def test_bad_input_is_said_in_one_line(world, call):
    with pytest.raises(phongpd.InputError) as error:
        call(world)
    assert "\n" not in str(error.value)


def test_a_missed_clearance_is_said_and_an_error_where_required(world):
    room = world.clearance([START, GOAL])
    asked = 1.5 * room.max()
    for ask in (
            lambda **o: world.plan(START, GOAL, clearance=f"{asked}unit", **o),
            lambda **o: world.optimize(START, GOAL, margin=f"{asked}unit", **o)):
        found = ask()
        lengths = found.row["lengths"]
        assert [lengths[end]["unit"] for end in ("start_room", "goal_room")] \
            == pytest.approx(room)
        assert found.row["clearance_shortfall"] == pytest.approx(
            asked - found.clearance)
        assert "the start has" in found.reason
        assert found.status != "clearance_missed"
        missed = ask(require=True)
        assert missed.status == "clearance_missed"
        assert world.is_motion_free(missed.path[:-1], missed.path[1:]).all()
    with pytest.raises(phongpd.InputError, match="clearance"):
        world.plan(START, GOAL, require=True)


def test_lengths_are_in_a_unit_that_has_a_name(tmp_path):
    box = {"shape": {"type": "box", "size": [1, 1, 1]}}
    scene = {"unit": "mm", "robot": box, "obstacles": [box],
             "start": [-3, 0, 0], "goal": [3, 0, 0]}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    world = phongpd.World.load(path)
    assert world.unit == "mm"
    for length in (0.5, "0.5", "0.5mm", "0.5 mm", "0.5unit"):
        for found in (world.plan(clearance=length), world.optimize(margin=length)):
            lengths = found.row["lengths"]
            assert lengths["unit"] == "mm"
            assert lengths["asked_clearance"]["unit"] == 0.5
    for ask in (lambda: world.plan(clearance="0.5cm"),
                lambda: world.optimize(margin="0.5cm"),
                lambda: phongpd.NonPenetrationRows(
                    world, world.start, world.goal, waypoints=2, margin="0.5cm")):
        with pytest.raises(phongpd.InputError, match="unit is mm"):
            ask()


def test_a_large_share_has_to_say_that_it_is_one(world):
    for call in (lambda v: world.plan(START, GOAL, clearance=v),
                 lambda v: world.optimize(START, GOAL, margin=v),
                 lambda v: phongpd.NonPenetrationRows(world, START, GOAL,
                                                      margin=v)):
        for value in (0.5, "0.5", 20):
            with pytest.raises(phongpd.InputError, match="did you mean"):
                call(value)
