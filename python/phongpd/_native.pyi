# SPDX-License-Identifier: GPL-3.0-or-later
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int32]
_Bytes = NDArray[np.uint8]
_Point = tuple[float, float, float]

__version__: str

class InputError(ValueError): ...
class BuildCancelled(Exception): ...

class Solid:
    @staticmethod
    def from_arrays(vertices: _Floats, triangles: _Ints, name: str) -> Solid: ...
    @staticmethod
    def read(path: str, name: str) -> Solid: ...
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
    def write(self, path: str) -> None: ...
    vertices: _Floats
    triangles: _Ints
    length: float
    report: dict[str, Any]

class Metric:
    @staticmethod
    def phong(space: ContactSpace, smoothing_length: float,
              is_tangent_plane: bool) -> Metric: ...
    @staticmethod
    def euclidean(space: ContactSpace) -> Metric: ...
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

class DepthQuery:
    def __init__(self, robot: Solid, obstacle: Solid, max_radius: float,
                 max_seconds: float) -> None: ...
    def at(self, positions: _Floats,
           orientations: _Floats | None = None) -> dict[str, Any]: ...
    warnings: list[str]

class Scene:
    @staticmethod
    def make(robot: Solid, obstacles: list[tuple[str, Solid]],
             bounds: tuple[_Point, _Point] | None, name: str) -> Scene: ...
    @staticmethod
    def load(text: str, seed: int | None) -> Scene: ...
    name: str
    start: _Floats
    goal: _Floats
    warnings: list[str]
    robot: Solid
    obstacles: list[Solid]
    bounds: _Floats | None

class World:
    def __init__(self, scene: Scene, cache: bool) -> None: ...
    def optimize(self, start: _Point, goal: _Point, metric: str, margin: str,
                 waypoints: int, seed: int, max_seconds: float,
                 is_straight: bool) -> str: ...
    def plan(self, start: _Point, goal: _Point, planner: str, retraction: str,
             clearance: str, max_seconds: float, seed: int) -> str: ...
    def diagnose(self, q: _Point) -> dict[str, Any]: ...
    def are_free(self, a: _Floats, b: _Floats) -> _Bytes: ...
    def clearances(self, points: _Floats) -> _Floats: ...
    scene: Scene
    length: float
    def contact_spaces(self) -> list[ContactSpace]: ...

class Roadmap:
    def __init__(self, world: World) -> None: ...
    def plan(self, start: _Point, goal: _Point) -> dict[str, Any]: ...
    nodes: int
    edges: int

class Rows:
    def __init__(self, world: World, metric: str, start: _Point, goal: _Point,
                 waypoints: int, samples_per_segment: int,
                 rows: int) -> None: ...
    def start(self, u: _Floats) -> None: ...
    def accept(self, u: _Floats) -> None: ...
    def evaluate(self, u: _Floats) -> tuple[_Floats, _Floats]: ...
    def sparsity(self) -> tuple[_Ints, _Ints]: ...
    variables: int
    rows: int

class View:
    def __init__(self, title: str, notes: list[str]) -> None: ...
    def add_mesh(self, name: str, role: str, vertices: _Floats,
                 triangles: _Ints) -> None: ...
    def set_robot(self, vertices: _Floats, triangles: _Ints) -> None: ...
    def set_ends(self, ends: _Floats) -> None: ...
    def add_path(self, name: str, points: _Floats, is_free: bool) -> None: ...
    def add_answer(self, points: _Floats, orientation: _Floats, status: str,
                   depth: float, clearance: float) -> None: ...
    def page(self, most_triangles: int) -> str: ...
