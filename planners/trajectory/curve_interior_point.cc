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
constexpr double kStartT = 0.005;         // that far inside the limits
constexpr double kRoomOfMissing = 0.003;  // of m at first, of the trust region
// The gap at the end, a share of what has been gained, and at least; the
// gradient's largest entry.
constexpr double kGap = 0.4;
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
    }
    AppendRows(piece.rows, &rows_);
    first.other = static_cast<int>(rows_.size());
    first.bound = first.row + static_cast<int>(piece.rows.size());
  }
  first_.push_back(first);
  int most = 0;
  for (int i = 0; i < pieces_; ++i) most = std::max(most, RowsOfPiece(i));
  weights_.resize(most);
  slacks_.resize(CountRows());
  if (has_norms_) slopes_.resize(CountRows());
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
    for (int k = first_[i].other; k < first_[i + 1].other; ++k) {
      to = WriteSlacks(&rows_[k], local, to);
    }
  }
}

template <typename Act>
void CurveInteriorPoint::ForNorms(int piece, const Act& act) const {
  int at = first_[piece].row;
  for (int k = first_[piece].other; k < first_[piece + 1].other; ++k) {
    if (rows_[k].kind == CurveProgram::Row::kNorm) act(k, at);
    at += rows_[k].is_pair ? 2 : 1;
  }
}

void CurveInteriorPoint::FollowSlacks(const VectorXd& x, double alpha) {
  slacks_ = state_.slack - alpha * slopes_;
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, x);
    ForNorms(i, [&](int k, int at) {
      WriteSlacks(&rows_[k], local, slacks_.data() + at);
    });
  }
}

double CurveInteriorPoint::SumOfT(int piece,
                                  const Eigen::ArrayXd& weights) const {
  double sum = 0.0;
  ForBounds(program_.pieces[piece], first_[piece].bound,
            [&](const auto& bounds, int at) {
              sum += TermsInT(bounds, weights.data() + at);
            });
  const auto add = [&](const CurveRowNow& row, const CurveRowWeights& by, int) {
    // Others may weigh infinitely much.
    if (row.t != 0.0) sum += row.t * by.along;
  };
  ForRows(rows_, first_[piece].other, first_[piece + 1].other,
          weights.data() + first_[piece].row, add);
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
                                         const double* weights) const {
  const First& first = first_[piece];
  CurveLocal sum = CurveLocal::Zero();
  ForBounds(program_.pieces[piece], 0, [&](const auto& bounds, int at) {
    AddGradients(bounds, weights + at, &sum);
  });
  ForRows(rows_, first.other, first_[piece + 1].other,
          weights + (first.row - first.bound),
          [&](const CurveRowNow& row, const CurveRowWeights& by, int) {
            AddRow(row, by, &sum);
          });
  return sum;
}

void CurveInteriorPoint::AddRows(BlockTridiagonal* matrix, VectorXd* residual) {
  double* const squares = weights_.data();
  for (int i = 0; i < pieces_; ++i) {
    const First& first = first_[i];
    const double* const duals = state_.dual.data() + first.bound;
    const int bounds_rows = first.row - first.bound;
    state_.WriteSquares(first.bound, RowsOfPiece(i), squares);
    CurveLocalMatrix lower = CurveLocalMatrix::Zero();
    ForBounds(program_.pieces[i], 0, [&](const auto& bounds, int at) {
      AddSquares(bounds, squares + at, &lower);
    });
    ForRows(rows_, first.other, first_[i + 1].other, squares + bounds_rows,
            [&](const CurveRowNow& row, const CurveRowWeights& by, int at) {
              // Norms are never one of two.
              AddSquare(row, by, duals[bounds_rows + at], &lower);
            });
    CurveLocalMatrix local = lower.selfadjointView<Eigen::Lower>();
    AddMatrix(program_, i, &local, matrix);
    AddGradient(program_, i, SumOfRows(i, duals), residual);
  }
}

// Steps of slacks and duals along one of x.
InteriorReach CurveInteriorPoint::FollowRows(const VectorXd& step,
                                             double centre) {
  InteriorReach reach;
  for (int i = 0; i < pieces_; ++i) {
    const First& first = first_[i];
    const CurveLocal local = ToLocal(program_, i, step);
    double* const slopes =
        has_norms_ ? slopes_.data() + first.bound : weights_.data();
    ForBounds(program_.pieces[i], 0, [&](const auto& bounds, int at) {
      SlopesOf(bounds, local, slopes + at);
    });
    double* to = slopes + (first.row - first.bound);
    for (int k = first.other; k < first_[i + 1].other; ++k) {
      to = WriteSlopes(rows_[k], local, to);
    }
    const InteriorReach part =
        state_.FollowPart(first.bound, RowsOfPiece(i), slopes, centre);
    reach.slack = std::min(reach.slack, part.slack);
    reach.dual = std::min(reach.dual, part.dual);
  }
  return reach;
}

Eigen::ArrayXd CurveInteriorPoint::BendsAlong(const VectorXd& step) const {
  Eigen::ArrayXd bends = Eigen::ArrayXd::Zero(CountRows());
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, step);
    ForNorms(i, [&](int k, int at) { bends[at] = BendOf(rows_[k], local); });
  }
  return bends;
}

void CurveInteriorPoint::AddCentres(double centre, VectorXd* to) {
  for (int i = 0; i < pieces_; ++i) {
    state_.WriteMultipliers(centre, first_[i].bound, RowsOfPiece(i),
                            weights_.data());
    AddGradient(program_, i, SumOfRows(i, weights_.data()), to);
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
    InteriorReach reach = FollowRows(step, centre).Times(kStepShare);
    double& alpha = reach.slack;  // of x, too
    // Of norms, which bend, the slacks themselves count in the end.
    for (; has_norms_ && alpha > kShortestStep; alpha *= kShorter) {
      FollowSlacks(x + alpha * step, alpha);
      if ((slacks_ > kLeastSlack * state_.slack).all()) break;
    }
    if (!(alpha > kShortestStep)) break;
    if (has_norms_) {
      state_.Move(reach, slacks_);
    } else {
      state_.Move(reach);
    }
    x += alpha * step;
  }
  result.x = x;
  return result;
}

}  // namespace phongpd::internal
