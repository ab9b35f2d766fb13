// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_interior_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planners/trajectory/curve_bounds.h"

namespace phongpd::internal {
namespace {

using Eigen::VectorXd;

constexpr int kMaxIterations = 40;
constexpr double kStartT = 0.03;          // that far inside the limits
constexpr double kRoomOfMissing = 0.003;  // of m at first, of the trust region
// The gap at the end, a share of what has been gained, and at least; the
// gradient's largest entry.
constexpr double kGap = 0.03;
constexpr double kLeastGap = 1e-6;
constexpr double kGradient = 0.1;
constexpr double kStepShare = 0.99;    // of the way to the nearest row
constexpr double kLeastSlack = 0.005;  // a step leaves this share of a slack
constexpr double kShorter = 0.8;       // the next try
// A step that leads less far ends it.  The first ones are as short as 1e-4
// where most of a wide margin is missing.
constexpr double kShortestStep = 1e-5;

}  // namespace

CurveInteriorPoint::CurveInteriorPoint(const CurveProgram& program)
    : program_(program),
      pieces_(program.size()),
      hessian_(pieces_),
      linear_(VectorXd::Zero(hessian_.size())) {
  First first{0, 0, 0};
  std::size_t others = 0;
  for (const CurveProgram::Piece& piece : program.pieces) {
    others += piece.rows.size();
  }
  rows_.reserve(others);
  for (const CurveProgram::Piece& piece : program.pieces) {
    first.row = first.bound;
    for (const auto& bounds : piece.bounds) first.row += RowsOf(bounds);
    first_.push_back(first);
    for (const CurveProgram::Row& row : piece.rows) {
      has_norms_ = has_norms_ || row.kind == CurveProgram::Row::kNorm;
      rows_.emplace_back(row);
    }
    first.other = static_cast<int>(rows_.size());
    first.bound = first.row + static_cast<int>(piece.rows.size());
  }
  first_.push_back(first);
  slacks_.resize(CountRows());
  slopes_.resize(CountRows());
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
    ForBounds(program_.pieces[i], first_[i].bound,
              [&](const auto& bounds, int at) {
                SlacksOf(bounds, local, slacks_.data() + at);
              });
    double* to = slacks_.data() + first_[i].row;
    double along = 0.0;
    for (int k = first_[i].other; k < first_[i + 1].other; ++k) {
      *to++ = SlackAt(&rows_[k], local, &along);
    }
  }
}

void CurveInteriorPoint::FollowSlacks(const VectorXd& x, double alpha) {
  slacks_ = state_.slack - alpha * slopes_;
  for (int i = 0; has_norms_ && i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, x);
    double* to = slacks_.data() + first_[i].row;
    double along = 0.0;
    for (int k = first_[i].other; k < first_[i + 1].other; ++k, ++to) {
      if (rows_[k].row->kind != CurveProgram::Row::kNorm) continue;
      *to = SlackAt(&rows_[k], local, &along);
    }
  }
}

double CurveInteriorPoint::SumOfT(int piece,
                                  const Eigen::ArrayXd& weights) const {
  double sum = 0.0;
  ForBounds(program_.pieces[piece], first_[piece].bound,
            [&](const auto& bounds, int at) {
              sum += TermsInT(bounds, weights.data() + at);
            });
  int at = first_[piece].row;
  for (int k = first_[piece].other; k < first_[piece + 1].other; ++k, ++at) {
    // Others may weigh infinitely much.
    if (rows_[k].t != 0.0) sum += rows_[k].t * weights[at];
  }
  return sum;
}

void CurveInteriorPoint::MeetPriceOfMissing(int piece,
                                            Eigen::ArrayXd* products) const {
  const auto for_rows = [&](const auto& act) {
    int at = first_[piece].row;
    for (const auto& row : program_.pieces[piece].rows) {
      if (row.missing < 0.0) act(at);
      ++at;
    }
  };
  double sum = 0.0;
  for_rows([&](int at) { sum += 1.0 / slacks_[at]; });
  for_rows([&](int at) { (*products)[at] = program_.missing / sum; });
}

// Duals are μ/slack, with the μ that the price of t asks for; but for rows that
// know m, which have some room.  False where x is not within all rows.
bool CurveInteriorPoint::Begin(VectorXd* x) {
  (*x)[x->size() - 1] = kStartT;
  const bool has_missing = program_.missing > 0.0;
  for (int i = 0; has_missing && i < pieces_; ++i) {
    (*x)[kBlock * i + 10] = program_.pieces[i].missing + kRoomOfMissing;
  }
  FindSlacks(*x);
  if (!(slacks_ > 0.0).all()) return false;
  const Eigen::ArrayXd inverse = slacks_.inverse();
  double of_t = 0.0;
  for (int i = 0; i < pieces_; ++i) of_t -= SumOfT(i, inverse);
  Eigen::ArrayXd products =
      Eigen::ArrayXd::Constant(CountRows(), program_.t / of_t);
  for (int i = 0; has_missing && i < pieces_; ++i) {
    MeetPriceOfMissing(i, &products);
  }
  state_.Begin(slacks_, products);
  return true;
}

CurveLocal CurveInteriorPoint::SumOfRows(int piece,
                                         const Eigen::ArrayXd& weights) const {
  const First& first = first_[piece];
  CurveLocal sum = CurveLocal::Zero();
  ForBounds(program_.pieces[piece], first.bound,
            [&](const auto& bounds, int at) {
              AddGradients(bounds, weights.data() + at, &sum);
            });
  ForRows(
      rows_, first.other, first_[piece + 1].other, weights, first.row,
      [&](int k, const CurveRowWeights& by) { AddRow(rows_[k], by, &sum); });
  return sum;
}

void CurveInteriorPoint::AddRows(BlockTridiagonal* matrix,
                                 VectorXd* residual) const {
  const Eigen::ArrayXd squares = state_.Squares();
  for (int i = 0; i < pieces_; ++i) {
    const First& first = first_[i];
    CurveLocalMatrix lower = CurveLocalMatrix::Zero();
    ForBounds(program_.pieces[i], first.bound, [&](const auto& bounds, int at) {
      AddSquares(bounds, squares.data() + at, &lower);
    });
    ForRows(rows_, first.other, first_[i + 1].other, squares, first.row,
            [&](int k, const CurveRowWeights& by) {
              // Norms are never one of two.
              const double dual = state_.dual[first.row + k - first.other];
              AddSquare(rows_[k], by, dual, &lower);
            });
    CurveLocalMatrix local = lower.selfadjointView<Eigen::Lower>();
    AddMatrix(program_, i, &local, matrix);
    AddGradient(program_, i, SumOfRows(i, state_.dual), residual);
  }
}

// Steps of slacks and duals along one of x; how far they lead at most.
double CurveInteriorPoint::FollowRows(const VectorXd& step, double centre) {
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, step);
    ForBounds(program_.pieces[i], first_[i].bound,
              [&](const auto& bounds, int at) {
                SlopesOf(bounds, local, slopes_.data() + at);
              });
    double* to = slopes_.data() + first_[i].row;
    double along = 0.0;
    for (int k = first_[i].other; k < first_[i + 1].other; ++k) {
      *to++ = Slope(rows_[k], local, &along);
    }
  }
  return state_.Follow(slopes_, centre);
}

Eigen::ArrayXd CurveInteriorPoint::BendsAlong(const VectorXd& step) const {
  Eigen::ArrayXd bends = Eigen::ArrayXd::Zero(CountRows());
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, step);
    double* to = bends.data() + first_[i].row;
    for (int k = first_[i].other; k < first_[i + 1].other; ++k, ++to) {
      if (rows_[k].row->kind != CurveProgram::Row::kNorm) continue;
      *to = BendOf(rows_[k], local);
    }
  }
  return bends;
}

void CurveInteriorPoint::AddCentres(double centre, VectorXd* to) const {
  const Eigen::ArrayXd multipliers = state_.Multipliers(centre);
  for (int i = 0; i < pieces_; ++i) {
    AddGradient(program_, i, SumOfRows(i, multipliers), to);
  }
}

CurveInteriorPoint::Result CurveInteriorPoint::Solve() {
  Result result;
  result.x = VectorXd::Zero(hessian_.size());
  VectorXd x = result.x;
  // Not so where rounding takes all room: then no step is the answer.
  result.rows = CountRows();
  if (!Begin(&x)) return result;
  // The objective at x = 0, but for the m that rows need there.
  double at_rest = 0.0;
  for (const auto& piece : program_.pieces) {
    at_rest += program_.missing * piece.missing;
  }

  BlockTridiagonal matrix(pieces_);
  for (; result.iterations < kMaxIterations; ++result.iterations) {
    const VectorXd gradient = hessian_.Times(x) + linear_;
    VectorXd residual = gradient;  // of the Lagrangian
    matrix = hessian_;
    AddRows(&matrix, &residual);
    Fix(&residual);
    const double gained = at_rest - 0.5 * x.dot(gradient + linear_);
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
    if (has_norms_) state_.Bend(BendsAlong(step));

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
