// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/path_springs.h"

#include <algorithm>
#include <cmath>

namespace phongpd {

using Eigen::Vector3d;

PathSprings::PathSprings(const TrajectoryProblem& problem, double start_length)
    : center(0.5 * problem.start + 0.5 * problem.goal),
      unit(Diagonal(problem)),
      waypoints(problem.waypoints),
      start((problem.start - center) / unit),
      goal((problem.goal - center) / unit),
      eta(MaxSegment(problem, start_length) / unit) {
  const double reference = std::max((goal - start).norm(), 1e-3);
  weight = (waypoints + 1) / (reference * reference);
}

Eigen::VectorXd PathSprings::ToVariables(const Path& path) const {
  Eigen::VectorXd u(3 * waypoints);
  for (int i = 0; i < waypoints; ++i) {
    u.segment<3>(3 * i) =
        (path[static_cast<std::size_t>(i + 1)] - center) / unit;
  }
  return u;
}

Path PathSprings::ToPath(const Vector3d& first, const double* x,
                         const Vector3d& last) const {
  Path path{first};
  for (int i = 0; i < waypoints; ++i) {
    path.push_back(center + unit * Eigen::Map<const Vector3d>(x + 3 * i));
  }
  path.push_back(last);
  return path;
}

Vector3d PathSprings::Step(int segment, const double* x) const {
  using Map = Eigen::Map<const Vector3d>;
  const Vector3d from =
      segment == 0 ? start : Vector3d(Map(x + 3 * (segment - 1)));
  const Vector3d to =
      segment == waypoints ? goal : Vector3d(Map(x + 3 * segment));
  return to - from;
}

double PathSprings::Energy(const double* x) const {
  double sum = 0.0;
  for (int i = 0; i <= waypoints; ++i) sum += Step(i, x).squaredNorm();
  return weight * sum;
}

void PathSprings::Gradient(const double* x, double* gradient) const {
  for (int i = 0; i < waypoints; ++i) {
    Eigen::Map<Vector3d>(gradient + 3 * i) =
        2.0 * weight * (Step(i, x) - Step(i + 1, x));
  }
}

bool PathSprings::Lengths(const double* x, double* values,
                          double* jacobian) const {
  bool are_finite = true;
  for (int i = 0; i <= waypoints; ++i) {
    const Vector3d step = Step(i, x);
    values[i] = step.squaredNorm() / eta;
    are_finite = are_finite && std::isfinite(values[i]);
    for (int end = 0; end < 2; ++end) {
      const int waypoint = i - 1 + end;
      if (waypoint < 0 || waypoint >= waypoints) continue;
      const double sign = end == 0 ? -2.0 : 2.0;
      for (int axis = 0; axis < 3; ++axis) {
        *jacobian++ = sign * step[axis] / eta;
      }
    }
  }
  return are_finite;
}

void PathSprings::JacobianPattern(int first_row, int* row, int* col) const {
  for (int segment = 0; segment <= waypoints; ++segment) {
    for (int end = 0; end < 2; ++end) {
      const int waypoint = segment - 1 + end;  // 0 … N−1 are free
      if (waypoint < 0 || waypoint >= waypoints) continue;
      for (int axis = 0; axis < 3; ++axis) {
        *row++ = first_row + segment;
        *col++ = 3 * waypoint + axis;
      }
    }
  }
}

// The diagonal, then the entries three below it.
void PathSprings::HessianPattern(int* row, int* col) const {
  for (int i = 0; i < 3 * waypoints; ++i) {
    *row++ = i;
    *col++ = i;
  }
  for (int i = 3; i < 3 * waypoints; ++i) {
    *row++ = i;
    *col++ = i - 3;
  }
}

void PathSprings::Hessian(double factor, const double* multipliers,
                          double* values) const {
  for (int i = 0; i < waypoints; ++i) {
    std::fill(values, values + 3,
              Stiffness(i, factor, multipliers) +
                  Stiffness(i + 1, factor, multipliers));
    values += 3;
  }
  for (int i = 1; i < waypoints; ++i) {
    std::fill(values, values + 3, -Stiffness(i, factor, multipliers));
    values += 3;
  }
}

}  // namespace phongpd
