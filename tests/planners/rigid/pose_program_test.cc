// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: central differences of the functions themselves; Ipopt misled by rows
// of the wrong sign, and what the judge says to that.
#include "planners/rigid/optimizer/pose_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/pi.h"
#include "planners/rigid/optimizer/pose_rounds.h"
#include "planners/rigid/rigid_world.h"
#include "planners/trajectory/ipopt_solve.h"
#include "problems/shapes/shapes.h"

namespace phongpd::internal {
namespace {

using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d,
    Eigen::VectorXd;

Vector3d RandomVector(std::mt19937* engine) {
  std::normal_distribution<double> normal;
  const double x = normal(*engine), y = normal(*engine), z = normal(*engine);
  return {x, y, z};
}

Quaterniond TurnBy(const Vector3d& w) {
  return Quaterniond(AngleAxisd(w.norm(), w.stableNormalized()));
}

TEST(TurnJacobian, IsTheDifferenceOfRotationsAndHasItsInverse) {
  std::mt19937 engine(1);
  for (const double angle : {1e-7, 0.9e-3, 1.1e-3, 0.3, 2.0, 3.1, 5.0}) {
    const Vector3d w = angle * RandomVector(&engine).normalized();
    const Vector3d d = RandomVector(&engine).normalized();
    constexpr double kStep = 1e-5;
    const Vector3d turned =
        TurnBetween(TurnBy(w - kStep * d), TurnBy(w + kStep * d)) / (2 * kStep);
    EXPECT_LT((TurnJacobian(w) * d - turned).norm(), 1e-8) << angle;
    EXPECT_LT((TurnJacobian(w) * InverseTurnJacobian(w) - Matrix3d::Identity())
                  .norm(),
              1e-12 * (1 + 1 / (2 * kPi - angle)))
        << angle;
  }
}

TEST(PoseBetween, TurnsWithItsEndsAsDifferencesDo) {
  std::mt19937 engine(2);
  for (int i = 0; i < 20; ++i) {
    RobotPose a, b;
    a.position = RandomVector(&engine);
    b.position = RandomVector(&engine);
    a.orientation = TurnBy(RandomVector(&engine));
    b.orientation =
        TurnBy(RandomVector(&engine).normalized() * 0.15 * i) * a.orientation;
    const double t = 0.05 * i;
    const PoseBetween between(a, b, t);
    const RobotPose truth = RigidMotion(a, b).At(t);
    EXPECT_LT((between.pose.position - truth.position).norm(), 1e-12);
    EXPECT_LT(between.pose.orientation.angularDistance(truth.orientation),
              1e-7);
    const Vector3d d = RandomVector(&engine).normalized();
    constexpr double kStep = 1e-5;
    const auto turned = [&](double at_a, double at_b) {
      RobotPose p = a, q = b;
      p.orientation = TurnBy(at_a * d) * a.orientation;
      q.orientation = TurnBy(at_b * d) * b.orientation;
      return PoseBetween(p, q, t).pose.orientation;
    };
    const Vector3d by_start =
        TurnBetween(turned(-kStep, 0), turned(kStep, 0)) / (2 * kStep);
    const Vector3d by_end =
        TurnBetween(turned(0, -kStep), turned(0, kStep)) / (2 * kStep);
    EXPECT_LT((between.by_start * d - by_start).norm(), 1e-7);
    EXPECT_LT((between.by_end * d - by_end).norm(), 1e-7);
  }
}

// A bar through a hole that it is too long for.
const RigidWorld& World() {
  static const RigidWorld world(MakeBox({-1.0, -0.2, -0.2}, {1.0, 0.2, 0.2}),
                                MakePlateWithHole(6.0, 0.4, 1.6));
  return world;
}

RobotPose At(const Vector3d& position, const Vector3d& turn) {
  RobotPose pose;
  pose.position = position;
  if (turn.norm() > 0.0) pose.orientation = TurnBy(turn);
  return pose;
}

// Some samples apart, some within the plate.
PoseProgram Program(PoseRows* rows) {
  const std::vector<RobotPose> poses = {
      At({0.2, 0.1, 2.0}, {0, 0, 0}), At({0.15, 0.05, 0.62}, {0.2, 0.35, 0.1}),
      At({0.4, 0.2, 0.1}, {0.5, 0.2, 0.0}),
      At({-0.3, 0.2, -2.0}, {0.2, 0.3, 0.3})};
  return PoseProgram(
      PoseChart(poses, World().reach(), World().gyration()),
      {{0, 0.9, 0.01}, {1, 0.3, 0.01}, {1, 1.0, 0.01}, {2, 0.5, 0.01}},
      {Vector3d(-3, -3, -3), Vector3d(3, 3, 3)}, rows);
}

TEST(PoseProgram, DerivativesAreCentralDifferences) {
  PoseRows rows(World().model(), 3, 0.5, false);
  PoseProgram program = Program(&rows);
  const int n = program.variables(), m = program.rows();
  ASSERT_EQ(n, 12);
  ASSERT_EQ(m, 12);
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0.0, 0.03);
  int smooth = 0, kinks = 0, below = 0;
  for (int trial = 0; trial < 6; ++trial) {
    VectorXd x(n);
    for (double& value : x) value = normal(engine);
    VectorXd gradient(n), values(m);
    std::vector<double> entries(
        static_cast<std::size_t>(program.jacobian_nonzeros()));
    std::vector<int> row(entries.size()), col(entries.size());
    program.ObjectiveGradient(x.data(), gradient.data());
    program.JacobianPattern(row.data(), col.data());
    ASSERT_TRUE(program.Constraints(x.data(), values.data(), entries.data()));
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(m, n);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      jacobian(row[k], col[k]) += entries[k];
    }
    below += static_cast<int>((values.array() < 0.0).count());
    constexpr double kStep = 1e-6;
    for (int c = 0; c < n; ++c) {
      VectorXd up = x, down = x, at_up(m), at_down(m);
      up[c] += kStep;
      down[c] -= kStep;
      EXPECT_NEAR(
          gradient[c],
          (program.Objective(up.data()) - program.Objective(down.data())) /
              (2 * kStep),
          1e-7);
      ASSERT_TRUE(program.Constraints(up.data(), at_up.data(), nullptr));
      ASSERT_TRUE(program.Constraints(down.data(), at_down.data(), nullptr));
      for (int r = 0; r < m; ++r) {
        const double one = (at_up[r] - values[r]) / kStep;
        const double other = (values[r] - at_down[r]) / kStep;
        if (std::abs(one - other) > 1e-3) {
          ++kinks;  // the nearest feature changes there
          continue;
        }
        ++smooth;
        EXPECT_NEAR(jacobian(r, c), 0.5 * (one + other), 1e-4)
            << "trial " << trial << ", row " << r << ", variable " << c;
      }
    }
  }
  EXPECT_GT(smooth, 700);  // of 864
  EXPECT_LT(kinks, 100);
  EXPECT_GT(below, 6);  // depths were among them
}

// All rows with their signs turned: what is deep in the plate looks free.
class Flipped final : public NonlinearProgram {
 public:
  explicit Flipped(PoseProgram* program) : program_(*program) {}
  int variables() const override { return program_.variables(); }
  int rows() const override { return program_.rows(); }
  int jacobian_nonzeros() const override {
    return program_.jacobian_nonzeros();
  }
  int hessian_nonzeros() const override { return program_.hessian_nonzeros(); }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override {
    program_.Bounds(x_low, x_high, g_low, g_high);
  }
  void JacobianPattern(int* row, int* col) const override {
    program_.JacobianPattern(row, col);
  }
  void HessianPattern(int* row, int* col) const override {
    program_.HessianPattern(row, col);
  }
  double Objective(const double* x) const override {
    return program_.Objective(x);
  }
  void ObjectiveGradient(const double* x, double* gradient) const override {
    program_.ObjectiveGradient(x, gradient);
  }
  bool Constraints(const double* x, double* values, double* jacobian) override {
    if (!program_.Constraints(x, values, jacobian)) return false;
    for (int i = 0; i < rows(); ++i) values[i] = -values[i];
    for (int i = 0; i < jacobian_nonzeros(); ++i) jacobian[i] = -jacobian[i];
    return true;
  }
  void Hessian(const double* x, double objective_factor,
               const double* multipliers, double* values) const override {
    program_.Hessian(x, objective_factor, multipliers, values);
  }

 private:
  PoseProgram& program_;
};

TEST(PoseProgram, RowsOfTheWrongSignAreRefusedByTheJudge) {
  // A bar moved sideways within the plate, where every sample is deep.
  PoseRows rows(World().model(), 2, 0.5, false);
  const std::vector<RobotPose> poses = {At({1.9, 0.0, 0.0}, {0, 0, 0}),
                                        At({1.95, 0.05, 0.02}, {0.02, 0, 0}),
                                        At({2.0, 0.0, 0.0}, {0, 0, 0})};
  PoseProgram program(PoseChart(poses, World().reach(), World().gyration()),
                      {{0, 0.5, 0.01}, {0, 1.0, 0.01}, {1, 0.5, 0.01}},
                      {Vector3d(-3, -3, -3), Vector3d(3, 3, 3)}, &rows);
  Flipped flipped(&program);
  const IpoptRun run = SolveWithIpopt(
      &flipped, VectorXd::Zero(flipped.variables()), IpoptSettings());
  ASSERT_TRUE(IsClassOk(run.status)) << run.raw_status;  // it believes it
  const std::vector<RobotPose> path = program.chart().Poses(run.x.data());
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    EXPECT_EQ(World().judge().Check(RigidMotion(path[i], path[i + 1])).outcome,
              MotionVerdict::kCollides);
  }
}

// Samples alone let the edge of a thin wall pass between them; rows added where
// the judge finds it do not.
TEST(PoseRounds, WhatSamplesMissIsRefutedAndGetsRows) {
  const RigidWorld thin(MakeBox({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}),
                        MakeBox({-1.0, -1.0, -0.01}, {1.0, 1.0, 0.01}));
  RobotPose start = At({1.03, 0.0, 2.03}, {0, 0, 0});
  RobotPose goal = At({1.03, 0.3, -2.0}, {0, 0, 0.3});
  const RobotPose middle = At({1.03, 0.1, 0.7}, {0, 0, 0.15});
  PoseRoundsTask task;
  task.bounds = {Vector3d(-4, -4, -4), Vector3d(4, 4, 4)};
  task.margin = 1e-3;
  task.time_limit = 100.0;
  for (const int rounds : {1, 20}) {
    task.max_rounds = rounds;
    PoseRows rows(thin.model(), 4, 0.05, false);
    RigidStop stop(100.0, {});
    const PoseRoundsEnd end =
        FreePoses(thin.model(), {start, middle, goal}, task, &rows, &stop);
    EXPECT_TRUE(end.was_refuted);
    EXPECT_EQ(end.path.empty(), rounds == 1);
    EXPECT_GE(end.added_samples, 1u);
    for (std::size_t i = 0; i + 1 < end.path.size(); ++i) {
      EXPECT_TRUE(thin.judge()
                      .Check(RigidMotion(end.path[i], end.path[i + 1]))
                      .IsFree());
    }
  }
}

}  // namespace
}  // namespace phongpd::internal
