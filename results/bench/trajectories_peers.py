# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions of peers, beside PhongPD's on the same ends and limits.  What needs a
path gets the polyline that PhongPD's own motion began with.  Each function gives
(what it says itself, seconds, positions over time, derivatives over time or
None, where it is: the corners of a polyline, or a spline, in time or not)."""
import numpy as np

CONTROL_POINTS, COLLISION_SAMPLES = 40, 60  # of Drake
MARGIN = 1e-4  # of D: for all the same, next to none
WIDE = 0.01  # of D: what a user of samples adds, so that nothing is between them
# Points at which TOPP-RA keeps its limits: between fewer it exceeds them.
GRID = 4_001
SIMPLIFY_SECONDS = 5.0


def ruckig_stops(problem):
    """Straight from corner to corner, at rest in each; axes in phase, so that
    the segments are kept."""
    import ruckig
    v, a, j = problem.limits
    total, knots = 0.0, []
    for begin, end in zip(problem.path[:-1], problem.path[1:]):
        wish = ruckig.InputParameter(3)
        wish.current_position, wish.target_position = list(begin), list(end)
        for name in ("current", "target"):
            setattr(wish, f"{name}_velocity", [0.0] * 3)
            setattr(wish, f"{name}_acceleration", [0.0] * 3)
        wish.max_velocity, wish.max_acceleration = [v] * 3, [a] * 3
        wish.max_jerk = [j] * 3
        wish.synchronization = ruckig.Synchronization.Phase
        found = ruckig.Trajectory(3)
        result = ruckig.Ruckig(3).calculate(wish, found)
        if result not in (ruckig.Result.Working, ruckig.Result.Finished):
            raise ValueError(f"ruckig: {result}")
        knots.append(found)
        total += found.duration

    def at(times):
        begins = np.concatenate([[0.0], np.cumsum([k.duration for k in knots])])
        which = np.clip(np.searchsorted(begins, times, side="right") - 1, 0,
                        len(knots) - 1)
        return np.array([[knots[k].at_time(min(max(t - begins[k], 0.0),
                                               knots[k].duration))[order]
                          for k, t in zip(which, times)] for order in range(3)])
    return (True, total, lambda t: at(t)[0], lambda t: (*at(t)[1:], None),
            problem.path)


def _through_spline(corners, problem):
    import toppra
    import toppra.algorithm
    import toppra.constraint
    toppra.setup_logging("ERROR")
    steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    corners = corners[np.concatenate([[True], steps > 1e-9])]
    at = np.concatenate([[0.0], np.cumsum(
        np.linalg.norm(np.diff(corners, axis=0), axis=1))])
    path = toppra.SplineInterpolator(at, corners)
    v, a, _ = problem.limits
    bound = np.array([[-1.0, 1.0]] * 3)
    solver = toppra.algorithm.TOPPRA(
        [toppra.constraint.JointVelocityConstraint(v * bound),
         toppra.constraint.JointAccelerationConstraint(a * bound)],
        path, gridpoints=np.linspace(*path.path_interval, GRID),
        parametrizer="ParametrizeConstAccel")
    found = solver.compute_trajectory(0.0, 0.0)
    if found is None:
        raise ValueError("toppra: no parametrization")
    return (True, float(found.duration), found,
            lambda t: (found(t, 1), found(t, 2), None), path.cspl)


def toppra_corners(problem):
    """A cubic spline through the corners, as fast as velocity and acceleration
    allow.  It knows no jerk and no obstacle."""
    return _through_spline(problem.path, problem)


def ompl_toppra(problem):
    """OMPL's simplifier with PhongPD's exact checks, then as above."""
    from ompl import base, geometric
    from phongpd.for_ompl import ExactMotionValidator, ExactValidityChecker
    space, box = base.RealVectorStateSpace(3), base.RealVectorBounds(3)
    low, high = problem.box()
    for axis in range(3):
        box.setLow(axis, float(low[axis]))
        box.setHigh(axis, float(high[axis]))
    space.setBounds(box)
    # The setup must outlive its path.
    setup = geometric.SimpleSetup(space)
    information = setup.getSpaceInformation()
    information.setStateValidityChecker(
        ExactValidityChecker(information, problem.world))
    information.setMotionValidator(
        ExactMotionValidator(information, problem.world))
    information.setup()
    path = geometric.PathGeometric(information)
    for corner in problem.path:
        state = space.allocState()
        for axis in range(3):
            state[axis] = float(corner[axis])
        path.append(state)
    geometric.PathSimplifier(information).simplify(path, SIMPLIFY_SECONDS)
    corners = np.array([[s[0], s[1], s[2]] for s in path.getStates()])
    return _through_spline(corners, problem)


def _resampled(path, count):
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    where = np.linspace(0.0, at[-1], count)
    return np.column_stack([np.interp(where, at, path[:, k]) for k in range(3)])


def _kto(problem, first, margin=MARGIN):
    """Drake's KinematicTrajectoryOptimization by SNOPT: a cubic B-spline, its
    derivatives' control points within the limits; obstacles by PhongPD's exact
    distance, at samples."""
    from pydrake.autodiffutils import ExtractGradient, ExtractValue, \
        InitializeAutoDiff
    from pydrake.planning import KinematicTrajectoryOptimization
    from pydrake.solvers import SnoptSolver, SolverOptions
    from pydrake.trajectories import BsplineTrajectory
    from scipy.interpolate import BSpline
    wish = KinematicTrajectoryOptimization(3, CONTROL_POINTS, 4, 1.0)
    v, a, j = problem.limits
    one = np.ones(3)
    wish.AddDurationCost(1.0)
    wish.AddVelocityBounds(-v * one, v * one)
    wish.AddAccelerationBounds(-a * one, a * one)
    wish.AddJerkBounds(-j * one, j * one)
    low, high = problem.box()
    wish.AddPositionBounds(low, high)
    wish.AddDurationConstraint(0.1 * problem.stops, 2.0 * problem.stops)
    for s, end in ((0, problem.start), (1, problem.goal)):
        wish.AddPathPositionConstraint(end, end, s)
        wish.AddPathVelocityConstraint(0 * one, 0 * one, s)
        wish.AddPathAccelerationConstraint(0 * one, 0 * one, s)
    basis = wish.basis()
    weights = np.array([[basis.EvaluateBasisFunctionI(i, s)
                         for i in range(CONTROL_POINTS)]
                        for s in np.linspace(0, 1, COLLISION_SAMPLES + 2)[1:-1]])

    def clear(x):
        is_plain = x.dtype != object
        flat = x if is_plain else ExtractValue(x).ravel()
        points = weights @ flat.reshape(3, -1, order="F").T
        value, slope = problem.distances(points)
        if is_plain:
            return value
        jacobian = np.einsum("si,sk->sik", weights, slope).reshape(
            COLLISION_SAMPLES, -1)
        return InitializeAutoDiff(value, jacobian @ ExtractGradient(x)).ravel()

    program = wish.get_mutable_prog()
    program.AddConstraint(
        clear, np.full(COLLISION_SAMPLES, margin * problem.world.length),
        np.full(COLLISION_SAMPLES, np.inf),
        np.asarray(wish.control_points()).ravel(order="F"))
    wish.SetInitialGuess(BsplineTrajectory(
        basis, [c.reshape(3, 1) for c in _resampled(first, CONTROL_POINTS)]))
    program.SetInitialGuess(wish.duration(), problem.stops)
    options = SolverOptions()
    options.SetOption(SnoptSolver.id(), "Major iterations limit", 300)
    result = SnoptSolver().Solve(program, program.initial_guess(), options)
    found = wish.ReconstructTrajectory(result)
    slopes = [found.MakeDerivative(k) for k in (1, 2, 3)]
    return (bool(result.is_success()), float(found.end_time()),
            lambda t: found.vector_values(t).T,
            lambda t: tuple(s.vector_values(t).T for s in slopes),
            BSpline(found.basis().knots(),
                    np.hstack(found.control_points()).T, found.basis().degree()))


def drake_line(problem):
    return _kto(problem, np.array([problem.start, problem.goal]))


def drake_path(problem):
    return _kto(problem, problem.path)


def drake_wide(problem):
    return _kto(problem, problem.path, WIDE)


# Name, package, how, and what to know of it.
PEERS = [
    ("Ruckig, stops", "ruckig", ruckig_stops,
     "rests at each corner of our path; free, as it keeps the segments"),
    ("TOPP-RA", "toppra", toppra_corners,
     "spline through the corners of our path; has no limit of jerk"),
    ("OMPL + TOPP-RA", "ompl", ompl_toppra,
     "our path by OMPL's simplifier first; has no limit of jerk"),
    ("Drake KTO, line", "drake", drake_line, "begins with the straight line"),
    ("Drake KTO, path", "drake", drake_path, "begins with our path"),
    ("Drake KTO, path, wide", "drake", drake_wide,
     f"the same, with a margin of {WIDE:g} D at its samples")]
