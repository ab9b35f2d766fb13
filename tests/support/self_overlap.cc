// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/self_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/bvh/box_tree.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Wide = Eigen::Matrix<long double, 3, 1>;
using Corners = std::array<Vector3d, 3>;

// Least overlap over the directions tried so far.
class Directions {
 public:
  Directions(const Corners& a, const Corners& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      a_[k] = (a[k] - a[0]).cast<long double>();
      b_[k] = (b[k] - a[0]).cast<long double>();
    }
  }
  Wide EdgeOfA(int k) const { return a_[(k + 1) % 3] - a_[k]; }
  Wide EdgeOfB(int k) const { return b_[(k + 1) % 3] - b_[k]; }

  void Try(const Wide& direction) {
    const long double length = direction.norm();
    if (!(length > 0)) return;
    long double low_a = direction.dot(a_[0]), high_a = low_a;
    long double low_b = direction.dot(b_[0]), high_b = low_b;
    for (std::size_t k = 1; k < 3; ++k) {
      const long double p = direction.dot(a_[k]), q = direction.dot(b_[k]);
      low_a = std::min(low_a, p);
      high_a = std::max(high_a, p);
      low_b = std::min(low_b, q);
      high_b = std::max(high_b, q);
    }
    const long double overlap = std::min(high_a - low_b, high_b - low_a);
    least_ = std::min(least_, static_cast<double>(overlap / length));
  }

  void TryAcross(const Wide& edge) {
    if (edge.norm() > 0) Try(edge.unitOrthogonal());
  }

  double least() const { return least_; }

 private:
  std::array<Wide, 3> a_, b_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double OverlapDepth(const Corners& a, const Corners& b) {
  Directions directions(a, b);
  const Wide normal_a = directions.EdgeOfA(0).cross(directions.EdgeOfA(1));
  const Wide normal_b = directions.EdgeOfB(0).cross(directions.EdgeOfB(1));
  directions.Try(normal_a);
  directions.Try(normal_b);
  for (int i = 0; i < 3; ++i) {
    // Triangles that rounding made segments have no normal, and segments that
    // are almost parallel no product: any direction across them will do.
    directions.TryAcross(directions.EdgeOfA(i));
    directions.TryAcross(directions.EdgeOfB(i));
    directions.Try(normal_a.cross(directions.EdgeOfA(i)));
    directions.Try(normal_b.cross(directions.EdgeOfB(i)));
    for (int j = 0; j < 3; ++j) {
      directions.Try(directions.EdgeOfA(i).cross(directions.EdgeOfB(j)));
    }
  }
  // No direction at all: two points.
  return std::isfinite(directions.least()) ? directions.least() : 0.0;
}

double DeepestSelfOverlap(const TriangleMesh& mesh) {
  std::vector<Corners> corners;
  std::vector<BoundingBox> boxes;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Corners& c = corners.emplace_back(
        Corners{mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
    boxes.push_back({c[0].cwiseMin(c[1]).cwiseMin(c[2]),
                     c[0].cwiseMax(c[1]).cwiseMax(c[2])});
  }
  const BoxTree tree(boxes, 4);
  double deepest = 0.0;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const auto meets = [&](const Vector3d& min, const Vector3d& max) {
      return (min.array() <= boxes[t].max.array()).all() &&
             (max.array() >= boxes[t].min.array()).all();
    };
    tree.ForEach(
        [&](int node) {
          return meets(tree.nodes()[node].min, tree.nodes()[node].max);
        },
        [&](int position) {
          const auto other = static_cast<std::size_t>(tree.order()[position]);
          if (other > t && meets(boxes[other].min, boxes[other].max)) {
            deepest =
                std::max(deepest, OverlapDepth(corners[t], corners[other]));
          }
          return true;
        });
  }
  return deepest;
}

}  // namespace phongpd
