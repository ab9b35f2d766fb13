// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/pose_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/rigid/closest_offset.h"
#include "constraints/rigid/distinct_triangles.h"
#include "core/bvh/box_tree_pairs.h"

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

// Where the corners of a triangle are from the plane of a face: how high the
// lowest and the highest, times the length of the face's normal.
struct PlaneHeights {
  PlaneHeights(const TriangleCorners& face, const TriangleCorners& other) {
    const Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
    squared_normal = normal.squaredNorm();
    for (const Vector3d& p : other) {
      const double height = normal.dot(p - face[0]);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }

  // All on one side, and more than the radius off.
  bool AreBeyond(double radius) const {
    const double height = std::max(low, -high);
    return height > 0.0 && height * height > radius * radius * squared_normal;
  }
  bool AreOnBothSides() const { return low < 0.0 && high > 0.0; }

  double low = std::numeric_limits<double>::infinity(), high = -low;
  double squared_normal = 0.0;
};

// Six times the volume.
double Volume(const Vector3d& a, const Vector3d& b, const Vector3d& c,
              const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

bool RunsThrough(const Vector3d& p, const Vector3d& q,
                 const TriangleCorners& t) {
  if (!(Volume(t[0], t[1], t[2], p) * Volume(t[0], t[1], t[2], q) < 0.0)) {
    return false;
  }
  const auto [low, high] =
      std::minmax({Volume(p, q, t[0], t[1]), Volume(p, q, t[1], t[2]),
                   Volume(p, q, t[2], t[0])});
  return !(low < 0.0 && high > 0.0);
}

// To rounding.
bool DoMeet(const TriangleCorners& a, const TriangleCorners& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (RunsThrough(a[i], a[j], b) || RunsThrough(b[i], b[j], a)) return true;
  }
  return false;
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

// ForEachClosePair; the visits may make the radius smaller.
template <typename Visit>
bool WalkClosePairs(const ContactSurface& robot, const ContactSurface& obstacle,
                    const RobotPose& pose, const double& radius,
                    const Visit& visit, long* tests, RigidStop* stop) {
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
    if (!PlaneHeights(fixed, placed).AreBeyond(radius) &&
        !PlaneHeights(placed, fixed).AreBeyond(radius)) {
      visit(a, b, placed);
    }
    return true;
  };
  ForEachPair(robot.tree, obstacle.tree, keep, visit_leaves);
  return !is_stopped;
}

}  // namespace

ContactSurface::ContactSurface(const std::vector<TriangleMesh>& meshes)
    : corners(DistinctCorners(meshes)), tree(SortIntoTree(&corners)) {}

bool ForEachClosePair(const ContactSurface& robot,
                      const ContactSurface& obstacle, const RobotPose& pose,
                      double radius, const VisitTriangles& visit, long* tests,
                      RigidStop* stop) {
  return WalkClosePairs(robot, obstacle, pose, radius, visit, tests, stop);
}

void FindContacts(const ContactSurface& robot, const ContactSurface& obstacle,
                  const RobotPose& pose, double radius,
                  std::vector<PoseContact>* contacts, long* tests,
                  std::size_t most) {
  contacts->clear();
  const auto keep_nearest = [&] {
    if (contacts->size() <= most) return;
    const auto last = contacts->begin() + static_cast<std::ptrdiff_t>(most) - 1;
    std::nth_element(contacts->begin(), last, contacts->end(), IsNearer);
    contacts->resize(most);
    radius = contacts->back().gap;
  };
  const auto visit = [&](std::size_t, std::size_t j,
                         const TriangleCorners& placed) {
    const TriangleCorners& fixed = obstacle.corners[j];
    if (PlaneHeights(fixed, placed).AreOnBothSides() &&
        PlaneHeights(placed, fixed).AreOnBothSides() && DoMeet(placed, fixed)) {
      return;
    }
    const ClosestOffset closest = FindClosestOffset(placed, fixed);
    const double gap = closest.offset.norm();
    if (!(gap <= radius) || closest.direction.isZero()) return;
    contacts->push_back(
        {closest.direction, closest.on_first - pose.position, gap});
    if (contacts->size() / 2 >= most) keep_nearest();
  };
  WalkClosePairs(robot, obstacle, pose, radius, visit, tests, nullptr);
  keep_nearest();
}

}  // namespace phongpd::internal
