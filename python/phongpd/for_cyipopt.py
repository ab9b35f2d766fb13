# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of NonPenetrationRows for cyipopt::

    from phongpd.for_cyipopt import NonPenetrationProblem

    rows = phongpd.NonPenetrationRows(world, start, goal, waypoints=20)
    program = NonPenetrationProblem(rows, f, gradient)
    ipopt = program.problem()
    ipopt.add_option("tol", 1e-6)
    u, info = ipopt.solve(u0)
    path = rows.path(u)
    if not world.is_motion_free(path[:-1], path[1:]).all():
        raise RuntimeError("the path collides, whatever the solver says")

cyipopt compiles itself against an Ipopt that is there (coinor-libipopt-dev).
"""

from __future__ import annotations

from typing import Any, Callable

import cyipopt
import numpy as np
from numpy.typing import NDArray

from ._arguments import Floats
from ._native import InputError
from ._rows import NonPenetrationRows


class NonPenetrationProblem:
    """min f(u) subject to rows(u) >= rows.margin, as cyipopt wants a program.

    objective, gradient: of u, (3N,), the waypoints as x y z; gradient returns
    (3N,).  Without second derivatives of d Ipopt's own
    L-BFGS is taken.  The branches of the rows follow the solver once an
    iteration, at its iterate: the point at which the Jacobian was asked last.
    (Ipopt before 3.14, as Debian 12 has it, hands the iterate to nobody.)
    """

    def __init__(self, rows: NonPenetrationRows,
                 objective: Callable[[Floats], float],
                 gradient: Callable[[Floats], Floats]) -> None:
        if not isinstance(rows, NonPenetrationRows):
            raise InputError("rows: expected NonPenetrationRows, found "
                             f"{type(rows).__name__}")
        self._rows = rows
        self.objective, self.gradient = objective, gradient
        self._iterate: Floats | None = None

    def problem(self) -> Any:
        """A cyipopt.Problem of it: the waypoints are free, each row is at
        least the margin."""
        m, n = self._rows.shape
        ipopt = cyipopt.Problem(
            n=n, m=m, problem_obj=self, lb=np.full(n, -np.inf),
            ub=np.full(n, np.inf), cl=np.full(m, self._rows.margin),
            cu=np.full(m, np.inf))
        ipopt.add_option("hessian_approximation", "limited-memory")
        return ipopt

    def constraints(self, u: Floats) -> Floats:
        """(rows,): of NonPenetrationRows."""
        return self._rows.value(u)

    def jacobianstructure(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        return self._rows.pattern

    def jacobian(self, u: Floats) -> Floats:
        """One derivative for each place of the structure."""
        self._iterate = np.array(u)
        return self._rows.entries(u)

    def intermediate(self, *counters: Any) -> bool:
        """Ipopt calls it once an iteration; goes on."""
        if self._iterate is not None:
            self._rows.accept(self._iterate)
        return True
