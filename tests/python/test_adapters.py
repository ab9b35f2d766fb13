# SPDX-License-Identifier: GPL-3.0-or-later
# Each adapter beside its real counterpart.  Truth: differences of values, the
# exact judge of motions, and three solvers that must agree.  A wheel that does
# not load here is said so, by name.
import numpy as np
import phongpd
import pytest

START, GOAL = (-1, 0.1, 0), (3, 0, 0.1)
MARGIN = "0.05unit"


def counterpart(module):
    return pytest.importorskip(
        module, reason=f"the wheel of {module} does not load here",
        exc_type=ImportError)


def whole(u):
    return np.vstack([[START], np.reshape(u, (-1, 3)), [GOAL]])


def energy(u):
    return float((np.diff(whole(u), axis=0) ** 2).sum())


def slope(u):
    steps = 2 * np.diff(whole(u), axis=0)
    return (steps[:-1] - steps[1:]).ravel()


def line(waypoints):
    """Straight through the obstacle: the solver has to find the way out."""
    return np.linspace(START, GOAL, waypoints + 2)[1:-1].ravel()


@pytest.fixture
def rows(world):
    return phongpd.NonPenetrationRows(world, START, GOAL, waypoints=10,
                                      margin=MARGIN)


def is_free(world, u):
    path = whole(u)
    return bool(world.is_motion_free(path[:-1], path[1:]).all())


def solve_by_casadi(rows):
    casadi = counterpart("casadi")
    from phongpd.for_casadi import BranchAdvance, NonPenetration
    m, n = rows.shape
    keep = NonPenetration(rows)
    u = casadi.MX.sym("u", n)
    path = casadi.reshape(
        casadi.vertcat(casadi.DM(START), u, casadi.DM(GOAL)), 3, -1)
    advance = BranchAdvance(rows, variables=n, constraints=m)
    solver = casadi.nlpsol(
        "solver", "ipopt",
        {"x": u, "f": casadi.sumsqr(path[:, 1:] - path[:, :-1]), "g": keep(u)},
        {"ipopt.hessian_approximation": "limited-memory",
         "iteration_callback": advance, "print_time": False,
         "ipopt.print_level": 0, "ipopt.sb": "yes"})
    found = solver(x0=line(n // 3), lbg=rows.margin)
    assert solver.stats()["success"]
    return np.array(found["x"]).ravel()


def solve_by_cyipopt(rows):
    counterpart("cyipopt")
    from phongpd.for_cyipopt import NonPenetrationProblem
    program = NonPenetrationProblem(rows, energy, slope).problem()
    program.add_option("print_level", 0)
    program.add_option("sb", "yes")
    u, info = program.solve(line(rows.shape[1] // 3))
    assert info["status"] in (0, 1)  # solved, to an acceptable level
    return u


def solve_by_scipy(rows):
    optimize = counterpart("scipy.optimize")
    found = optimize.minimize(
        energy, line(rows.shape[1] // 3), jac=slope, method="SLSQP",
        callback=rows.accept, options={"maxiter": 300},
        constraints={"type": "ineq", "fun": lambda u: rows.value(u) - rows.margin,
                     "jac": rows.jacobian})
    assert found.success
    return found.x


@pytest.mark.parametrize("solve", [solve_by_casadi, solve_by_cyipopt,
                                   solve_by_scipy])
def test_a_solver_leads_the_line_out_of_the_box(world, rows, solve):
    assert not is_free(world, line(10))
    u = solve(rows)
    assert rows.value(u).min() > rows.margin - 1e-6
    assert is_free(world, u)


# A cell of one's own: a tool among fences thinner than what lies between two
# samples.  Beyond them a path goes over or around.
FENCES = [((-0.01, -0.5, -0.5), (0.01, 0.5, 0.3)),   # 20 mm
          ((-0.001, -0.6, -0.6), (0.001, 0.4, 0.5)),  # 2 mm
          ((0.3, -0.3, -0.9), (0.32, 0.9, 0.2))]
CELL = (-1, 0.02, 0.01), (1, -0.03, 0.02)


def in_cell(solve, fence, monkeypatch, **options):
    """Does the solver claim success, and is the path free?"""
    from conftest import make_box
    tool = make_box((-0.005, -0.005, -0.005), (0.005, 0.005, 0.005))
    world = phongpd.World(tool, {"fence": make_box(*fence)})
    monkeypatch.setitem(globals(), "START", CELL[0])
    monkeypatch.setitem(globals(), "GOAL", CELL[1])
    rows = phongpd.NonPenetrationRows(world, *CELL, waypoints=20,
                                      margin="0.005unit", **options)
    try:
        u = solve(rows)
    except AssertionError:
        return False, None  # it says itself that it failed
    path = rows.path(u)
    assert (path[0] == CELL[0]).all() and (path[-1] == CELL[1]).all()
    return True, bool(world.is_motion_free(path[:-1], path[1:]).all())


SOLVERS = [solve_by_casadi, solve_by_cyipopt, solve_by_scipy]


@pytest.mark.parametrize("solve", SOLVERS)
@pytest.mark.parametrize("fence", FENCES)
def test_no_success_is_claimed_for_a_path_through_a_fence(solve, fence,
                                                          monkeypatch):
    claimed, free = in_cell(solve, fence, monkeypatch)
    assert free or not claimed
    assert claimed or fence == FENCES[2]  # that one is hard


def test_samples_of_ones_own_may_miss_a_fence(monkeypatch):
    """Why the rule is the default: the case is one."""
    assert in_cell(solve_by_scipy, FENCES[0], monkeypatch,
                   samples_per_segment=4) == (True, False)


def test_samples_by_the_rule_leave_no_gap(world):
    for waypoints in (1, 5, 40):
        for margin in ("0.002unit", "0.05unit"):
            rows = phongpd.NonPenetrationRows(world, START, GOAL, margin=margin,
                                              waypoints=waypoints)
            s, h = rows.samples_per_segment, rows.max_segment
            assert h == pytest.approx(
                1.6 * np.linalg.norm(np.subtract(START, GOAL)) / (waypoints + 1))
            assert h / (s + 1) < 2 * rows.margin <= h / max(s, 1e-9)
            # The last rows are the segments'.
            u = line(waypoints) + 0.01 * np.arange(3 * waypoints) % 0.07
            length = np.linalg.norm(np.diff(whole(u), axis=0), axis=1)
            assert rows.value(u)[-waypoints - 1:] == pytest.approx(
                rows.margin + h - length)
            slope, step = rows.jacobian(u)[-waypoints - 1:], 1e-6
            for k in range(min(9, len(u))):
                e = np.zeros(len(u))
                e[k] = step
                change = (rows.value(u + e) - rows.value(u - e)) / (2 * step)
                assert change[-waypoints - 1:] == pytest.approx(slope[:, k],
                                                                abs=1e-6)


def test_ends_without_the_margin_are_said(world):
    room = world.clearance([START])[0]
    with pytest.raises(phongpd.InputError, match="room of the start"):
        phongpd.NonPenetrationRows(world, START, GOAL, margin=f"{1.1 * room}unit")


def test_solvers_agree(world):
    found = []
    for solve in (solve_by_casadi, solve_by_cyipopt):
        rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=10,
                                          margin=MARGIN)
        found.append(energy(solve(rows)))
    assert found[0] == pytest.approx(found[1], rel=1e-5)


@pytest.mark.parametrize("metric", ["euclidean", "phong@0.2/exact"])
def test_casadi_has_value_and_slope_of_the_rows(world, metric):
    casadi = counterpart("casadi")
    from phongpd.for_casadi import NonPenetration
    rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=5,
                                      samples_per_segment=2, metric=metric)
    keep = NonPenetration(rows)
    x = casadi.MX.sym("x", rows.shape[1])
    # Through a map of CasADi's own, so that its chain rule is used.
    g = casadi.Function("g", [x], [keep(2 * x)])
    jacobian = casadi.Function("J", [x], [casadi.jacobian(keep(2 * x), x)])
    u = (line(5).reshape(-1, 3) + [0.0, 0.3, 0.7]).ravel() / 2
    assert (np.array(g(u)).ravel() == rows.value(2 * u)).all()
    # As sparse as the path is: a sample knows two waypoints at most.
    assert jacobian.sparsity_out(0).nnz() == len(rows.pattern[0])
    exact, h = np.array(jacobian(u)), 1e-6
    for k in range(rows.shape[1]):
        step = np.zeros(rows.shape[1])
        step[k] = h
        change = np.array(g(u + step) - g(u - step)).ravel() / (2 * h)
        assert np.abs(change - exact[:, k]).max() < 1e-6
    with pytest.raises(RuntimeError, match="expected finite numbers"):
        keep(np.full(rows.shape[1], np.nan))


@pytest.mark.parametrize("metric, verdict", [
    ("euclidean", "No errors detected"), ("phong@0.2/exact", "No errors detected"),
    ("phong@0.2", "checker detected")])  # the direction, no slope
def test_cyipopts_own_check_tells_slopes_from_directions(world, capfd, metric,
                                                         verdict):
    counterpart("cyipopt")
    from phongpd.for_cyipopt import NonPenetrationProblem
    rows = phongpd.NonPenetrationRows(world, START, GOAL, waypoints=5,
                                      samples_per_segment=2, metric=metric)
    program = NonPenetrationProblem(rows, energy, slope).problem()
    for option, value in (("derivative_test", "first-order"), ("max_iter", 0),
                          ("derivative_test_tol", 1e-4), ("print_level", 4),
                          ("point_perturbation_radius", 0.0)):
        program.add_option(option, value)
    program.solve((line(5).reshape(-1, 3) + [0.0, 0.3, 0.7]).ravel())
    assert verdict in capfd.readouterr().out


def test_branches_follow_the_solver(rows):
    counterpart("cyipopt")
    from phongpd.for_cyipopt import NonPenetrationProblem
    accepted = []

    class Watched(phongpd.NonPenetrationRows):
        def accept(self, u):
            accepted.append(np.array(u))
            super().accept(u)

    rows.__class__ = Watched
    program = NonPenetrationProblem(rows, energy, slope).problem()
    program.add_option("print_level", 0)
    u, _ = program.solve(line(10))
    assert (accepted[0] == line(10)).all()
    assert (accepted[-1] == u).all() and len(accepted) > 3


def test_ompl_plans_with_exact_motions(world):
    counterpart("ompl")
    from ompl import geometric, util
    from phongpd.for_ompl import path_of, simple_setup, state_of
    util.setLogLevel(util.LogLevel.LOG_NONE)
    for planner in (geometric.RRTConnect, geometric.KPIECE1, geometric.PRM):
        setup = simple_setup(world)
        setup.setStartAndGoalStates(state_of(setup, START),
                                    state_of(setup, GOAL))
        setup.setPlanner(planner(setup.getSpaceInformation()))
        assert setup.solve(10.0)
        path = path_of(setup.getSolutionPath())
        assert path[0] == pytest.approx(START)
        assert path[-1] == pytest.approx(GOAL)
        assert world.is_motion_free(path[:-1], path[1:]).all()


def test_ompl_sees_a_needle_between_two_samples(robot):
    counterpart("ompl")
    from conftest import make_box
    from phongpd.for_ompl import simple_setup, state_of
    needle = make_box((1.5, 0.5, -9), (1.5 + 1e-9, 0.5 + 1e-9, 9))
    world = phongpd.World(make_box((0, 0, 0), (1e-3, 1e-3, 1e-3)),
                          {"needle": needle}, bounds=[[-3] * 3, [4] * 3])
    setup = simple_setup(world)
    space = setup.getSpaceInformation()
    through = [state_of(setup, (x, 0.4995, 0)) for x in (-1, 3)]
    beside = [state_of(setup, (x, 0.4985, 0)) for x in (-1, 3)]
    assert space.isValid(through[0]) and space.isValid(through[1])
    assert not space.checkMotion(*through)
    assert space.checkMotion(*beside)


def test_what_adapters_cannot_use_is_said(world, rows):
    counterpart("casadi"), counterpart("cyipopt"), counterpart("ompl")
    from phongpd.for_casadi import BranchAdvance, NonPenetration
    from phongpd.for_cyipopt import NonPenetrationProblem
    from phongpd.for_ompl import simple_setup, state_of
    endless = phongpd.World(world.robot, {"o": world.obstacles[0]})
    for call in (lambda: NonPenetration("rows"),
                 lambda: BranchAdvance(rows, variables=3, constraints=1),
                 lambda: NonPenetrationProblem(None, energy, slope),
                 lambda: simple_setup(endless),
                 lambda: simple_setup("world"),
                 lambda: state_of(simple_setup(world), (0, np.nan, 0))):
        with pytest.raises(phongpd.InputError) as error:
            call()
        assert "\n" not in str(error.value)
