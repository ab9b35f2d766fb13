// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_bounds.h"

#include <array>
#include <type_traits>

namespace phongpd::internal {
namespace {

using Bounds = CurveProgram::Bounds;
using Eigen::Array3d;
using OfColumns = Eigen::Map<const Eigen::Array<double, 3, Eigen::Dynamic>>;
using ToColumns = Eigen::Map<Eigen::Array<double, 3, Eigen::Dynamic>>;
using Points = Eigen::Map<const Eigen::Array<double, 3, 6>>;

int Columns(const Bounds& bounds) { return bounds.last - bounds.first + 1; }

// The order as a constant: sums of so few terms are worth no loop.
template <typename Do>
void ByOrder(const Bounds& bounds, const Do& act) {
  switch (bounds.order) {
    case 0:
      return act(std::integral_constant<int, 0>());
    case 1:
      return act(std::integral_constant<int, 1>());
    case 2:
      return act(std::integral_constant<int, 2>());
    default:
      return act(std::integral_constant<int, 3>());
  }
}

// What both sides of the bounds have beside the points.
Array3d RoomBy(const Bounds& bounds, const CurveLocal& step) {
  return bounds.t * (step[kCurveT] + step[kCurveEta]);
}

// act(column, what the points change it by), of all columns.
template <typename Do>
void ForAlong(const Bounds& bounds, const CurveLocal& step, const Do& act) {
  const Points points(step.data());
  ByOrder(bounds, [&](auto order) {
    constexpr int kOrder = decltype(order)::value;
    for (int j = bounds.first; j <= bounds.last; ++j) {
      Array3d sum = points.col(j + kOrder);
      for (int k = 0; k < kOrder; ++k) {
        sum += kDifferences[kOrder][k] * points.col(j + k);
      }
      act(j, Array3d(bounds.scale * sum));
    }
  });
}

}  // namespace

int RowsOf(const Bounds& bounds) { return 6 * Columns(bounds); }

void SlopesOf(const Bounds& bounds, const CurveLocal& step, double* slopes) {
  const int n = Columns(bounds);
  ToColumns most(slopes, 3, n), least(slopes + 3 * n, 3, n);
  const Array3d of_t = RoomBy(bounds, step);
  ForAlong(bounds, step, [&](int j, const Array3d& along) {
    most.col(j - bounds.first) = of_t + along;
    least.col(j - bounds.first) = of_t - along;
  });
}

void SlacksOf(const Bounds& bounds, const CurveLocal& x, double* slacks) {
  const int n = Columns(bounds);
  ToColumns most(slacks, 3, n), least(slacks + 3 * n, 3, n);
  const Array3d room = bounds.most - RoomBy(bounds, x);
  ForAlong(bounds, x, [&](int j, const Array3d& along) {
    const Array3d value = bounds.value.col(j) + along;
    most.col(j - bounds.first) = room - value;
    least.col(j - bounds.first) = room + value;
  });
}

void AddSquares(const Bounds& bounds, const double* weights,
                CurveLocalMatrix* lower) {
  const int n = Columns(bounds);
  const OfColumns most(weights, 3, n), least(weights + 3 * n, 3, n);
  CurveLocalMatrix& m = *lower;
  Array3d of_t = Array3d::Zero();
  ByOrder(bounds, [&](auto order) {
    constexpr int kOrder = decltype(order)::value;
    constexpr auto kTimes = kDifferences[kOrder];
    for (int j = bounds.first; j <= bounds.last; ++j) {
      const auto above = most.col(j - bounds.first);
      const auto below = least.col(j - bounds.first);
      const Array3d sum = above + below;
      const Array3d with_t = (above - below) * bounds.t;
      const Array3d square = sum * bounds.scale * bounds.scale;
      of_t += sum * bounds.t * bounds.t;
      for (int axis = 0; axis < 3; ++axis) {
        const double along_t = with_t[axis] * bounds.scale[axis];
        for (int a = 0; a <= kOrder; ++a) {
          const int column = 3 * (j + a) + axis;
          for (int b = a; b <= kOrder; ++b) {
            m(3 * (j + b) + axis, column) +=
                kTimes[a] * kTimes[b] * square[axis];
          }
          m(kCurveEta, column) += kTimes[a] * along_t;
          m(kCurveT, column) += kTimes[a] * along_t;
        }
      }
    }
  });
  m(kCurveEta, kCurveEta) += of_t.sum();
  m(kCurveT, kCurveEta) += of_t.sum();
  m(kCurveT, kCurveT) += of_t.sum();
}

void AddGradients(const Bounds& bounds, const double* weights,
                  CurveLocal* gradient) {
  const int n = Columns(bounds);
  const OfColumns most(weights, 3, n), least(weights + 3 * n, 3, n);
  Eigen::Map<Eigen::Array<double, 3, 6>> points(gradient->data());
  Array3d of_t = Array3d::Zero();
  ByOrder(bounds, [&](auto order) {
    constexpr int kOrder = decltype(order)::value;
    for (int j = bounds.first; j <= bounds.last; ++j) {
      const auto above = most.col(j - bounds.first);
      const auto below = least.col(j - bounds.first);
      const Array3d along = above - below;
      of_t += above + below;
      for (int k = 0; k <= kOrder; ++k) {
        points.col(j + k) += kDifferences[kOrder][k] * bounds.scale * along;
      }
    }
  });
  const double room = (of_t * bounds.t).sum();
  (*gradient)[kCurveEta] += room;
  (*gradient)[kCurveT] += room;
}

double TermsInT(const Bounds& bounds, const double* weights) {
  const int n = Columns(bounds);
  return (OfColumns(weights, 3, 2 * n).rowwise().sum() * bounds.t).sum();
}

}  // namespace phongpd::internal
