// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/obstacle_groups.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "constraints/motion_oracle.h"
#include "core/bvh/box_tree.h"
#include "core/bvh/box_tree_pairs.h"
#include "core/mesh/union_find.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Of the largest coordinate: beyond what the grids of two contact spaces round
// by, 2^-38 of the operands each.
constexpr double kSlack = 1e-9;
constexpr int kLeafSize = 4;

std::vector<BoundingBox> TriangleBoxes(const TriangleMesh& mesh) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[static_cast<std::size_t>(t[0])],
                   &b = mesh.vertices[static_cast<std::size_t>(t[1])],
                   &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return boxes;
}

double LargestCoordinate(const BoundingBox& box) {
  return box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
}

template <typename Box>
bool AreWithin(const Vector3d& reach, const Box& a, const Box& b) {
  return ((a.min - reach).array() <= b.max.array()).all() &&
         ((b.min - reach).array() <= a.max.array()).all();
}

// Do boxes of triangles of the two come within reach of each other?
bool SurfacesAreNear(const Vector3d& reach, const BoxTree& a,
                     const std::vector<BoundingBox>& boxes_a, const BoxTree& b,
                     const std::vector<BoundingBox>& boxes_b) {
  bool near = false;
  ForEachPair(
      a, b,
      [&](int i, int j) {
        return AreWithin(reach, a.nodes()[static_cast<std::size_t>(i)],
                         b.nodes()[static_cast<std::size_t>(j)]);
      },
      [&](int k, int l) {
        const auto i = static_cast<std::size_t>(a.order()[k]);
        const auto j = static_cast<std::size_t>(b.order()[l]);
        near = AreWithin(reach, boxes_a[i], boxes_b[j]);
        return !near;
      });
  return near;
}

}  // namespace

std::vector<std::vector<int>> ObstacleGroups(
    const Solid& robot, const std::vector<Solid>& obstacles) {
  const BoundingBox robot_box = ComputeBounds(robot);
  double largest = LargestCoordinate(robot_box);
  std::vector<BoundingBox> whole;
  std::vector<std::vector<BoundingBox>> boxes;
  std::vector<BoxTree> trees;
  for (const Solid& obstacle : obstacles) {
    whole.push_back(ComputeBounds(obstacle));
    largest = std::max(largest, LargestCoordinate(whole.back()));
    boxes.push_back(TriangleBoxes(obstacle));
    trees.emplace_back(boxes.back(), kLeafSize);
  }
  const Vector3d reach =
      (robot_box.max - robot_box.min).array() + kSlack * largest;

  internal::UnionFind groups(obstacles.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = static_cast<int>(i), b = static_cast<int>(j);
      if (groups.Find(a) == groups.Find(b) ||
          !AreWithin(reach, whole[i], whole[j])) {
        continue;
      }
      // Surfaces that are apart: what the oracle finds is one in the other.
      if (SurfacesAreNear(reach, trees[i], boxes[i], trees[j], boxes[j]) ||
          MotionOracle(obstacles[i], obstacles[j]).Collides(Vector3d::Zero())) {
        groups.Join(a, b);
      }
    }
  }
  std::map<int, std::size_t> place;
  std::vector<std::vector<int>> out;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const auto index = static_cast<int>(i);
    const auto [at, is_new] = place.emplace(groups.Find(index), out.size());
    if (is_new) out.emplace_back();
    out[at->second].push_back(index);
  }
  return out;
}

}  // namespace phongpd
