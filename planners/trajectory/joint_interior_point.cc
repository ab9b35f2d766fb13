// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_interior_point.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Row = CurveProgram::Row;

constexpr int kMaxIterations = 30;
constexpr double kStartT = 0.03;  // that far inside the limits
// The gap at the end, a share of what has been gained, and at least; the
// gradient's largest entry.
constexpr double kGap = 0.03;
constexpr double kLeastGap = 1e-6;
constexpr double kGradient = 1e-3;
constexpr double kStepShare = 0.99;  // of the way to the nearest row
constexpr double kShortestStep = 1e-4;
// A norm so small beside its limit gets no row in its own direction.
constexpr double kSmallNorm = 0.1;

}  // namespace

JointInteriorPoint::JointInteriorPoint(const JointProgram& program)
    : program_(program),
      unknowns_(program),
      hessian_(unknowns_.pieces(), unknowns_.block()),
      linear_(VectorXd::Zero(hessian_.size())),
      lines_(static_cast<std::size_t>(unknowns_.pieces())) {
  for (int i = 0; i < unknowns_.pieces(); ++i) {
    for (int c = 0; c < unknowns_.curves(); ++c) AddLines(c, i);
  }
  AddJointRows();
  int rows = 0;
  for (auto& of_piece : lines_) {
    for (Line& line : of_piece) {
      line.at = rows;
      rows += line.sides;
    }
  }
  slopes_.resize(rows);
  unknowns_.AddObjective(&hessian_, &linear_);
}

void JointInteriorPoint::AddLines(int curve, int piece) {
  std::vector<Line>& lines = lines_[piece];
  const bool stays = program_.stays[static_cast<std::size_t>(curve)];
  const CurveProgram::Piece& of = program_.curves[curve].pieces[piece];
  for (const auto& bounds : of.bounds) {
    if (!stays) AddBoundLines(curve, bounds, &lines);
  }
  for (const Row& row : of.rows) {
    // Of what every curve has the same of, those of the first one.
    if (row.kind == Row::kScalar && curve > 0) continue;
    if (row.kind != Row::kScalar && stays) continue;
    if (row.kind == Row::kNorm) {
      AddNormLines(curve, row, &lines);
      continue;
    }
    Line line;
    line.first = row.kind == Row::kScalar ? -1 : curve;
    line.from = row.first;
    line.to = row.last;
    line.weight = row.weight;
    line.direction = row.direction;
    line.eta = row.eta;
    line.t = row.t;
    line.constant[0] = row.constant;
    lines.push_back(line);
  }
}

void JointInteriorPoint::AddBoundLines(int curve,
                                       const CurveProgram::Bounds& bounds,
                                       std::vector<Line>* lines) const {
  for (int j = bounds.first; j <= bounds.last; ++j) {
    for (int axis = 0; axis < 3; ++axis) {
      if (bounds.scale[axis] == 0.0) continue;
      const double value = bounds.value(axis, j);
      Line line;
      line.first = curve;
      line.from = j;
      line.to = j + bounds.order;
      for (int k = 0; k <= bounds.order; ++k) {
        line.weight[j + k] = bounds.scale[axis] * kDifferences[bounds.order][k];
      }
      line.axis = axis;
      line.direction = Vector3d::Unit(axis);
      line.eta = -bounds.order * value;
      line.t = bounds.t[axis];
      line.sides = 2;
      line.constant = {value - bounds.most, -value - bounds.most};
      lines->push_back(line);
    }
  }
}

// The box about the ball, and the plane that touches it where the value is.
// Here η changes what is bounded and not the bound, to first order the same:
// many robots that meet come closer to their least time by that.
void JointInteriorPoint::AddNormLines(int curve, const Row& row,
                                      std::vector<Line>* lines) const {
  Line line;
  line.first = curve;
  line.from = row.first;
  line.to = row.last;
  line.weight = row.weight;
  line.t = row.t;
  for (int axis = 0; axis < 3; ++axis) {
    line.axis = axis;
    line.direction = Vector3d::Unit(axis);
    line.eta = row.eta * row.value[axis];
    line.sides = 2;
    line.constant[0] = row.constant + row.value[axis];
    line.constant[1] = row.constant - row.value[axis];
    lines->push_back(line);
  }
  const double norm = row.value.norm();
  if (norm < kSmallNorm) return;
  line.axis = -1;
  line.direction = row.value / norm;
  line.eta = row.eta * norm;
  line.sides = 1;
  line.constant[0] = row.constant + norm;
  lines->push_back(line);
}

void JointInteriorPoint::AddJointRows() {
  for (const JointProgram::Row& row : program_.rows) {
    Line line;
    line.first = row.first;
    line.second = row.second;
    line.from = row.from;
    line.to = row.to;
    line.weight = row.weight;
    line.direction = row.direction;
    line.eta = row.eta;
    line.theta = row.theta;
    line.t = row.t;
    line.constant[0] = row.constant;
    lines_[row.piece].push_back(line);
  }
}

double JointInteriorPoint::Along(const Line& line,
                                 const VectorXd& local) const {
  double along = line.eta * local[unknowns_.EtaAt()] +
                 line.theta * local[unknowns_.ThetaAt()];
  if (line.first < 0) return along;
  for (int j = line.from; j <= line.to; ++j) {
    const int at = 18 * line.first + 3 * j;
    if (line.axis >= 0) {
      along += line.weight[j] * local[at + line.axis];
      continue;
    }
    Vector3d moved = local.segment<3>(at);
    if (line.second >= 0) moved -= local.segment<3>(18 * line.second + 3 * j);
    along += line.weight[j] * line.direction.dot(moved);
  }
  return along;
}

// by · (its gradient without t)².
void JointInteriorPoint::AddSquare(const Line& line, double by,
                                   MatrixXd* matrix) const {
  MatrixXd& m = *matrix;
  if (line.theta != 0.0) {  // few have that
    VectorXd gradient = VectorXd::Zero(m.rows());
    AddLine(line, 1.0, &gradient);
    m += by * gradient * gradient.transpose();
    return;
  }
  const int eta = unknowns_.EtaAt();
  m(eta, eta) += by * line.eta * line.eta;
  if (line.first < 0) return;
  const int a = 18 * line.first;
  if (line.axis >= 0) {
    for (int j = line.from; j <= line.to; ++j) {
      const int at = a + 3 * j + line.axis;
      const double weight = by * line.weight[j];
      for (int k = line.from; k <= line.to; ++k) {
        m(at, a + 3 * k + line.axis) += weight * line.weight[k];
      }
      m(at, eta) += weight * line.eta;
      m(eta, at) += weight * line.eta;
    }
    return;
  }
  const Eigen::Matrix3d square =
      by * line.direction * line.direction.transpose();
  for (int j = line.from; j <= line.to; ++j) {
    const Vector3d with_eta = (by * line.eta * line.weight[j]) * line.direction;
    m.block<3, 1>(a + 3 * j, eta) += with_eta;
    m.block<1, 3>(eta, a + 3 * j) += with_eta.transpose();
    for (int k = line.from; k <= line.to; ++k) {
      const Eigen::Matrix3d part = line.weight[j] * line.weight[k] * square;
      m.block<3, 3>(a + 3 * j, a + 3 * k) += part;
      if (line.second < 0) continue;
      const int b = 18 * line.second;
      m.block<3, 3>(b + 3 * j, b + 3 * k) += part;
      m.block<3, 3>(a + 3 * j, b + 3 * k) -= part;
      m.block<3, 3>(b + 3 * j, a + 3 * k) -= part;
    }
  }
}

void JointInteriorPoint::AddLine(const Line& line, double by,
                                 VectorXd* local) const {
  (*local)[unknowns_.EtaAt()] += by * line.eta;
  (*local)[unknowns_.ThetaAt()] += by * line.theta;
  if (line.first < 0) return;
  for (int j = line.from; j <= line.to; ++j) {
    const Vector3d part = by * line.weight[j] * line.direction;
    local->segment<3>(18 * line.first + 3 * j) += part;
    if (line.second >= 0) local->segment<3>(18 * line.second + 3 * j) -= part;
  }
}

// Half as far as rows let it that more time is bad for.
double JointInteriorPoint::FirstT() const {
  double t = kStartT;
  for (const auto& of_piece : lines_) {
    for (const Line& line : of_piece) {
      if (line.t > 0.0) t = std::min(t, -0.5 * line.constant[0] / line.t);
    }
  }
  return std::max(t, 0.0);
}

void JointInteriorPoint::FindSlopes(const VectorXd& x) {
  for (int i = 0; i < unknowns_.pieces(); ++i) {
    const VectorXd local = unknowns_.ToLocal(i, x);
    for (const Line& line : lines_[i]) {
      const double along = Along(line, local);
      const double of_t = line.t * local[unknowns_.TAt()];
      slopes_[line.at] = along + of_t;
      if (line.sides > 1) slopes_[line.at + 1] = -along + of_t;
    }
  }
}

// Duals are μ/slack, with the μ that the price of t asks for.
bool JointInteriorPoint::Begin(VectorXd* x) {
  (*x)[x->size() - 1] = FirstT();
  FindSlopes(*x);
  double of_t = 0.0;
  Eigen::ArrayXd slacks = -slopes_;
  for (const auto& of_piece : lines_) {
    for (const Line& line : of_piece) {
      for (int s = 0; s < line.sides; ++s) {
        double& slack = slacks[line.at + s];
        slack -= line.constant[static_cast<std::size_t>(s)];
        if (!(slack > 0.0)) return false;
        if (line.t < 0.0) of_t -= line.t / slack;
      }
    }
  }
  state_.Begin(slacks, Eigen::ArrayXd::Constant(slacks.size(),
                                                program_.curves[0].t / of_t));
  return true;
}

void JointInteriorPoint::AddRows(WideTridiagonal* matrix,
                                 VectorXd* residual) const {
  const int t = unknowns_.TAt();
  Eigen::ArrayXd squares(state_.size());
  state_.WriteSquares(0, state_.size(), squares.data());
  MatrixXd local(t + 1, t + 1);
  for (int i = 0; i < unknowns_.pieces(); ++i) {
    local.setZero();
    VectorXd of_rows = VectorXd::Zero(t + 1), with_t = VectorXd::Zero(t + 1);
    for (const Line& line : lines_[i]) {
      double by = 0.0, by_t = 0.0, dual = 0.0;
      for (int s = 0; s < line.sides; ++s) {
        const double sign = s == 0 ? 1.0 : -1.0;
        const double square = squares[line.at + s];
        by += square;
        by_t += sign * square;
        dual += sign * state_.dual[line.at + s];
        of_rows[t] += state_.dual[line.at + s] * line.t;
      }
      AddSquare(line, by, &local);
      AddLine(line, dual, &of_rows);
      if (line.t == 0.0) continue;
      AddLine(line, by_t * line.t, &with_t);
      local(t, t) += by * line.t * line.t;
    }
    local.col(t) += with_t;
    local.row(t) += with_t.transpose();
    unknowns_.AddMatrix(i, &local, matrix);
    unknowns_.AddGradient(i, of_rows, residual);
  }
}

void JointInteriorPoint::AddCentres(double centre, VectorXd* to) const {
  Eigen::ArrayXd multipliers(state_.size());
  state_.WriteMultipliers(centre, 0, state_.size(), multipliers.data());
  for (int i = 0; i < unknowns_.pieces(); ++i) {
    VectorXd of_rows = VectorXd::Zero(unknowns_.TAt() + 1);
    for (const Line& line : lines_[i]) {
      double by = 0.0;
      for (int s = 0; s < line.sides; ++s) {
        const double multiplier = multipliers[line.at + s];
        by += s == 0 ? multiplier : -multiplier;
        of_rows[unknowns_.TAt()] += multiplier * line.t;
      }
      AddLine(line, by, &of_rows);
    }
    unknowns_.AddGradient(i, of_rows, to);
  }
}

JointInteriorPoint::Result JointInteriorPoint::Solve() {
  Result result;
  result.x = VectorXd::Zero(hessian_.size());
  VectorXd x = result.x;
  // Not so where rounding takes all room: then no step is the answer.
  result.rows = static_cast<int>(slopes_.size());
  if (!Begin(&x)) return result;
  WideTridiagonal matrix(unknowns_.pieces(), unknowns_.block());
  for (; result.iterations < kMaxIterations; ++result.iterations) {
    const VectorXd gradient = hessian_.Times(x) + linear_;
    VectorXd residual = gradient;
    matrix = hessian_;
    AddRows(&matrix, &residual);
    unknowns_.Fix(&residual);
    const double gained = -0.5 * x.dot(gradient + linear_);
    if (state_.Gap() <= std::max(kLeastGap, kGap * gained) &&
        residual.cwiseAbs().maxCoeff() <= kGradient) {
      break;
    }
    unknowns_.Fix(&matrix);
    matrix.Factorize();

    // Predictor.
    VectorXd step = -gradient;
    unknowns_.Fix(&step);
    matrix.Solve(&step);
    FindSlopes(step);
    const double centre = state_.Predict(state_.Follow(slopes_, 0.0));

    // Corrector.
    step = -gradient;
    AddCentres(centre, &step);
    unknowns_.Fix(&step);
    matrix.Solve(&step);
    FindSlopes(step);
    const InteriorReach reach =
        state_.Follow(slopes_, centre).Times(kStepShare);
    if (!(reach.slack > kShortestStep)) break;
    state_.Move(reach);
    x += reach.slack * step;
  }
  result.x = x;
  return result;
}

}  // namespace phongpd::internal
