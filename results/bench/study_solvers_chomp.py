# SPDX-License-Identifier: GPL-3.0-or-later
"""CHOMP (Zucker and others, IJRR 2013): covariant descent of smoothness and of an
obstacle cost that is zero where there is room,

    x <- x − η A⁻¹ (λ ∂smooth + ∂obstacle),    smooth = xᵀ A x of accelerations,
    ∂obstacle = Σ |x'| ((I − x̂'x̂'ᵀ) ∇c − c κ),

c of the signed distance d: ε/2 − d inside, (d − ε)²/2ε within ε, 0 beyond."""
import numpy as np

from study_solvers_program import sample_weights

# chomp_planning.yaml of MoveIt; its metres are shares of D, and its path takes 3 s.
ITERATIONS, AFTERWARDS, CHECK_EVERY = 200, 5, 10
SMOOTHNESS, OBSTACLE, RATE, RIDGE = 0.1, 1.0, 0.01, 0.01
STEP_LIMIT, CLEARANCE, THRESHOLD, DURATION = 0.1, 0.2, 0.07, 3.0


def potential(d):
    """c and its slope, of distances in units of D."""
    near = (d >= 0.0) & (d < CLEARANCE)
    cost = np.where(d < 0.0, 0.5 * CLEARANCE - d, 0.0)
    slope = np.where(d < 0.0, -1.0, 0.0)
    cost[near] = (d[near] - CLEARANCE) ** 2 / (2.0 * CLEARANCE)
    slope[near] = (d[near] - CLEARANCE) / CLEARANCE
    return cost, slope


class _Smoothness:
    """Accelerations by differences, the ends at rest."""

    def __init__(self, program):
        n = program.waypoints
        second = np.zeros((n + 2, n + 4))  # the path and one more of each end
        for i in range(n + 2):
            second[i, i:i + 3] = 1.0, -2.0, 1.0
        free, fixed = second[:, 2:-2], second[:, [0, 1, -2, -1]]
        ends = np.array([program.start] * 2 + [program.goal] * 2)
        matrix = free.T @ free + RIDGE * np.eye(n)
        inverse = np.linalg.inv(matrix)
        # As MoveIt scales it: no entry of the inverse above 1.
        scale = inverse.max()
        self.inverse, self.scale = inverse / scale, scale
        self.free, self.moved = free, fixed @ ends

    def cost_and_slope(self, x):
        accelerations = self.free @ x + self.moved
        return (self.scale * float((accelerations ** 2).sum()),
                2.0 * self.scale * self.free.T @ accelerations)


class _Obstacles:

    def __init__(self, program):
        self.p = program
        inner = program.rows.samples_per_segment
        self.weights = sample_weights(program.waypoints, inner)
        self.share = 1.0 / (inner + 1)  # of a waypoint's time
        self.step = DURATION / (program.waypoints + 1)
        self.count = len(self.weights)
        self.margin = program.rows.margin / program.unit

    def _motion(self, x):
        """Velocity and acceleration at the samples: of the waypoints by central
        differences, in between by those of its segment's ends."""
        path = self.p.path(x)
        velocity, acceleration = np.zeros_like(path), np.zeros_like(path)
        velocity[1:-1] = (path[2:] - path[:-2]) / (2.0 * self.step)
        acceleration[1:-1] = (path[2:] - 2.0 * path[1:-1]
                              + path[:-2]) / self.step ** 2
        velocity[[0, -1]] = (path[[1, -1]] - path[[0, -2]]) / self.step
        return self.weights @ velocity, self.weights @ acceleration

    def cost_and_slope(self, x):
        """Cost, functional gradient of the waypoints, least distance."""
        v = x.ravel()
        d = self.p.gaps(v)[:self.count] + self.margin
        cost, slope = potential(d)
        jacobian = np.zeros((self.p.count, self.p.size))
        jacobian[self.p.pattern] = self.p.entries(v)
        # Of each sample: its direction, from the waypoint that weighs most.
        free = self.weights[:, 1:-1]
        heavy = free.argmax(axis=1)
        at = np.arange(self.count)
        n = jacobian[:self.count].reshape(self.count, -1, 3)[at, heavy] \
            / free[at, heavy][:, None]
        velocity, acceleration = self._motion(x)
        speed = np.maximum(np.linalg.norm(velocity, axis=1), 1e-12)
        along = velocity / speed[:, None]

        def across(a):
            return a - along * (a * along).sum(axis=1)[:, None]
        bent = across(acceleration) / speed[:, None] ** 2
        change = speed[:, None] * (slope[:, None] * across(n) - cost[:, None] * bent)
        return (self.share * float((cost * speed).sum()),
                self.share * free.T @ change, d.min())


def solve(program):
    """(v, says collision-free): the iterate of least cost, as MoveIt returns it.
    All points move at once, as in the paper."""
    smooth, obstacles = _Smoothness(program), _Obstacles(program)
    x = np.clip(program.first, program.low, program.high).reshape(-1, 3)
    low, high = program.low.reshape(-1, 3), program.high.reshape(-1, 3)
    best, best_cost, best_room, left, is_free = x, np.inf, -np.inf, None, False
    for iteration in range(ITERATIONS):
        if program.is_spent():
            break
        program.accept(x.ravel())
        smooth_cost, smooth_slope = smooth.cost_and_slope(x)
        cost, slope, room = obstacles.cost_and_slope(x)
        if SMOOTHNESS * smooth_cost + OBSTACLE * cost < best_cost:
            best, best_room = x, room
            best_cost = SMOOTHNESS * smooth_cost + OBSTACLE * cost
        if iteration % CHECK_EVERY == 0 and best_room > 0.0:
            return best.ravel(), True
        if left is None and OBSTACLE * cost < THRESHOLD:
            is_free, left = True, AFTERWARDS
        if left is not None:
            if left == 0:
                break
            left -= 1
        change = -RATE * smooth.inverse @ (SMOOTHNESS * smooth_slope
                                           + OBSTACLE * slope)
        largest = np.abs(change).max(axis=0)
        x = np.clip(x + change * np.minimum(1.0, STEP_LIMIT / np.maximum(
            largest, 1e-300)), low, high)
    return best.ravel(), is_free
