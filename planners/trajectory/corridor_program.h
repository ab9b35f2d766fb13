// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/corridor.h"
#include "planners/trajectory/nonlinear_program.h"
#include "planners/trajectory/path_springs.h"

namespace phongpd {

// Planes around the segments of a path, in the frame of PathSprings.
struct Corridor {
  struct Plane {
    Eigen::Vector3d normal;  // towards the segment
    double level;            // of the obstacle: n·u ≤ level
    double distance;         // of the segment
  };
  std::vector<std::vector<Plane>> planes;  // of each segment
  // What a segment can have: the margin, or most of half the gap between two
  // opposite planes if that is less.
  std::vector<double> wanted;
  std::vector<double> missing;  // wanted − clearance, ≥ 0

  int CountPlanes() const;
  double TotalMissing() const;
};

// PolishInCorridor, stopped after that many rounds ≥ 1.
CorridorSummary PolishRounds(const TrajectoryProblem& problem, const Path& path,
                             int max_rounds, double time_limit,
                             const PathObserver& on_path);

Corridor FindCorridor(const TrajectoryProblem& problem,
                      const PathSprings& springs, const Path& path,
                      double reach);

// The convex program of one round (corridor.h).  Variables: the waypoints,
// then s_i of the segments that lack clearance.
class CorridorProgram : public NonlinearProgram {
 public:
  // All outlive the program; `now` are the waypoints as variables.
  CorridorProgram(const TrajectoryProblem& problem, const PathSprings& springs,
                  const Corridor& corridor, const Eigen::VectorXd& now,
                  double trust, double price);

  Eigen::VectorXd Start() const;  // the path as it is

  int variables() const override;
  int rows() const override;
  int jacobian_nonzeros() const override;
  int hessian_nonzeros() const override { return springs_.hessian_nonzeros(); }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override;
  void JacobianPattern(int* row, int* col) const override;
  void HessianPattern(int* row, int* col) const override;
  double Objective(const double* x) const override;
  void ObjectiveGradient(const double* x, double* gradient) const override;
  bool Constraints(const double* x, double* values, double* jacobian) override;
  void Hessian(const double* x, double objective_factor,
               const double* multipliers, double* values) const override;

 private:
  // n·u_waypoint + s ≥ level.
  struct Row {
    int waypoint;
    int elastic;  // variable of s, −1: none
    Eigen::Vector3d normal;
    double level;
  };

  const TrajectoryProblem& problem_;
  const PathSprings& springs_;
  const Eigen::VectorXd& now_;
  double trust_, price_;
  std::vector<double> missing_;  // largest s of each elastic variable
  std::vector<Row> planes_;
  int plane_nonzeros_ = 0;
};

}  // namespace phongpd
