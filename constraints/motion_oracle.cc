// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/motion_oracle.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "constraints/curve_hull.h"
#include "constraints/translated_triangles.h"
#include "core/bvh/box_tree.h"
#include "core/bvh/box_tree_pairs.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::Corners;

constexpr int kLeafSize = 2;
// Of the largest coordinate: more than sums and products of three round.
constexpr double kSlack = 1e-14;

struct TestedSolid {
  BoxTree tree;
  std::vector<Corners> corners;  // in the tree's order
  std::vector<int> triangles;    // of the mesh, in the tree's order
  std::vector<Vector3d> seeds;   // a vertex of each component
  double largest = 0.0;          // absolute coordinate
};

TestedSolid MakeTested(const Solid& given, const std::string& what) {
  RequireNotEmpty(given, what);
  const TriangleMesh& mesh = given.mesh();
  TestedSolid solid;
  std::vector<Corners> corners;
  std::vector<BoundingBox> boxes;
  std::vector<int> triangles;
  int count = 0;
  const std::vector<int> label = LabelComponents(mesh, &count);
  std::vector<bool> has_seed(static_cast<std::size_t>(count), false);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
      solid.largest = std::max(solid.largest, t[k].cwiseAbs().maxCoeff());
    }
    const auto component = static_cast<std::size_t>(label[i]);
    if (!has_seed[component]) solid.seeds.push_back(t[0]);
    has_seed[component] = true;
    // Its points belong to its neighbours.
    if (internal::IsDegenerate(t)) continue;
    boxes.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]),
                     t[0].cwiseMax(t[1]).cwiseMax(t[2])});
    corners.push_back(t);
    triangles.push_back(static_cast<int>(i));
  }
  solid.tree = BoxTree(boxes, kLeafSize);
  for (const int item : solid.tree.order()) {
    solid.corners.push_back(corners[static_cast<std::size_t>(item)]);
    solid.triangles.push_back(triangles[static_cast<std::size_t>(item)]);
  }
  return solid;
}

// The winding number of a solid around x = v + s·q, which is not on its
// surface.
int WindingNumber(const TestedSolid& solid, const Vector3d& v,
                  const Vector3d& q, int s) {
  const Vector3d x = v + static_cast<double>(s) * q;
  const double slack = kSlack * (solid.largest + v.cwiseAbs().maxCoeff() +
                                 q.cwiseAbs().maxCoeff());
  int winding = 0;
  solid.tree.ForEach(
      [&](int index) {
        const BoxTree::Node& node =
            solid.tree.nodes()[static_cast<std::size_t>(index)];
        return node.max.z() >= x.z() - slack && node.min.x() <= x.x() + slack &&
               node.max.x() >= x.x() - slack && node.min.y() <= x.y() + slack &&
               node.max.y() >= x.y() - slack;
      },
      [&](int position) {
        winding += internal::UpwardCrossing(
            solid.corners[static_cast<std::size_t>(position)], v, q, s);
        return true;
      });
  return winding;
}

// Conservative: may A + q meet B for boxes A, B and q on the segment, or no
// farther from it than the slack, by axis?
class Segment {
 public:
  Segment(const Vector3d& a, const Vector3d& b, const Vector3d& slack)
      : middle_(0.5 * a + 0.5 * b), half_(0.5 * (b - a)), slack_(slack) {}

  bool Reaches(const BoxTree::Node& robot,
               const BoxTree::Node& obstacle) const {
    // q lies in the box of B − A.
    const Vector3d low = obstacle.min - robot.max;
    const Vector3d high = obstacle.max - robot.min;
    const Vector3d t = middle_ - 0.5 * (low + high);
    const Vector3d h = 0.5 * (high - low) + slack_;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(t[k]) > std::abs(half_[k]) + h[k]) return false;
    }
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (std::abs(t[i] * half_[j] - t[j] * half_[i]) >
          h[i] * std::abs(half_[j]) + h[j] * std::abs(half_[i])) {
        return false;
      }
    }
    return true;
  }

 private:
  Vector3d middle_, half_, slack_;
};

void RequireFinite(const Vector3d& q) {
  if (IsFinite(q)) return;
  throw InputError("motion oracle: the configuration must be finite");
}

}  // namespace

struct MotionOracle::Impl {
  // Calls visit(position in robot, position in obstacle) for the pairs of
  // triangles that meet on the way from a to b, until it returns false.
  template <typename Visit>
  void ForEachMeeting(const Vector3d& a, const Vector3d& b,
                      const Visit& visit) const {
    ForEachInReach(a, b, Vector3d::Zero(), [&](std::size_t i, std::size_t j) {
      return !internal::MeetWhileMoving(robot.corners[i], obstacle.corners[j],
                                        a, b) ||
             visit(i, j);
    });
  }

  // The same for all pairs that may meet, `beside` the way at most.
  template <typename Visit>
  void ForEachInReach(const Vector3d& a, const Vector3d& b,
                      const Vector3d& beside, const Visit& visit) const {
    const double reach = robot.largest + obstacle.largest +
                         a.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff() +
                         beside.maxCoeff();
    const Segment segment(a, b, beside.array() + kSlack * reach);
    const auto& robots = robot.tree.nodes();
    const auto& obstacles = obstacle.tree.nodes();
    ForEachPair(
        robot.tree, obstacle.tree,
        [&](int r, int o) {
          return segment.Reaches(robots[static_cast<std::size_t>(r)],
                                 obstacles[static_cast<std::size_t>(o)]);
        },
        [&](int r, int o) {
          return visit(static_cast<std::size_t>(r),
                       static_cast<std::size_t>(o));
        });
  }

  // Does one solid hold a component of the other at q?  Surfaces apart.
  bool Holds(const Vector3d& q) const {
    for (const Vector3d& seed : robot.seeds) {
      if (WindingNumber(obstacle, seed, q, 1) > 0) return true;
    }
    for (const Vector3d& seed : obstacle.seeds) {
      if (WindingNumber(robot, seed, q, -1) > 0) return true;
    }
    return false;
  }

  TestedSolid robot, obstacle;
};

MotionOracle::MotionOracle(const Solid& robot, const Solid& obstacle)
    : impl_(std::make_unique<Impl>()) {
  impl_->robot = MakeTested(robot, "robot");
  impl_->obstacle = MakeTested(obstacle, "obstacle");
}

MotionOracle::~MotionOracle() = default;
MotionOracle::MotionOracle(MotionOracle&&) noexcept = default;
MotionOracle& MotionOracle::operator=(MotionOracle&&) noexcept = default;

bool MotionOracle::Collides(const Vector3d& q) const { return Collides(q, q); }

bool MotionOracle::Collides(const Vector3d& a, const Vector3d& b) const {
  RequireFinite(a);
  RequireFinite(b);
  bool meets = false;
  impl_->ForEachMeeting(a, b, [&](std::size_t, std::size_t) {
    meets = true;
    return false;
  });
  // While surfaces stay apart, what holds what does not change.
  return meets || impl_->Holds(a);
}

MotionMeeting MotionOracle::FirstMeeting(const Vector3d& a,
                                         const Vector3d& b) const {
  RequireFinite(a);
  RequireFinite(b);
  MotionMeeting first;
  const Impl& impl = *impl_;
  impl.ForEachMeeting(a, b, [&](std::size_t i, std::size_t j) {
    const double fraction = internal::MeetingFractions(
        impl.robot.corners[i], impl.obstacle.corners[j], a, b)[0];
    if (!first.found || fraction < first.fraction) {
      first = {true, fraction, impl.robot.triangles[i],
               impl.obstacle.triangles[j]};
    }
    return true;
  });
  // A surface may be met on the way out of a solid.
  const bool starts_apart = !Collides(a);
  if (!starts_apart && (!first.found || first.fraction > 0.0)) {
    first = {true, 0.0, -1, -1};
  }
  return first;
}

internal::HullGap MotionOracle::FindHullGap(
    const internal::CurveHull& hull) const {
  const int n = hull.size() - 1;
  const Vector3d a = hull.At(0), b = hull.At(n);
  Vector3d beside = Vector3d::Zero();
  for (int i = 0; i <= n; ++i) {
    const Vector3d on_chord = a + (static_cast<double>(i) / n) * (b - a);
    beside = beside.cwiseMax(hull.high(i) - on_chord)
                 .cwiseMax(on_chord - hull.low(i));
  }
  internal::HullGap found;
  const Impl& impl = *impl_;
  impl.ForEachInReach(a, b, beside, [&](std::size_t i, std::size_t j) {
    const internal::HullGap gap = internal::FindHullGap(
        impl.robot.corners[i], impl.obstacle.corners[j], hull);
    if (!gap.is_apart) found = gap;
    return gap.is_apart;
  });
  return found;
}

}  // namespace phongpd
