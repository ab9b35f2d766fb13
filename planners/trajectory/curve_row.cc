// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_row.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Σ_j w_j ΔB_j.
Vector3d Moved(const CurveProgram::Row& row, const CurveLocal& step) {
  Vector3d moved = Vector3d::Zero();
  for (int j = row.first; j <= row.last; ++j) {
    moved += row.weight[j] * step.segment<3>(3 * j);
  }
  return moved;
}

// Of the terms in ΔB and η.
double AlongRow(const CurveRowNow& now, const CurveLocal& step) {
  const double of_eta = now.eta * step[kCurveEta];
  return now.row->kind == CurveProgram::Row::kScalar
             ? of_eta
             : of_eta + now.direction.dot(Moved(*now.row, step));
}

}  // namespace

double Slope(const CurveRowNow& now, const CurveLocal& step, double* along) {
  const CurveProgram::Row& row = *now.row;
  if (!row.repeats) *along = AlongRow(now, step);
  return *along + row.missing * step[kCurveMissing] + now.t * step[kCurveT];
}

double SlackAt(CurveRowNow* now, const CurveLocal& x, double* along) {
  const CurveProgram::Row& row = *now->row;
  if (row.kind != CurveProgram::Row::kNorm) {
    return -(row.constant + Slope(*now, x, along));
  }
  const Vector3d y =
      row.value + row.value_by_eta * x[kCurveEta] + Moved(row, x);
  const double u = -row.constant - row.t * x[kCurveT];
  if (!(u > 0.0)) return u;
  const double square = y.squaredNorm() / u;
  now->bend = 2.0 / u;
  now->direction = now->bend * y;
  now->eta = now->direction.dot(row.value_by_eta);
  now->t = row.t * (1.0 + square / u);
  return u - square;
}

double BendOf(const CurveRowNow& now, const CurveLocal& step) {
  const CurveProgram::Row& row = *now.row;
  const Vector3d bent = row.value_by_eta * step[kCurveEta] + Moved(row, step) +
                        0.5 * row.t * step[kCurveT] * now.direction;
  return 0.5 * now.bend * bent.squaredNorm();
}

void AddSquare(const CurveRowNow& now, const CurveRowWeights& by, double dual,
               CurveLocalMatrix* lower) {
  const CurveProgram::Row& row = *now.row;
  CurveLocalMatrix& m = *lower;
  const double by_missing = by.missing * row.missing, by_t = by.along * now.t;
  const double by_eta = by.along * now.eta;
  m(kCurveEta, kCurveEta) += by_eta * now.eta;
  m(kCurveMissing, kCurveEta) += by_missing * now.eta;
  m(kCurveMissing, kCurveMissing) += by_missing * row.missing;
  m(kCurveT, kCurveEta) += by_t * now.eta;
  m(kCurveT, kCurveMissing) += by_t * row.missing;
  m(kCurveT, kCurveT) += by_t * now.t;
  if (row.kind == CurveProgram::Row::kScalar) return;
  Eigen::Matrix3d square = by.along * now.direction * now.direction.transpose();
  Vector3d with_eta = by_eta * now.direction, with_t = by_t * now.direction;
  if (row.kind == CurveProgram::Row::kNorm) {
    // The row's own curvature; u changes by −t · (its unknown).
    const double bend = dual * now.bend;
    const Vector3d by_t_of_y = 0.5 * row.t * now.direction;
    square.diagonal().array() += bend;
    with_eta += bend * row.value_by_eta;
    with_t += bend * by_t_of_y;
    m(kCurveEta, kCurveEta) += bend * row.value_by_eta.squaredNorm();
    m(kCurveT, kCurveEta) += bend * row.value_by_eta.dot(by_t_of_y);
    m(kCurveT, kCurveT) += bend * by_t_of_y.squaredNorm();
  }
  const Vector3d with_missing = by_missing * now.direction;
  for (int j = row.first; j <= row.last; ++j) {
    const double weight = row.weight[j];
    const Eigen::Matrix3d of_j = weight * square;
    for (int k = j; k <= row.last; ++k) {
      m.block<3, 3>(3 * k, 3 * j) += row.weight[k] * of_j;
    }
    m.block<1, 3>(kCurveEta, 3 * j) += weight * with_eta.transpose();
    m.block<1, 3>(kCurveMissing, 3 * j) += weight * with_missing.transpose();
    m.block<1, 3>(kCurveT, 3 * j) += weight * with_t.transpose();
  }
}

void AddRow(const CurveRowNow& now, const CurveRowWeights& by,
            CurveLocal* gradient) {
  const CurveProgram::Row& row = *now.row;
  (*gradient)[kCurveEta] += by.along * now.eta;
  (*gradient)[kCurveMissing] += by.missing * row.missing;
  (*gradient)[kCurveT] += by.along * now.t;
  if (row.kind == CurveProgram::Row::kScalar) return;
  const Vector3d along = by.along * now.direction;
  for (int j = row.first; j <= row.last; ++j) {
    gradient->segment<3>(3 * j) += row.weight[j] * along;
  }
}

}  // namespace phongpd::internal
