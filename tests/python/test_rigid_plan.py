# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: the exact depth at many poses of the path; a plank that has to turn.
import json

import numpy as np
import phongpd
import pytest
from conftest import box_arrays
from scipy.spatial.transform import Rotation

PLANK = box_arrays((-0.1, -0.8, -0.1), (0.1, 0.8, 0.1))
WALLS = [box_arrays((-0.2, -3.25, -1.5), (0.2, -0.25, 1.5)),
         box_arrays((-0.2, 0.25, -1.5), (0.2, 3.25, 1.5))]
BOUNDS = (-4, -3, -1.2), (4, 3, 1.2)


def at(x, about_z=0.0):
    c, s = np.cos(about_z), np.sin(about_z)
    return np.array([[c, -s, 0, x], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def test_a_plank_turns_to_get_through_a_slit():
    world = phongpd.RigidWorld(PLANK, WALLS)
    plan = world.plan(at(-2), at(2, np.pi), bounds=BOUNDS, time_limit=60)
    assert plan.solved and plan.reason == "" and plan.planner != "line"
    assert len(plan.poses) >= 3
    assert np.allclose(plan.poses[0], at(-2), atol=1e-14)
    assert np.allclose(plan.poses[-1], at(2, np.pi), atol=1e-14)
    judge = phongpd.RigidJudge(PLANK, WALLS)
    assert all(check.free for check in judge.check_path(plan.poses))
    assert plan.length > 4
    assert 0 < plan.clearance.lower <= plan.clearance.upper
    assert plan.clearance.motion < len(plan.poses) - 1
    found = judge.clearance(plan.poses)
    assert found.lower == pytest.approx(plan.clearance.lower, rel=2e-3)
    for wall in WALLS:
        query = phongpd.DepthQuery(phongpd.Solid(*PLANK), phongpd.Solid(*wall))
        for pose in plan.poses:
            x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat()
            assert query.at(pose[:3, 3], (w, x, y, z)).status == "separate"
    again = world.plan(at(-2), at(2, np.pi), bounds=BOUNDS, time_limit=60)
    assert (again.poses == plan.poses).all()


def test_a_plan_by_any_number_of_threads_is_the_same_each_time():
    world = phongpd.RigidWorld(PLANK, WALLS)
    for threads in (1, 3):
        one, other = (world.plan(at(-2), at(2, np.pi), bounds=BOUNDS, time_limit=60,
                                 threads=threads) for _ in range(2))
        assert one.solved and (one.poses == other.poses).all()


def test_an_optimised_path_is_proved_and_no_longer_than_the_plan():
    world = phongpd.RigidWorld(PLANK, WALLS)
    found = world.optimize(at(-2), at(2, np.pi), bounds=BOUNDS, time_limit=120,
                           start_from="planner")
    assert found.solved, found.reason
    assert 4 < found.length <= found.planned_length
    assert found.rounds >= 1 and found.iterations >= 1
    assert np.allclose(found.poses[0], at(-2), atol=1e-14)
    assert np.allclose(found.poses[-1], at(2, np.pi), atol=1e-14)
    judge = phongpd.RigidJudge(PLANK, WALLS)
    assert all(check.free for check in judge.check_path(found.poses))
    free = world.optimize(at(-2), at(-3))
    assert (free.status, free.planner, free.length) == ("solved", "line", 1.0)


def test_says_why_there_is_no_path():
    world = phongpd.RigidWorld(PLANK, WALLS)
    inside = world.plan(at(0), at(2), bounds=BOUNDS)
    assert inside.status == "start_in_collision" and inside.reason
    assert inside.poses.shape == (0, 4, 4) and inside.clearance is None
    beyond = world.plan(at(-2), at(9), bounds=BOUNDS)
    assert beyond.status == "goal_out_of_bounds"


def test_refuses_bad_input_in_one_line():
    world = phongpd.RigidWorld(PLANK, WALLS)
    for arguments, text in (
            ({"bounds": (1, 2, 3)}, "bounds: expected"),
            ({"time_limit": 0.0}, "time"), ({"time_limit": np.nan}, "time"),
            ({"threads": 0}, "threads: expected a whole number of at least 1"),
            ({"threads": 65}, "at most 64"), ({"threads": 1.5}, "threads")):
        with pytest.raises(phongpd.InputError, match=text) as error:
            world.plan(at(-2), at(2), **arguments)
        assert "\n" not in str(error.value)
    for arguments, text in (({"knots": 0}, "knots"), ({"margin": -1}, "margin"),
                            ({"start_from": "left"}, "start_from"),
                            ({"start_noise": 2}, "start_noise")):
        with pytest.raises(phongpd.InputError, match=text) as error:
            world.optimize(at(-2), at(2), **arguments)
        assert "\n" not in str(error.value)
    with pytest.raises(phongpd.InputError, match="start"):
        world.plan(np.eye(3), at(2))


def test_a_scene_brings_its_ends_bounds_and_meshes(tmp_path):
    world = phongpd.RigidWorld.load("window")
    assert np.allclose(world.start[:3, 3], (2, 2, 3))
    assert world.bounds.tolist() == [[-5, -5, -5], [5, 5, 5]]
    assert world.warnings == []
    (robot,), (plate,) = world.robot, world.obstacles
    assert robot[0].shape[1] == 3 and robot[1].shape == (20, 3)
    plan = world.plan(time_limit=60)
    assert plan.solved
    assert np.allclose(plan.poses[0], world.start, atol=1e-14)
    query = phongpd.DepthQuery(phongpd.Solid(*robot), phongpd.Solid(*plate))
    for pose in plan.poses:
        x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat()
        assert query.at(pose[:3, 3], (w, x, y, z)).status == "separate"
    # It shows itself, turning, and so does a way of one's own.
    assert '"turns":[[' in phongpd.view(plan).html()
    assert '"turns":[[' in phongpd.view(world, own=plan.poses).html()
    assert plan.to_row()["poses"] == len(plan.poses)
    # One knob, with or without its name; other scenes are World's.
    one = phongpd.RigidWorld.load("peg:play=0.5")
    assert (one.obstacles[0][0] == phongpd.RigidWorld.load("peg:0.5")
            .obstacles[0][0]).all()
    for scene, words in (("tunnel", "World.load"), ("peg:9", r"\[1e-05, 3\]"),
                         ("nothing", "found neither")):
        with pytest.raises(phongpd.InputError, match=words):
            phongpd.RigidWorld.load(scene)
    with pytest.raises(phongpd.InputError, match="start: expected a pose"):
        phongpd.RigidWorld(PLANK, WALLS).plan()
    with pytest.raises(phongpd.InputError, match="RigidWorld|turns"):
        phongpd.World.load("peg")


def test_takes_surfaces_that_are_not_closed_and_says_so(tmp_path):
    sheet = {"type": "triangles", "triangles": [[0, 1, 2]],
             "vertices": [[0, -9, -9], [0, 9, -9], [0, 0, 9]]}
    scene = {"robot": {"turns": True,
                       "shape": {"type": "box", "size": [0.2, 0.2, 0.2]}},
             "obstacles": [{"shape": sheet}], "start": [-1, 0, 0],
             "goal": [1, 0, 0], "planning": {"time_limit": 60}}
    path = tmp_path / "sheet.json"
    path.write_text(json.dumps(scene))
    world = phongpd.RigidWorld.load(path)
    assert len(world.warnings) == 1 and "judged as they are" in world.warnings[0]
    plan = world.plan()
    assert plan.solved and len(plan.poses) > 2
    scene["obstacles"][0]["repair"] = "safe"
    path.write_text(json.dumps(scene))
    with pytest.raises(phongpd.InputError, match="open"):
        phongpd.RigidWorld.load(path)
