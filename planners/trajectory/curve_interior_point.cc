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
constexpr double kGradient = 1e-3;
constexpr double kStepShare = 0.99;    // of the way to the nearest row
constexpr double kLeastSlack = 0.005;  // a step leaves this share of a slack
constexpr double kShorter = 0.8;       // the next try
constexpr double kShortestStep = 1e-3;

// The μ that the corrector aims at, by Mehrotra: the mean product of slack and
// dual, times the cube of the share that the predictor, `reach` of it, leaves.
// Notes the products of its steps.
double CentreOfCurve(double reach, double gap, int rows,
                     std::vector<std::vector<CurveRowState>>* states) {
  double after = 0.0;
  for (auto& of_piece : *states) {
    for (CurveRowState& state : of_piece) {
      after += (state.slack + reach * state.slack_step) *
               (state.dual + reach * state.dual_step);
      state.product = state.slack_step * state.dual_step;
    }
  }
  const double ratio = after / gap;
  return ratio * ratio * ratio * gap / rows;
}

}  // namespace

CurveInteriorPoint::CurveInteriorPoint(const CurveProgram& program)
    : program_(program),
      pieces_(program.size()),
      hessian_(pieces_),
      linear_(VectorXd::Zero(hessian_.size())),
      states_(pieces_) {
  for (int i = 0; i < pieces_; ++i) {
    for (const CurveProgram::Row& row : program.pieces[i].rows) {
      CurveRowState state = {};
      state.row = &row;
      state.direction = row.direction;
      state.eta = row.eta;
      states_[i].push_back(state);
    }
  }
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

// False, and the slacks are not to be used, if one falls below that share.
bool CurveInteriorPoint::UpdateSlacks(const VectorXd& x, double least_share) {
  bool is_inside = true;
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, x);
    double along = 0.0;
    for (CurveRowState& state : states_[i]) {
      const double slack = SlackAt(&state, local, &along);
      is_inside = is_inside && slack > least_share * state.slack;
      state.next_slack = slack;
    }
  }
  if (!is_inside) return false;
  for (auto& of_piece : states_) {
    for (CurveRowState& state : of_piece) state.slack = state.next_slack;
  }
  return true;
}

// Duals are μ/slack, with the μ that the price of t asks for; and m is where
// they meet its price.
bool CurveInteriorPoint::Begin(VectorXd* x, int* rows) {
  (*x)[x->size() - 1] = kStartT;
  double of_t = 0.0;
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, *x);
    double along = 0.0;
    for (CurveRowState& state : states_[i]) {
      ++*rows;
      const double slack = SlackAt(&state, local, &along);
      if (state.row->t < 0.0) of_t -= state.row->t / slack;
    }
  }
  const double mu = program_.t / of_t;
  for (int i = 0; program_.missing > 0.0 && i < pieces_; ++i) {
    int count = 0;
    for (const CurveRowState& state : states_[i])
      count += state.row->missing < 0.0;
    (*x)[kBlock * i + 10] =
        program_.pieces[i].missing + mu * count / program_.missing;
  }
  if (!UpdateSlacks(*x, 0.0)) return false;
  for (auto& of_piece : states_) {
    for (CurveRowState& state : of_piece) state.dual = mu / state.slack;
  }
  return true;
}

double CurveInteriorPoint::AddRows(BlockTridiagonal* matrix,
                                   VectorXd* residual) const {
  double gap = 0.0;
  for (int i = 0; i < pieces_; ++i) {
    CurveLocalMatrix local = CurveLocalMatrix::Zero();
    CurveLocal of_rows = CurveLocal::Zero();
    const std::vector<CurveRowState>& states = states_[i];
    for (std::size_t k = 0; k < states.size(); ++k) {
      const CurveRowState& state = states[k];
      gap += state.slack * state.dual;
      double by = state.dual / state.slack, by_t = by;
      if (k + 1 < states.size() && states[k + 1].row->is_mirrored) {
        const CurveRowState& other = states[++k];
        gap += other.slack * other.dual;
        by += other.dual / other.slack;
        by_t -= other.dual / other.slack;
      }
      local(kCurveT, kCurveT) += by * state.row->t * state.row->t;
      AddRow(state, by, by_t, &local);
    }
    AddGradients(
        states, [](const CurveRowState& state) { return state.dual; },
        &of_rows);
    AddMatrix(program_, i, &local, matrix);
    AddGradient(program_, i, of_rows, residual);
  }
  return gap;
}

// Steps of slacks and duals along one of x; how far they lead at most.
double CurveInteriorPoint::FollowRows(const VectorXd& step, double centre) {
  double alpha = 1.0;
  for (int i = 0; i < pieces_; ++i) {
    const CurveLocal local = ToLocal(program_, i, step);
    double along = 0.0;
    for (CurveRowState& state : states_[i]) {
      const double slope = Slope(state, local, &along);
      state.slack_step = -slope;
      state.dual_step =
          -state.dual +
          (state.dual * slope + centre - state.product) / state.slack;
      if (state.slack_step < 0.0) {
        alpha = std::min(alpha, -state.slack / state.slack_step);
      }
      if (state.dual_step < 0.0) {
        alpha = std::min(alpha, -state.dual / state.dual_step);
      }
    }
  }
  return alpha;
}

CurveInteriorPoint::Result CurveInteriorPoint::Solve() {
  Result result;
  result.x = VectorXd::Zero(hessian_.size());
  VectorXd x = result.x;
  // Not so where rounding takes all room: then no step is the answer.
  if (!Begin(&x, &result.rows)) return result;

  BlockTridiagonal matrix(pieces_);
  for (; result.iterations < kMaxIterations; ++result.iterations) {
    const VectorXd gradient = hessian_.Times(x) + linear_;
    VectorXd residual = gradient;  // of the Lagrangian
    matrix = hessian_;
    const double gap = AddRows(&matrix, &residual);
    Fix(&residual);
    const double gained = -0.5 * x.dot(gradient + linear_);  // from x = 0
    if (gap <= std::max(kLeastGap, kGap * gained) &&
        residual.cwiseAbs().maxCoeff() <= kGradient) {
      break;
    }
    Fix(&matrix);
    matrix.Factorize();

    // Predictor.
    for (auto& of_piece : states_) {
      for (CurveRowState& state : of_piece) state.product = 0.0;
    }
    VectorXd step = -gradient;
    Fix(&step);
    matrix.Solve(&step);
    const double reach = FollowRows(step, 0.0);
    const double centre = CentreOfCurve(reach, gap, result.rows, &states_);

    // Corrector.
    const auto multiplier = [centre](const CurveRowState& state) {
      return (state.product - centre) / state.slack;
    };
    step = -gradient;
    for (int i = 0; i < pieces_; ++i) {
      CurveLocal of_rows = CurveLocal::Zero();
      AddGradients(states_[i], multiplier, &of_rows);
      AddGradient(program_, i, of_rows, &step);
    }
    Fix(&step);
    matrix.Solve(&step);
    double alpha = std::min(1.0, kStepShare * FollowRows(step, centre));
    // The slacks themselves count in the end: norms bend.
    while (alpha > kShortestStep &&
           !UpdateSlacks(x + alpha * step, kLeastSlack)) {
      alpha *= kShorter;
    }
    if (!(alpha > kShortestStep)) break;
    for (auto& of_piece : states_) {
      for (CurveRowState& state : of_piece)
        state.dual += alpha * state.dual_step;
    }
    x += alpha * step;
  }
  result.x = x;
  return result;
}

}  // namespace phongpd::internal
