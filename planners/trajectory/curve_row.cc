// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_row.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Σ_j w_j ΔB_j.
Vector3d Moved(const CurveRowNow& now, const CurveLocal& step) {
  Vector3d moved = Vector3d::Zero();
  for (int j = now.first; j <= now.last; ++j) {
    moved += now.weight[j] * step.segment<3>(3 * j);
  }
  return moved;
}

// Of the terms in ΔB and η.
double AlongRow(const CurveRowNow& now, const CurveLocal& step) {
  const double of_eta = now.eta * step[kCurveEta];
  return now.kind == CurveProgram::Row::kScalar
             ? of_eta
             : of_eta + now.direction.dot(Moved(now, step));
}

double SlackOfNorm(CurveRowNow* now, const CurveLocal& x) {
  const CurveProgram::Row& row = *now->row;
  const Vector3d y = row.value + Moved(*now, x);
  const double u = -row.constant - row.eta * x[kCurveEta] - row.t * x[kCurveT];
  if (!(u > 0.0)) return u;
  const double square = y.squaredNorm() / u;
  now->bend = 2.0 / u;
  now->direction = now->bend * y;
  now->eta = row.eta * (1.0 + square / u);
  now->t = row.t * (1.0 + square / u);
  return u - square;
}

}  // namespace

CurveRowNow::CurveRowNow(const CurveProgram::Row& of)
    : row(&of),
      direction(of.direction),
      eta(of.eta),
      t(of.t),
      missing(of.missing),
      weight(of.weight),
      kind(static_cast<std::int8_t>(of.kind)),
      first(static_cast<std::int8_t>(of.first)),
      last(static_cast<std::int8_t>(of.last)) {}

void AppendRows(const std::vector<CurveProgram::Row>& rows,
                std::vector<CurveRowNow>* to) {
  for (const CurveProgram::Row& row : rows) {
    if (row.repeats) {
      to->back().is_pair = true;
      to->back().missing = row.missing;
    } else {
      to->emplace_back(row);
    }
  }
}

double* WriteSlopes(const CurveRowNow& now, const CurveLocal& step,
                    double* to) {
  const double along = AlongRow(now, step) + now.t * step[kCurveT];
  if (now.is_pair) *to++ = along;
  *to++ = along + now.missing * step[kCurveMissing];
  return to;
}

double* WriteSlacks(CurveRowNow* now, const CurveLocal& x, double* to) {
  if (now->kind == CurveProgram::Row::kNorm) {
    *to = SlackOfNorm(now, x);
    return to + 1;
  }
  double* const end = WriteSlopes(*now, x, to);
  for (const CurveProgram::Row* row = now->row; to != end; ++row, ++to) {
    *to = -(row->constant + *to);
  }
  return end;
}

double BendOf(const CurveRowNow& now, const CurveLocal& step) {
  const CurveProgram::Row& row = *now.row;
  const double of_u = row.eta * step[kCurveEta] + row.t * step[kCurveT];
  const Vector3d bent = Moved(now, step) + 0.5 * of_u * now.direction;
  return 0.5 * now.bend * bent.squaredNorm();
}

void AddSquare(const CurveRowNow& now, const CurveRowWeights& by, double dual,
               CurveLocalMatrix* lower) {
  CurveLocalMatrix& m = *lower;
  const double by_missing = by.missing * now.missing, by_t = by.along * now.t;
  const double by_eta = by.along * now.eta;
  m(kCurveEta, kCurveEta) += by_eta * now.eta;
  m(kCurveMissing, kCurveEta) += by_missing * now.eta;
  m(kCurveMissing, kCurveMissing) += by_missing * now.missing;
  m(kCurveT, kCurveEta) += by_t * now.eta;
  m(kCurveT, kCurveMissing) += by_t * now.missing;
  m(kCurveT, kCurveT) += by_t * now.t;
  if (now.kind == CurveProgram::Row::kScalar) return;
  Eigen::Matrix3d square = by.along * now.direction * now.direction.transpose();
  Vector3d with_eta = by_eta * now.direction, with_t = by_t * now.direction;
  if (now.kind == CurveProgram::Row::kNorm) {
    const CurveProgram::Row& row = *now.row;
    // The row's own curvature; u changes by −t · (its unknown).
    const double bend = dual * now.bend;
    const Vector3d by_eta_of_y = 0.5 * row.eta * now.direction;
    const Vector3d by_t_of_y = 0.5 * row.t * now.direction;
    square.diagonal().array() += bend;
    with_eta += bend * by_eta_of_y;
    with_t += bend * by_t_of_y;
    m(kCurveEta, kCurveEta) += bend * by_eta_of_y.squaredNorm();
    m(kCurveT, kCurveEta) += bend * by_eta_of_y.dot(by_t_of_y);
    m(kCurveT, kCurveT) += bend * by_t_of_y.squaredNorm();
  }
  const Vector3d with_missing = by_missing * now.direction;
  for (int j = now.first; j <= now.last; ++j) {
    const double weight = now.weight[j];
    const Eigen::Matrix3d of_j = weight * square;
    for (int k = j; k <= now.last; ++k) {
      m.block<3, 3>(3 * k, 3 * j) += now.weight[k] * of_j;
    }
    m.block<1, 3>(kCurveEta, 3 * j) += weight * with_eta.transpose();
    m.block<1, 3>(kCurveMissing, 3 * j) += weight * with_missing.transpose();
    m.block<1, 3>(kCurveT, 3 * j) += weight * with_t.transpose();
  }
}

void AddRow(const CurveRowNow& now, const CurveRowWeights& by,
            CurveLocal* gradient) {
  (*gradient)[kCurveEta] += by.along * now.eta;
  (*gradient)[kCurveMissing] += by.missing * now.missing;
  (*gradient)[kCurveT] += by.along * now.t;
  if (now.kind == CurveProgram::Row::kScalar) return;
  const Vector3d along = by.along * now.direction;
  for (int j = now.first; j <= now.last; ++j) {
    gradient->segment<3>(3 * j) += now.weight[j] * along;
  }
}

}  // namespace phongpd::internal
