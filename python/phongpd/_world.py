# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answers import Diagnosis, Plan, Trajectory
from ._arguments import Floats, flag, length, motion_end, places_on_the_way, \
    point, real, rows, scene_name, seconds, text, whole_number
from ._contact import ContactSpace
from ._motion import Motion, motion_of, moving_of, wishes_of
from ._native import InputError
from ._solid import Solid, as_solid
from ._view import Canvas, Shown

if TYPE_CHECKING:
    from ._roadmap import Roadmap

_MOST_SEED = 2 ** 64 - 1
_Point = Tuple[float, float, float]


class World(Shown):
    """A robot that translates among obstacles, perhaps within bounds.

    Contact spaces are built when something asks for them, once, and kept;
    moving start and goal builds nothing.  Safe to use from several threads;
    optimisations and plans of one world wait for each other.
    """

    def __init__(self, robot: Any, obstacles: Any, *,
                 bounds: ArrayLike | None = None, name: str = "world",
                 cache: bool = False, max_mib: float = 0.0) -> None:
        """robot: Solid, file or mesh.  obstacles: one, or a dict of them by
        name.  bounds: (2, 3), least and greatest position of the robot; None:
        none.  cache: keep contact spaces in the user's cache folder.
        max_mib: of a build, as ContactSpace.build has it."""
        if not isinstance(obstacles, Mapping):
            obstacles = {"obstacle": obstacles}
        named = [(str(key), as_solid(value, str(key))._native)
                 for key, value in obstacles.items()]
        box = None
        if bounds is not None:
            corners = rows(bounds, "bounds", 3)
            if len(corners) != 2:
                raise InputError(
                    f"bounds: expected shape (2, 3), found {corners.shape}")
            box = (point(corners[0], "bounds"), point(corners[1], "bounds"))
        self._open(_native.Scene.make(as_solid(robot, "robot")._native, named,
                                      box, text(name, "name")), cache, max_mib)

        self._has_ends = False

    def _open(self, scene: Any, cache: bool, max_mib: float) -> None:
        self._native = _native.World(scene, flag(cache, "cache"),
                                     real(max_mib, "max_mib", "MiB"))

    @classmethod
    def load(cls, scene: str | os.PathLike[str], *, seed: int | None = None,
             cache: bool = False, max_mib: float = 0.0) -> World:
        """Of a scene file, or of a family with knobs as the command line takes
        them: "u_axis", "plate:thickness=0.02"; seed: of a family; the rest as
        above."""
        world = cls.__new__(cls)
        if seed is not None:
            seed = whole_number(seed, "seed", 0, _MOST_SEED)
        world._open(_native.Scene.load(scene_name(scene), seed), cache,
                    max_mib)
        world._has_ends = True
        return world

    @property
    def name(self) -> str:
        return self._native.scene.name

    @property
    def unit(self) -> str:
        """What the unit is called in the scene file it was loaded from, "mm";
        "": it has no name."""
        return self._native.scene.unit

    @property
    def robot(self) -> Solid:
        return Solid._of(self._native.scene.robot)

    @property
    def obstacles(self) -> list[Solid]:
        return [Solid._of(solid) for solid in self._native.scene.obstacles]

    @property
    def bounds(self) -> Floats | None:
        """(2, 3), or None."""
        return self._native.scene.bounds

    @property
    def start(self) -> Floats:
        """Of the scene it was loaded from."""
        return self._native.scene.start

    @property
    def goal(self) -> Floats:
        return self._native.scene.goal

    @property
    def length(self) -> float:
        """D, that shares refer to: the diagonal of what the obstacles' contact
        space takes up; user's unit."""
        return self._native.length

    @property
    def warnings(self) -> list[str]:
        return self._native.scene.warnings

    def diagnose(self, q: ArrayLike) -> Diagnosis:
        """Exact, on the solids; builds nothing."""
        return Diagnosis(**self._native.diagnose(point(q, "q")))

    def contact_spaces(self) -> list[ContactSpace]:
        """That of all obstacles together; none where none can be touched
        within the bounds."""
        return [ContactSpace(space) for space in self._native.contact_spaces()]

    def is_free(self, points: ArrayLike) -> NDArray[np.bool_]:
        """(N,): does the robot touch nothing there?  Exact."""
        places = rows(points, "points", 3)
        return self._native.are_free(places, places).view(np.bool_)

    def is_motion_free(self, a: ArrayLike, b: ArrayLike) -> NDArray[np.bool_]:
        """(N,): is every point of the straight motion a[i] -> b[i] free?
        Exact, without sampling."""
        begins, ends = rows(a, "a", 3), rows(b, "b", 3)
        if len(begins) != len(ends):
            raise InputError(f"b: expected {len(begins)} rows as in a, "
                             f"found {len(ends)}")
        return self._native.are_free(begins, ends).view(np.bool_)

    def clearance(self, points: ArrayLike) -> Floats:
        """(N,): distance to contact and bounds; 0 where not free."""
        return self._native.clearances(rows(points, "points", 3))

    @property
    def limits(self) -> Floats | None:
        """(3, 3): of velocity, acceleration and jerk, by x, y and z, where the
        scene it was loaded from has them."""
        return self._native.scene.limits

    def optimize(self, start: ArrayLike | None = None,
                 goal: ArrayLike | None = None, *, limits: Any = None,
                 margin: float | str | None = None, require: bool = False,
                 preset: str = "", model: str = "", routes: int = 0,
                 max_seconds: float | None = None,
                 budget: float | None = None,
                 via: ArrayLike | None = None, tolerance: Any = None,
                 dwell: ArrayLike = 0.0, duration: float | None = None,
                 by_norm: bool = False, departure: ArrayLike | None = None,
                 arrival: ArrayLike | None = None,
                 moving: Mapping[str, Any] | None = None, metric: str = "",
                 waypoints: int = 0, seed: int = 1,
                 straight: bool = False) -> Trajectory | Motion:
        """A short way that keeps clear, judged exactly: with limits a Motion, a
        fast curve in time that is free and keeps them for all t, proved, from
        rest to rest; without, a Trajectory, a smooth polyline by Ipopt.

        start, goal: positions; the scene's own where it was loaded.
        limits: (velocity, acceleration, jerk), each one number or of x, y and
        z, user's units and seconds; None: the scene's, if it has any; "none":
        a path without time.
        margin: distance kept, a share of D or "0.5unit" (shares above
        0.1 as "0.5D"), and where the scene's unit has a name 20 or "20mm" in
        it; what is kept less is in `reason` and in row["lengths"],
        with the room of start and goal, and with `require` the status is
        "clearance_missed".
        preset: "fast", "balanced" or "tight" (phongpd optimize --help); "": the
        scene's.  model: "full", the whole contact space; "window", free space
        alone, and no metric but "euclidean" and "smoothed", from what of the
        contact space they meet; "auto", window where limits of memory refuse
        the whole; "": the scene's, and of a polyline full where that is auto.
        routes: ways around the obstacles that are tried, 1 to 8; 0: the
        preset's.  max_seconds: of a polyline's solve, or of the search for a
        faster curve; there is one before.  budget: of a polyline, seconds of
        processors, builds included, within which preset, model and metric
        answered most often with about as many triangles
        (results/trade/budget.md); what is named besides wins over it.

        With limits.  by_norm: they are of the norm instead of every axis, one
        number each.  via: (M, 3), places to pass on the way, in order, each
        within `tolerance`, a length as above, 0.001 of D if None; `dwell`:
        seconds to rest at it; both one for all, or one for each.  None: the
        scene's places.  duration: seconds that it takes, with as little jerk as
        can be found; 0: as few as can be; None: the scene's.  departure,
        arrival: velocity (3,), or velocity and acceleration (2, 3), with which
        it begins and ends; None: the scene's, at rest if it has none.  moving:
        obstacles to keep off that move, {name: (solid, motion)}, the motion a
        Motion of another or (durations (N,), points (N, K, 3)), the Bézier
        points of where the solid is moved to from the time 0 on; None: the
        scene's.

        Without.  metric: "phong" (or smoothed, smoothed-foot), by the scene's
        smoothing length, "phong@L" by that one, "euclidean"; "": the scene's.
        waypoints: free ones; 0: the scene's.  seed: of
        straightening.  straight: start from the line even where it collides, as
        comparisons do.
        """
        ends = self._ends(start, goal)
        wants_path = isinstance(limits, str) and limits == "none"
        if not wants_path and (limits is not None or self.limits is not None):
            _require_none("a motion in time; limits=\"none\" asks for a path",
                          metric=metric != "", waypoints=waypoints != 0,
                          straight=straight is not False, seed=seed != 1)
            if budget is not None:
                raise InputError("budget: expected None for a motion in time, of "
                                 "which nothing was measured, found "
                                 f"{budget!r}; limits=\"none\" asks for a path")
            return self._motion(ends, limits, margin, require, preset, model,
                                routes, max_seconds, via, tolerance, dwell,
                                duration, by_norm, departure, arrival, moving)
        _require_none("a path without limits", via=via is not None,
                      tolerance=tolerance is not None,
                      dwell=not _is_zero(dwell), duration=duration is not None,
                      by_norm=by_norm is not False,
                      departure=departure is not None,
                      arrival=arrival is not None, moving=moving is not None)
        row = self._native.optimize(
            *ends, metric=text(metric, "metric"),
            margin=length(margin, "margin"),
            waypoints=whole_number(waypoints, "waypoints", 0),
            seed=whole_number(seed, "seed", 0, _MOST_SEED),
            max_seconds=seconds(max_seconds, "max_seconds"),
            straight=flag(straight, "straight"), preset=text(preset, "preset"),
            model=text(model, "model"), require=flag(require, "require"),
            routes=whole_number(routes, "routes", 0, 8),
            budget=_budget(budget))
        return Trajectory(
            status=row["status_class"], reason=row["reason"],
            free=row["collision_free"], path=_path(row),
            objective=row["objective"], clearance=row["clearance"],
            iterations=row["iterations"], seconds=row["seconds"]["total"],
            row=row, world=self)

    def optimize_in_time(self, start: ArrayLike | None = None,
                         goal: ArrayLike | None = None, *, limits: Any = None,
                         **wishes: Any) -> Motion:
        """optimize with limits, by the name that it had at first, until 0.3."""
        warnings.warn("optimize_in_time is optimize(limits=...); it goes with 0.3",
                      DeprecationWarning, stacklevel=2)
        if limits is None and self.limits is None:
            raise InputError("limits: expected (velocity, acceleration, jerk), "
                             "found None, and the scene has none")
        found = self.optimize(start, goal, limits=limits, **wishes)
        if not isinstance(found, Motion):
            raise InputError(f"limits: expected numbers, found {limits!r}")
        return found

    def _motion(self, ends: tuple[_Point, _Point], limits: Any, margin: Any,
                require: Any, preset: Any, model: Any, routes: Any,
                max_seconds: Any, via: Any, tolerance: Any, dwell: Any,
                duration: Any, by_norm: Any, departure: Any,
                arrival: Any, moving: Any) -> Motion:
        scene = self._native.scene
        wishes = wishes_of(
            scene, limits, scene.via if via is None
            else places_on_the_way(via, tolerance, dwell),
            scene.duration if duration is None else duration,
            margin, max_seconds, preset, require, routes, by_norm,
            scene.departure if departure is None
            else motion_end(departure, "departure"),
            scene.arrival if arrival is None
            else motion_end(arrival, "arrival"))
        return motion_of(self._native.optimize_in_time(
            *ends, text(model, "model"), wishes, moving_of(moving)), self)

    def retime(self, path: ArrayLike, *, limits: Any = None,
               via: ArrayLike | None = None, tolerance: Any = None,
               dwell: ArrayLike = 0.0, duration: float = 0.0,
               margin: float | str | None = None,
               max_seconds: float | None = None, preset: str = "",
               require: bool = False, by_norm: bool = False,
               departure: ArrayLike | None = None,
               arrival: ArrayLike | None = None) -> Motion:
        """The same near a free path (K, 3) of one's own, of which the places of
        `via` are points; what the scene says of them, of its duration, departure
        and arrival counts for nothing.
        """
        points = [point(p, "path") for p in rows(path, "path", 3)]
        if len(points) < 2:
            raise InputError("path: expected two points at least, found "
                             f"{len(points)}")
        wishes = wishes_of(
            self._native.scene, limits, [] if via is None
            else places_on_the_way(via, tolerance, dwell),
            duration, margin, max_seconds, preset, require, 0, by_norm,
            motion_end(departure, "departure"), motion_end(arrival, "arrival"))
        return motion_of(self._native.retime(points, wishes), self)

    def plan(self, start: ArrayLike | None = None,
             goal: ArrayLike | None = None, *,
             planner: str = "", retraction: str = "phong",
             clearance: float | str | None = None, max_seconds: float = 5.0,
             seed: int = 1, preset: str = "", model: str = "",
             require: bool = False, budget: float | None = None) -> Plan:
        """A path that is free by exact tests, or why there is none.

        planner: "contact-surface", which "" stands for, is complete,
        deterministic and proves infeasibility; the others sample (names: `phongpd plan --help`), for
        `max_seconds`, by `seed`; retraction-* carry samples to the contact
        space by `retraction`.  budget: picks planner, model and preset, as that
        of optimize does.  clearance: to seek where there is room, a share
        of D or "0.5unit", told as optimize takes it; what is kept less is told
        as there, `require` too.  preset: of contact-surface, as of optimize.
        model: "full", the whole contact space; "window", of it what leads from
        start to goal, and free space alone for planners that only check
        motions; "auto", the window for those, and where limits refuse the
        whole; "": the scene's.
        """
        ends = self._ends(start, goal)
        row = self._native.plan(
            *ends, planner=text(planner, "planner"),
            retraction=text(retraction, "retraction"),
            clearance=length(clearance, "clearance"),
            max_seconds=seconds(max_seconds, "max_seconds"),
            seed=whole_number(seed, "seed", 0, _MOST_SEED),
            preset=text(preset, "preset"), model=text(model, "model"),
            require=flag(require, "require"), budget=_budget(budget))
        return Plan(
            status=row["status"], reason=row["reason"], solved=row["solved"],
            infeasible=row["infeasible_proved"], path=_path(row),
            length=row["path_length"], clearance=row["clearance"],
            seconds=row["seconds"]["solve"], row=row, world=self,
            ends=np.array(ends))

    def roadmap(self) -> Roadmap:
        """For many queries; building it costs what ten to three hundred calls
        of plan do."""
        from ._roadmap import Roadmap
        return Roadmap(self)

    def _ends(self, start: ArrayLike | None,
              goal: ArrayLike | None) -> tuple[_Point, _Point]:
        return (self._end(start, "start", self.start),
                self._end(goal, "goal", self.goal))

    def _end(self, given: ArrayLike | None, name: str,
             of_scene: Floats) -> _Point:
        if given is None and not self._has_ends:
            raise InputError(f"{name}: expected three finite numbers, found "
                             "None, and the world was not loaded with one")
        return point(of_scene if given is None else given, name)

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        if not canvas.is_new(self):
            return
        for obstacle in self.obstacles:
            canvas.mesh(obstacle.name, "obstacle", obstacle)
        canvas.robot(self.robot)
        canvas.is_free = self.is_motion_free
        if self.unit:
            canvas.unit(self.unit)
        if self._has_ends:
            canvas.ends(self.start, self.goal)

    def _facts(self) -> dict[str, Any]:
        return {"world": self.name, "obstacles": len(self.obstacles),
                "D": self.length, "warnings": "; ".join(self.warnings)}

    def __repr__(self) -> str:
        return f"<World {self.name!r}: D {self.length:g}>"


def native_world(world: World) -> _native.World:
    if isinstance(world, World):
        return world._native
    raise InputError(f"world: expected a World, found {type(world).__name__}")


def _require_none(subject: str, **given: bool) -> None:
    for name, is_given in given.items():
        if is_given:
            raise InputError(f"{name}: expected none for {subject}, found one")


def _budget(value: Any) -> float:
    """0: none."""
    return 0.0 if value is None else seconds(value, "budget")


def _is_zero(value: Any) -> bool:
    return isinstance(value, (int, float)) and value == 0


def _path(row: dict[str, Any]) -> Floats:
    return np.asarray(row["path"], dtype=np.float64).reshape(-1, 3)
