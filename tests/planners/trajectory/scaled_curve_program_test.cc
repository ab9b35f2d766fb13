// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: F as a dense matrix, and the curve itself where a step leads.
#include "planners/trajectory/scaled_curve_program.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "planners/trajectory/curve_bounds.h"
#include "planners/trajectory/curve_limits.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kUnevenPieces = 5, kBlockSize = BlockTridiagonal::kSize;

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()() { return uniform_(engine_); }
  Vector3d Point() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

// Uneven pieces; both ends at rest, or neither.
KnotCurve UnevenCurve(bool at_rest, Draw* random) {
  KnotCurve curve;
  for (int k = 0; k <= kUnevenPieces; ++k) {
    const bool rests = at_rest && (k == 0 || k == kUnevenPieces);
    curve.knots.push_back({random->Point(),
                           rests ? Vector3d::Zero().eval() : random->Point(),
                           rests ? Vector3d::Zero().eval() : random->Point()});
    if (k < kUnevenPieces) curve.durations.push_back(0.6 + 0.4 * (*random)());
  }
  return curve;
}

CurveProgramOptions UnevenOptions() {
  CurveProgramOptions options;
  options.limits.velocity.setConstant(1.0);
  options.limits.acceleration.setConstant(2.0);
  options.limits.jerk.setConstant(8.0);
  options.trust = 0.3;
  return options;
}

CurveProgram UnevenProgramOf(const KnotCurve& curve) {
  return BuildCurveProgram(curve, std::vector<PieceCells>(kUnevenPieces),
                           UnevenOptions());
}

// Column by column.
MatrixXd DenseF(const CurveProgram& program, int piece) {
  const int n = kBlockSize * kUnevenPieces + 1;
  MatrixXd f(21, n);
  for (int k = 0; k < n; ++k) {
    f.col(k) = ToLocal(program, piece, VectorXd::Unit(n, k));
  }
  return f;
}

MatrixXd DenseOf(const BlockTridiagonal& matrix) {
  const int n = matrix.size();
  MatrixXd dense(n, n);
  for (int k = 0; k < n; ++k) dense.col(k) = matrix.Times(VectorXd::Unit(n, k));
  return dense;
}

TEST(ScaledCurveProgram, AddsWhatPiecesKnowToWhatKnotsKnow) {
  Draw random(1);
  for (const bool at_rest : {true, false}) {
    const CurveProgram program = UnevenProgramOf(UnevenCurve(at_rest, &random));
    for (int piece = 0; piece < kUnevenPieces; ++piece) {
      const MatrixXd f = DenseF(program, piece);
      const CurveLocal local = CurveLocal::Random();
      VectorXd gradient = VectorXd::Zero(f.cols());
      AddGradient(program, piece, local, &gradient);
      EXPECT_LT((gradient - f.transpose() * local).norm(), 1e-12) << piece;
      const CurveLocalMatrix half = CurveLocalMatrix::Random();
      const CurveLocalMatrix m = half * half.transpose();
      CurveLocalMatrix spent = m;
      BlockTridiagonal blocks(kUnevenPieces);
      AddMatrix(program, piece, &spent, &blocks);
      EXPECT_LT((DenseOf(blocks) - f.transpose() * m * f).norm(), 1e-10)
          << piece;
    }
  }
}

// What x means to a curve, in its own units.
KnotCurve ChangeOf(const CurveProgram& program, const VectorXd& x,
                   double trust) {
  KnotCurve change;
  for (int k = 0; k < kUnevenPieces; ++k) {
    const auto of = x.segment<kBlockSize>(kBlockSize * k);
    const double pace = program.pace[static_cast<std::size_t>(k)];
    change.knots.push_back({trust * of.head<3>(),
                            5.0 * trust / pace * of.segment<3>(3),
                            20.0 * trust / (pace * pace) * of.segment<3>(6)});
    change.durations.push_back(of[9]);
  }
  change.knots.emplace_back();
  return change;
}

VectorXd RandomUnknowns(Draw* random) {
  VectorXd x(kBlockSize * kUnevenPieces + 1);
  for (double& value : x) value = (*random)();
  x.head<9>().setZero();
  return x;
}

// Of a tenth of a step a hundredth is neglected.
TEST(ScaledCurveProgram, KnowsBezierPointsToFirstOrder) {
  Draw random(2);
  for (const bool at_rest : {true, false}) {
    const KnotCurve curve = UnevenCurve(at_rest, &random);
    const CurveProgram program = UnevenProgramOf(curve);
    const double trust = UnevenOptions().trust;
    const VectorXd x = RandomUnknowns(&random);
    const auto error = [&](double share, int piece) {
      const KnotCurve moved = Moved(curve, ChangeOf(program, x, trust), share);
      const CurveLocal local = ToLocal(program, piece, share * x);
      const Eigen::Map<const KnotCurve::Points> by(local.data());
      return (curve.PointsOf(piece) + trust * by - moved.PointsOf(piece))
          .norm();
    };
    for (int piece = 0; piece < kUnevenPieces; ++piece) {
      EXPECT_LT(error(1e-3, piece), 1e-5) << piece;
      EXPECT_NEAR(error(1e-3, piece) / error(1e-4, piece), 100.0, 5.0);
    }
  }
}

// The same way in times that are longer or shorter: not to first order alone.
TEST(ScaledCurveProgram, KnowsExactlyWhatGoesFasterAsAWhole) {
  Draw random(3);
  const KnotCurve curve = UnevenCurve(true, &random);
  const CurveProgram program = UnevenProgramOf(curve);
  for (const double eta : {-0.3, 0.2}) {
    KnotCurve change;
    for (const KnotCurve::State& knot : curve.knots) {
      change.knots.push_back(
          {Vector3d::Zero(), -eta * knot.v, -2.0 * eta * knot.a});
    }
    change.durations.assign(kUnevenPieces, eta);
    KnotCurve slowed = curve;
    slowed.Slow(std::exp(eta));
    const KnotCurve moved = Moved(curve, change, 1.0);
    EXPECT_NEAR(moved.Duration(), slowed.Duration(), 1e-12);
    for (int piece = 0; piece < kUnevenPieces; ++piece) {
      EXPECT_LT((moved.PointsOf(piece) - curve.PointsOf(piece)).norm(), 1e-14);
    }
    // The ends' states are not changed but given.
    const KnotCurve half = Moved(curve, change, 0.5);
    EXPECT_EQ(half.knots.front().v, curve.knots.front().v);
    EXPECT_EQ(half.knots.back().v, curve.knots.back().v);
  }
}

// Whatever the points come to be, a piece whose rows hold keeps its limits.
TEST(ScaledCurveProgram, ErrsOnTheSafeSideOfLimits) {
  Draw random(4);
  KnotCurve curve = UnevenCurve(true, &random);
  const MotionLimits limits = UnevenOptions().limits;
  curve.Slow(1.05 * SlowingOf(curve, limits));
  const CurveProgram program = UnevenProgramOf(curve);
  int within = 0, nearly = 0;
  for (int i = 0; i < 2000; ++i) {
    const int piece = i % kUnevenPieces;
    const double h = curve.durations[static_cast<std::size_t>(piece)];
    CurveLocal u = CurveLocal::Zero();
    const double size = std::min(0.9, 0.1 * std::pow(h, 3));
    for (int k = 0; k < 18; ++k) u[k] = size * random();
    u[kCurveEta] = 0.2 * random();
    bool holds = true;
    ForBounds(program.pieces[static_cast<std::size_t>(piece)], 0,
              [&](const auto& bounds, int) {
                VectorXd slacks(RowsOf(bounds));
                SlacksOf(bounds, u, slacks.data());
                holds = holds && slacks.minCoeff() > 0.0;
              });
    if (!holds) continue;
    ++within;
    const Eigen::Map<const KnotCurve::Points> by(u.data());
    const PieceDerivatives of(
        curve.PointsOf(piece) + UnevenOptions().trust * by,
        h * std::exp(u[kCurveEta]));
    const double use = std::max({of.velocity.cwiseAbs().maxCoeff() / 1.0,
                                 of.acceleration.cwiseAbs().maxCoeff() / 2.0,
                                 of.jerk.cwiseAbs().maxCoeff() / 8.0});
    EXPECT_LE(use, 1.0) << piece;
    nearly += use > 0.8;
  }
  EXPECT_GT(within, 200);
  EXPECT_LT(within, 1900);
  EXPECT_GT(nearly, 20);
}

}  // namespace
}  // namespace phongpd::internal
