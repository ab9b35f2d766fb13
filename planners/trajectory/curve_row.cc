// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_row.h"

#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kRound = 1e-3;  // |y| → (|y|² + this²)^½: smooth, and more

using OfPoints = Eigen::Map<const Eigen::Matrix<double, 3, 6>>;

// Of the terms in ΔB and η.
double AlongRow(const CurveRowNow& now, const CurveLocal& step) {
  const CurveProgram::Row& row = *now.row;
  double along = now.eta * step[kCurveEta];
  if (row.kind == CurveProgram::Row::kScalar) return along;
  Vector3d moved = Vector3d::Zero();
  for (int j = row.first; j <= row.last; ++j) {
    moved += row.weight[j] * step.segment<3>(3 * j);
  }
  return along + now.direction.dot(moved);
}

}  // namespace

double Slope(const CurveRowNow& now, const CurveLocal& step, double* along) {
  const CurveProgram::Row& row = *now.row;
  if (!row.repeats) *along = AlongRow(now, step);
  return *along + row.missing * step[kCurveMissing] + row.t * step[kCurveT];
}

double SlackAt(CurveRowNow* now, const CurveLocal& x, double* along) {
  const CurveProgram::Row& row = *now->row;
  if (row.kind != CurveProgram::Row::kNorm) {
    return -(row.constant + Slope(*now, x, along));
  }
  const Vector3d y = row.value + row.value_by_eta * x[kCurveEta] +
                     OfPoints(x.data()) * row.weight;
  const double norm = std::sqrt(y.squaredNorm() + kRound * kRound);
  now->direction = y / norm;
  now->inverse_norm = 1.0 / norm;
  now->eta = now->direction.dot(row.value_by_eta);
  return -(norm + row.constant + row.t * x[kCurveT]);
}

void AddSquare(const CurveRowNow& now, const CurveRowWeights& by, double dual,
               CurveLocalMatrix* lower) {
  const CurveProgram::Row& row = *now.row;
  CurveLocalMatrix& m = *lower;
  const double by_missing = by.missing * row.missing, by_t = by.along * row.t;
  const double by_eta = by.along * now.eta;
  m(kCurveEta, kCurveEta) += by_eta * now.eta;
  m(kCurveMissing, kCurveEta) += by_missing * now.eta;
  m(kCurveMissing, kCurveMissing) += by_missing * row.missing;
  m(kCurveT, kCurveEta) += by_t * now.eta;
  m(kCurveT, kCurveMissing) += by_t * row.missing;
  m(kCurveT, kCurveT) += by_t * row.t;
  if (row.kind == CurveProgram::Row::kScalar) return;
  Eigen::Matrix3d square = by.along * now.direction * now.direction.transpose();
  Vector3d with_eta = by_eta * now.direction;
  if (row.kind == CurveProgram::Row::kNorm) {
    // The row's own curvature, by the dual.
    const Eigen::Matrix3d bend = dual * now.inverse_norm *
                                 (Eigen::Matrix3d::Identity() -
                                  now.direction * now.direction.transpose());
    square += bend;
    const Vector3d bent = bend * row.value_by_eta;
    m(kCurveEta, kCurveEta) += row.value_by_eta.dot(bent);
    with_eta += bent;
  }
  for (int j = row.first; j <= row.last; ++j) {
    const Eigen::Matrix3d of_j = row.weight[j] * square;
    for (int k = j; k <= row.last; ++k) {
      m.block<3, 3>(3 * k, 3 * j) += row.weight[k] * of_j;
    }
    const auto along = row.weight[j] * now.direction.transpose();
    m.block<1, 3>(kCurveEta, 3 * j) += row.weight[j] * with_eta.transpose();
    m.block<1, 3>(kCurveMissing, 3 * j) += by_missing * along;
    m.block<1, 3>(kCurveT, 3 * j) += by_t * along;
  }
}

void AddRow(const CurveRowNow& now, const CurveRowWeights& by,
            CurveLocal* gradient) {
  const CurveProgram::Row& row = *now.row;
  (*gradient)[kCurveEta] += by.along * now.eta;
  (*gradient)[kCurveMissing] += by.missing * row.missing;
  (*gradient)[kCurveT] += by.along * row.t;
  if (row.kind == CurveProgram::Row::kScalar) return;
  const Vector3d along = by.along * now.direction;
  for (int j = row.first; j <= row.last; ++j) {
    gradient->segment<3>(3 * j) += row.weight[j] * along;
  }
}

}  // namespace phongpd::internal
