// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_tree.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bvh/box_tree.h"
#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// The positions of a node's items in the order of the tree.
struct ItemRange {
  int first = 0, last = 0;
};

// A turned box has to be so much smaller to be taken.
constexpr double kSmaller = 0.9;
constexpr double kRotationTo = 0x1p-50;

// A fourth of the half of its surface: what meets it at random goes by that.
double SizeOf(const Vector3d& half) {
  return half.x() * half.y() + half.y() * half.z() + half.z() * half.x();
}

// The corners of the items in a range.
template <typename Visit>
void ForEachCorner(const std::vector<TriangleCorners>& corners,
                   const std::vector<int>& order, const ItemRange& range,
                   const Visit& visit) {
  for (int k = range.first; k < range.last; ++k) {
    const int item = order[static_cast<std::size_t>(k)];
    for (const Vector3d& x : corners[static_cast<std::size_t>(item)]) visit(x);
  }
}

// A rotation whose columns are u, which is not 0, and what is near v.
Matrix3d AxesFrom(const Vector3d& u, const Vector3d& v) {
  Matrix3d axes;
  axes.col(0) = u.normalized();
  const Vector3d across = axes.col(0).cross(v);
  if (!(across.norm() > 1e-8 * v.norm())) return Matrix3d::Identity();
  axes.col(2) = across.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  // Of a unit quaternion, it is a rotation to rounding, or nothing like one.
  axes = Quaterniond(axes).normalized().toRotationMatrix();
  const Matrix3d off = axes.transpose() * axes - Matrix3d::Identity();
  return off.cwiseAbs().maxCoeff() < kRotationTo ? axes : Matrix3d::Identity();
}

// Of a triangle along its longest edge; else by the moments of the corners.
// Any rotation is right.
Matrix3d AxesOf(const std::vector<TriangleCorners>& corners,
                const std::vector<int>& order, const ItemRange& range,
                const Vector3d& middle) {
  if (range.last - range.first == 1) {
    const TriangleCorners& t = corners[static_cast<std::size_t>(
        order[static_cast<std::size_t>(range.first)])];
    const Vector3d e[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (e[k].squaredNorm() > e[longest].squaredNorm()) longest = k;
    }
    if (!(e[longest].norm() > 0.0)) return Matrix3d::Identity();
    return AxesFrom(e[longest], e[(longest + 1) % 3]);
  }
  Matrix3d moments = Matrix3d::Zero();
  ForEachCorner(corners, order, range, [&](const Vector3d& x) {
    moments += (x - middle) * (x - middle).transpose();
  });
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moments);
  if (solver.info() != Eigen::Success) return Matrix3d::Identity();
  const Matrix3d& axes = solver.eigenvectors();
  return axes.allFinite() ? AxesFrom(axes.col(2), axes.col(1))
                          : Matrix3d::Identity();
}

// The box of a range along the axes.
RigidNode BoxAlong(const Matrix3d& axes,
                   const std::vector<TriangleCorners>& corners,
                   const std::vector<int>& order, const ItemRange& range) {
  Vector3d low = Vector3d::Constant(kInfinity), high = -low;
  ForEachCorner(corners, order, range, [&](const Vector3d& x) {
    const Vector3d y = axes.transpose() * x;
    low = low.cwiseMin(y);
    high = high.cwiseMax(y);
  });
  RigidNode node;
  node.axes = axes;
  const Vector3d middle = 0.5 * (low + high);
  node.center = axes * middle;
  node.half = (high - middle).cwiseMax(middle - low);
  return node;
}

// The smaller box, and its ball.
void FitBox(const std::vector<TriangleCorners>& corners,
            const std::vector<int>& order, const ItemRange& range,
            RigidNode* node) {
  RigidNode box = BoxAlong(Matrix3d::Identity(), corners, order, range);
  const RigidNode turned = BoxAlong(AxesOf(corners, order, range, box.center),
                                    corners, order, range);
  if (SizeOf(turned.half) < kSmaller * SizeOf(box.half)) {
    box = turned;
    node->is_turned = true;
  }
  node->center = box.center;
  node->half = box.half;
  node->axes = box.axes;
  double squared = 0.0;
  ForEachCorner(corners, order, range, [&](const Vector3d& x) {
    squared = std::max(squared, (x - box.center).squaredNorm());
  });
  node->radius = std::sqrt(squared);
}

}  // namespace

RigidTree MakeRigidTree(std::vector<TriangleCorners> corners) {
  RigidTree tree;
  std::vector<BoundingBox> boxes;
  boxes.reserve(corners.size());
  for (const TriangleCorners& t : corners) {
    boxes.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]),
                     t[0].cwiseMax(t[1]).cwiseMax(t[2])});
    for (const Vector3d& x : t) tree.reach = std::max(tree.reach, x.norm());
  }
  const BoxTree boxed(boxes, 1);
  const auto& nodes = boxed.nodes();
  tree.nodes.resize(nodes.size());
  std::vector<ItemRange> items(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children first
    const BoxTree::Node& from = nodes[i];
    RigidNode& node = tree.nodes[i];
    const auto first = static_cast<std::size_t>(from.first);
    if (from.IsLeaf()) {
      node.triangle = boxed.order()[first];
      items[i] = {from.first, from.first + 1};
    } else {
      node.left = from.first;
      items[i] = {std::min(items[first].first, items[first + 1].first),
                  std::max(items[first].last, items[first + 1].last)};
    }
    FitBox(corners, boxed.order(), items[i], &node);
  }
  if (!nodes.empty()) tree.size = 0.5 * (nodes[0].max - nodes[0].min).norm();
  tree.corners = std::move(corners);
  return tree;
}

}  // namespace phongpd::internal
