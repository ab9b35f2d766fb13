# SPDX-License-Identifier: GPL-3.0-or-later
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int32]
_Bytes = NDArray[np.uint8]
_Point = tuple[float, float, float]

__version__: str
default_smoothing_length: float

class InputError(ValueError): ...
class BuildRefusal(InputError): ...
class BuildCancelled(Exception): ...

class Solid:
    @staticmethod
    def from_arrays(vertices: _Floats, triangles: _Ints, name: str) -> Solid: ...
    @staticmethod
    def read(path: str, name: str) -> tuple[Solid, list[str]]: ...
    def write(self, path: str) -> None: ...
    name: str
    vertices: _Floats
    triangles: _Ints
    volume: float
    components: int
    warnings: list[str]

class ContactSpace:
    @staticmethod
    def build(robot: Solid, obstacle: Solid, robot_hull: bool,
              target_faces: int, wrap: float, outer_shell_only: bool,
              max_seconds: float, max_mib: float,
              cache: bool) -> ContactSpace: ...
    @staticmethod
    def sum(a: Solid, b: Solid, max_seconds: float, max_mib: float,
            cache: bool) -> ContactSpace: ...
    @staticmethod
    def take(solid: Solid) -> ContactSpace: ...
    @staticmethod
    def read(path: str) -> ContactSpace: ...
    def write(self, path: str) -> None: ...
    vertices: _Floats
    triangles: _Ints
    length: float
    report: dict[str, Any]

class ContactSpacePiece:
    @staticmethod
    def build(robot: Solid, obstacle: Solid, index: int, count: int,
              robot_hull: bool, target_faces: int, wrap: float,
              outer_shell_only: bool, max_seconds: float,
              max_mib: float) -> ContactSpacePiece: ...
    @staticmethod
    def read(path: str) -> ContactSpacePiece: ...
    def content(self) -> bytes: ...
    index: int
    count: int
    boxes: int
    faces: int

def join(pieces: Sequence[ContactSpacePiece]) -> ContactSpace: ...

class Metric:
    @staticmethod
    def phong(space: ContactSpace, smoothing_length: float,
              is_tangent_plane: bool) -> Metric: ...
    @staticmethod
    def euclidean(space: ContactSpace) -> Metric: ...
    @staticmethod
    def smoothed(space: ContactSpace, smoothing_length: float,
                 is_at_contact: bool) -> Metric: ...
    def query(self, points: _Floats, is_tracked: bool) -> dict[str, Any]: ...
    def at(self, q: Sequence[float] | _Floats, after: Answer | None) -> Answer: ...

class Answer:
    point: _Floats
    status: int
    inside: bool
    signed_distance: float
    contact: _Floats
    direction: _Floats
    gradient: _Floats
    penetration: _Floats
    triangle: int

class TrackerState:
    def __init__(self) -> None: ...

class PenetrationTracker:
    def __init__(self, space: ContactSpace, ratio: float,
                 speed: float) -> None: ...
    def follow(self, state: TrackerState,
               points: _Floats) -> dict[str, Any]: ...

_Removal = tuple[int, str, str, _Floats, list[tuple[float, ...]], _Floats, bool,
                 float, float, float, float, float]

def remove(part: Solid, rest: Sequence[Solid], tolerance: float,
           verify: bool, turn_seconds: float) -> _Removal: ...
def disassemble(parts: Sequence[Solid], tolerance: float, verify: bool,
                turn_seconds: float) -> tuple[list[_Removal], list[_Removal]]: ...

class RigidJudge:
    def __init__(self, robot: Sequence[tuple[_Floats, _Ints]],
                 obstacles: Sequence[tuple[_Floats, _Ints]]) -> None: ...
    def check(self, poses: _Floats, names: list[str], exact: bool
              ) -> list[tuple[str, float, float, float, tuple[int, int],
                              tuple[int, int], int, bool]]: ...
    def clearance(self, poses: _Floats, names: list[str], relative: float,
                  absolute: float) -> tuple[
        float, float, float, int, tuple[int, int], tuple[int, int], bool,
        int]: ...
    def first_hit(self, poses: _Floats, names: list[str],
                  resolution: float) -> tuple[
        str, float, float, tuple[int, int], tuple[int, int], int]: ...

_RigidAnswer = tuple[
    str, str, list[tuple[float, ...]], float, str, float,
    tuple[float, float, float, int, tuple[int, int], tuple[int, int], bool, int]
    | None]

class RigidWorld:
    def __init__(self, robot: Sequence[tuple[_Floats, _Ints]],
                 obstacles: Sequence[tuple[_Floats, _Ints]]) -> None: ...
    def plan(self, ends: _Floats, bounds: _Floats, time_limit: float,
             seed: int, threads: int) -> _RigidAnswer: ...
    def optimize(self, ends: _Floats, bounds: _Floats, time_limit: float,
                 seed: int, threads: int, start_from: str, knots: int,
                 margin: float, start_noise: float, is_tracked: bool) -> tuple[
        _RigidAnswer, str, bool, float, int, int, int]: ...
    robot: list[tuple[_Floats, _Ints]]
    obstacles: list[tuple[_Floats, _Ints]]

def load_turning(text: str) -> tuple[
    RigidWorld, str, str, list[tuple[float, ...]], _Floats | None, float,
    list[str]]: ...

class DepthQuery:
    def __init__(self, robot: Solid, obstacle: Solid, max_radius: float,
                 max_seconds: float) -> None: ...
    def at(self, positions: _Floats,
           orientations: _Floats | None = None) -> dict[str, Any]: ...
    warnings: list[str]

class Scene:
    @staticmethod
    def make(robot: Solid, obstacles: list[tuple[str, Solid]],
             bounds: tuple[_Point, _Point] | None, name: str,
             unit: str) -> Scene: ...
    @staticmethod
    def load(text: str, seed: int | None) -> Scene: ...
    name: str
    unit: str
    start: _Floats
    goal: _Floats
    warnings: list[str]
    robot: Solid
    obstacles: list[Solid]
    bounds: _Floats | None
    limits: _Floats | None
    limits_by_norm: bool
    via: list[tuple[_Point, str, float]]
    duration: float
    departure: tuple[_Point, _Point]
    arrival: tuple[_Point, _Point]

_Moving = tuple[str, Solid, _Floats, _Floats]

class MotionWishes:
    def __init__(self, limits: tuple[_Point, _Point, _Point],
                 via: list[tuple[_Point, str, float]], duration: float,
                 margin: str, preset: str, max_seconds: float,
                 is_required: bool, routes: int, by_norm: bool,
                 departure: tuple[_Point, _Point],
                 arrival: tuple[_Point, _Point]) -> None: ...

class PathAnswer:
    status: str
    reason: str
    path: _Floats
    is_free: bool
    is_solved: bool
    is_infeasible: bool
    length: float
    clearance: float
    seconds: float
    objective: float
    iterations: int
    duration: float
    durations: _Floats
    points: _Floats
    row: dict[str, Any]

class FleetAnswer:
    status: str
    reason: str
    is_solved: bool
    duration: float
    robots: list[PathAnswer]
    row: dict[str, Any]

class World:
    def __init__(self, scene: Scene, cache: bool,
                 max_mib: float) -> None: ...
    def optimize(self, start: _Point, goal: _Point, *, metric: str,
                 margin: str, waypoints: int, seed: int, max_seconds: float,
                 straight: bool, preset: str, model: str, require: bool,
                 routes: int, budget: float = ...) -> PathAnswer: ...
    def optimize_in_time(self, start: _Point, goal: _Point, model: str,
                         wishes: MotionWishes,
                         moving: list[_Moving]) -> PathAnswer: ...
    def retime(self, path: list[_Point],
               wishes: MotionWishes) -> PathAnswer: ...
    def plan(self, start: _Point, goal: _Point, *, planner: str,
             retraction: str, clearance: str, max_seconds: float, seed: int,
             preset: str, model: str, require: bool,
             budget: float = ...) -> PathAnswer: ...
    def diagnose(self, q: _Point) -> dict[str, Any]: ...
    def are_free(self, a: _Floats, b: _Floats) -> _Bytes: ...
    def clearances(self, points: _Floats) -> _Floats: ...
    def check_curve(
            self, durations: _Floats, points: _Floats, blur: float,
            limits: tuple[_Point, _Point, _Point] | None, by_norm: bool,
            moving: list[_Moving]
    ) -> tuple[str, float, float, int, _Floats, dict[str, float],
               tuple[float, float], int, str]: ...
    scene: Scene
    length: float
    def contact_spaces(self) -> list[ContactSpace]: ...

def load_robots(path: str) -> tuple[str, list[tuple[str, Scene]]]: ...
def optimize_fleet(
        name: str,
        tasks: list[tuple[str, World, _Point, _Point, MotionWishes]],
        moving: list[_Moving]) -> FleetAnswer: ...

class Roadmap:
    def __init__(self, world: World) -> None: ...
    def plan(self, start: _Point, goal: _Point) -> dict[str, Any]: ...
    nodes: int
    edges: int

class Rows:
    def __init__(self, world: World, metric: str, start: _Point, goal: _Point,
                 waypoints: int, margin: str, samples_per_segment: int,
                 max_segment: float, rows: int) -> None: ...
    def start(self, u: _Floats) -> None: ...
    def accept(self, u: _Floats) -> None: ...
    def evaluate(self, u: _Floats) -> tuple[_Floats, _Floats]: ...
    def sparsity(self) -> tuple[_Ints, _Ints]: ...
    margin: float
    max_segment: float
    samples_per_segment: int
    variables: int
    rows: int

class Comparison:
    def __init__(self, scene: str, max_mib: float, cache: bool) -> None: ...
    def row(self, seed: int, protocol: str, metric: str) -> str: ...

class ThreadLimit:
    def __init__(self, threads: int) -> None: ...
    def release(self) -> None: ...
def did_you_mean(word: str, names: list[str]) -> str: ...
def scene_digest(scene: str) -> str: ...
def check_method(protocol: str, metric: str) -> None: ...
def check_planner(planner: str, retraction: str, clearance: str) -> None: ...
class View:
    def __init__(self, title: str, notes: list[str]) -> None: ...
    def add_mesh(self, name: str, role: str, vertices: _Floats,
                 triangles: _Ints) -> None: ...
    def set_robot(self, vertices: _Floats, triangles: _Ints) -> None: ...
    def set_unit(self, name: str) -> None: ...
    def set_ends(self, ends: _Floats) -> None: ...
    def add_path(self, name: str, points: _Floats, is_free: bool) -> None: ...
    def set_turned_ends(self, ends: _Floats) -> None: ...
    def add_turning_path(self, name: str, poses: _Floats,
                         is_free: bool) -> None: ...
    def add_answer(self, points: _Floats, orientation: _Floats, status: str,
                   depth: float, clearance: float) -> None: ...
    def page(self, most_triangles: int) -> str: ...
