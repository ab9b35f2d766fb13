# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: pegs and shells whose ways are known.
import numpy as np
import phongpd
import pytest
from conftest import make_box
from scipy.spatial.transform import Rotation

PEG = make_box((-0.5, -0.5, -1), (0.5, 0.5, 1))
SIDES = [make_box((0.5, -2, -0.5), (2, 2, 0.5)),
         make_box((-2, -2, -0.5), (-0.5, 2, 0.5)),
         make_box((-0.5, 0.5, -0.5), (0.5, 2, 0.5)),
         make_box((-0.5, -2, -0.5), (0.5, -0.5, 0.5))]


def test_an_exact_fit_comes_out_along_its_axis_once_it_is_granted():
    tight = phongpd.remove(PEG, SIDES)
    assert tight.status == "start_in_collision" and not tight.out
    assert tight.reason and len(tight.path) == 0
    out = phongpd.remove(PEG, SIDES, tolerance=1e-3)
    assert out.out and out.reason == ""
    assert out.granted == pytest.approx((1e-3, 1e-3 * np.sqrt(3)))
    assert (out.path[0] == 0).all() and abs(out.path[-1][2]) > 1.5
    assert np.abs(out.path[:, :2]).max() < 1.0
    assert out.length == pytest.approx(
        np.linalg.norm(np.diff(out.path, axis=0), axis=1).sum())


def test_what_is_shut_in_is_proved_to_stay():
    walls = [make_box(low, high) for low, high in (
        ((-3, -3, -3), (3, 3, -2)), ((-3, -3, 2), (3, 3, 3)),
        ((-3, -3, -3), (3, -2, 3)), ((-3, 2, -3), (3, 3, 3)),
        ((-3, -3, -3), (-2, 3, 3)), ((2, -3, -3), (3, 3, 3)))]
    held = phongpd.remove(PEG, walls)
    assert held.status == "infeasible_proved"
    # The walls overlap at the edges: nothing is proved of them.
    apart = phongpd.disassemble([PEG, *walls], tolerance=1e-3)
    assert not apart.steps and not apart.complete and not apart.proved
    assert [one.status for one in apart.stuck] == [
        "infeasible_proved", *["start_in_collision"] * 6]
    pile = phongpd.disassemble([walls[0], PEG, walls[1]], tolerance=1e-3)
    assert pile.complete and pile.proved and len(pile.steps) == 2


def test_refuses_bad_input_in_one_line():
    for call, text in ((lambda: phongpd.remove(PEG, []), "expected parts"),
                       (lambda: phongpd.remove(PEG, SIDES, tolerance=-1.0),
                        "tolerance: expected a number >= 0"),
                       (lambda: phongpd.remove(PEG, SIDES, tolerance=0.7),
                        "take a smaller tolerance"),
                       (lambda: phongpd.disassemble([PEG]), "at least 2")):
        with pytest.raises(phongpd.InputError, match=text) as error:
            call()
        assert "\n" not in str(error.value)


def test_a_key_comes_out_of_its_lock_by_a_turn_which_is_found_or_not():
    lock = phongpd.RigidWorld.load("lock:0.09")
    plates = [phongpd.Solid(*plate) for plate in lock.obstacles]
    vertices, triangles = lock.robot[0]
    c = np.sqrt(0.5)
    lying = vertices @ np.array([[c, c, 0], [-c, c, 0], [0, 0, 1]])
    key = phongpd.Solid(lying - (0, 0, 0.75), triangles)
    held = phongpd.remove(key, plates)
    assert held.status == "infeasible_proved" and held.needs_turns
    out = phongpd.remove(key, plates, turn_seconds=100)
    assert out.out and out.needs_turns and len(out.path) == 0
    assert np.allclose(out.poses[0][:3, 3], out.pivot)
    assert np.allclose(out.pivot, (0, 0, 1.15))
    judge = phongpd.RigidJudge((key.vertices - out.pivot, triangles),
                               lock.obstacles)
    assert all(check.free for check in judge.check_path(out.poses))
    # The exact depth at many poses of it, by other code.
    moved = phongpd.Solid(key.vertices - out.pivot, triangles)
    for plate in plates:
        query = phongpd.DepthQuery(moved, plate)
        for pose in out.poses:
            x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat()
            assert query.at(pose[:3, 3], (w, x, y, z)).status == "separate"
    apart = phongpd.disassemble([plates[0], key], turn_seconds=100)
    assert apart.complete and len(apart.steps) == 1
    shut = [make_box(low, high) for low, high in (
        ((-3, -3, -3), (3, 3, -2)), ((-3, -3, 2), (3, 3, 3)),
        ((-3, -3, -3), (3, -2, 3)), ((-3, 2, -3), (3, 3, 3)),
        ((-3, -3, -3), (-2, 3, 3)), ((2, -3, -3), (3, 3, 3)))]
    none = phongpd.remove(PEG, shut, turn_seconds=0.2)
    assert none.status == "time_limit" and none.needs_turns
    assert "no translation takes it out, proved" in none.reason
