# SPDX-License-Identifier: GPL-3.0-or-later
"""One program, several solvers: the shortest path (sum of squared steps) under
d >= margin, rows and Jacobian of NonPenetrationRows, from the straight line that
collides; judged exactly on the whole path."""

import statistics
import time

import numpy as np
import phongpd
from python_report import told

HEADER = ["scene", "solver", "runs", "says solved", "free, exactly judged",
          "objective / best, median of free", "evaluations, median",
          "CPU s, median"]
SCENES = ["u_axis", "plate:thickness=0.02"]
WAYPOINTS, SAMPLES, TOLERANCE, ITERATIONS = 10, 3, 1e-6, 100
METRIC = "phong@0.2"


class Program:
    """min f(u), rows(u) >= margin; u are the free waypoints."""

    def __init__(self, world):
        self.start, self.goal = np.array(world.start), np.array(world.goal)
        self.rows = phongpd.NonPenetrationRows(
            world, self.start, self.goal, waypoints=WAYPOINTS,
            samples_per_segment=SAMPLES, metric=METRIC)
        self.margin = 0.01 * world.length
        self.evaluations = 0
        line = np.linspace(self.start, self.goal, WAYPOINTS + 2)[1:-1].ravel()
        self.first = line

    def path(self, u):
        return np.vstack([[self.start], np.reshape(u, (-1, 3)), [self.goal]])

    def objective(self, u):
        steps = np.diff(self.path(u), axis=0)
        slope = np.zeros((WAYPOINTS + 2, 3))
        slope[1:] += 2 * steps
        slope[:-1] -= 2 * steps
        return float((steps ** 2).sum()), slope[1:-1].ravel()

    def value(self, u):
        self.evaluations += 1
        return self.rows.value(u)


def by_scipy(p):
    from scipy.optimize import minimize
    found = minimize(
        p.objective, p.first, jac=True, method="SLSQP", callback=p.rows.accept,
        options={"maxiter": ITERATIONS, "ftol": TOLERANCE},
        constraints={"type": "ineq", "fun": lambda u: p.value(u) - p.margin,
                     "jac": p.rows.jacobian})
    return found.x, bool(found.success)


def by_casadi(p):
    import casadi

    class Rows(casadi.Callback):
        def __init__(self):
            casadi.Callback.__init__(self)
            self.construct("rows", {})

        def get_sparsity_in(self, i):
            return casadi.Sparsity.dense(p.rows.shape[1], 1)

        def get_sparsity_out(self, i):
            return casadi.Sparsity.dense(p.rows.shape[0], 1)

        def eval(self, arguments):
            return [p.value(np.array(arguments[0]).ravel())]

        def has_jacobian(self):
            return True

        def get_jacobian(self, name, inames, onames, options):
            self.slope = Slope(name)
            return self.slope

    class Slope(casadi.Callback):
        def __init__(self, name):
            casadi.Callback.__init__(self)
            self.construct(name, {})

        def get_n_in(self):
            return 2

        def get_sparsity_in(self, i):
            # Of u, and of the value there, which is not needed.
            return casadi.Sparsity.dense(p.rows.shape[1 if i == 0 else 0], 1)

        def get_sparsity_out(self, i):
            return casadi.Sparsity.dense(*p.rows.shape)

        def eval(self, arguments):
            return [p.rows.jacobian(np.array(arguments[0]).ravel())]

    u = casadi.MX.sym("u", p.rows.shape[1])
    path = casadi.vertcat(casadi.DM(p.start), u, casadi.DM(p.goal))
    rows = Rows()
    solver = casadi.nlpsol("solver", "ipopt", {
        "x": u, "f": casadi.sumsqr(path[3:] - path[:-3]), "g": rows(u)}, {
            "print_time": False, "ipopt": {
                "print_level": 0, "sb": "yes", "tol": TOLERANCE,
                "max_iter": ITERATIONS, "mu_strategy": "adaptive",
                "hessian_approximation": "limited-memory"}})
    found = solver(x0=p.first, lbg=p.margin, ubg=np.inf)
    return np.array(found["x"]).ravel(), bool(solver.stats()["success"])


def _by_drake(name):
    def solve(p):
        from pydrake.autodiffutils import ExtractGradient, ExtractValue, \
            InitializeAutoDiff
        from pydrake.solvers import IpoptSolver, MathematicalProgram, \
            SnoptSolver, SolverOptions
        solver = {"snopt": SnoptSolver, "ipopt": IpoptSolver}[name]()
        program = MathematicalProgram()
        u = program.NewContinuousVariables(len(p.first))

        def rows(x):
            if x.dtype != object:
                return p.value(x)
            at = ExtractValue(x).ravel()
            slope = p.rows.jacobian(at) @ ExtractGradient(x)
            return InitializeAutoDiff(p.value(at), slope).ravel()

        program.AddConstraint(rows, np.full(p.rows.shape[0], p.margin),
                              np.full(p.rows.shape[0], np.inf), u)
        path = np.vstack([[p.start], u.reshape(-1, 3), [p.goal]])
        program.AddQuadraticCost((np.diff(path, axis=0) ** 2).sum())
        program.AddVisualizationCallback(p.rows.accept, u)
        options = SolverOptions()
        options.SetOption(IpoptSolver.id(), "tol", TOLERANCE)
        options.SetOption(IpoptSolver.id(), "max_iter", ITERATIONS)
        options.SetOption(IpoptSolver.id(), "mu_strategy", "adaptive")
        options.SetOption(SnoptSolver.id(), "Major iterations limit", ITERATIONS)
        options.SetOption(SnoptSolver.id(), "Major optimality tolerance",
                          TOLERANCE)
        found = solver.Solve(program, p.first, options)
        return found.GetSolution(u), found.is_success()
    return solve


SOLVERS = [("scipy, SLSQP", by_scipy), ("casadi, Ipopt", by_casadi),
           ("drake, SNOPT", _by_drake("snopt")),
           ("drake, Ipopt", _by_drake("ipopt"))]


def _own(world):
    """PhongPD's own pipeline on its own program: for the verdict only."""
    run = world.optimize(metric=METRIC, waypoints=WAYPOINTS, margin=0.01)
    return run.path, run.status in ("solved", "polished")


def run(seeds):
    """Rows of HEADER, and what failed."""
    rows, failures = [], {}
    for scene in SCENES:
        answers = {}
        for seed in seeds:
            world = phongpd.World.load(scene, seed=seed)
            world.contact_spaces()
            for name, solve in SOLVERS:
                program = Program(world)
                begin = time.process_time()
                try:
                    u, says = solve(program)
                except Exception as error:
                    failures.setdefault(name, f"{name}: {told(error)}")
                    continue
                answers.setdefault(name, []).append(
                    _answer(world, program.path(u), says, program.evaluations,
                            time.process_time() - begin))
            begin = time.process_time()
            path, says = _own(world)
            answers.setdefault("PhongPD's own pipeline", []).append(_answer(
                world, path, says, None, time.process_time() - begin))
        best = [min((a[2] for a in at if a[1]), default=np.nan)
                for at in zip(*answers.values())]
        rows += [_row(scene, name, found, best)
                 for name, found in answers.items()]
    return rows, list(failures.values())


def _answer(world, path, says, evaluations, seconds):
    steps = np.diff(path, axis=0)
    free = len(path) > 1 and bool(
        world.is_motion_free(path[:-1], path[1:]).all())
    # Of a path with K steps, what one with WAYPOINTS + 1 would have.
    cost = float((steps ** 2).sum()) * len(steps) / (WAYPOINTS + 1)
    return says, free, cost, evaluations, seconds


def _row(scene, name, found, best):
    ratios = [a[2] / b for a, b in zip(found, best) if a[1]]
    counts = [a[3] for a in found if a[3] is not None]
    return (scene, name, len(found), sum(a[0] for a in found),
            sum(a[1] for a in found),
            statistics.median(ratios) if ratios else "-",
            statistics.median(counts) if counts else "-",
            statistics.median(a[4] for a in found))
