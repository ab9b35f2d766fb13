# SPDX-License-Identifier: GPL-3.0-or-later
"""Sequential convex optimisation as TrajOpt does it (Schulman and others, IJRR 2014,
algorithm 1): rows as an l1 penalty, made linear about x, in a box of trust, each
quadratic program by OSQP.

    min f(x') + μ Σ t,   g(x) + J(x)(x' − x) + t >= 0,  t >= 0,  |x' − x|∞ <= s
"""
import numpy as np
import osqp
from scipy import sparse

# BasicTrustRegionSQPParameters of trajopt_sco (tesseract-robotics/trajopt); lengths,
# there metres and radians, are shares of D here.
IMPROVE_RATIO, LEAST_BOX, LEAST_IMPROVE = 0.25, 1e-4, 1e-4
ITERATIONS, SHRINK, EXPAND, TOLERANCE = 50, 0.1, 1.5, 1e-4
PENALTIES, PENALTY_FACTOR, PENALTY, BOX = 5, 10.0, 10.0, 0.1
FAILURES = 3  # of the quadratic program, after which it gives up
# OSQPModelConfig of the same.
OSQP = {"eps_abs": 1e-4, "eps_rel": 1e-6, "max_iter": 8192, "polishing": True,
        "verbose": False}


class _Model:
    """The convex program at x; f is quadratic, so its model is itself."""

    def __init__(self, program):
        self.p, n, m = program, program.size, program.count
        steps = sparse.diags([1.0, -1.0], [0, -1],
                             shape=(program.waypoints + 1, program.waypoints))
        self.hessian = 2.0 * program.weight * sparse.kron(steps.T @ steps,
                                                         sparse.eye(3))
        self.quadratic = sparse.triu(sparse.block_diag(
            [self.hessian, sparse.csc_matrix((m, m))]), format="csc")
        self.boxes = sparse.eye(n + m)

    def at(self, x, gaps, entries):
        self.x, self.gaps = x, gaps
        self.jacobian = sparse.csc_matrix((entries, self.p.pattern),
                                          (self.p.count, self.p.size))
        self.slope = self.p.slope(x)

    def solve(self, penalty, box):
        """The best x' there, or None."""
        n, m = self.p.size, self.p.count
        rows = sparse.hstack([self.jacobian, sparse.eye(m)])
        low = np.concatenate([-self.gaps, np.maximum(-box, self.p.low - self.x),
                              np.zeros(m)])
        high = np.concatenate([np.full(m, np.inf),
                               np.minimum(box, self.p.high - self.x),
                               np.full(m, np.inf)])
        solver = osqp.OSQP()
        solver.setup(self.quadratic, np.concatenate([self.slope, np.full(m, penalty)]),
                     sparse.vstack([rows, self.boxes], format="csc"), low, high, **OSQP)
        found = solver.solve(raise_error=False)
        if found.info.status not in ("solved", "solved inaccurate"):
            return None
        return self.x + found.x[:n]

    def merit(self, x, penalty):
        linear = self.gaps + self.jacobian @ (x - self.x)
        return self.p.objective(x) + penalty * missing(linear).sum()


def missing(gaps):
    return np.maximum(0.0, -gaps)


class _Search:

    def __init__(self, program):
        self.p, self.model = program, _Model(program)
        self.box, self.penalty, self.failures = BOX, PENALTY, 0
        self.move_to(np.clip(program.first, program.low, program.high))

    def move_to(self, x):
        self.p.accept(x)
        self.x, self.gaps = x, self.p.gaps(x)
        self.model.at(x, self.gaps, self.p.entries(x))

    def step(self):
        """One step within the box: "taken", or why the penalty's program is done."""
        old = self.p.objective(self.x) + self.penalty * missing(self.gaps).sum()
        while self.box >= LEAST_BOX:
            if self.p.is_spent():
                return "spent"
            x = self.model.solve(self.penalty, self.box)
            if x is None:
                self.failures += 1
                if self.failures >= FAILURES:
                    return "failed"
                self.box *= SHRINK
                continue
            promised = old - self.model.merit(x, self.penalty)
            gained = old - (self.p.objective(x)
                            + self.penalty * missing(self.p.gaps(x)).sum())
            if promised < LEAST_IMPROVE:
                return "converged"
            if gained < IMPROVE_RATIO * promised:
                self.box *= SHRINK
                continue
            self.move_to(x)
            self.box *= EXPAND
            return "taken"
        return "converged"

    def run(self):
        """True where it says that it has converged with all rows kept."""
        for _ in range(PENALTIES):
            for _ in range(ITERATIONS):
                end = self.step()
                if end != "taken":
                    break
            if end != "converged":
                return False
            if missing(self.gaps).max() < TOLERANCE:
                return True
            self.penalty *= PENALTY_FACTOR
            self.box = max(self.box, LEAST_BOX / SHRINK * 1.5)
        return False


def solve(program):
    """(v, says converged)"""
    search = _Search(program)
    says = search.run()
    return search.x, says
