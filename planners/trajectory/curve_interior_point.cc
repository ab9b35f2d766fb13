// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_interior_point.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::VectorXd;

constexpr int kMaxIterations = 40;
constexpr double kStartT = 0.03;  // that far inside the limits
// The gap at the end, a share of what has been gained, and at least; the
// gradient's largest entry.
constexpr double kGap = 0.03;
constexpr double kLeastGap = 1e-6;
constexpr double kGradient = 1e-2;
constexpr double kStepShare = 0.99;    // of the way to the nearest row
constexpr double kLeastSlack = 0.005;  // a step leaves this share of a slack
constexpr double kShorter = 0.8;       // the next try
constexpr double kShortestStep = 1e-3;

}  // namespace

CurveInteriorPoint::CurveInteriorPoint(const CurveProgram& program)
    : program_(program),
      pieces_(program.size()),
      hessian_(pieces_),
      linear_(VectorXd::Zero(hessian_.size())) {
  first_.push_back(0);
  for (const CurveProgram::Piece& piece : program.pieces) {
    for (const CurveProgram::Row& row : piece.rows) {
      if (row.kind == CurveProgram::Row::kNorm) {
        norms_.push_back(static_cast<int>(rows_.size()));
      }
      rows_.push_back({&row, row.direction, row.eta, 0.0});
    }
    first_.push_back(static_cast<int>(rows_.size()));
  }
  slacks_.resize(first_.back());
  slopes_.resize(first_.back());
  AddObjective(program_, &hessian_, &linear_);
}

void CurveInteriorPoint::Fix(BlockTridiagonal* matrix) const {
  auto& first = matrix->diagonal[0];
  first.topRows<9>().setZero();
  first.leftCols<9>().setZero();
  first.diagonal().head<9>().setOnes();
  matrix->above[0].topRows<9>().setZero();
  matrix->border[0].head<9>().setZero();
  if (program_.missing > 0.0) return;
  for (auto& block : matrix->diagonal) block(10, 10) = 1.0;
}

void CurveInteriorPoint::Fix(VectorXd* x) const { x->head<9>().setZero(); }

void CurveInteriorPoint::FindSlacks(const VectorXd& x) {
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, x);
    double along = 0.0;
    for (int k = first_[i]; k < first_[i + 1]; ++k) {
      slacks_[k] = SlackAt(&rows_[k], local, &along);
    }
  }
}

void CurveInteriorPoint::FollowSlacks(const VectorXd& x, double alpha) {
  slacks_ = state_.slack - alpha * slopes_;
  int piece = -1;
  CurveLocal local;
  double along = 0.0;
  for (const int k : norms_) {
    if (piece < 0 || k >= first_[piece + 1]) {
      while (k >= first_[piece + 1]) ++piece;
      local = ToLocal(program_, piece, x);
    }
    slacks_[k] = SlackAt(&rows_[k], local, &along);
  }
}

// Duals are μ/slack, with the μ that the price of t asks for; and m is where
// they meet its price.  False where x is not within all rows.
bool CurveInteriorPoint::Begin(VectorXd* x) {
  (*x)[x->size() - 1] = kStartT;
  FindSlacks(*x);
  double of_t = 0.0;
  for (int k = 0; k < first_.back(); ++k) {
    if (rows_[k].row->t < 0.0) of_t -= rows_[k].row->t / slacks_[k];
  }
  const double mu = program_.t / of_t;
  for (int i = 0; program_.missing > 0.0 && i < pieces_; ++i) {
    int count = 0;
    for (int k = first_[i]; k < first_[i + 1]; ++k) {
      count += rows_[k].row->missing < 0.0;
    }
    (*x)[kBlock * i + 10] =
        program_.pieces[i].missing + mu * count / program_.missing;
  }
  FindSlacks(*x);
  if (!(slacks_ > 0.0).all()) return false;
  state_.Begin(slacks_, mu);
  return true;
}

void CurveInteriorPoint::AddRows(BlockTridiagonal* matrix,
                                 VectorXd* residual) const {
  const Eigen::ArrayXd squares = state_.dual / state_.slack;
  for (int i = 0; i < pieces_; ++i) {
    CurveLocalMatrix lower = CurveLocalMatrix::Zero();
    CurveLocal of_rows = CurveLocal::Zero();
    ForRows<OfSquares>(rows_, first_[i], first_[i + 1], squares,
                       [&](int k, const CurveRowWeights& by) {
                         AddSquare(rows_[k], by, state_.dual[k], &lower);
                       });
    ForRows<OfGradients>(rows_, first_[i], first_[i + 1], state_.dual,
                         [&](int k, const CurveRowWeights& by) {
                           AddRow(rows_[k], by, &of_rows);
                         });
    CurveLocalMatrix local = lower.selfadjointView<Eigen::Lower>();
    AddMatrix(program_, i, &local, matrix);
    AddGradient(program_, i, of_rows, residual);
  }
}

// Steps of slacks and duals along one of x; how far they lead at most.
double CurveInteriorPoint::FollowRows(const VectorXd& step, double centre) {
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, step);
    double along = 0.0;
    for (int k = first_[i]; k < first_[i + 1]; ++k) {
      slopes_[k] = Slope(rows_[k], local, &along);
    }
  }
  return state_.Follow(slopes_, centre);
}

void CurveInteriorPoint::AddCentres(double centre, VectorXd* to) const {
  const Eigen::ArrayXd multipliers = state_.Multipliers(centre);
  for (int i = 0; i < pieces_; ++i) {
    CurveLocal of_rows = CurveLocal::Zero();
    ForRows<OfGradients>(rows_, first_[i], first_[i + 1], multipliers,
                         [&](int k, const CurveRowWeights& by) {
                           AddRow(rows_[k], by, &of_rows);
                         });
    AddGradient(program_, i, of_rows, to);
  }
}

CurveInteriorPoint::Result CurveInteriorPoint::Solve() {
  Result result;
  result.x = VectorXd::Zero(hessian_.size());
  VectorXd x = result.x;
  // Not so where rounding takes all room: then no step is the answer.
  result.rows = first_.back();
  if (!Begin(&x)) return result;

  BlockTridiagonal matrix(pieces_);
  for (; result.iterations < kMaxIterations; ++result.iterations) {
    const VectorXd gradient = hessian_.Times(x) + linear_;
    VectorXd residual = gradient;  // of the Lagrangian
    matrix = hessian_;
    AddRows(&matrix, &residual);
    Fix(&residual);
    const double gained = -0.5 * x.dot(gradient + linear_);  // from x = 0
    if (state_.Gap() <= std::max(kLeastGap, kGap * gained) &&
        residual.cwiseAbs().maxCoeff() <= kGradient) {
      break;
    }
    Fix(&matrix);
    matrix.Factorize();

    // Predictor.
    VectorXd step = -gradient;
    Fix(&step);
    matrix.Solve(&step);
    const double centre = state_.Predict(FollowRows(step, 0.0));

    // Corrector.
    step = -gradient;
    AddCentres(centre, &step);
    Fix(&step);
    matrix.Solve(&step);
    double alpha = std::min(1.0, kStepShare * FollowRows(step, centre));
    // The slacks themselves count in the end: norms bend.
    for (; alpha > kShortestStep; alpha *= kShorter) {
      FollowSlacks(x + alpha * step, alpha);
      if ((slacks_ > kLeastSlack * state_.slack).all()) break;
    }
    if (!(alpha > kShortestStep)) break;
    state_.Move(alpha, slacks_);
    x += alpha * step;
  }
  result.x = x;
  return result;
}

}  // namespace phongpd::internal
