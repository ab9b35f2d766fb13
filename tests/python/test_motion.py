# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: finite differences, the world's exact test of places, the program's own
# rows, and the kinematics of one axis in closed form.
import json
import pickle
import subprocess
import warnings

import numpy as np
import phongpd
import pytest

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)
LIMITS = (1, 2, 10)


@pytest.fixture
def motion(world):
    return world.optimize(START, GOAL, limits=LIMITS)


def test_a_motion_is_free_and_keeps_its_limits(world, motion):
    assert motion.certified and motion.free
    assert motion.solved
    assert motion.row["verified"] == "confirmed"
    assert motion.points.shape == (len(motion.durations), 6, 3)
    assert motion.durations.sum() == pytest.approx(motion.duration)
    times = np.linspace(0, motion.duration, 2001)
    assert world.is_free(motion.at(times)).all()
    assert motion.at([0.0])[0] == pytest.approx(START, abs=1e-15)
    assert motion.at([motion.duration])[0] == pytest.approx(GOAL, abs=1e-12)
    for order, limit in enumerate(LIMITS, 1):
        assert np.abs(motion.at(times, order)).max() <= limit * (1 + 1e-9)
    assert 0 < motion.clearance <= world.clearance(motion.at(times)).min() + 1e-9


def test_limits_that_make_it_slow_are_asked_about(world):
    slow = {"limits": (1e-3, 2, 10), "preset": "fast"}
    with pytest.warns(UserWarning, match="takes .* s; are the limits") as said:
        world.optimize(START, GOAL, **slow)
    assert said[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        asked = world.optimize(START, GOAL, duration=7200, **slow)
    with pytest.warns(UserWarning, match="are the limits"):
        world.retime(asked.path, limits=(1e-3, 2, 10))


def test_derivatives_are_those_of_the_position(motion):
    h = 1e-5
    inner = np.linspace(2 * h, motion.duration - 2 * h, 300)
    for order in (1, 2):
        left = motion.at(inner - h, order - 1)
        right = motion.at(inner + h, order - 1)
        found = (right - left) / (2 * h)
        assert found == pytest.approx(motion.at(inner, order), abs=2e-4)


def test_samples_are_the_rows_of_the_program(world, motion):
    rows = motion.samples(50)
    assert rows.shape == (int(motion.duration * 50) + 2, 10)
    assert rows[-1, 0] == motion.duration
    assert np.diff(rows[:-1, 0]) == pytest.approx(0.02)
    assert rows[:, 1:4] == pytest.approx(motion.at(rows[:, 0]))
    assert rows[:, 7:10] == pytest.approx(motion.at(rows[:, 0], 2))


def test_the_program_answers_the_same(tmp_path, program):
    out = tmp_path / "t.json"
    subprocess.run([program, "optimize", "plate_hole", "--limits", "1,2,10",
                    "--duration", "12", "--output", out, "--no-cache"],
                   check=True, capture_output=True)
    world = phongpd.World.load("plate_hole")
    assert world.limits is None
    mine = world.optimize(limits=LIMITS, duration=12)
    theirs = json.loads(out.read_text())
    assert mine.row["pieces"] == theirs["pieces"]
    assert mine.row["asked_duration"] == 12
    assert mine.duration == pytest.approx(12)


def test_it_passes_places_and_rests_there(world):
    via = [(-1.5, 1, 0), (0.5, 2, 0.5)]
    motion = world.optimize(START, GOAL, limits=LIMITS, via=via,
                            tolerance=["0.01unit", "0.02unit"],
                            dwell=[0, 0.5])
    assert motion.certified
    times = np.linspace(0, motion.duration, 20001)
    ways = [np.linalg.norm(motion.at(times) - place, axis=1) for place in via]
    assert ways[0].min() < 0.011 and ways[1].min() < 1e-12
    assert ways[0].argmin() < ways[1].argmin()
    still = times[ways[1] < 1e-12]
    assert still[-1] - still[0] == pytest.approx(0.5, abs=1e-3)


def test_it_begins_and_ends_as_it_is_told(world):
    motion = world.optimize(START, GOAL, limits=LIMITS,
                            departure=[(0, 0.4, 0.1), (0.1, 0, 0)],
                            arrival=(0, -0.2, 0))
    assert motion.certified
    ends = np.array([0.0, motion.duration])
    assert motion.at(ends, 1) == pytest.approx(
        np.array([(0, 0.4, 0.1), (0, -0.2, 0)]), abs=1e-9)
    assert motion.at(ends, 2) == pytest.approx(
        np.array([(0.1, 0, 0), (0, 0, 0)]), abs=1e-7)


def test_a_path_of_ones_own_is_retimed(world):
    # Along one axis with room: 2 (d / a)^1/2 at least, with limits of jerk more.
    path = np.array([(-1, 2, 2), (1, 2, 2), (3, 2, 2)])
    motion = world.retime(path, limits=((9, 1, 1), 2, 1e3), preset="tight")
    assert motion.certified and motion.row["planner"] is None
    assert 2 * np.sqrt(4 / 2) < motion.duration < 2 * np.sqrt(4 / 2) * 1.1
    blocked = world.retime([START, GOAL], limits=LIMITS)
    assert blocked.status == "not_free" and not blocked.certified
    assert "segment 0" in blocked.reason
    assert blocked.samples().shape == (0, 10)
    assert "no motion" in str(blocked)


def test_limits_of_the_norm_are_kept_by_the_norm(world):
    by_axis = world.optimize(START, GOAL, limits=LIMITS)
    motion = world.optimize(START, GOAL, limits=LIMITS, by_norm=True)
    assert motion.solved and motion.row["limits"]["by"] == "norm"
    times = np.linspace(0.0, motion.duration, 2001)
    for order, limit in enumerate(LIMITS, 1):
        norms = np.linalg.norm(motion.at(times, order), axis=1)
        assert norms.max() <= limit * (1 + 1e-9)
    # The norm is at least each coordinate: what keeps it takes no less time.
    assert motion.duration >= by_axis.duration * (1 - 1e-3)


def test_several_routes_are_never_slower(world):
    wish = {"limits": LIMITS, "preset": "fast", "margin": 1e-6}
    one = world.optimize(START, GOAL, **wish)
    best = world.optimize(START, GOAL, routes=4, **wish)
    assert best.duration <= one.duration
    assert 1 <= best.row["routes"] <= 4 and one.row["routes"] == 1


def test_limits_places_and_duration_may_be_the_scenes(tmp_path):
    box = {"shape": {"type": "box", "size": [1, 1, 1]}}
    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps({
        "robot": box, "obstacles": [box], "start": [-2, 0, 0],
        "goal": [2, 0, 0], "limits": {"velocity": [1, 2, 3],
                                      "acceleration": 2, "jerk": 10},
        "via": [{"point": [0, 2, 0], "tolerance": "0.2D"}], "duration": 15}))
    world = phongpd.World.load(scene)
    assert world.limits.tolist() == [[1, 2, 3], [2, 2, 2], [10, 10, 10]]
    motion = world.optimize()
    assert motion.duration == pytest.approx(15)
    assert motion.row["via"][0]["tolerance"]["share"] == pytest.approx(0.2)
    fast = world.optimize(via=np.empty((0, 3)), duration=0)
    assert fast.duration < 15 and fast.row["via"] == []
    path = world.optimize(limits="none")
    assert isinstance(path, phongpd.Trajectory) and path.free


def test_its_first_name_warns_and_answers_the_same(world, motion):
    with pytest.warns(DeprecationWarning, match="optimize"):
        again = world.optimize_in_time(START, GOAL, limits=LIMITS)
    assert again.duration == motion.duration
    with pytest.warns(DeprecationWarning), \
            pytest.raises(phongpd.InputError, match="limits"):
        world.optimize_in_time(START, GOAL)


def test_a_motion_shows_itself_and_travels(motion):
    assert "motion" in motion._repr_html_()
    assert phongpd.view(motion).html()
    assert motion.to_row()["certified"] is True
    copy = pickle.loads(pickle.dumps(motion))
    assert copy.at([1.0]) == pytest.approx(motion.at([1.0]))
    with pytest.raises(phongpd.InputError, match="pickle"):
        phongpd.view(copy)


def test_it_is_plotted_with_its_limits(motion):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    axes = motion.plot()
    assert len(axes) == 4
    for order, one in enumerate(axes):
        curves = [line for line in one.lines if len(line.get_xdata()) > 2]
        assert [line.get_label() for line in curves] == ["x", "y", "z"]
        t = curves[0].get_xdata()
        for k, line in enumerate(curves):
            assert line.get_ydata() == pytest.approx(motion.at(t, order)[:, k])
        dashed = sorted(line.get_ydata()[0] for line in one.lines
                        if len(line.get_xdata()) == 2)
        assert dashed == ([] if order == 0 else
                          [-LIMITS[order - 1], LIMITS[order - 1]])
    pyplot.close("all")


@pytest.mark.parametrize("given, words", [
    ({"limits": 3}, "limits: expected"),
    ({"limits": (1, 2)}, "limits: expected"),
    ({"limits": ((1, 2), 2, 3)}, "limits: velocity"),
    ({"limits": (0, 2, 3)}, "velocity"),
    ({"limits": (1, 2, np.nan)}, "jerk"),
    ({"limits": ((1, 2, 3), 2, 3), "by_norm": True}, "velocity"),
    ({"limits": LIMITS, "routes": 9}, "routes"),
    ({"limits": LIMITS, "via": (1, 2)}, "via: expected shape"),
    ({"limits": LIMITS, "via": (np.inf, 2, 0)}, "via 0"),
    ({"limits": LIMITS, "via": (0, 2, 0), "tolerance": [1, 2]}, "tolerance"),
    ({"limits": LIMITS, "via": (0, 2, 0), "tolerance": 0}, "tolerance"),
    ({"limits": LIMITS, "via": (0, 2, 0), "dwell": -1}, "dwell"),
    ({"limits": LIMITS, "via": (0, 2, 0), "dwell": [1, 2]}, "dwell"),
    ({"limits": LIMITS, "duration": -1}, "duration"),
    ({"limits": LIMITS, "departure": (1, 2)}, "departure: expected shape"),
    ({"limits": LIMITS, "arrival": (0, np.nan, 0)}, "arrival"),
    ({"arrival": (0, 1, 0)}, "arrival: expected none"),
    ({"limits": LIMITS, "duration": "soon"}, "duration"),
    ({"limits": LIMITS, "max_seconds": 0}, "max_seconds"),
    ({"limits": LIMITS, "preset": "slow"}, "preset"),
    ({"limits": LIMITS, "margin": "-1unit"}, "margin"),
    ({"limits": "fast"}, "limits: expected"),
    ({"limits": LIMITS, "metric": "euclidean"}, "metric: expected none"),
    ({"limits": LIMITS, "straight": True}, "straight: expected none"),
    ({"limits": LIMITS, "waypoints": 3}, "waypoints: expected none"),
    ({"limits": "none", "via": (0, 2, 0)}, "via: expected none"),
    ({"via": (0, 2, 0)}, "via: expected none"),
    ({"dwell": [1.0]}, "dwell: expected none"),
    ({"duration": 0}, "duration: expected none"),
    ({"by_norm": True}, "by_norm: expected none"),
    ({"routes": 9}, "routes"),
])
def test_it_refuses_in_one_line(world, given, words):
    with pytest.raises(phongpd.InputError, match=words) as error:
        world.optimize(START, GOAL, **given)
    assert "\n" not in str(error.value)


def test_questions_out_of_range_are_refused(world, motion):
    for times in ([-0.1], [motion.duration * 1.01], [[0.0]], [np.nan]):
        with pytest.raises(phongpd.InputError, match="times"):
            motion.at(times)
    with pytest.raises(phongpd.InputError, match="order"):
        motion.at([0.0], 4)
    for rate in (0, -1, np.nan, 1e7):
        with pytest.raises(phongpd.InputError, match="rate"):
            motion.samples(rate)
    with pytest.raises(phongpd.InputError, match="two points"):
        world.retime([START], limits=LIMITS)
