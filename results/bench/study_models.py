# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of the study's block of others' meshes (results/study/protocol.md):

    build/venv/bin/python -B results/bench/study_models.py MODELS FOLDER --seed S

writes NAME.json to FOLDER for each, start and goal drawn by the seed, of the OFF
files in MODELS (scripts/models.sh), and meshes.csv, which of these are taken and why
the others are not.  What is before the colon of a scene's name is its family.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import random
import zlib
from dataclasses import dataclass

import numpy as np
import phongpd

LEAST, MOST = 100, 8000  # triangles: no mere boxes, no hours
SCANS = ("armadillo", "bunny00")  # known to be scans, taken whatever their size
ALIKE = 0.05  # of a measure: no farther apart, two meshes are one shape
SMALL = 400  # triangles of a mesh that is the robot, too
ROBOT = 0.25  # its diagonal, over the obstacle's
GROUPS, GROUPED = 6, 2000  # scenes of several obstacles, triangles of each of these
# Centres of several obstacles of diagonal 1, the first 3, 4 or 5: boxes in distinct
# places cannot meet, and between any two a ball of ours fits.
STEP = 1.2
CORNERS = STEP * np.array([
    (0, 0, 0), (1, 0, 0), (0.5, math.sqrt(0.75), 0),
    (0.5, math.sqrt(1 / 12), math.sqrt(2 / 3)),
    (0.5, math.sqrt(1 / 12), -math.sqrt(2 / 3))])
BALL = {"shape": {"type": "ball", "radius": 0.08, "triangles": 80}}
BOX = {"shape": {"type": "box", "size": [0.1, 0.12, 0.14]},
       "rotation": {"axis": [1, 2, 3], "degrees": 40}}
TRAP = {"id": "trap", "position": [-0.5, -0.5, -0.25],
        "shape": {"type": "u", "size": 1, "wall": 0.2, "height": 0.5}}
COLUMNS = ("mesh", "triangles", "scan", "left out because")
TRIALS = 1000


@dataclass(frozen=True)
class Model:
    """A mesh file; what is left out has a reason, and measures only if closed."""
    path: pathlib.Path
    reason: str = ""
    triangles: int = 0
    size: float = 0.0  # the diagonal of its box
    centre: tuple = ()
    shape: tuple = ()  # edges of the box and volume, both over the size

    @property
    def name(self):
        return self.path.stem

    @property
    def is_scan(self):
        return self.name in SCANS


def measured(path):
    try:
        solid = phongpd.Solid.read(path)
    except phongpd.InputError as error:
        # Without the file's place, and what to do about it.
        reason = str(error).removeprefix(f"{path}: ").split(", the first near")[0]
        return Model(path, reason)
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    size = float(np.linalg.norm(high - low))
    return Model(path, "", len(solid.triangles), size, tuple((low + high) / 2),
                 (*sorted((high - low) / size), solid.volume / size ** 3))


def alike(a, b):
    return all(abs(x - y) <= ALIKE * max(x, y) for x, y in zip(a.shape, b.shape))


def survey(paths):
    """All of them, by triangles: of two that are alike the coarser one stays."""
    models = [measured(path) for path in paths]
    found = []
    for one in sorted(models, key=lambda m: (m.triangles, m.name)):
        twin = next((m for m in found if not m.reason and alike(m, one)), None)
        reason = one.reason
        if not reason and one.triangles < LEAST:
            reason = f"fewer than {LEAST} triangles"
        elif not reason and one.triangles > MOST and not one.is_scan:
            reason = f"more than {MOST} triangles"
        elif not reason and twin is not None:
            reason = f"the shape of {twin.name}"
        found.append(Model(one.path, reason, one.triangles, one.size, one.centre,
                           one.shape))
    return found


def placed(model, folder, size, at=(0.0, 0.0, 0.0)):
    """The solid of a scene file in the folder: of that diagonal, its box there."""
    scale = size / model.size
    return {"mesh": os.path.relpath(model.path, folder), "scale": scale,
            "position": [float(x - scale * c) for x, c in zip(at, model.centre)]}


def rooms(models, folder):
    """{name: robot and obstacles} of the meshes that are taken."""
    taken = [model for model in models if not model.reason]
    found = {}
    for i, model in enumerate(taken):
        found[model.name] = {
            "robot": (BALL, BOX)[i % 2],
            "obstacles": [{"id": model.name, **placed(model, folder, 1.0)}]}
    for model in taken:
        if model.triangles <= SMALL:
            found[f"{model.name}:robot"] = {
                "robot": placed(model, folder, ROBOT), "obstacles": [TRAP]}
    small = [model for model in taken if model.triangles <= GROUPED]
    for i in range(GROUPS):
        name = f"several{i + 1}"
        group = random.Random(name).sample(small, min(len(small), 3 + i % 3))
        found[name] = {
            "robot": BALL,
            "obstacles": [{"id": model.name, **placed(model, folder, 1.0, at)}
                          for model, at in zip(group, CORNERS)]}
    return found


def pose(at):
    matrix = np.eye(4)
    matrix[:3, 3] = at
    return matrix


def ends(robot, obstacles, chance):
    """Start and goal as scenes of families have them: on a sphere that holds all
    positions of contact, opposite up to 0.3 rad, and the line between collides."""
    corners = np.concatenate([one.vertices for one in obstacles])
    low = corners.min(axis=0) - robot.vertices.max(axis=0)
    high = corners.max(axis=0) - robot.vertices.min(axis=0)
    radius = 0.55 * np.linalg.norm(high - low)
    judge = phongpd.RigidJudge(robot, obstacles)
    for _ in range(TRIALS):
        u, other = chance.normal(size=(2, 3))
        u /= np.linalg.norm(u)
        side = np.cross(u, other)
        side /= np.linalg.norm(side)
        tilt = chance.uniform(-0.3, 0.3)
        v = u * math.cos(tilt) + side * math.sin(tilt)
        start, goal = (low + high) / 2 - radius * u, (low + high) / 2 + radius * v
        if judge.check(pose(start), pose(goal)).status == "collides":
            return start.tolist(), goal.tolist()
    raise SystemExit("expected a straight line that collides, found none")


def file_of(name):
    """That of the scene, in its folder."""
    return name.replace(":", "-") + ".json"


def write_scene(name, room, folder, seed):
    path = folder / file_of(name)
    scene = {"name": name, **room, "start": [0, 0, 0], "goal": [0, 0, 0]}
    path.write_text(json.dumps(scene))
    # Read back, as the program places solids.
    world = phongpd.World.load(path)
    chance = np.random.default_rng([seed, zlib.crc32(name.encode())])
    scene["start"], scene["goal"] = ends(
        world.robot, list(world.obstacles), chance)
    path.write_text(json.dumps(scene, indent=1) + "\n")


def write_meshes(models, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for model in sorted(models, key=lambda m: m.name):
            writer.writerow([model.name, model.triangles or "",
                             "yes" if model.is_scan else "", model.reason])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", type=int, required=True)
    arguments = parser.parse_args()
    models = survey(sorted(arguments.models.glob("*.off")))
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for name, room in rooms(models, arguments.folder).items():
        write_scene(name, room, arguments.folder, arguments.seed)
    write_meshes(models, arguments.folder / "meshes.csv")


if __name__ == "__main__":
    main()
