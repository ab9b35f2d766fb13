# SPDX-License-Identifier: GPL-3.0-or-later
# What answers show of themselves: words, rows, pictures.  Truth: the answers'
# own fields, the data block of the page, pandas.
import base64
import html
import json
import pickle
import re

import numpy as np
import phongpd
import pytest
from conftest import make_box

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)


def data_of(page):
    block = re.search(r'<script type="application/json" id="view-data">(.*?)'
                      "</script>", page, re.DOTALL)
    return json.loads(block.group(1))


def framed(thing):
    """The page within what a notebook shows."""
    shown = thing._repr_html_()
    frame = re.search(r'<iframe srcdoc="([^"]*)"', shown)
    assert frame, shown[:200]
    return html.unescape(frame.group(1))


def triangles_of(mesh):
    return np.frombuffer(base64.b64decode(mesh["indices"]), "<u4").reshape(-1, 3)


@pytest.fixture
def run(world):
    return world.optimize(START, GOAL)


def test_words_say_what_was_answered(world, run, space, robot, obstacle):
    assert str(run).startswith(run.status)
    assert f"{len(run.path)} points" in str(run)
    assert str(world.diagnose(START)) == "free"
    assert str(world.diagnose((0.5, 0, 0))).startswith("in obstacle, at most 0.7")
    assert str(world.diagnose((5, 0, 0))) == "beyond the bounds in x by 1"
    assert "path of" in str(world.plan(START, GOAL))
    wall = make_box((1.5, -9, -9), (2, 9, 9))
    shut = phongpd.World(robot, wall, bounds=[[-3, -3, -3], [4, 3, 3]])
    assert str(shut.plan((-1, 0, 0), (3, 0, 0))).startswith("no path, proved")
    for thing in (run, space, robot, world, world.plan(START, GOAL),
                  world.roadmap(), phongpd.DepthQuery(robot, obstacle),
                  phongpd.PhongMetric(space).at((0, 0, 0)),
                  phongpd.PhongMetric(space).query([(0, 0, 0)]),
                  phongpd.PenetrationTracker(space).follow([(0, 0, 0)])):
        assert len(repr(thing)) < 400 and "object at" not in repr(thing)


def test_rows_are_flat_and_pandas_takes_them(world, run, space, robot, obstacle):
    pandas = pytest.importorskip("pandas")
    answer = phongpd.depth(robot, obstacle, at=(0.1, 0, 0))
    for thing in (run, space, robot, answer, world.plan(START, GOAL),
                  world.diagnose(START), world.roadmap().plan(START, GOAL),
                  phongpd.PhongMetric(space).at((0.3, 0, 0))):
        row = thing.to_row()
        frame = pandas.DataFrame([row, row])
        assert frame.shape == (2, len(row))
        for value in row.values():
            assert isinstance(value, (str, bool, int, float, type(None))), value
    row = answer.to_row()
    assert (row["x"], row["qw"], row["depth"]) == (0.1, 1, answer.depth)
    assert row["direction_x"] == answer.direction[0]
    assert run.to_row()["length"] == pytest.approx(
        np.linalg.norm(np.diff(run.path, axis=0), axis=1).sum())


def test_batches_are_columns(space):
    pandas = pytest.importorskip("pandas")
    points = np.random.default_rng(1).uniform(-1, 2, (50, 3))
    answer = phongpd.PhongMetric(space).query(points)
    frame = pandas.DataFrame(answer.to_columns())
    assert (frame[["x", "y", "z"]].to_numpy() == points).all()
    assert (frame["gradient_z"] == answer.gradient[:, 2]).all()
    assert set(frame["status"]) <= set(answer.WORDS)
    assert list(frame.columns)[:6] == ["x", "y", "z", "status", "inside",
                                       "signed_distance"]
    motion = phongpd.PenetrationTracker(space).follow(points)
    frame = pandas.DataFrame(motion.to_columns())
    assert (frame["penetration_y"] == motion.penetration[:, 1]).all()


def test_one_answer_is_a_row_of_the_batch(space):
    points = np.random.default_rng(2).uniform(-1, 2, (50, 3))
    for metric in (phongpd.PhongMetric(space), phongpd.EuclideanMetric(space)):
        columns = metric.query(points).to_columns()
        for i, q in enumerate(points):
            for key, value in metric.at(q).to_row().items():
                assert value == columns[key][i], key
    assert metric.at((0, 0, 0)).to_row() == metric.at([0.0, 0, 0]).to_row()


def test_one_answer_after_the_other_is_the_tracked_batch(space):
    metric = phongpd.PhongMetric(space)
    line = np.linspace([0.0, 0.1, 0.2], [1.9, 0.1, 0.2], 200)
    tracked = metric.query(line, tracked=True)
    answer = None
    for i, q in enumerate(line):
        answer = metric.at(q, after=answer)
        assert (answer.contact == tracked.contact[i]).all()
        assert answer.status == tracked.statuses[i]
        assert (answer.penetration == tracked.penetration[i]).all()
    assert metric.at((np.nan, 0, 0)).status == "invalid"
    for bad in ((1, 2), (), "abc", None, 3.0, np.zeros((2, 3)), ("a", "b", "c")):
        with pytest.raises(phongpd.InputError, match="q: expected"):
            metric.at(bad)
    with pytest.raises(phongpd.InputError, match="after: expected"):
        metric.at((0, 0, 0), after=(0, 0, 0))


def test_solids_and_contact_spaces_show_their_mesh(robot, space):
    for thing, role in ((robot, "mesh"), (space, "contact")):
        mesh, = data_of(framed(thing))["meshes"]
        assert mesh["role"] == role
        assert (triangles_of(mesh) == thing.triangles).all()


def test_answers_show_the_world_and_the_way(world, run):
    data = data_of(framed(run))
    assert [mesh["name"] for mesh in data["meshes"]] == ["obstacle"]
    assert data["robot"]["triangles"] == 12
    path, = data["paths"]
    assert path["free"] and np.array(path["points"]) == pytest.approx(run.path)
    data = data_of(framed(world.plan(START, GOAL)))
    assert (data["start"], data["goal"]) == (list(START), list(GOAL))
    loaded = phongpd.World.load("u_axis")
    assert data_of(framed(loaded))["start"] == loaded.start.tolist()


def test_a_depth_shows_both_solids_and_where_they_touch(robot, obstacle):
    answer = phongpd.depth(robot, obstacle, at=(0.1, 0, 0))
    shown, = data_of(framed(answer))["answers"]
    assert shown["position"] == [0.1, 0, 0]
    assert shown["depth"] == answer.depth
    assert shown["on_a"] == answer.on_robot.tolist()
    assert data_of(framed(phongpd.depth(robot, robot)))["robot"]


def test_a_view_joins_things_of_one_world(world, run, space, tmp_path):
    plan = world.plan(START, GOAL)
    page = phongpd.view(world, space, plan, phong=run, line=[START, GOAL],
                        title="a <b> & c", notes=["one </script> note"])
    page.write(tmp_path / "page.html")
    data = data_of((tmp_path / "page.html").read_text("utf-8"))
    assert data["title"] == "a <b> & c" and len(data["notes"]) == 1
    assert len(data["meshes"]) == 2
    assert [(p["name"], p["free"]) for p in data["paths"]] == [
        ("plan", True), ("phong", True), ("line", False)]
    assert len(framed(page)) < 2e6


@pytest.mark.parametrize("unit", [None, "mm"])
def test_a_view_calls_lengths_as_the_scene_does(unit, tmp_path):
    box = {"shape": {"type": "box", "size": [1, 1, 1]}}
    scene = {"robot": box, "obstacles": [box], "start": [-3, 0, 0],
             "goal": [3, 0, 0], **({"unit": unit} if unit else {})}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    world = phongpd.World.load(path)
    for shown in (world, world.plan(), phongpd.view(world.optimize())):
        assert data_of(framed(shown))["unit"] == (unit or "units")


def test_what_cannot_be_shown_is_said(world, run, robot, obstacle):
    other = phongpd.World(robot, obstacle)
    for things in (["text"], [world, other], [5],
                   [pickle.loads(pickle.dumps(run))]):
        with pytest.raises(phongpd.InputError, match="view: expected"):
            phongpd.view(*things)
    with pytest.raises(phongpd.InputError, match="path: expected"):
        phongpd.view(np.zeros((4, 2)))
    with pytest.raises(phongpd.InputError, match="path: expected finite"):
        phongpd.view(way=[(0, 0, 0), (0, np.nan, 0)])
    with pytest.raises(phongpd.InputError, match="most_triangles"):
        phongpd.view(robot).html(0)


def ball(n):
    """A sphere of 4 n (n - 1) triangles."""
    around, along = np.meshgrid(np.arange(2 * n), np.arange(1, n))
    theta, phi = np.pi * along / n, np.pi * around / n
    ring = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi),
                     np.cos(theta)], -1).reshape(-1, 3)
    vertices = np.vstack([[[0, 0, 1]], ring, [[0, 0, -1]]])
    faces, last = [], len(vertices) - 1
    for j in range(2 * n):
        k = (j + 1) % (2 * n)
        faces.append((0, 1 + j, 1 + k))
        faces.append((last, last - 2 * n + k, last - 2 * n + j))
        for i in range(n - 2):
            a, b = 1 + i * 2 * n + j, 1 + i * 2 * n + k
            faces += [(a, a + 2 * n, b), (b, a + 2 * n, b + 2 * n)]
    return phongpd.Solid(vertices, np.array(faces), "ball")


def test_a_notebook_gets_a_coarser_mesh_and_is_told_so(monkeypatch):
    solid = ball(100)
    assert len(solid.triangles) == 39600
    data = data_of(framed(solid))
    assert data["meshes"][0]["shown"] <= 30000
    assert "of 39600 triangles are shown" in data["notes"][0]
    assert data_of(phongpd.view(solid).html())["meshes"][0]["shown"] == 39600
    monkeypatch.setattr("phongpd._view._MOST_TRIANGLES", 1000)
    assert "39600 triangles are too many to show here" in solid._repr_html_()


def test_answers_go_through_pickle_without_their_world(run, world, robot,
                                                       obstacle):
    for thing in (run, world.plan(START, GOAL)):
        copy = pickle.loads(pickle.dumps(thing))
        assert copy.world is None and (copy.path == thing.path).all()
        assert copy.to_row() == thing.to_row()
        assert str(copy) == str(thing)
    copy = pickle.loads(pickle.dumps(phongpd.depth(robot, obstacle)))
    assert copy.solids is None and copy.depth == pytest.approx(0.2)
