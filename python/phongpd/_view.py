# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures to turn: a page of its own, or a frame in a notebook."""

from __future__ import annotations

import html
import os
from typing import Any, Callable, Iterable, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arguments import Floats, numbers, rows, whole_number
from ._native import InputError

# A notebook keeps what it shows: about 1.5 MB, 0.7 of them the viewer itself.
_NOTEBOOK_TRIANGLES = 30_000
# Beyond, drawing coarser takes longer than one waits for a cell.
_MOST_TRIANGLES = 5_000_000


class _Mesh(Protocol):
    @property
    def vertices(self) -> Floats: ...

    @property
    def triangles(self) -> NDArray[np.int32]: ...


class Canvas:
    """What is drawn on: meshes, one robot, paths, answers."""

    def __init__(self, title: str, notes: Iterable[str] = ()) -> None:
        self._native = _native.View(title, list(notes))
        self._drawn: list[object] = []
        self._robot: _Mesh | None = None
        self.triangles = 0
        self.is_free: Callable[[ArrayLike, ArrayLike], Any] | None = None
        """Judges straight motions, once a world has been drawn."""

    def is_new(self, thing: object) -> bool:
        """Once for each thing."""
        if any(thing is other for other in self._drawn):
            return False
        self._drawn.append(thing)
        return True

    def mesh(self, name: str, role: str, mesh: _Mesh) -> None:
        """role: "obstacle", "contact" (translucent) or "mesh"."""
        self.triangles += len(mesh.triangles)
        self._native.add_mesh(name, role, mesh.vertices, mesh.triangles)

    def robot(self, mesh: _Mesh) -> None:
        """At the origin; it goes where paths and answers say."""
        if self._robot is mesh:
            return
        if self._robot is not None:
            raise InputError("view: expected things of one robot and one world, "
                             "found another; make a view of each")
        self._robot = mesh
        self.triangles += len(mesh.triangles)
        self._native.set_robot(mesh.vertices, mesh.triangles)

    def unit(self, name: str) -> None:
        """What a unit of length is called."""
        self._native.set_unit(name)

    def ends(self, start: ArrayLike, goal: ArrayLike) -> None:
        self._native.set_ends(rows(np.array([start, goal]), "ends", 3))

    def path(self, name: str, points: ArrayLike, free: bool) -> None:
        self._native.add_path(name, _way(points), free)

    def way(self, name: str, points: ArrayLike) -> None:
        """A path of which nobody has said whether it is free."""
        way = _way(points)
        self.path(name, way, self.is_free is None
                  or bool(np.all(self.is_free(way[:-1], way[1:]))))

    def turned_ends(self, start: ArrayLike, goal: ArrayLike) -> None:
        """Poses, (4, 4)."""
        self._native.set_turned_ends(np.array([start, goal], float))

    def turning_way(self, name: str, poses: ArrayLike, free: bool) -> None:
        """Poses, (N, 4, 4), between which the robot moves as RigidJudge has
        it."""
        way = numbers(poses, "path", "(N, 4, 4)")
        if way.ndim != 3 or way.shape[1:] != (4, 4):
            raise InputError(f"path: expected shape (N, 4, 4), found {way.shape}")
        self._native.add_turning_path(name, way, free)

    def answer(self, points: ArrayLike, orientation: ArrayLike, status: str,
               depth: float, clearance: float) -> None:
        """points: (4, 3): position, direction, on the robot, on the obstacle."""
        self._native.add_answer(
            rows(points, "answer", 3), rows(orientation, "orientation", 4),
            status, depth, clearance)

    def page(self, most_triangles: int) -> str:
        return self._native.page(most_triangles)


class Shown:
    """Mixed into what can be looked at: it shows itself in a notebook."""

    def _draw(self, canvas: Canvas, name: str | None) -> None:
        raise NotImplementedError

    def _facts(self) -> dict[str, Any]:
        """What stands above the picture."""
        return {}

    def _repr_html_(self) -> str:
        canvas = Canvas(type(self).__name__)
        self._draw(canvas, None)
        return _table(self._facts()) + _frame(canvas)


class View(Shown):
    """Things shown together, to turn, cut and play; see `view`."""

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas

    def html(self, most_triangles: int = 200_000) -> str:
        """The page: one text, nothing loaded from elsewhere.  Meshes with more
        triangles together are drawn coarser, and the page says so."""
        return self._canvas.page(
            whole_number(most_triangles, "most_triangles", 1))

    def write(self, path: str | os.PathLike[str],
              most_triangles: int = 200_000) -> None:
        """The page as a file."""
        page = self.html(most_triangles)
        with open(path, "w", encoding="utf-8") as file:
            file.write(page)

    def __repr__(self) -> str:
        return f"<View: {self._canvas.triangles} triangles>"

    def _repr_html_(self) -> str:
        return _frame(self._canvas)


def view(*things: Any, title: str = "PhongPD", notes: Iterable[str] = (),
         **named: Any) -> View:
    """One picture of several things.

    things: Solid, ContactSpace, World, Trajectory, Plan, Motion, Depth,
    RigidWorld, RigidPlan, or an array (K, 3), the way of the robot's position, or
    (K, 4, 4), of its poses, taken as free; of at most one robot.  Those with
    a name, `view(world, phong=one, euclid=other)`, have it in the legend.  An
    array after a world is judged in it, which builds the world's contact space
    if it is not there; before one, or without, it counts as free.
    notes: what a person should know, a sentence each.
    """
    canvas = Canvas(title, notes)
    for name, thing in [*((None, t) for t in things), *named.items()]:
        if isinstance(thing, Shown):
            thing._draw(canvas, name)
        elif isinstance(thing, np.ndarray) and thing.ndim == 3:
            canvas.turning_way(name or "path", thing, True)
        elif isinstance(thing, (np.ndarray, list, tuple)):
            canvas.way(name or "path", thing)
        else:
            raise InputError(
                "view: expected Solid, ContactSpace, World, Trajectory, Plan, "
                "Motion, Depth or an array (K, 3), found "
                f"{type(thing).__name__}")
    return View(canvas)


def _way(points: ArrayLike) -> Floats:
    way = rows(points, "path", 3)
    if not np.isfinite(way).all():
        raise InputError("path: expected finite numbers, found others in "
                         f"{int((~np.isfinite(way)).any(axis=1).sum())} rows")
    return way


def _table(facts: dict[str, Any]) -> str:
    cells = "".join(
        f"<tr><th style='text-align:left'>{html.escape(key)}</th>"
        f"<td style='text-align:left'>{html.escape(_text(value))}</td></tr>"
        for key, value in facts.items() if value not in ("", None))
    return f"<table>{cells}</table>" if cells else ""


def _text(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _frame(canvas: Canvas) -> str:
    if canvas.triangles > _MOST_TRIANGLES:
        return (f"<p>{canvas.triangles} triangles are too many to show here, "
                f"more than {_MOST_TRIANGLES}; phongpd.view(...)"
                ".write('page.html') writes a page of them.</p>")
    try:
        page = canvas.page(_NOTEBOOK_TRIANGLES)
    except InputError as error:  # built without three.js
        return f"<p>{html.escape(str(error))}</p>"
    return (f'<iframe srcdoc="{html.escape(page)}" title="PhongPD viewer" '
            'style="width:100%;height:480px;border:1px solid #ccc"></iframe>')
