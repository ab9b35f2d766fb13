// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/pose_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/rigid/distinct_triangles.h"
#include "core/bvh/box_tree_pairs.h"
#include "core/bvh/segment_triangle_distance.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of triangles, a few milliseconds.
constexpr long kPairsBetweenAsks = 4096;

std::vector<TriangleCorners> DistinctCorners(
    const std::vector<TriangleMesh>& meshes) {
  std::vector<TriangleCorners> all;
  for (const TriangleMesh& mesh : meshes) {
    const std::vector<TriangleCorners> corners = CornersOf(mesh);
    all.insert(all.end(), corners.begin(), corners.end());
  }
  std::vector<TriangleCorners> distinct;
  for (const std::size_t k : DistinctTriangles(all)) distinct.push_back(all[k]);
  return distinct;
}

struct ClosestPoints {
  Vector3d on_robot = Vector3d::Zero(), on_obstacle = Vector3d::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();
};

// Of two triangles: an edge of one of them has one of the points.
ClosestPoints ClosestOf(const TriangleCorners& a, const TriangleCorners& b) {
  ClosestPoints best;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const SegmentTrianglePair mine = ClosestPair(a[i], a[j], b[0], b[1], b[2]);
    if (mine.squared_distance < best.squared_distance) {
      best = {mine.on_segment, mine.on_triangle, mine.squared_distance};
    }
    const SegmentTrianglePair its = ClosestPair(b[i], b[j], a[0], a[1], a[2]);
    if (its.squared_distance < best.squared_distance) {
      best = {its.on_triangle, its.on_segment, its.squared_distance};
    }
  }
  return best;
}

// Are all corners of one more than the radius off the plane of the other, on
// one side?
bool IsBeyondPlane(const TriangleCorners& face, const TriangleCorners& other,
                   double radius) {
  const Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3d& p : other) {
    const double height = normal.dot(p - face[0]);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const double height = std::max(low, -high);
  return height > 0.0 &&
         height * height > radius * radius * normal.squaredNorm();
}

// The largest gap between two boxes along their axes, < 0 where none parts
// them.
class BoxGap {
 public:
  BoxGap(const Matrix3d& rotation, const Vector3d& position)
      : rotation_(rotation),
        absolute_(rotation.cwiseAbs()),
        position_(position) {}

  double operator()(const BoxTree::Node& a, const BoxTree::Node& b) const {
    const Vector3d half_a = 0.5 * (a.max - a.min);
    const Vector3d half_b = 0.5 * (b.max - b.min);
    const Vector3d between =
        rotation_ * (0.5 * (a.min + a.max)) + position_ - 0.5 * (b.min + b.max);
    const Vector3d outer = between.cwiseAbs() - half_b - absolute_ * half_a;
    const Vector3d inner = (rotation_.transpose() * between).cwiseAbs() -
                           half_a - absolute_.transpose() * half_b;
    return std::max(outer.maxCoeff(), inner.maxCoeff());
  }

 private:
  const Matrix3d rotation_, absolute_;
  const Vector3d position_;
};

}  // namespace

ContactSurface::ContactSurface(const std::vector<TriangleMesh>& meshes)
    : corners(DistinctCorners(meshes)), tree(SortIntoTree(&corners)) {}

bool ForEachClosePair(const ContactSurface& robot,
                      const ContactSurface& obstacle, const RobotPose& pose,
                      double radius, const VisitTriangles& visit, long* tests,
                      RigidStop* stop) {
  const Matrix3d rotation = pose.orientation.toRotationMatrix();
  const BoxGap gap(rotation, pose.position);
  const auto keep = [&](int i, int j) {
    ++*tests;
    return gap(robot.tree.nodes()[static_cast<std::size_t>(i)],
               obstacle.tree.nodes()[static_cast<std::size_t>(j)]) <= radius;
  };
  long looked = 0;
  bool is_stopped = false;
  const auto visit_leaves = [&](int i, int j) {
    ++*tests;
    if (stop != nullptr && ++looked % kPairsBetweenAsks == 0) {
      is_stopped = stop->Asks();
      if (is_stopped) return false;
    }
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    TriangleCorners placed = robot.corners[a];
    for (Vector3d& p : placed) p = rotation * p + pose.position;
    const TriangleCorners& fixed = obstacle.corners[b];
    if (!IsBeyondPlane(fixed, placed, radius) &&
        !IsBeyondPlane(placed, fixed, radius)) {
      visit(a, b, placed);
    }
    return true;
  };
  ForEachPair(robot.tree, obstacle.tree, keep, visit_leaves);
  return !is_stopped;
}

void FindContacts(const ContactSurface& robot, const ContactSurface& obstacle,
                  const RobotPose& pose, double radius,
                  std::vector<PoseContact>* contacts, long* tests) {
  contacts->clear();
  const auto visit = [&](std::size_t, std::size_t j,
                         const TriangleCorners& placed) {
    const ClosestPoints closest = ClosestOf(placed, obstacle.corners[j]);
    const double distance = std::sqrt(closest.squared_distance);
    if (distance > 0.0 && distance <= radius) {
      contacts->push_back({(closest.on_robot - closest.on_obstacle) / distance,
                           closest.on_robot - pose.position, distance});
    }
  };
  ForEachClosePair(robot, obstacle, pose, radius, visit, tests);
}

}  // namespace phongpd::internal
