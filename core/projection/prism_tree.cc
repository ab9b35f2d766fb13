// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/prism_tree.h"

#include <cmath>
#include <utility>

#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using internal::kInfinity;
// |n(λ)| from which normals bound anything.
constexpr double kLeastNorm = 1e-3;
// Bounds of normals smaller than this are moved away from 0.
constexpr double kFlatNormals = 2e-6;

struct NormalBounds {
  Vector3d min = Vector3d::Constant(kInfinity);
  Vector3d max = Vector3d::Constant(-kInfinity);
  double least_norm = kInfinity;

  void Extend(const NormalBounds& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
    least_norm = std::min(least_norm, other.least_norm);
  }
};

NormalBounds BoundNormals(const FieldProjector& projector, int triangle) {
  NormalBounds bounds;
  bounds.least_norm = projector.prisms()[triangle].min_norm;
  if (projector.kind() == FieldKind::kTangentPlane ||
      bounds.least_norm < kLeastNorm) {
    return {Vector3d::Constant(-1.0), Vector3d::Constant(1.0), 0.0};
  }
  for (const int v : projector.field().mesh.triangles[triangle]) {
    const Vector3d& normal = projector.field().normals[v];
    bounds.min = bounds.min.cwiseMin(normal);
    bounds.max = bounds.max.cwiseMax(normal);
  }
  return bounds;
}

double HalfArea(const BoxTree::Node& node) {
  const Vector3d d = node.max - node.min;
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

}  // namespace

// Turns the binary tree into one of fours.
struct PrismTree::Builder {
  const BoxTree& tree;
  const std::vector<NormalBounds>& normals;  // per node of the binary tree
  std::vector<Node>* nodes;

  // The four nodes below `root` in which the largest have been opened.
  std::vector<int> Children(int root) const {
    std::vector<int> children = {root};
    while (children.size() < 4) {
      int largest = -1;
      for (std::size_t i = 0; i < children.size(); ++i) {
        const BoxTree::Node& node = tree.nodes()[children[i]];
        if (node.IsLeaf()) continue;
        if (largest < 0 ||
            HalfArea(node) > HalfArea(tree.nodes()[children[largest]])) {
          largest = static_cast<int>(i);
        }
      }
      if (largest < 0) break;
      const int left = tree.nodes()[children[largest]].first;
      children[largest] = left;
      children.push_back(left + 1);
    }
    return children;
  }

  void Set(int child, int source, Node* node) const {
    const BoxTree::Node& box = tree.nodes()[source];
    const NormalBounds& bounds = normals[source];
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      double low = bounds.min[i] - kWide, high = bounds.max[i] + kWide;
      if (std::abs(low) < kFlatNormals) low = -kFlatNormals;
      if (std::abs(high) < kFlatNormals) high = kFlatNormals;
      node->min[k][child] = static_cast<float>(box.min[i] - kWide);
      node->max[k][child] = static_cast<float>(box.max[i] + kWide);
      node->over_min[k][child] = static_cast<float>(1.0 / low);
      node->over_max[k][child] = static_cast<float>(1.0 / high);
    }
    node->least_norm[child] =
        static_cast<float>(bounds.least_norm * (1.0 - kRelative));
  }

  void Run() const {
    std::vector<std::pair<int, int>> open;  // binary node, wide node
    if (tree.nodes().empty()) return;
    nodes->emplace_back();
    open.emplace_back(0, 0);
    while (!open.empty()) {
      const auto [source, target] = open.back();
      open.pop_back();
      const std::vector<int> children = Children(source);
      Node node{};
      for (Four& low : node.min) low = low + kFarAway;
      for (std::size_t k = 0; k < children.size(); ++k) {
        const BoxTree::Node& child = tree.nodes()[children[k]];
        Set(static_cast<int>(k), children[k], &node);
        if (child.IsLeaf()) {
          node.child[k] = ~tree.order()[child.first];
        } else {
          node.child[k] = static_cast<int>(nodes->size());
          nodes->emplace_back();
          open.emplace_back(children[k], node.child[k]);
        }
      }
      (*nodes)[target] = node;
    }
  }
};

PrismTree::PrismTree(const FieldProjector& projector) {
  const TriangleMesh& mesh = projector.field().mesh;
  std::vector<BoundingBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d& b = mesh.vertices[t[1]];
    const Vector3d& c = mesh.vertices[t[2]];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  const BoxTree tree(boxes, 1);
  std::vector<NormalBounds> normals(tree.nodes().size());
  for (std::size_t i = normals.size(); i-- > 0;) {  // children first
    const BoxTree::Node& node = tree.nodes()[i];
    if (node.IsLeaf()) {
      normals[i] = BoundNormals(projector, tree.order()[node.first]);
    } else {
      normals[i] = normals[node.first];
      normals[i].Extend(normals[node.first + 1]);
    }
  }
  Builder{tree, normals, &nodes_}.Run();
}

}  // namespace phongpd
