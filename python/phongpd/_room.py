# SPDX-License-Identifier: GPL-3.0-or-later
"""What a world is, and what is asked of it without a search."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from numpy import bool_
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, Point, flag, motion_limits, point, real, \
    rows, scene_name, seed_number, text
from ._contact import ContactSpace
from ._curve import CurveCheck, curve_of, moving_of
from ._native import InputError
from ._sizes import warn_of_sizes
from ._solid import Solid, as_solid
from ._view import Canvas, Shown

R = TypeVar("R", bound="Room")


@dataclass(frozen=True)
class Diagnosis:
    """Is a position free, and if not, why; exact, of the solids themselves."""

    free: bool
    contacts: list[dict[str, Any]]
    """For each obstacle in the way: its name, a translation `depth_at_most`
    along `direction` that leaves it."""
    excesses: list[dict[str, Any]]
    """For each bound that is not kept: axis, is_maximum, bound, by."""

    def to_row(self) -> dict[str, Any]:
        """Flat, for pandas.DataFrame([one.to_row(), ...])."""
        return {"free": self.free,
                "in_obstacles": "; ".join(c["obstacle"] for c in self.contacts),
                "depth_at_most": max(
                    (c["depth_at_most"] for c in self.contacts), default=0.0),
                "out_of_bounds_by": max(
                    (e["by"] for e in self.excesses), default=0.0)}

    def __str__(self) -> str:
        if self.free:
            return "free"
        return "; ".join(
            [f"in {c['obstacle']}, at most {c['depth_at_most']:.6g} deep"
             for c in self.contacts]
            + [f"beyond the bounds in {'xyz'[e['axis']]} by {e['by']:.6g}"
               for e in self.excesses])


class Room(Shown):
    """A robot that translates among obstacles, perhaps within bounds; World is
    one in which ways are sought, too."""

    def _make(self, robot: Any, obstacles: Any, bounds: ArrayLike | None,
              name: str, unit: str, cache: bool, max_mib: float) -> None:
        if isinstance(obstacles, (list, tuple)):
            raise InputError(
                "obstacles: expected one, or several in a dict by name, found "
                f"{type(obstacles).__name__}; write {{\"part\": \"part.stl\"}}, or "
                "for arrays Solid(vertices, triangles)")
        if not isinstance(obstacles, Mapping):
            obstacles = {"obstacle": obstacles}
        solids = {str(key): as_solid(value, str(key))
                  for key, value in obstacles.items()}
        named = [(key, solid._native) for key, solid in solids.items()]
        moved = as_solid(robot, "robot")
        box = None
        if bounds is not None:
            corners = rows(bounds, "bounds", 3)
            if len(corners) != 2:
                raise InputError(
                    f"bounds: expected shape (2, 3), found {corners.shape}")
            box = (point(corners[0], "bounds"), point(corners[1], "bounds"))
        self._open(_native.Scene.make(moved._native, named, box,
                                      text(name, "name"), text(unit, "unit")),
                   cache, max_mib)
        self._has_ends = False
        warn_of_sizes(("the robot", moved.vertices),
                      ((key, solid.vertices) for key, solid in solids.items()))

    def _open(self, scene: Any, cache: bool, max_mib: float) -> None:
        self._native = _native.World(scene, flag(cache, "cache"),
                                     real(max_mib, "max_mib", "MiB"))

    @classmethod
    def load(cls: type[R], scene: str | os.PathLike[str], *,
             seed: int | None = None, cache: bool = False,
             max_mib: float = 0.0) -> R:
        """Of a scene file, or of a family with knobs as the command line takes
        them: "u_axis", "plate:thickness=0.02"; seed: of a family; the rest as
        above."""
        if seed is not None:
            seed = seed_number(seed)
        return cls._of(_native.Scene.load(scene_name(scene), seed), cache,
                       max_mib)

    @classmethod
    def _of(cls: type[R], scene: _native.Scene, cache: bool = False,
            max_mib: float = 0.0) -> R:
        """Of a scene that has start and goal."""
        room = cls.__new__(cls)
        room._open(scene, cache, max_mib)
        room._has_ends = True
        return room

    @property
    def name(self) -> str:
        return self._native.scene.name

    @property
    def unit(self) -> str:
        """What the unit is called in the scene file it was loaded from, or was
        made with, "mm"; "": it has no name."""
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

    def is_free(self, points: ArrayLike) -> NDArray[bool_]:
        """(N,): does the robot touch nothing there?  Exact."""
        places = rows(points, "points", 3)
        return self._native.are_free(places, places).view(bool_)

    def is_motion_free(self, a: ArrayLike, b: ArrayLike) -> NDArray[bool_]:
        """(N,): is every point of the straight motion a[i] -> b[i] free?
        Exact, without sampling."""
        begins, ends = rows(a, "a", 3), rows(b, "b", 3)
        if len(begins) != len(ends):
            raise InputError(f"b: expected {len(begins)} rows as in a, "
                             f"found {len(ends)}")
        return self._native.are_free(begins, ends).view(bool_)

    def check_curve(self, curve: Any, *, limits: Any = None,
                    by_norm: bool = False,
                    moving: Mapping[str, Any] | None = None) -> CurveCheck:
        """Is a curve in time free for all t?  Of any maker, without samples;
        "free" is proved, what touches is not free.

        curve: a Motion; (durations (N,), points (N, K, 3)), the Bézier points of
        each piece, of degree K - 1, 1 to 7; or what scipy.interpolate has for
        three values over time: CubicSpline, PPoly, BSpline.  Pieces join to
        rounding, 1e-12 of the largest coordinate; nothing smaller than that gap
        is decided.
        limits: (velocity, acceleration, jerk), or a dict of them, each one
        number or of x, y and z, user's units and seconds, to be compared with;
        None: the scene's, if it has any.  by_norm: they are of the norm, one number each.
        moving: obstacles that move, {name: (solid, motion)} as optimize takes
        them; None or none: the scene's.  The robot rests at the curve's end until they
        rest, too.

        Some microseconds a piece that is clear; the contact space is built
        first, as for is_free.
        """
        durations, points, blur = curve_of(curve, "curve")
        known, of_norm = limits_in(self._native.scene, limits, by_norm)
        others, of_others = moving_of(moving)
        return CurveCheck(*self._native.check_curve(
            durations, points.reshape(-1, 3), blur + of_others,
            None if known is None else motion_limits(known, of_norm), of_norm,
            others))

    def clearance(self, points: ArrayLike) -> Floats:
        """(N,): distance to contact and bounds; 0 where not free."""
        return self._native.clearances(rows(points, "points", 3))

    @property
    def limits(self) -> Floats | None:
        """(3, 3): of velocity, acceleration and jerk, by x, y and z, where the
        scene it was loaded from has them."""
        return self._native.scene.limits

    def _ends(self, start: ArrayLike | None,
              goal: ArrayLike | None) -> tuple[Point, Point]:
        return (self._end(start, "start", self.start),
                self._end(goal, "goal", self.goal))

    def _end(self, given: ArrayLike | None, name: str,
             of_scene: Floats) -> Point:
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
        return f"<{type(self).__name__} {self.name!r}: D {self.length:g}>"


def limits_in(scene: _native.Scene, limits: Any,
              by_norm: Any) -> tuple[Any, bool]:
    """Those given, or else the scene's, or None; and are they of the norm?"""
    of_norm = flag(by_norm, "by_norm")
    if isinstance(limits, Mapping) and "by" in limits:
        by = limits["by"]
        if by not in ("axis", "norm"):
            raise InputError(f"limits: by: expected 'axis' or 'norm', found {by!r}")
        of_norm = of_norm or by == "norm"
        limits = {key: limits[key] for key in limits if key != "by"}
    if limits is not None:
        return limits, of_norm
    return scene.limits, of_norm or scene.limits_by_norm


def as_room(world: R) -> R:
    if isinstance(world, Room):
        return world
    raise InputError(f"world: expected a World, found {type(world).__name__}")


def native_world(world: Room) -> _native.World:
    return as_room(world)._native
