// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_row.h"

#include <array>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kRound = 1e-3;  // |y| → (|y|² + this²)^½: smooth, and more

// Of the terms in ΔB and η.
double AlongRow(const CurveRowState& state, const CurveLocal& step) {
  const CurveProgram::Row& row = *state.row;
  double along = state.eta * step[kCurveEta];
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

}  // namespace

double Slope(const CurveRowState& state, const CurveLocal& step,
             double* along) {
  const CurveProgram::Row& row = *state.row;
  *along = row.is_mirrored ? -*along : AlongRow(state, step);
  return *along + row.missing * step[kCurveMissing] + row.t * step[kCurveT];
}

double SlackAt(CurveRowState* state, const CurveLocal& x, double* along) {
  const CurveProgram::Row& row = *state->row;
  if (row.kind != CurveProgram::Row::kNorm) {
    return -(row.constant + Slope(*state, x, along));
  }
  Vector3d y = row.value + row.value_by_eta * x[kCurveEta];
  for (int j = row.first; j <= row.last; ++j) {
    y += row.weight[j] * x.segment<3>(3 * j);
  }
  const double norm = std::sqrt(y.squaredNorm() + kRound * kRound);
  state->direction = y / norm;
  state->inverse_norm = 1.0 / norm;
  state->eta = state->direction.dot(row.value_by_eta);
  return -(norm + row.constant + row.t * x[kCurveT]);
}

void AddRow(const CurveRowState& state, double by, double by_t,
            CurveLocalMatrix* matrix) {
  const CurveProgram::Row& row = *state.row;
  CurveLocalMatrix& m = *matrix;
  const std::array<double, 2> others = {state.eta, row.missing};
  const std::array<double, 3> scalars = {by * state.eta, by * row.missing,
                                         by_t * row.t};
  for (int j = 0; j < 2; ++j) {
    for (int k = 0; k < 3; ++k)
      m(kCurveEta + j, kCurveEta + k) += others[j] * scalars[k];
    m(kCurveT, kCurveEta + j) += others[j] * scalars[2];
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
        m(at, kCurveEta + k) += weight * scalars[k];
        m(kCurveEta + k, at) += weight * scalars[k];
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
    m(kCurveEta, kCurveEta) += row.value_by_eta.dot(by_eta);
    for (int j = row.first; j <= row.last; ++j) {
      m.block<3, 1>(3 * j, kCurveEta) += row.weight[j] * by_eta;
      m.block<1, 3>(kCurveEta, 3 * j) += row.weight[j] * by_eta.transpose();
    }
  }
  for (int j = row.first; j <= row.last; ++j) {
    for (int k = row.first; k <= row.last; ++k) {
      m.block<3, 3>(3 * j, 3 * k) += row.weight[j] * row.weight[k] * square;
    }
    const Vector3d along = row.weight[j] * state.direction;
    for (int k = 0; k < 3; ++k) {
      m.block<3, 1>(3 * j, kCurveEta + k) += scalars[k] * along;
      m.block<1, 3>(kCurveEta + k, 3 * j) += scalars[k] * along.transpose();
    }
  }
}

void AddRow(const CurveRowState& state, double by, double by_t,
            CurveLocal* gradient) {
  const CurveProgram::Row& row = *state.row;
  (*gradient)[kCurveEta] += by * state.eta;
  (*gradient)[kCurveMissing] += by * row.missing;
  (*gradient)[kCurveT] += by_t * row.t;
  if (row.kind == CurveProgram::Row::kScalar) return;
  for (int j = row.first; j <= row.last; ++j) {
    if (row.kind == CurveProgram::Row::kAxis) {
      (*gradient)[3 * j + row.axis] += by * row.weight[j];
    } else {
      gradient->segment<3>(3 * j) += by * row.weight[j] * state.direction;
    }
  }
}

}  // namespace phongpd::internal
