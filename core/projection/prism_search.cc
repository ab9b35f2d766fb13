// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/prism_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpd {

namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTie = 1e-13;         // of depths, field frame
constexpr double kSameContact = 1e-9;  // of contacts, field frame

// Does `a` come before `b`?  Contacts closer than kSameContact are one.
bool ComesFirst(const FieldProjector& projector, const Projection& a,
                const Projection& b) {
  if (a.depth < b.depth - kTie) return true;
  if (a.depth > b.depth + kTie) return false;
  const Vector3d p = projector.Point(a), q = projector.Point(b);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(p[i] - q[i]) > kSameContact) return p[i] < q[i];
  }
  if (a.depth != b.depth) return a.depth < b.depth;
  for (int i = 0; i < 3; ++i) {
    if (p[i] != q[i]) return p[i] < q[i];
  }
  return false;
}

}  // namespace

PrismSearch::PrismSearch(const FieldProjector& projector) {
  const TriangleMesh& mesh = projector.field().mesh;
  const std::vector<Vector3d>& normals = projector.field().normals;
  std::vector<BoundingBox> boxes;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d& b = mesh.vertices[t[1]];
    const Vector3d& c = mesh.vertices[t[2]];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  tree_ = BoxTree(boxes, 1);
  normals_.resize(tree_.nodes().size());
  for (std::size_t i = normals_.size(); i-- > 0;) {  // children first
    const BoxTree::Node& node = tree_.nodes()[i];
    NormalBounds& bounds = normals_[i];
    if (node.IsLeaf()) {
      bounds = {Vector3d::Constant(kInfinity), Vector3d::Constant(-kInfinity),
                kInfinity};
      for (int k = node.first; k < node.first + node.count; ++k) {
        const int triangle = tree_.order()[k];
        for (const int v : mesh.triangles[triangle]) {
          bounds.min = bounds.min.cwiseMin(normals[v]);
          bounds.max = bounds.max.cwiseMax(normals[v]);
        }
        bounds.least_norm =
            std::min(bounds.least_norm, projector.prisms()[triangle].min_norm);
      }
    } else {
      const NormalBounds& left = normals_[node.first];
      const NormalBounds& right = normals_[node.first + 1];
      bounds = {left.min.cwiseMin(right.min), left.max.cwiseMax(right.max),
                std::min(left.least_norm, right.least_norm)};
    }
    if (bounds.least_norm < 1e-3 ||
        projector.kind() == FieldKind::kTangentPlane) {
      bounds.least_norm = 0.0;
    }
  }
}

bool PrismSearch::InPrisms(int node, const Vector3d& x, double depth) const {
  const NormalBounds& normals = normals_[node];
  if (normals.least_norm == 0.0 || depth == kInfinity) return true;
  const BoxTree::Node& box = tree_.nodes()[node];
  const double s = depth / normals.least_norm + kSlack;
  return ((x - box.min).array() >= -s * normals.max.array().max(0.0) - kSlack)
             .all() &&
         ((x - box.max).array() <= -s * normals.min.array().min(0.0) + kSlack)
             .all();
}

Projection PrismSearch::FindLeastDepth(const FieldProjector& projector,
                                       const Vector3d& x) const noexcept {
  Projection best;
  best.depth = kInfinity;
  tree_.NearestFirst(
      kInfinity,
      [&](int node) {
        const double bound = best.depth + kSlack;
        if (!InPrisms(node, x, bound)) return kInfinity;
        // Compared with `bound`, so a rounded root is safe.
        return std::sqrt(tree_.nodes()[node].SquaredDistance(x));
      },
      [&](int position) {
        std::array<Projection, 3> found;
        const int count = projector.Project(tree_.order()[position], x,
                                            best.depth + kSlack, &found);
        for (int i = 0; i < count; ++i) {
          if (ComesFirst(projector, found[i], best)) best = found[i];
        }
        return best.depth + kSlack;
      });
  return best;
}

}  // namespace phongpd
