// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/trajectory/trajectory_problem.h"

namespace phongpd {

// The parts of a program over the N free points u_1 … u_N of a
// TrajectoryProblem that know nothing of obstacles, every segment being a
// spring:
//
//   energy  weight · Σ |u_{i+1} − u_i|²,   rows  |u_{i+1} − u_i|²/η ≤ η
//
// for the N+1 segments, where waypoint = center + unit·u with the centre half
// way between start and goal and the unit D; energy = f, η = h/D.  Points are
// in `x` one after the other; what follows them in x is not looked at.
struct PathSprings {
  // `start_length` decides h.
  PathSprings(const TrajectoryProblem& problem, double start_length);

  Eigen::VectorXd ToVariables(const Path& path) const;
  // Of the given ends, which are taken as they are.
  Path ToPath(const Eigen::Vector3d& first, const double* x,
              const Eigen::Vector3d& last) const;

  Eigen::Vector3d center;
  double unit = 1.0;
  int waypoints = 1;  // N
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  double weight = 1.0;
  double eta = 1.0;

  // u_{i+1} − u_i for i in 0 … N, the ends included.
  Eigen::Vector3d Step(int segment, const double* x) const;

  double Energy(const double* x) const;
  void Gradient(const double* x, double* gradient) const;  // 3N numbers

  int rows() const { return waypoints + 1; }
  int jacobian_nonzeros() const { return 6 * waypoints; }
  // False where a value is not finite.
  bool Lengths(const double* x, double* values, double* jacobian) const;
  void JacobianPattern(int first_row, int* row, int* col) const;

  // Second derivative of a segment's spring: on the diagonal of both its ends,
  // negative between them.
  double Stiffness(int segment, double factor,
                   const double* multipliers) const {
    return 2.0 * (factor * weight + multipliers[segment] / eta);
  }
  // Lower triangle; of the energy times a factor and the rows by multipliers.
  int hessian_nonzeros() const { return 6 * waypoints - 3; }
  void HessianPattern(int* row, int* col) const;
  void Hessian(double factor, const double* multipliers, double* values) const;
};

}  // namespace phongpd
