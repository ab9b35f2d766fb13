# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of NonPenetrationRows for CasADi::

    from phongpd.for_casadi import BranchAdvance, NonPenetration

    rows = phongpd.NonPenetrationRows(world, start, goal, waypoints=20)
    keep = NonPenetration(rows)
    u = casadi.MX.sym("u", rows.shape[1])
    advance = BranchAdvance(rows, variables=u.numel(), constraints=rows.shape[0])
    solver = casadi.nlpsol("solver", "ipopt", {"x": u, "f": f(u), "g": keep(u)}, {
        "ipopt.hessian_approximation": "limited-memory",
        "iteration_callback": advance})
    found = solver(x0=u0, lbg=rows.margin)
    path = rows.path(found["x"])
    if not world.is_motion_free(path[:-1], path[1:]).all():
        raise RuntimeError("the path collides, whatever the solver says")

First derivatives only: a solver that wants the exact Hessian of what holds
these rows cannot be made.  Keep the objects as long as the functions made of
them: CasADi does not.
"""

from __future__ import annotations

from typing import Any, Sequence

import casadi
import numpy as np

from ._native import InputError
from ._rows import NonPenetrationRows


class NonPenetration(casadi.Callback):  # type: ignore[misc]
    """g(u) = the rows, to be >= rows.margin; user's unit.

    u: (3N, 1), waypoints as x y z; g: (rows, 1).  Its Jacobian is the rows'
    own, as sparse as the path.  u that is not finite is CasADi's evaluation error,
    at which Ipopt shortens its step.
    """

    def __init__(self, rows: NonPenetrationRows,
                 name: str = "non_penetration",
                 options: dict[str, Any] | None = None) -> None:
        casadi.Callback.__init__(self)
        self._rows = _checked(rows)
        self._pattern, self._order = _pattern(rows)
        self._jacobian: _Jacobian | None = None
        self.construct(name, options or {})

    def get_n_in(self) -> int:
        return 1

    def get_n_out(self) -> int:
        return 1

    def get_sparsity_in(self, i: int) -> Any:
        return casadi.Sparsity.dense(self._rows.shape[1], 1)

    def get_sparsity_out(self, i: int) -> Any:
        return casadi.Sparsity.dense(self._rows.shape[0], 1)

    def eval(self, arguments: Sequence[Any]) -> list[Any]:
        return [casadi.DM(self._rows.value(np.array(arguments[0]).ravel()))]

    def has_jac_sparsity(self, output: int, input: int) -> bool:
        return True

    def get_jac_sparsity(self, output: int, input: int, symmetric: bool) -> Any:
        return self._pattern

    def has_jacobian(self) -> bool:
        return True

    def get_jacobian(self, name: str, inames: Sequence[str],
                     onames: Sequence[str], options: dict[str, Any]) -> Any:
        self._jacobian = _Jacobian(self._rows, self._pattern, self._order,
                                   name, options)
        return self._jacobian


class _Jacobian(casadi.Callback):  # type: ignore[misc]
    """dg/du of u, and of g(u) which it does not need."""

    def __init__(self, rows: NonPenetrationRows, pattern: Any,
                 order: Any, name: str, options: dict[str, Any]) -> None:
        casadi.Callback.__init__(self)
        self._rows, self._pattern, self._order = rows, pattern, order
        self.construct(name, options)

    def get_n_in(self) -> int:
        return 2

    def get_n_out(self) -> int:
        return 1

    def get_sparsity_in(self, i: int) -> Any:
        return casadi.Sparsity.dense(self._rows.shape[1 - i], 1)

    def get_sparsity_out(self, i: int) -> Any:
        return self._pattern

    def eval(self, arguments: Sequence[Any]) -> list[Any]:
        entries = self._rows.entries(np.array(arguments[0]).ravel())
        return [casadi.DM(self._pattern, entries[self._order])]


class BranchAdvance(casadi.Callback):  # type: ignore[misc]
    """For nlpsol's option iteration_callback: after each iteration of the
    solver the branches of the rows follow it.

    variables, constraints, parameters: how many the program has (x, g, p);
    first: where in x the waypoints begin.
    """

    def __init__(self, rows: NonPenetrationRows, *, variables: int,
                 constraints: int, parameters: int = 0, first: int = 0,
                 name: str = "branch_advance",
                 options: dict[str, Any] | None = None) -> None:
        casadi.Callback.__init__(self)
        self._rows = _checked(rows)
        self._sizes = {"x": variables, "f": 1, "g": constraints,
                       "lam_x": variables, "lam_g": constraints,
                       "lam_p": parameters}
        if not 0 <= first <= variables - rows.shape[1]:
            raise InputError(
                f"first: expected 0 to {variables - rows.shape[1]}, the rows "
                f"having {rows.shape[1]} of {variables} variables, found {first}")
        self._mine = slice(first, first + rows.shape[1])
        self.construct(name, options or {})

    def get_n_in(self) -> int:
        return int(casadi.nlpsol_n_out())

    def get_n_out(self) -> int:
        return 1

    def get_name_in(self, i: int) -> str:
        return str(casadi.nlpsol_out(i))

    def get_name_out(self, i: int) -> str:
        return "ret"

    def get_sparsity_in(self, i: int) -> Any:
        return casadi.Sparsity.dense(self._sizes[casadi.nlpsol_out(i)], 1)

    def eval(self, arguments: Sequence[Any]) -> list[Any]:
        self._rows.accept(np.array(arguments[0]).ravel()[self._mine])
        return [0]


def _checked(rows: NonPenetrationRows) -> NonPenetrationRows:
    if isinstance(rows, NonPenetrationRows):
        return rows
    raise InputError("rows: expected NonPenetrationRows, found "
                     f"{type(rows).__name__}")


def _pattern(rows: NonPenetrationRows) -> tuple[Any, Any]:
    """The pattern, and which entry each of its places holds: CasADi stores by
    columns."""
    row, column = rows.pattern
    order = np.lexsort((row, column))
    return casadi.Sparsity.triplet(*rows.shape, row[order].tolist(),
                                   column[order].tolist()), order
