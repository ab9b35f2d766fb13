# SPDX-License-Identifier: GPL-3.0-or-later
"""Solvers of the study's part on others: problems whose answer is known in closed
form, and is the published page that of the published rows?"""
import importlib
import pathlib
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results/bench"))
pytest.importorskip("phongpd")
import study_solvers  # noqa: E402
import study_solvers_chomp as chomp  # noqa: E402
import study_solvers_program as programs  # noqa: E402
import study_solvers_report as reports  # noqa: E402

START, GOAL = np.array([-0.5, 0.0, 0.0]), np.array([0.5, 0.0, 0.0])
MARGIN = 0.01


class Rows:
    """Rows of a distance in closed form, as NonPenetrationRows tells them."""

    def __init__(self, distance, waypoints, inner):
        self.distance, self.samples_per_segment = distance, inner
        self.margin, self.max_segment = MARGIN, 0.5 * 1.6
        self.weights = programs.sample_weights(waypoints, inner)
        sample, waypoint = np.nonzero(self.weights[:, 1:-1])
        self.blocks = sample, self.weights[:, 1:-1][sample, waypoint]
        self.shape = len(self.weights), 3 * waypoints
        self.pattern = (np.repeat(sample, 3), (3 * waypoint[:, None]
                                               + np.arange(3)).ravel())

    def path(self, u):
        return np.vstack([START, np.reshape(u, (-1, 3)), GOAL])

    def accept(self, u):
        pass

    def value(self, u):
        return self.distance(self.weights @ self.path(u))[0]

    def entries(self, u):
        sample, weight = self.blocks
        n = self.distance(self.weights @ self.path(u))[1]
        return (weight[:, None] * n[sample]).ravel()


def ball(q):
    """Of radius 0.2, its centre below the line."""
    away = q - [0.0, 0.0, -0.05]
    r = np.linalg.norm(away, axis=1)
    return r - 0.2, away / r[:, None]


def floor(q):
    """z >= 0.1."""
    return q[:, 2] - 0.1, np.tile([0.0, 0.0, 1.0], (len(q), 1))


def nothing(q):
    return np.ones(len(q)), np.tile([0.0, 0.0, 1.0], (len(q), 1))


def program(distance, waypoints=1, inner=0):
    return programs.Program(Rows(distance, waypoints, inner), START, GOAL, 1.0)


def load(solver):
    """Its function; skips where one of its packages is not installed."""
    module, function, packages = study_solvers.SOLVERS[solver]
    for package in packages:
        pytest.importorskip(package)
    return getattr(importlib.import_module(module), function)


@pytest.mark.parametrize("solver, tolerance", [
    ("sqp", 1e-3), ("ipopt-3.14", 1e-5), ("ipopt-3.11", 1e-5), ("snopt", 1e-5)])
@pytest.mark.parametrize("distance, height", [
    # The nearest point to the line's middle that has the margin.
    (ball, 0.2 + MARGIN - 0.05), (floor, 0.1 + MARGIN), (nothing, 0.0)])
def test_one_waypoint_goes_where_it_is_known_to(solver, tolerance, distance, height):
    solve = load(solver)
    asked = program(distance)
    v, says = solve(asked)
    assert says
    assert v == pytest.approx([0.0, 0.0, height], abs=tolerance)
    # Two steps of √(1/4 + h²), of one of 1.
    assert asked.objective(v) == pytest.approx(1.0 + 4.0 * height ** 2, abs=tolerance)
    assert asked.evaluations < 100


@pytest.mark.parametrize("solver, most", [
    ("sqp", 1.05), ("ipopt-3.14", 1.05), ("ipopt-3.11", 1.05), ("snopt", 1.05),
    ("kto", 1.2)])  # whose energy is that of its control points
def test_many_waypoints_go_around_the_ball(solver, most):
    solve = load(solver)
    asked = program(ball, 12, 2)
    v, says = solve(asked)
    assert says and asked.gaps(v).min() > -1e-4
    # No shorter than the tangents and the arc, but for corners, and hardly longer.
    height, radius = 0.05, 0.2 + MARGIN
    reach = np.hypot(0.5, height)
    turn = 2.0 * (np.arctan2(0.5, height) - np.arccos(radius / reach))
    length = 2.0 * np.sqrt(reach ** 2 - radius ** 2) + radius * turn
    assert length ** 2 * 0.98 < asked.objective(v) < length ** 2 * most


def test_budgets_end_a_run():
    solve = load("ipopt-3.11")
    asked = programs.Program(Rows(ball, 12, 2), START, GOAL, 1.0, most=3)
    assert not solve(asked)[1] and asked.is_spent()


def test_value_and_slope_at_one_point_are_one_evaluation():
    asked = program(ball)
    asked.gaps(asked.first)
    asked.entries(asked.first)
    assert asked.evaluations == 1
    asked.gaps(asked.first + 0.1)
    assert asked.evaluations == 2


def test_objective_has_its_slope():
    asked = program(ball, 4)
    v = asked.first + np.random.default_rng(1).normal(0.0, 0.1, asked.size)
    assert asked.objective(asked.first) == pytest.approx(1.0)
    for i, step in enumerate(1e-6 * np.eye(asked.size)):
        change = asked.objective(v + step) - asked.objective(v - step)
        assert asked.slope(v)[i] == pytest.approx(change / 2e-6, abs=1e-7)


def test_chomps_costs_have_their_slopes():
    d = np.array([-0.3, -0.1, 0.05, 0.15, 0.3])
    cost, slope = chomp.potential(d)
    change = chomp.potential(d + 1e-7)[0] - chomp.potential(d - 1e-7)[0]
    assert slope == pytest.approx(change / 2e-7, abs=1e-6)
    # It is continuous at both ends of the layer.
    for at in (0.0, chomp.CLEARANCE):
        low, high = chomp.potential(np.array([at - 1e-12, at + 1e-12]))[0]
        assert low == pytest.approx(high, abs=1e-11)
    smooth = chomp._Smoothness(program(ball, 6))
    x = np.random.default_rng(2).normal(0.0, 0.1, (6, 3))
    slope = smooth.cost_and_slope(x)[1]
    for i in range(18):
        step = np.zeros((6, 3))
        step.flat[i] = 1e-6
        change = (smooth.cost_and_slope(x + step)[0]
                  - smooth.cost_and_slope(x - step)[0])
        assert slope.flat[i] == pytest.approx(change / 2e-6, abs=1e-6)


def test_chomp_leaves_the_ball():
    asked = program(ball, 20, 2)
    assert asked.gaps(asked.first).min() < -0.1
    v, says = chomp.solve(asked)
    assert says
    assert asked.gaps(v).min() > -MARGIN  # it keeps no margin
    # What is free from the start stays the line.
    asked = program(nothing, 20, 2)
    v, says = chomp.solve(asked)
    assert says and np.array_equal(v, asked.first)


def test_samples_are_those_of_the_path():
    path = np.arange(4.0)  # ends, and two waypoints
    assert programs.sample_weights(2, 1) @ path == pytest.approx(
        [0.5, 1.0, 1.5, 2.0, 2.5])


def test_placebos_are_as_far_and_by_lot():
    chance = np.random.default_rng(3)
    n = chance.normal(size=(1000, 3))
    n /= np.linalg.norm(n, axis=1)[:, None]
    angle, lot = chance.uniform(0.0, 3.0, 1000), programs.lots(n)
    found = programs.turned(n, angle, lot)
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(1000))
    assert np.arccos((found * n).sum(axis=1)) == pytest.approx(angle, abs=1e-6)
    assert np.array_equal(lot, programs.lots(n))
    assert abs(np.exp(1j * lot).mean()) < 0.1  # all around


def test_placebo_rows_have_euclids_values_and_another_side():
    phongpd = pytest.importorskip("phongpd")
    world = phongpd.World.load("u_axis", seed=90001)
    kinds = {name: programs.make_rows(world, name, 10) for name in
             ("euclidean", "smoothed@0.2", "placebo@0.2")}
    u = np.linspace(world.start, world.goal, 12)[1:-1].ravel()
    values = kinds["euclidean"].value(u)
    assert np.array_equal(values, kinds["placebo@0.2"].value(u))
    n = {name: kinds["placebo@0.2"]._directions(rows.entries(u))
         for name, rows in kinds.items()}
    count = len(n["euclidean"])
    inside = values[:count] < 0.0
    assert inside.any() and not inside.all()
    assert n["placebo@0.2"][~inside] == pytest.approx(n["euclidean"][~inside])
    cosines = {name: (one * n["euclidean"]).sum(axis=1)[inside]
               for name, one in n.items()}
    assert cosines["placebo@0.2"] == pytest.approx(cosines["smoothed@0.2"], abs=1e-9)


def made_rows(won):
    """Of 9 families; what `won` says of (solver, metric) is converged and free."""
    return [{"scene": f"f{family}:x=1", "family": f"f{family}",
             "problem": (f"f{family}:x=1", "1"), "cell": (solver, metric),
             "both": won(solver, metric)}
            for family in range(9) for solver in reports.SOLVERS
            for metric in (*reports.METRICS, reports.EXACT)]


def test_22_comparisons_are_corrected_together():
    none = reports.hypotheses(made_rows(lambda solver, metric: True))
    assert len(none) == 22
    assert {one["verdict"] for one in none} == {"tie"}
    found = reports.hypotheses(made_rows(
        lambda solver, metric: solver == "sqp" and metric == "phong@0.2"))
    assert {one["a"] for one in found if one["difference"] == 1.0} == {
        ("sqp", "phong@0.2")}
    # 2 of 2^9 ways, times 22.
    assert min(one["corrected"] for one in found) == pytest.approx(44 / 512)


def test_problems_must_be_the_same():
    rows = made_rows(lambda solver, metric: True)[1:]
    with pytest.raises(SystemExit, match="same problems"):
        reports.hypotheses(rows)


def test_the_published_page_is_that_of_its_rows(tmp_path):
    for name in ("solvers.csv", "rows.csv", "solvers_measured.txt"):
        (tmp_path / name).write_bytes((ROOT / "results/study" / name).read_bytes())
    reports.report(tmp_path)
    assert (tmp_path / "solvers.md").read_text() == \
        (ROOT / "results/study/solvers.md").read_text()


if __name__ == "__main__":
    sys.exit(pytest.main([__file__, "-q", "-p", "no:cacheprovider"]))
