// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_interior_point.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kEta = 18, kMissing = 19, kT = 20;  // of a piece's unknowns

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
constexpr double kRound = 1e-3;  // |y| → (|y|² + this²)^½: smooth, and more

// The μ that the corrector aims at, by Mehrotra: the mean product of slack and
// dual, times the cube of the share that the predictor, `reach` of it, leaves.
// Notes the products of its steps.  State: of a row, private to the class.
template <typename State>
double CentreOfCurve(double reach, double gap, int rows,
                     std::vector<std::vector<State>>* states) {
  double after = 0.0;
  for (auto& of_piece : *states) {
    for (State& state : of_piece) {
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
      pieces_(static_cast<int>(program.pieces.size())),
      hessian_(pieces_),
      linear_(VectorXd::Zero(hessian_.size())),
      states_(pieces_) {
  for (int i = 0; i < pieces_; ++i) {
    for (const CurveProgram::Row& row : program.pieces[i].rows) {
      State state = {};
      state.row = &row;
      state.direction = row.direction;
      state.eta = row.eta;
      states_[i].push_back(state);
    }
  }
  AddObjective();
}

void CurveInteriorPoint::AddObjective() {
  // ∫ of products of the quadratic Bernstein polynomials, times 30.
  Eigen::Matrix3d products;
  products << 6, 3, 1, 3, 4, 3, 1, 3, 6;
  for (int i = 0; i < pieces_; ++i) {
    const CurveProgram::Piece& piece = program_.pieces[i];
    LocalMatrix matrix = LocalMatrix::Zero();
    Local gradient = Local::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const auto& rows = piece.jerk[axis];
      const Eigen::Matrix<double, 8, 8> square =
          (2.0 * piece.jerk_weight / 30.0) * rows.transpose() * products * rows;
      const auto place = [&](int j) { return j < 6 ? 3 * j + axis : kEta; };
      for (int j = 0; j < 7; ++j) {
        gradient[place(j)] += square(j, 7);
        for (int k = 0; k < 7; ++k) matrix(place(j), place(k)) += square(j, k);
      }
    }
    gradient[kEta] += piece.share;
    matrix(kEta, kEta) += piece.share;
    gradient[kMissing] += program_.missing;
    if (i > 0) {
      const double by = 2.0 * program_.evenness;
      const double jump =
          piece.log_duration - program_.pieces[i - 1].log_duration;
      hessian_.diagonal[i](9, 9) += by;
      hessian_.diagonal[i - 1](9, 9) += by;
      hessian_.above[i - 1](9, 9) -= by;
      linear_[kBlock * i + 9] += by * jump;
      linear_[kBlock * (i - 1) + 9] -= by * jump;
    }
    AddGradient(i, gradient, &linear_);
    AddMatrix(i, &matrix, &hessian_);
  }
  linear_[linear_.size() - 1] = program_.t;
}

CurveInteriorPoint::Local CurveInteriorPoint::ToLocal(int piece,
                                                      const VectorXd& x) const {
  const CurveProgram::Piece& of = program_.pieces[piece];
  const auto from = x.segment<kBlock>(kBlock * piece);
  Local local;
  const double r = of.before, s = of.after;
  local.segment<3>(0) = from.segment<3>(0);
  local.segment<3>(3) = from.segment<3>(0) + r * from.segment<3>(3);
  local.segment<3>(6) = from.segment<3>(0) + 2.0 * r * from.segment<3>(3) +
                        r * r * from.segment<3>(6);
  if (piece + 1 < pieces_) {
    const auto to = x.segment<kBlock>(kBlock * (piece + 1));
    local.segment<3>(9) = to.segment<3>(0) - 2.0 * s * to.segment<3>(3) +
                          s * s * to.segment<3>(6);
    local.segment<3>(12) = to.segment<3>(0) - s * to.segment<3>(3);
    local.segment<3>(15) = to.segment<3>(0);
  } else {
    local.segment<9>(9).setZero();
  }
  for (int j = 0; j < 6; ++j) {
    local.segment<3>(3 * j) += from[9] * of.by_eta.col(j);
  }
  local[kEta] = from[9];
  local[kMissing] = from[10];
  local[kT] = x[x.size() - 1];
  return local;
}

void CurveInteriorPoint::AddGradient(int piece, const Local& local,
                                     VectorXd* x) const {
  const CurveProgram::Piece& of = program_.pieces[piece];
  auto from = x->segment<kBlock>(kBlock * piece);
  const double r = of.before, s = of.after;
  const Vector3d b1 = local.segment<3>(3), b2 = local.segment<3>(6);
  from.segment<3>(0) += local.segment<3>(0) + b1 + b2;
  from.segment<3>(3) += r * (b1 + 2.0 * b2);
  from.segment<3>(6) += r * r * b2;
  from[9] += local[kEta];
  for (int j = 0; j < 6; ++j) {
    from[9] += of.by_eta.col(j).dot(local.segment<3>(3 * j));
  }
  from[10] += local[kMissing];
  (*x)[x->size() - 1] += local[kT];
  if (piece + 1 == pieces_) return;
  auto to = x->segment<kBlock>(kBlock * (piece + 1));
  const Vector3d b3 = local.segment<3>(9), b4 = local.segment<3>(12);
  to.segment<3>(0) += local.segment<3>(15) + b4 + b3;
  to.segment<3>(3) -= s * (b4 + 2.0 * b3);
  to.segment<3>(6) += s * s * b3;
}

// FᵀMF with ToLocal's F, columns first, then rows.
void CurveInteriorPoint::AddMatrix(int piece, LocalMatrix* local,
                                   BlockTridiagonal* to) const {
  const CurveProgram::Piece& of = program_.pieces[piece];
  const double r = of.before, s = of.after;
  LocalMatrix& m = *local;
  for (int pass = 0; pass < 2; ++pass) {
    for (int j = 0; j < 6; ++j) {
      for (int c = 0; c < 3; ++c) {
        m.col(kEta) += of.by_eta(c, j) * m.col(3 * j + c);
      }
    }
    for (int c = 0; c < 3; ++c) {
      auto b0 = m.col(c), b1 = m.col(3 + c), b2 = m.col(6 + c);
      b0 += b1 + b2;
      b1 = r * (b1 + 2.0 * b2);
      b2 *= r * r;
      auto b3 = m.col(9 + c), b4 = m.col(12 + c), b5 = m.col(15 + c);
      b5 += b4 + b3;
      b4 = -s * (b4 + 2.0 * b3);
      b3 *= s * s;
    }
    m.transposeInPlace();
  }
  // The order after: p v a of the first knot; a v p of the second; η m t.
  to->diagonal[piece].topLeftCorner<9, 9>() += m.topLeftCorner<9, 9>();
  to->diagonal[piece].block<9, 2>(0, 9) += m.block<9, 2>(0, kEta);
  to->diagonal[piece].block<2, 9>(9, 0) += m.block<2, 9>(kEta, 0);
  to->diagonal[piece].block<2, 2>(9, 9) += m.block<2, 2>(kEta, kEta);
  to->border[piece].head<9>() += m.block<9, 1>(0, kT);
  to->border[piece].tail<2>() += m.block<2, 1>(kEta, kT);
  to->corner += m(kT, kT);
  if (piece + 1 == pieces_) return;
  for (int o = 0; o < 3; ++o) {
    const int column = 15 - 3 * o;
    to->above[piece].block<9, 3>(0, 3 * o) += m.block<9, 3>(0, column);
    to->above[piece].block<2, 3>(9, 3 * o) += m.block<2, 3>(kEta, column);
    to->border[piece + 1].segment<3>(3 * o) += m.block<3, 1>(column, kT);
    for (int q = 0; q < 3; ++q) {
      to->diagonal[piece + 1].block<3, 3>(3 * o, 3 * q) +=
          m.block<3, 3>(column, 15 - 3 * q);
    }
  }
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

// Of the terms in ΔB and η.
double CurveInteriorPoint::Along(const State& state, const Local& step) {
  const CurveProgram::Row& row = *state.row;
  double along = state.eta * step[kEta];
  if (row.kind == CurveProgram::Row::kAxis) {
    for (int j = row.first; j <= row.last; ++j) {
      along += row.weight[j] * step[3 * j + row.axis];
    }
  } else if (row.kind != CurveProgram::Row::kScalar) {
    for (int j = row.first; j <= row.last; ++j) {
      along += row.weight[j] * state.direction.dot(step.segment<3>(3 * j));
    }
  }
  return along;
}

// `along`: of the row before, then of this one.
double CurveInteriorPoint::Slope(const State& state, const Local& step,
                                 double* along) {
  const CurveProgram::Row& row = *state.row;
  *along = row.is_mirrored ? -*along : Along(state, step);
  return *along + row.missing * step[kMissing] + row.t * step[kT];
}

// The slack at x, and of a norm its gradient there.
double CurveInteriorPoint::SlackAt(State* state, const Local& x,
                                   double* along) {
  const CurveProgram::Row& row = *state->row;
  if (row.kind != CurveProgram::Row::kNorm) {
    return -(row.constant + Slope(*state, x, along));
  }
  Vector3d y = row.value + row.value_by_eta * x[kEta];
  for (int j = row.first; j <= row.last; ++j) {
    y += row.weight[j] * x.segment<3>(3 * j);
  }
  const double norm = std::sqrt(y.squaredNorm() + kRound * kRound);
  state->direction = y / norm;
  state->inverse_norm = 1.0 / norm;
  state->eta = state->direction.dot(row.value_by_eta);
  return -(norm + row.constant + row.t * x[kT]);
}

// False, and the slacks are not to be used, if one falls below that share.
bool CurveInteriorPoint::UpdateSlacks(const VectorXd& x, double least_share) {
  bool is_inside = true;
  for (int i = 0; i < pieces_; ++i) {
    const Local local = ToLocal(i, x);
    double along = 0.0;
    for (State& state : states_[i]) {
      const double slack = SlackAt(&state, local, &along);
      is_inside = is_inside && slack > least_share * state.slack;
      state.next_slack = slack;
    }
  }
  if (!is_inside) return false;
  for (auto& of_piece : states_) {
    for (State& state : of_piece) state.slack = state.next_slack;
  }
  return true;
}

// by · (terms in ΔB, η and m)², by_t · those times the term in t; the square of
// that is for the caller.
void CurveInteriorPoint::AddRow(const State& state, double by, double by_t,
                                LocalMatrix* matrix) {
  const CurveProgram::Row& row = *state.row;
  LocalMatrix& m = *matrix;
  const std::array<double, 2> others = {state.eta, row.missing};
  const std::array<double, 3> scalars = {by * state.eta, by * row.missing,
                                         by_t * row.t};
  for (int j = 0; j < 2; ++j) {
    for (int k = 0; k < 3; ++k) m(kEta + j, kEta + k) += others[j] * scalars[k];
    m(kT, kEta + j) += others[j] * scalars[2];
  }
  if (row.kind == CurveProgram::Row::kScalar) return;
  if (row.kind == CurveProgram::Row::kAxis) {
    for (int j = row.first; j <= row.last; ++j) {
      const double weight = row.weight[j];
      const int at = 3 * j + row.axis;
      for (int k = row.first; k <= row.last; ++k) {
        m(at, 3 * k + row.axis) += by * weight * row.weight[k];
      }
      for (int k = 0; k < 3; ++k) {
        m(at, kEta + k) += weight * scalars[k];
        m(kEta + k, at) += weight * scalars[k];
      }
    }
    return;
  }
  Eigen::Matrix3d square = by * state.direction * state.direction.transpose();
  if (row.kind == CurveProgram::Row::kNorm) {
    // The row's own curvature, by the dual.
    const Eigen::Matrix3d bend =
        state.dual * state.inverse_norm *
        (Eigen::Matrix3d::Identity() -
         state.direction * state.direction.transpose());
    square += bend;
    const Vector3d by_eta = bend * row.value_by_eta;
    m(kEta, kEta) += row.value_by_eta.dot(by_eta);
    for (int j = row.first; j <= row.last; ++j) {
      m.block<3, 1>(3 * j, kEta) += row.weight[j] * by_eta;
      m.block<1, 3>(kEta, 3 * j) += row.weight[j] * by_eta.transpose();
    }
  }
  for (int j = row.first; j <= row.last; ++j) {
    for (int k = row.first; k <= row.last; ++k) {
      m.block<3, 3>(3 * j, 3 * k) += row.weight[j] * row.weight[k] * square;
    }
    const Vector3d along = row.weight[j] * state.direction;
    for (int k = 0; k < 3; ++k) {
      m.block<3, 1>(3 * j, kEta + k) += scalars[k] * along;
      m.block<1, 3>(kEta + k, 3 * j) += scalars[k] * along.transpose();
    }
  }
}

void CurveInteriorPoint::AddRow(const State& state, double by, double by_t,
                                Local* gradient) {
  const CurveProgram::Row& row = *state.row;
  (*gradient)[kEta] += by * state.eta;
  (*gradient)[kMissing] += by * row.missing;
  (*gradient)[kT] += by_t * row.t;
  if (row.kind == CurveProgram::Row::kScalar) return;
  for (int j = row.first; j <= row.last; ++j) {
    if (row.kind == CurveProgram::Row::kAxis) {
      (*gradient)[3 * j + row.axis] += by * row.weight[j];
    } else {
      gradient->segment<3>(3 * j) += by * row.weight[j] * state.direction;
    }
  }
}

// Σ multiplier · gradient of a row.
template <typename Multiplier>
void CurveInteriorPoint::AddGradients(const std::vector<State>& states,
                                      const Multiplier& multiplier,
                                      Local* gradient) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double by = multiplier(states[k]);
    if (k + 1 < states.size() && states[k + 1].row->is_mirrored) {
      const double other = multiplier(states[k + 1]);
      AddRow(states[k++], by - other, by + other, gradient);
    } else {
      AddRow(states[k], by, by, gradient);
    }
  }
}

// Duals are μ/slack, with the μ that the price of t asks for; and m is where
// they meet its price.
bool CurveInteriorPoint::Begin(VectorXd* x, int* rows) {
  (*x)[x->size() - 1] = kStartT;
  double of_t = 0.0;
  for (int i = 0; i < pieces_; ++i) {
    const Local local = ToLocal(i, *x);
    double along = 0.0;
    for (State& state : states_[i]) {
      ++*rows;
      const double slack = SlackAt(&state, local, &along);
      if (state.row->t < 0.0) of_t -= state.row->t / slack;
    }
  }
  const double mu = program_.t / of_t;
  for (int i = 0; program_.missing > 0.0 && i < pieces_; ++i) {
    int count = 0;
    for (const State& state : states_[i]) count += state.row->missing < 0.0;
    (*x)[kBlock * i + 10] =
        program_.pieces[i].missing + mu * count / program_.missing;
  }
  if (!UpdateSlacks(*x, 0.0)) return false;
  for (auto& of_piece : states_) {
    for (State& state : of_piece) state.dual = mu / state.slack;
  }
  return true;
}

double CurveInteriorPoint::AddRows(BlockTridiagonal* matrix,
                                   VectorXd* residual) const {
  double gap = 0.0;
  for (int i = 0; i < pieces_; ++i) {
    LocalMatrix local = LocalMatrix::Zero();
    Local of_rows = Local::Zero();
    const std::vector<State>& states = states_[i];
    for (std::size_t k = 0; k < states.size(); ++k) {
      const State& state = states[k];
      gap += state.slack * state.dual;
      double by = state.dual / state.slack, by_t = by;
      if (k + 1 < states.size() && states[k + 1].row->is_mirrored) {
        const State& other = states[++k];
        gap += other.slack * other.dual;
        by += other.dual / other.slack;
        by_t -= other.dual / other.slack;
      }
      local(kT, kT) += by * state.row->t * state.row->t;
      AddRow(state, by, by_t, &local);
    }
    AddGradients(
        states, [](const State& state) { return state.dual; }, &of_rows);
    AddMatrix(i, &local, matrix);
    AddGradient(i, of_rows, residual);
  }
  return gap;
}

// Steps of slacks and duals along one of x; how far they lead at most.
double CurveInteriorPoint::FollowRows(const VectorXd& step, double centre) {
  double alpha = 1.0;
  for (int i = 0; i < pieces_; ++i) {
    const Local local = ToLocal(i, step);
    double along = 0.0;
    for (State& state : states_[i]) {
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
      for (State& state : of_piece) state.product = 0.0;
    }
    VectorXd step = -gradient;
    Fix(&step);
    matrix.Solve(&step);
    const double reach = FollowRows(step, 0.0);
    const double centre = CentreOfCurve(reach, gap, result.rows, &states_);

    // Corrector.
    const auto multiplier = [centre](const State& state) {
      return (state.product - centre) / state.slack;
    };
    step = -gradient;
    for (int i = 0; i < pieces_; ++i) {
      Local of_rows = Local::Zero();
      AddGradients(states_[i], multiplier, &of_rows);
      AddGradient(i, of_rows, &step);
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
      for (State& state : of_piece) state.dual += alpha * state.dual_step;
    }
    x += alpha * step;
  }
  result.x = x;
  return result;
}

}  // namespace phongpd::internal
