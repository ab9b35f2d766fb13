# SPDX-License-Identifier: GPL-3.0-or-later
"""Solvers of others on a Program, each from its own package: solve(program)
gives (v, says solved).  Ipopt has what PhongPD's own optimiser gives it:
the exact Hessian of the objective and of the length rows, nothing of the contact's."""
import numpy as np

TOLERANCE, ITERATIONS = 1e-6, 3000
# As the protocol straight-monotone of `phongpd compare`; all else is Ipopt's own.
IPOPT = {"tol": TOLERANCE, "max_iter": ITERATIONS, "mu_strategy": "monotone",
         "honor_original_bounds": "yes", "print_level": 0, "sb": "yes"}
CONTROL_POINTS, ORDER = 10, 4  # Drake's own defaults


def lagrangian_hessian(p):
    """CasADi's function (x, p, lam_f, lam_g) -> upper triangle."""
    import casadi
    x, none = casadi.SX.sym("x", p.size), casadi.SX.sym("p", 0)
    f, g = casadi.SX.sym("f"), casadi.SX.sym("g", p.count)
    path = casadi.vertcat(p.start, x, p.goal)
    steps = casadi.reshape(path[3:] - path[:-3], 3, -1)
    lagrangian = f * p.weight * casadi.sumsqr(steps)
    first = p.count - p.length_rows
    for i in range(p.length_rows):
        lagrangian -= g[first + i] * casadi.norm_2(steps[:, i])
    hessian = casadi.hessian(lagrangian, x)[0]
    return casadi.Function("nlp_hess_l", [x, none, f, g], [casadi.triu(hessian)],
                           ["x", "p", "lam_f", "lam_g"],
                           ["triu_hess_gamma_x_x"])


def by_ipopt_of_casadi(p):
    import casadi
    order = np.lexsort(p.pattern)
    pattern = casadi.Sparsity.triplet(p.count, p.size, p.pattern[0][order].tolist(),
                                      p.pattern[1][order].tolist())

    class Base(casadi.Callback):
        def __init__(self, name, ins, outs, evaluate):
            casadi.Callback.__init__(self)
            self.ins, self.outs, self.evaluate = ins, outs, evaluate
            self.construct(name, {})

        def get_n_in(self):
            return len(self.ins)

        def get_sparsity_in(self, i):
            return casadi.Sparsity.dense(self.ins[i], 1)

        def get_sparsity_out(self, i):
            return self.outs

        def eval(self, arguments):
            return [self.evaluate(np.array(arguments[0]).ravel())]

    class Rows(Base):
        def has_jacobian(self):
            return True

        def get_jacobian(self, name, inames, onames, options):
            self.jacobian = Base(
                name, [p.size, p.count], pattern,
                lambda v: casadi.DM(pattern, p.entries(v)[order]))
            return self.jacobian

    class Advance(Base):
        def get_n_in(self):
            return casadi.nlpsol_n_out()

        def get_name_in(self, i):
            return casadi.nlpsol_out(i)

        def get_sparsity_in(self, i):
            size = {"x": p.size, "f": 1, "g": p.count, "lam_x": p.size,
                    "lam_g": p.count, "lam_p": 0}[casadi.nlpsol_out(i)]
            return casadi.Sparsity.dense(size, 1)

    def advance(v):
        p.accept(v)
        return float(p.is_spent())

    rows = Rows("rows", [p.size], casadi.Sparsity.dense(p.count, 1), p.gaps)
    follow = Advance("advance", [], casadi.Sparsity.dense(1, 1), advance)
    x = casadi.MX.sym("x", p.size)
    path = casadi.vertcat(p.start, x, p.goal)
    solver = casadi.nlpsol("solver", "ipopt", {
        "x": x, "f": p.weight * casadi.sumsqr(path[3:] - path[:-3]), "g": rows(x)}, {
            "print_time": False, "ipopt": IPOPT, "hess_lag": lagrangian_hessian(p),
            "iteration_callback": follow, "show_eval_warnings": False})
    found = solver(x0=p.first, lbg=0.0, ubg=np.inf, lbx=p.low, ubx=p.high)
    return np.array(found["x"]).ravel(), bool(solver.stats()["success"])


class _ForCyipopt:
    """What cyipopt asks of a program.  Ipopt 3.11 hands its iterate to nobody: it is
    where the Jacobian was asked last (python/phongpd/for_cyipopt.py)."""

    def __init__(self, p):
        self.p, self.iterate = p, p.first
        self.of_lagrangian = lagrangian_hessian(p)
        row, column = self.of_lagrangian.sparsity_out(0).get_triplet()
        # CasADi's upper triangle is the lower one of Ipopt.
        self.places = np.array(column), np.array(row)
        self.objective, self.gradient, self.constraints = p.objective, p.slope, p.gaps

    def jacobianstructure(self):
        return self.p.pattern

    def jacobian(self, v):
        self.iterate = np.array(v)
        return self.p.entries(v)

    def hessianstructure(self):
        return self.places

    def hessian(self, v, multipliers, factor):
        found = self.of_lagrangian(v, [], factor, multipliers)
        return np.array(found.nonzeros())

    def intermediate(self, *others):
        self.p.accept(self.iterate)
        return not self.p.is_spent()


def by_cyipopt(p):
    import cyipopt
    asked = _ForCyipopt(p)
    solver = cyipopt.Problem(
        n=p.size, m=p.count, problem_obj=asked, lb=p.low, ub=p.high,
        cl=np.zeros(p.count), cu=np.full(p.count, np.inf))
    for name, value in IPOPT.items():
        solver.add_option(name, value)
    v, info = solver.solve(p.first)
    # Solve_Succeeded, Solved_To_Acceptable_Level: as ours counts.
    return v, info["status"] in (0, 1)


def _solved_by_snopt(program, p, variables, to_v, of_x, first):
    """Adds the rows at v = to_v(x), of_x its slope, None where v is x, and solves."""
    from pydrake.autodiffutils import ExtractValue, InitializeAutoDiff
    from pydrake.solvers import SnoptSolver, SolverOptions
    from study_solvers_program import Spent
    last = [first]

    def rows(x):
        if x.dtype != object:
            return p.gaps(to_v(x))
        if p.is_spent():
            raise Spent
        at = ExtractValue(x).ravel()
        last[0] = at
        # It tells no iterate: branches follow every point that is asked.
        v = to_v(at)
        p.accept(v)
        jacobian = np.zeros((p.count, p.size))
        jacobian[p.pattern] = p.entries(v)
        # x is the solver's variables: its own gradient is the identity.
        slope = jacobian if of_x is None else jacobian @ of_x
        return InitializeAutoDiff(p.gaps(v), slope).ravel()

    bound = program.AddConstraint(rows, np.zeros(p.count), np.full(p.count, np.inf),
                                  variables)
    touched = np.zeros((p.count, p.size))
    touched[p.pattern] = 1.0
    bound.evaluator().SetGradientSparsityPattern(
        list(zip(*np.nonzero(touched if of_x is None else touched @ np.abs(of_x)))))
    options = SolverOptions()
    options.SetOption(SnoptSolver.id(), "Major optimality tolerance", TOLERANCE)
    options.SetOption(SnoptSolver.id(), "Major iterations limit", ITERATIONS)
    try:
        found = SnoptSolver().Solve(program, None, options)
    except Exception:
        if not p.is_spent():
            raise
        return last[0], False
    return found.GetSolution(variables), found.is_success()


def by_snopt(p):
    from pydrake.solvers import MathematicalProgram
    program = MathematicalProgram()
    x = program.NewContinuousVariables(p.size)
    program.AddBoundingBoxConstraint(p.low, p.high, x)
    path = np.vstack([[p.start], x.reshape(-1, 3), [p.goal]])
    program.AddQuadraticCost(p.weight * (np.diff(path, axis=0) ** 2).sum())
    program.SetInitialGuess(x, p.first)
    return _solved_by_snopt(program, p, x, lambda at: at, None, p.first)


def by_kto(p):
    """KinematicTrajectoryOptimization: a B-spline of Drake's default size, rows at
    the waypoints it passes at even parameters and between them.  The path is the
    polyline of those, so that it is judged as all others."""
    from pydrake.planning import KinematicTrajectoryOptimization
    optimization = KinematicTrajectoryOptimization(3, CONTROL_POINTS, ORDER, 1.0)
    basis = optimization.basis()
    at = np.linspace(0.0, 1.0, p.waypoints + 2)[1:-1]
    values = np.array([[basis.EvaluateBasisFunctionI(i, t)
                        for i in range(CONTROL_POINTS)] for t in at])
    of_x = np.kron(values, np.eye(3))
    program = optimization.get_mutable_prog()
    points = optimization.control_points()
    x = points.T.ravel()
    optimization.AddDurationConstraint(1.0, 1.0)
    optimization.AddPathPositionConstraint(p.start, p.start, 0.0)
    optimization.AddPathPositionConstraint(p.goal, p.goal, 1.0)
    optimization.AddPositionBounds(p.low[:3], p.high[:3])
    optimization.AddPathEnergyCost(1.0)
    program.SetInitialGuessForAllVariables(
        np.nan_to_num(program.initial_guess(), nan=1.0))
    # Means of knots: the spline is the straight line at even speed.
    knots = np.array(basis.knots())
    along = np.array([[knots[i + 1:i + ORDER].mean()] for i in range(CONTROL_POINTS)])
    first = ((1.0 - along) * p.start + along * p.goal).ravel()
    program.SetInitialGuess(x, first)
    found, says = _solved_by_snopt(program, p, x, lambda at: of_x @ at, of_x, first)
    return of_x @ found, says
