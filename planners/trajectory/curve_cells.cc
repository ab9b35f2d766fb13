// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Weights = Eigen::Matrix<double, 6, 6>;  // a part's point by row

// Halvings of a piece; what is not clear then gets no plane, and if that
// matters the judge will say so.
constexpr int kMaxHalvings = 6;
// A point moves by at most so many times the largest coordinate's move.
const double kDiagonal = std::sqrt(3.0);

// Of de Casteljau at ½: first half and second.
Weights Half(bool second) {
  Weights half = Weights::Zero();
  half(0, 0) = 1.0;
  for (int i = 1; i < 6; ++i) {
    for (int k = 0; k <= i; ++k) {
      half(i, k) = 0.5 * (half(i - 1, k) + (k > 0 ? half(i - 1, k - 1) : 0.0));
    }
  }
  return second ? Weights(half.reverse()) : half;
}

class Finder {
 public:
  Finder(const FreeSpace& space, const KnotCurve::Points& points, double trust,
         double wanted)
      : space_(space), points_(points), reach_(kDiagonal * trust + wanted) {
    cells_.distance = std::numeric_limits<double>::infinity();
  }

  PieceCells Run() {
    AddBounds();
    AddPart(Weights::Identity(), 0);
    return std::move(cells_);
  }

 private:
  void AddBounds() {
    const BoundingBox& bounds = space_.bounds();
    if (bounds.IsEmpty()) return;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        const Vector3d normal = sign * Vector3d::Unit(axis);
        const double level =
            sign * (sign > 0.0 ? bounds.min[axis] : bounds.max[axis]);
        AddPlane(Weights::Identity(), normal,
                 [&](const Vector3d& q) { return normal.dot(q) - level; });
      }
    }
  }

  void AddPart(const Weights& weights, int halvings) {
    const KnotCurve::Points part = points_ * weights.transpose();
    const Vector3d a = part.col(0), b = part.col(5);
    double bend = 0.0;
    for (int j = 1; j < 5; ++j) {
      bend = std::max(bend, (part.col(j) - a - (j / 5.0) * (b - a)).norm());
    }
    const auto separators = space_.FindSeparators(a, b, bend + reach_, 0.0);
    const auto is_above = [&](const Separator& plane) {
      for (int j = 0; j < 6; ++j) {
        if (!(Height(plane, part.col(j)) > 0.0)) return false;
      }
      return true;
    };
    const bool is_clear =
        std::all_of(separators.begin(), separators.end(), is_above);
    if (!is_clear && halvings < kMaxHalvings) {
      static const Weights kFirst = Half(false), kSecond = Half(true);
      AddPart(kFirst * weights, halvings + 1);
      AddPart(kSecond * weights, halvings + 1);
      return;
    }
    if (!is_clear) cells_.distance = 0.0;  // nobody knows
    for (const Separator& plane : separators) {
      if (is_clear || is_above(plane)) {
        AddPlane(weights, plane.normal,
                 [&](const Vector3d& q) { return Height(plane, q); });
      }
    }
  }

  // From the triangle's highest corner, which loses few digits.
  static double Height(const Separator& plane, const Vector3d& q) {
    double height = std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : plane.corners) {
      height = std::min(height, plane.normal.dot(q - corner));
    }
    return height;
  }

  template <typename HeightOf>
  void AddPlane(const Weights& weights, const Vector3d& normal,
                const HeightOf& height_of) {
    const KnotCurve::Points part = points_ * weights.transpose();
    Eigen::Matrix<double, 6, 1> gap;
    for (int j = 0; j < 6; ++j) gap[j] = height_of(part.col(j));
    const double distance = gap.minCoeff();
    if (!(distance > 0.0)) return;
    cells_.distance = std::min(cells_.distance, distance);
    ++cells_.planes;
    for (int j = 0; j < 6; ++j) {
      if (gap[j] > reach_) continue;
      ClearanceRow row;
      row.weight = weights.row(j).transpose();
      row.last = 5;
      while (row.weight[row.first] == 0.0) ++row.first;
      while (row.weight[row.last] == 0.0) --row.last;
      row.normal = normal;
      row.gap = gap[j];
      row.distance = distance;
      cells_.rows.push_back(row);
    }
  }

  const FreeSpace& space_;
  const KnotCurve::Points& points_;
  const double reach_;
  PieceCells cells_;
};

}  // namespace

PieceCells FindCells(const FreeSpace& space, const KnotCurve::Points& points,
                     double trust, double wanted) {
  return Finder(space, points, trust, wanted).Run();
}

}  // namespace phongpd::internal
