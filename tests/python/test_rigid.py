# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: a square that turns, in closed form: its corners get to the root of 2.
import numpy as np
import phongpd
import pytest
from conftest import box_arrays, make_box


def pose(x=0.0, y=0.0, z=0.0, about_z=0.0):
    c, s = np.cos(about_z), np.sin(about_z)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])


CUBE = box_arrays((-1, -1, -1), (1, 1, 1))
QUARTER = pose(), pose(about_z=np.pi / 2)


def wall(gap):
    low = np.sqrt(2) + gap
    return box_arrays((low, -5, -4), (low + 1, 4, 3))


def test_a_turning_cube_needs_room_for_its_corners():
    for gap in (0.3, 1e-3, 1e-6):
        check = phongpd.RigidJudge(CUBE, wall(gap)).check(*QUARTER)
        assert check.free and check.status == "free"
        assert check.robot == check.obstacle == (-1, -1)
        check = phongpd.RigidJudge(CUBE, wall(-gap)).check(*QUARTER)
        assert check.status == "collides" and not check.free
        assert check.time == pytest.approx(0.5, abs=0.3)
        assert check.interval[0] <= check.time <= check.interval[1]
        assert check.robot[0] == check.obstacle[0] == 0
        assert min(check.robot[1], check.obstacle[1]) >= 0
    check = phongpd.RigidJudge(CUBE, wall(0.0)).check(*QUARTER)
    assert check.status == "undecided"
    assert np.allclose(check.interval, 0.5, atol=1e-3)


def test_the_first_contact_is_where_the_corner_meets_the_wall():
    # Two corners at radius root 2, at -45 and 45 degrees; the wall at x.
    for x in (1.05, 1.2, 1.4):
        judge = phongpd.RigidJudge(CUBE, wall(x - np.sqrt(2)))
        hit = judge.first_hit(*QUARTER)
        truth = (np.pi / 4 - np.arccos(x / np.sqrt(2))) / (np.pi / 2)
        first, last = hit.interval
        assert hit.status == "collides" and not hit.free
        assert first <= truth + 1e-12 and truth - 1e-12 <= last
        assert last - first <= 1e-9
        assert hit.robot[0] == hit.obstacle[0] == 0
        wide = judge.first_hit(*QUARTER, resolution=1e-3)
        assert wide.interval[1] - wide.interval[0] <= 1e-3
    free = phongpd.RigidJudge(CUBE, wall(1e-3)).first_hit(*QUARTER)
    assert free.free and free.interval == (0.0, 1.0)
    inside = phongpd.RigidJudge(
        CUBE, box_arrays((-9, -9, -9), (9, 9, 9))).first_hit(*QUARTER)
    assert inside.status == "collides" and inside.interval == (0.0, 0.0)
    for bad in (0.0, -1.0, 2.0, np.nan):
        with pytest.raises(phongpd.InputError, match="resolution"):
            judge.first_hit(*QUARTER, resolution=bad)


def test_the_clearance_is_what_the_corner_leaves():
    for gap in (0.3, 1e-3, 1e-6):
        judge = phongpd.RigidJudge(CUBE, wall(gap))
        found = judge.clearance(*QUARTER)
        assert found.resolved and found.lower > 0
        assert found.lower <= gap * (1 + 1e-9) <= found.upper * (1 + 1e-8)
        assert found.upper - found.lower <= 1.0001e-3 * found.upper + 1e-8
        assert found.time == pytest.approx(0.5, abs=0.05)
        assert found.robot[0] == found.obstacle[0] == found.motion == 0
        coarse = judge.clearance(*QUARTER, relative=0.0, absolute=0.1)
        assert coarse.upper - coarse.lower <= 0.1 * 1.001
    judge = phongpd.RigidJudge(CUBE, wall(0.3))
    way = np.stack([pose(-5), pose(-2), pose(), pose(about_z=np.pi / 2),
                    pose(-3)])
    path = judge.clearance(way)
    assert path.motion == 2
    assert path.lower <= 0.3 <= path.upper <= 0.3 * 1.01
    at_rest = judge.clearance(way[:1])
    assert at_rest.lower <= np.sqrt(2) + 0.3 + 4 <= at_rest.upper * (1 + 1e-9)
    hit = phongpd.RigidJudge(CUBE, wall(-0.1)).clearance(*QUARTER)
    assert hit.lower == 0 and hit.upper < 1e-6
    for bad in ({"relative": 1.0}, {"relative": -1}, {"absolute": np.nan}):
        with pytest.raises(phongpd.InputError, match=next(iter(bad))):
            judge.clearance(*QUARTER, **bad)
    for bad in ((pose(),), (np.zeros((0, 4, 4)),), (np.zeros(3),)):
        with pytest.raises(phongpd.InputError, match="poses: expected"):
            judge.clearance(*bad)


def test_what_is_undecided_is_decided_exactly_if_asked():
    at_two = phongpd.RigidJudge(CUBE, box_arrays((2, -5, -4), (3, 4, 3)))
    ends = pose(), pose(1)
    assert at_two.check(*ends).status == "undecided"
    assert not at_two.check(*ends).exact
    check = at_two.check(*ends, exact=True)
    assert check.exact and check.status == "collides" and check.time == 1.0
    sure = at_two.check(pose(), pose(0.5), exact=True)
    assert sure.free and not sure.exact
    path = at_two.check_path([pose(), pose(0.5), pose(1)], exact=True)
    assert [c.status for c in path] == ["free", "collides"]
    assert [c.exact for c in path] == [False, True]
    assert path[1].to_row()["exact"] is True


def test_takes_solids_files_arrays_and_lists(tmp_path):
    low, high = (1.3, -5, -4), (2, 4, 3)
    solid = make_box(low, high)
    file = tmp_path / "wall.off"
    solid.write(file)

    class Mesh:
        vertices, faces = box_arrays(low, high)

    far = make_box((9, 9, 9), (10, 10, 10))
    for obstacle in (solid, file, str(file), Mesh, box_arrays(low, high)):
        for others in ([], [far]):
            judge = phongpd.RigidJudge([CUBE], [*others, obstacle])
            check = judge.check(*QUARTER)
            assert check.status == "collides"
            assert check.obstacle[0] == len(others)
            assert check.robot[0] == 0
        assert phongpd.RigidJudge(CUBE, obstacle).check(*QUARTER) == \
            phongpd.RigidJudge([CUBE], [obstacle]).check(*QUARTER)


def test_a_surface_needs_no_volume():
    vertices, triangles = wall(-0.1)
    sheet = vertices, triangles[:2]
    assert not phongpd.RigidJudge(CUBE, sheet).check(*QUARTER).free
    inside = box_arrays((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1))
    assert phongpd.RigidJudge(inside, CUBE).check(*QUARTER).status == "collides"
    hull = CUBE[0], CUBE[1][:-1]  # without a lid it holds nothing
    assert phongpd.RigidJudge(inside, hull).check(*QUARTER).free


def test_a_path_is_its_motions():
    judge = phongpd.RigidJudge(CUBE, wall(-0.1))
    way = np.stack([pose(-1), pose(-1, about_z=0.7), pose(0, about_z=0.7),
                    pose(0.3)])
    checks = judge.check_path(way)
    assert [c.status for c in checks] == ["free", "free", "collides"] or \
        [c.status for c in checks] == ["free", "collides", "collides"]
    assert checks == [judge.check(a, b) for a, b in zip(way, way[1:])]
    row = checks[0].to_row()
    assert row["status"] == "free" and row["robot_mesh"] == -1
    for value in row.values():
        assert isinstance(value, (str, int, float))
    assert len(repr(checks)) < 800


def test_agrees_with_sampled_depths():
    random = np.random.default_rng(3)
    a = make_box((-0.5, -0.2, -0.1), (0.5, 0.2, 0.1))
    b = make_box((-0.6, -0.5, -0.4), (0.6, 0.5, 0.4))
    judge, query = phongpd.RigidJudge(a, b), phongpd.DepthQuery(a, b)
    outcomes = []
    for _ in range(60):
        start = pose(*random.uniform(-1.2, 1.2, 3), 0.0)
        end = pose(*random.uniform(-1.2, 1.2, 3), random.uniform(-2, 2))
        check = judge.check(start, end)
        outcomes.append(check.status)
        angle = np.arctan2(end[1, 0], end[0, 0])
        times = (np.linspace(0, 1, 20) if check.free else [check.time])
        for t in times:
            at = start[:3, 3] + t * (end[:3, 3] - start[:3, 3])
            turn = (np.cos(t * angle / 2), 0, 0, np.sin(t * angle / 2))
            found = query.at(at, turn).status
            assert found == ("separate" if check.free else "penetrating")
    assert outcomes.count("free") > 5 and outcomes.count("collides") > 20


BAD = {
    "a vector": (np.zeros(3), "shape (4, 4)"),
    "a 3 x 3 matrix": (np.eye(3), "shape (4, 4)"),
    "text": ("abc", "expected real numbers"),
    "none": (None, "expected real numbers"),
    "nan": (pose(x=np.nan), "finite pose"),
    "scaled": (np.diag([2.0, 2, 2, 1]), "expected a rotation"),
    "mirrored": (np.diag([1.0, 1, -1, 1]), "reflection"),
    "sheared": (np.eye(4) + np.eye(4, k=1) * [[1e-3], [0], [0], [0]],
                "0.001 off"),
    "projective": (np.diag([1.0, 1, 1, 2]), "last row of 0, 0, 0, 1"),
}


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_pose_is_said(name):
    value, words = BAD[name]
    judge = phongpd.RigidJudge(CUBE, wall(1.0))
    with pytest.raises(phongpd.InputError) as error:
        judge.check(pose(), value)
    assert "end" in str(error.value) and words in str(error.value)
    with pytest.raises(phongpd.InputError, match="start"):
        judge.check(value, pose())


def test_what_is_no_mesh_or_path_is_said():
    vertices, triangles = CUBE
    for bad, words in (
            (3, "robot: expected a Solid"), (None, "robot: expected a Solid"),
            ([], "mesh of the robot, found none"),
            ((vertices, triangles + 5), "8 vertices, found"),
            ((vertices, -triangles), "expected existing vertices"),
            ((vertices, triangles * 1.0), "expected whole numbers"),
            ((vertices[:, :2], triangles), "expected shape (N, 3)"),
            ((vertices * np.nan, triangles), "finite coordinates"),
            ((vertices, triangles[:0]), "expected triangles, found none"),
            ([CUBE, (vertices, triangles[:0])], "robot, mesh 1"),
            ("no such file.off", "no such file.off")):
        with pytest.raises(phongpd.InputError) as error:
            phongpd.RigidJudge(bad, CUBE)
        assert words in str(error.value)
        assert "\n" not in str(error.value)
    judge = phongpd.RigidJudge(CUBE, CUBE)
    for bad in (np.zeros((0, 4, 4)), np.eye(4), np.stack([np.eye(4)]), "a"):
        with pytest.raises(phongpd.InputError, match="poses"):
            judge.check_path(bad)
    with pytest.raises(phongpd.InputError, match="pose 1: expected a rotation"):
        judge.check_path([np.eye(4), np.diag([2.0, 1, 1, 1])])
