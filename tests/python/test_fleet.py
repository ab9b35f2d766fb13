# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: distances of boxes by hand at 10⁴ times, and the program's own rows.
import json
import pickle
import subprocess

import numpy as np
import phongpd
import pytest

from conftest import make_box

LIMITS = (1, 2, 20)


def box(center, size, name):
    half = np.asarray(size) / 2
    return make_box(center - half, center + half, name)


@pytest.fixture
def room():
    return phongpd.World(box((0, 0, 0), (0.2, 0.2, 0.2), "robot"),
                         {"post": box((0, 0, 0), (0.2, 0.2, 2), "post")},
                         bounds=[(-2, -2, -0.1), (2, 2, 0.1)])


def places(motion, times):
    return motion.at(np.minimum(times, motion.duration))


def least_gap(motions, duration):
    times = np.linspace(0, duration, 10_001)
    a, b = (places(one, times) for one in motions)
    gaps = np.maximum(np.abs(a - b) - 0.2, 0)
    return np.linalg.norm(gaps, axis=1).min()


def swap(room, **wishes):
    return phongpd.optimize_fleet(
        {"left": (room, (-1, 0.3, 0), (1, 0.3, 0)),
         "right": (room, (1, 0.3, 0), (-1, 0.3, 0))},
        limits=LIMITS, preset="fast", **wishes)


def test_limits_that_make_them_slow_are_asked_about(room):
    with pytest.warns(UserWarning, match="left: the motion takes"):
        phongpd.optimize_fleet({"left": (room, (-1, 0.3, 0), (1, 0.3, 0))},
                               limits=(1e-3, 2, 20), preset="fast")


def test_robots_change_places(room):
    fleet = swap(room)
    assert fleet.certified
    assert fleet.solved and fleet.status == "converged"
    assert list(fleet.motions) == ["left", "right"]
    assert fleet.duration == max(m.duration for m in fleet.motions.values())
    for motion in fleet.motions.values():
        assert motion.certified and motion.row["verified"] == "confirmed"
    assert places(fleet.motions["left"], [99.0])[0] == pytest.approx(
        (1, 0.3, 0))
    pair, = fleet.pairs
    assert pair["robots"] == ["left", "right"]
    assert pair["certified"] and pair["verified"] == "confirmed"
    least = least_gap(fleet.motions.values(), fleet.duration)
    assert 0 < pair["clearance"] <= least
    assert pair["least"] == pytest.approx(least, rel=0.02, abs=1e-6)
    assert "2 robots" in str(fleet)
    assert fleet.to_row()["clearance"] == pair["clearance"]
    page = phongpd.view(fleet).html()
    assert '"name":"left"' in page and '"name":"right"' in page
    again = pickle.loads(pickle.dumps(fleet))
    assert again.row == fleet.row
    with pytest.raises(phongpd.InputError, match="pickle"):
        phongpd.view(again)


def test_a_scene_file_gives_what_the_program_writes(program, tmp_path):
    scene = {
        "name": "two", "unit": "m", "preset": "fast",
        "robots": [
            {"id": name, "shape": {"type": "box", "size": [0.2, 0.2, 0.2]},
             "start": [x, 0.3, 0], "goal": [-x, 0.3, 0]}
            for name, x in (("a", -1), ("b", 1))],
        "obstacles": [{"shape": {"type": "box", "size": [0.2, 0.2, 2]}}],
        "bounds": {"min": [-2, -2, -0.1], "max": [2, 2, 0.1]},
        "limits": {"velocity": 1, "acceleration": 2, "jerk": 20}}
    path = tmp_path / "two.json"
    path.write_text(json.dumps(scene))
    mine = phongpd.optimize_fleet(path)
    subprocess.run([program, "optimize", str(path), "--output", "t.json"],
                   cwd=tmp_path, check=True, capture_output=True)
    theirs = json.loads((tmp_path / "t.json").read_text())
    assert mine.row["scene"] == "two" and mine.row["unit"] == "m"
    assert mine.row["pairs"] == theirs["pairs"]
    for ours, one in zip(mine.row["robots"], theirs["robots"]):
        assert ours["id"] == one["id"] and ours["pieces"] == one["pieces"]
    with pytest.raises(phongpd.InputError, match="expected one robot here"):
        phongpd.World.load(path)


def test_one_robot_keeps_off_what_moves(room):
    cart = box((0, 0.3, 0), (0.4, 0.2, 0.2), "cart")
    # It comes down the line between start and goal for 3 s.
    moving = {"cart": (cart, ([3.0], [[(0, 1.5, 0), (0, -0.5, 0)]]))}
    free = room.optimize((-1, 0.6, 0), (1, 0.6, 0), limits=LIMITS)
    motion = room.optimize((-1, 0.6, 0), (1, 0.6, 0), limits=LIMITS,
                           moving=moving)
    assert motion.certified and motion.row["moving"] == ["cart"]
    assert motion.duration >= free.duration * (1 - 1e-9)
    times = np.linspace(0, max(3.0, motion.duration), 10_001)
    y = 0.3 + 1.5 - 2.0 * np.minimum(times, 3.0) / 3.0
    apart = np.abs(places(motion, times) - np.column_stack(
        [np.zeros_like(y), y, np.zeros_like(y)]))
    assert ((apart - (0.3, 0.2, 0.2)).max(axis=1) > 0).all()
    # The same by a motion that was found before.
    other = room.optimize((1, -1, 0), (-1, -1, 0), limits=LIMITS)
    off = room.optimize((-1, -1, 0), (1, -1, 0), limits=LIMITS,
                        moving={"other": (room.robot, other)})
    assert off.certified
    assert least_gap([off, other], max(off.duration, other.duration)) > 0


def test_a_fleet_without_a_way_says_who(room):
    narrow = phongpd.World(room.robot, {"post": room.obstacles[0]},
                           bounds=[(-2, 0.25, -0.1), (2, 0.35, 0.1)])
    fleet = swap(narrow)
    assert not fleet.solved and not fleet.certified
    assert "no motion was found" in fleet.reason
    assert fleet.pairs == [] and "no motions" in str(fleet)
    assert fleet.row["tries"] >= 2


@pytest.mark.parametrize("robots, words", [
    ({}, "one at least"),
    ({"a": 5}, r"\(world, start, goal\)"),
])
def test_bad_robots_are_refused(robots, words):
    with pytest.raises(phongpd.InputError, match=words):
        phongpd.optimize_fleet(robots, limits=LIMITS)


def test_bad_fleets_and_movers_are_refused(room):
    one = (room, (-1, 0.3, 0), (1, 0.3, 0))
    with pytest.raises(phongpd.InputError, match="touch at their starts"):
        phongpd.optimize_fleet({"a": one, "b": (room, (-1, 0.4, 0), (1, 1, 0))},
                               limits=LIMITS)
    with pytest.raises(phongpd.InputError, match="limits"):
        phongpd.optimize_fleet({"a": one})
    for moving, words in [
            ({"c": 5}, r"moving: c: expected \(solid, motion\)"),
            ({"c": (room.robot, 5)}, "expected a Motion"),
            ({"c": (room.robot, ([1.0], [[0, 0, 0]]))}, r"points \(N, K, 3\)"),
            ({"c": (room.robot, ([0.0], [[(0, 0, 0), (1, 1, 1)]]))},
             "duration"),
            ({"post": (room.robot, ([1.0], [[(0, 5, 0), (1, 5, 1)]]))},
             "name of its own")]:
        with pytest.raises(phongpd.InputError, match=words):
            room.optimize((-1, 0.3, 0), (1, 0.3, 0), limits=LIMITS,
                          moving=moving)
    with pytest.raises(phongpd.InputError, match="moving"):
        room.optimize((-1, 0.3, 0), (1, 0.3, 0), moving={})
