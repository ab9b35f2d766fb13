# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of others' meshes: which meshes are taken and why not, and what the scenes
made of them are, asked of the contact space and of boxes."""
import csv
import json
import pathlib
import sys

import numpy as np
import phongpd
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results/bench"))
import study_models  # noqa: E402


def write_off(path, vertices, triangles):
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, map(float, v))) for v in vertices]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("models")
    ball = phongpd.World.load("u_axis").robot
    write_off(folder / "ball.off", ball.vertices, ball.triangles)
    write_off(folder / "open.off", ball.vertices, ball.triangles[1:])
    write_off(folder / "larger.off", 7.0 * ball.vertices + 3.0, ball.triangles)
    box = phongpd.World.load("plate").obstacles[0]
    write_off(folder / "plate.off", box.vertices, box.triangles)
    for family, name in (("torus_hole:around=24,across=12", "torus"),
                         ("ball_wrench", "wrench")):
        one = phongpd.World.load(family).obstacles[0]
        write_off(folder / f"{name}.off", one.vertices, one.triangles)
    return folder


@pytest.fixture(scope="module")
def models(folder):
    return study_models.survey(sorted(folder.glob("*.off")))


def test_closed_meshes_are_taken_and_others_told_why(models):
    reasons = {model.name: model.reason for model in models}
    assert reasons.pop("open").startswith("no closed surface; expected every edge")
    assert reasons == {"ball": "", "torus": "", "wrench": "",
                       "larger": "the shape of ball",
                       "plate": "fewer than 100 triangles"}


def test_large_meshes_are_taken_only_if_scans(folder, monkeypatch):
    monkeypatch.setattr(study_models, "MOST", 200)
    reasons = [study_models.survey([folder / "ball.off"])[0].reason]
    monkeypatch.setattr(study_models, "SCANS", ("ball",))
    reasons += [study_models.survey([folder / "ball.off"])[0].reason]
    assert reasons == ["more than 200 triangles", ""]


def test_obstacles_have_one_size_and_stay_apart(folder, models, tmp_path):
    rooms = study_models.rooms(models, tmp_path)
    assert [name for name in rooms if name.startswith("several")] == [
        f"several{i}" for i in range(1, 7)]
    study_models.write_scene("several1", rooms["several1"], tmp_path, 5)
    solids = phongpd.World.load(tmp_path / "several1.json").obstacles
    assert len(solids) == 3
    boxes = [(s.vertices.min(axis=0), s.vertices.max(axis=0)) for s in solids]
    for low, high in boxes:
        assert np.linalg.norm(high - low) == pytest.approx(1.0)
    for i, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:i]:
            gap = np.maximum(0.0, np.maximum(low - other_high, other_low - high))
            assert np.linalg.norm(gap) > 0.16  # what the ball is across
    corners = study_models.CORNERS
    assert min(np.linalg.norm(a - b) for i, a in enumerate(corners)
               for b in corners[:i]) == pytest.approx(1.2)


def test_start_and_goal_are_free_and_the_line_between_collides(models, tmp_path):
    for name, room in study_models.rooms(models, tmp_path).items():
        study_models.write_scene(name, room, tmp_path, 5)
        path = tmp_path / f"{name.replace(':', '-')}.json"
        world = phongpd.World.load(path)
        assert world.name == name
        assert world.is_free([world.start, world.goal]).all(), name
        assert not world.is_motion_free([world.start], [world.goal])[0], name


def test_scenes_are_those_of_their_seed(models, tmp_path):
    room = study_models.rooms(models, tmp_path)["torus"]
    found = []
    for seed in (5, 5, 6):
        study_models.write_scene("torus", room, tmp_path, seed)
        found.append(json.loads((tmp_path / "torus.json").read_text())["start"])
    assert found[0] == found[1] != found[2]


def test_the_list_of_meshes_tells_all_of_them(models, tmp_path):
    study_models.write_meshes(models, tmp_path / "meshes.csv")
    with open(tmp_path / "meshes.csv", newline="") as file:
        rows = {row["mesh"]: row for row in csv.DictReader(file)}
    assert sorted(rows) == sorted(model.name for model in models)
    assert rows["ball"]["left out because"] == rows["ball"]["scan"] == ""
    assert rows["open"]["triangles"] == ""


if __name__ == "__main__":
    sys.exit(pytest.main([__file__, "-q", "-p", "no:cacheprovider"]))
