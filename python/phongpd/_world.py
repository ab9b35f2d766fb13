# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from numpy.typing import ArrayLike

from ._answers import Plan, Trajectory, plan_of, trajectory_of
from ._arguments import flag, is_zero, length, point, real, rows, seconds, seed_number, \
    text, whole_number
from ._curve import moving_of
from ._motion import Motion, motion_of, wishes_of
from ._native import InputError
from ._roadmap import Roadmap
from ._room import Room


class World(Room):
    """A robot that translates among obstacles, perhaps within bounds.

    Contact spaces are built when something asks for them, once, and kept;
    moving start and goal builds nothing.  Safe to use from several threads;
    optimisations and plans of one world wait for each other.
    """

    def __init__(self, robot: Any, obstacles: Any, *,
                 bounds: ArrayLike | None = None, name: str = "world",
                 unit: str = "", cache: bool = False,
                 max_mib: float = 0.0) -> None:
        """robot: Solid, file or mesh.  obstacles: one, or a dict of them by
        name.  bounds: (2, 3), least and greatest position of the robot; None:
        none.  unit: what the solids' unit is called, "mm": margin and clearance
        can be told in it then, and nothing is converted; "": it has no name.
        cache: keep contact spaces in the user's cache folder.
        max_mib: of a build, as ContactSpace.build has it."""
        self._make(robot, obstacles, bounds, name, unit, cache, max_mib)

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
        limits: (velocity, acceleration, jerk), or a dict of them as scenes
        have it, each one number or of x, y and z, user's units and seconds;
        None: the scene's, if it has any; "none": a path without time.
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
        routes: ways around the obstacles that are tried to the end, 1 to 8; 0:
        the preset's; with limits, those that look best at first.  max_seconds:
        of a polyline's solve, or of the search for a faster curve; there is one
        before.  budget: of a polyline, seconds of
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
        obstacles to keep off that move, {name: (solid, motion)}, where the solid
        is moved to from the time 0 on, to rounding, as check_curve takes a
        curve: a Motion of another, (durations, points), or a spline; None, or
        none of them: the scene's.

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
            wishes = wishes_of(
                self._native.scene, limits=limits, margin=margin,
                require=require, preset=preset, routes=routes,
                max_seconds=max_seconds, by_norm=by_norm, via=via,
                tolerance=tolerance, dwell=dwell, duration=duration,
                departure=departure, arrival=arrival)
            return motion_of(self._native.optimize_in_time(
                *ends, text(model, "model"), wishes, moving_of(moving)[0]), self,
                self._native.scene.duration if duration is None else duration)
        _require_none("a path without limits", via=via is not None,
                      tolerance=tolerance is not None,
                      dwell=not is_zero(dwell), duration=duration is not None,
                      by_norm=by_norm is not False,
                      departure=departure is not None,
                      arrival=arrival is not None, moving=moving is not None)
        return trajectory_of(self._native.optimize(
            *ends, metric=text(metric, "metric"),
            margin=length(margin, "margin"),
            waypoints=whole_number(waypoints, "waypoints", 0),
            seed=seed_number(seed),
            max_seconds=seconds(max_seconds, "max_seconds"),
            straight=flag(straight, "straight"), preset=text(preset, "preset"),
            model=text(model, "model"), require=flag(require, "require"),
            routes=whole_number(routes, "routes", 0, 8),
            budget=_budget(budget)), self)

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
        rest = (0.0, 0.0, 0.0)
        wishes = wishes_of(
            self._native.scene, limits=limits, margin=margin, require=require,
            preset=preset, routes=0, max_seconds=max_seconds, by_norm=by_norm,
            via=[] if via is None else via, tolerance=tolerance, dwell=dwell,
            duration=real(duration, "duration"),
            departure=rest if departure is None else departure,
            arrival=rest if arrival is None else arrival)
        return motion_of(self._native.retime(points, wishes), self, duration)

    def plan(self, start: ArrayLike | None = None,
             goal: ArrayLike | None = None, *,
             planner: str = "", retraction: str = "phong",
             clearance: float | str | None = None, max_seconds: float = 5.0,
             seed: int = 1, preset: str = "", model: str = "",
             require: bool = False, budget: float | None = None) -> Plan:
        """A path that is free by exact tests, or why there is none.

        planner: "contact-surface", which "" stands for, is complete,
        deterministic and proves infeasibility; the others sample (names:
        `phongpd plan --help`), for `max_seconds`, by `seed`; retraction-* carry
        samples to the contact space by `retraction`.  budget: picks planner,
        model and preset, as that of optimize does.  clearance: to seek where there is room, a share
        of D or "0.5unit", told as optimize takes it; what is kept less is told
        as there, `require` too.  preset: of contact-surface, as of optimize.
        model: "full", the whole contact space; "window", of it what leads from
        start to goal, and free space alone for planners that only check
        motions; "auto", the window for those, and where limits refuse the
        whole; "": the scene's.
        """
        ends = self._ends(start, goal)
        return plan_of(self._native.plan(
            *ends, planner=text(planner, "planner"),
            retraction=text(retraction, "retraction"),
            clearance=length(clearance, "clearance"),
            max_seconds=seconds(max_seconds, "max_seconds"),
            seed=seed_number(seed), preset=text(preset, "preset"),
            model=text(model, "model"), require=flag(require, "require"),
            budget=_budget(budget)), self, ends)

    def roadmap(self) -> Roadmap:
        """For many queries; building it costs what ten to three hundred calls
        of plan do."""
        return Roadmap(self)


def _require_none(subject: str, **given: bool) -> None:
    for name, is_given in given.items():
        if is_given:
            raise InputError(f"{name}: expected none for {subject}, found one")


def _budget(value: Any) -> float:
    """0: none."""
    return 0.0 if value is None else seconds(value, "budget")
