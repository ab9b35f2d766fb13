// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/clearance_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "constraints/rigid/closest_offset.h"
#include "constraints/rigid/rigid_descent.h"
#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Of half the robot's diagonal: distances are not told apart further.
constexpr double kFinestShare = 1e-9;
// From one pass over the whole way to the next, finer one.
constexpr double kFinerBy = 1.0 / 16.0;
// Of a distance, more than rounding takes off a target.
constexpr double kRoundedShare = 0x1p-50;

// A triangle of the robot about the middle of a part.
class MovingTriangle {
 public:
  MovingTriangle(const FramedMotion& motion, const RigidPose& middle, double h,
                 const TriangleCorners& robot)
      : motion_(motion), h_(h), bend_(0.5 * h * h * motion.bend()) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d arm = middle.rotation * robot[i];
      placed_[i] = arm + middle.position;
      speed_[i] = motion.moved() + middle.turn.cross(arm);
      from_axis_[i] = motion.FromAxis(robot[i]);
      farthest = std::max(farthest, from_axis_[i]);
    }
    bound_ = h * (motion.distance() + motion.rate() * farthest);
  }

  // How far it is above the other one along n at the middle; all of the part,
  // less than rounding.
  double GapAlong(const Vector3d& n, const TriangleCorners& other) const {
    return Least(n, placed_) + Least(-n, other);
  }
  double GapOnPart(const Vector3d& n, const TriangleCorners& other) const {
    const double bend = bend_ * motion_.AcrossAxis(n);
    double least = kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
      const double away =
          h_ * std::abs(n.dot(speed_[i])) + bend * from_axis_[i];
      least = std::min(least, n.dot(placed_[i]) - away);
    }
    return least + Least(-n, other);
  }

  const TriangleCorners& placed() const { return placed_; }
  double bound() const { return bound_; }

 private:
  static double Least(const Vector3d& n, const TriangleCorners& t) {
    return std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
  }

  const FramedMotion& motion_;
  const double h_, bend_;
  TriangleCorners placed_;
  std::array<Vector3d, 3> speed_;
  std::array<double, 3> from_axis_;
  double bound_ = 0.0;
};

class ClearanceSearch {
 public:
  ClearanceSearch(const RigidSides& sides, const FramedMotion& motion,
                  double absolute, double known, long max_tests)
      : robot_(sides.robot.tree),
        obstacle_(sides.obstacle.tree),
        motion_(motion),
        poses_(motion),
        resolution_(ResolutionOf(sides, motion)),
        absolute_(std::max({absolute, kFinestShare * robot_.size,
                            kRigidSlacks * motion.slack()})),
        max_tests_(max_tests) {
    answer_.upper = known;
    // Some distance is known in any case.
    const RigidPose start = motion.At(0.0);
    MeasureAt(0.0, MovingTriangle(motion, start, 0.0, robot_.corners[0]), 0, 0);
  }

  // To a relative tolerance.  False: there were too many pairs.
  bool Pass(double relative) {
    double left = kInfinity;  // of parts that end at rounding
    stack_[0] = RigidPart();
    for (size_ = 1; size_ > 0 && Target(relative) > 0.0;) {
      if (answer_.tests >= max_tests_) return false;
      ++answer_.tests;
      RigidPart part = stack_[--size_];
      const RigidNode& a = robot_.nodes[static_cast<std::size_t>(part.robot)];
      const RigidNode& b =
          obstacle_.nodes[static_cast<std::size_t>(part.obstacle)];
      if (!a.IsLeaf() || !b.IsLeaf()) {
        LookAtNodes(part, a, b, Target(relative));
      } else if (!LooksBeyond(&part, a.triangle, b.triangle, relative, &left)) {
        Halve(part);
      }
    }
    answer_.lower = std::max(answer_.lower, std::min(Target(relative), left));
    return true;
  }

  // Is this tolerance more than the absolute one?
  bool IsCoarse(double relative) const {
    return relative * answer_.upper > absolute_;
  }

  FramedClearance Answer(double relative) {
    const double tolerance = std::max(relative * answer_.upper, absolute_);
    // The target is a difference, rounded.
    answer_.is_resolved = answer_.upper - answer_.lower <=
                          tolerance + kRoundedShare * answer_.upper;
    return answer_;
  }

 private:
  // As of RigidDescent: a step replaces a part by two, of a lower level.
  static constexpr int kStack =
      2 * BoxTree::kMaxDepth + RigidDescent::kMaxHalvings + 4;

  double Target(double relative) const {
    const double least = answer_.upper;
    return std::max(0.0, least - std::max(relative * least, absolute_));
  }

  void LookAtNodes(const RigidPart& part, const RigidNode& a,
                   const RigidNode& b, double target) {
    const RigidPose& middle = poses_.At(part);
    double bound = 0.0;
    if (LookAtBoxes(motion_, middle, part.half_width, target, a, b, &bound) ==
            PairSight::kApart ||
        AreBeyondAlongCentres(middle, part.half_width, target, a, b)) {
      return;
    }
    if (GoesFar(bound, a, b) && part.level < RigidDescent::kMaxHalvings) {
      Halve(part);
    } else {
      Open(part, a, b);
    }
  }

  // LookAtBoxes along the line of the centres, which for a distance says more
  // than the boxes' axes do.
  bool AreBeyondAlongCentres(const RigidPose& middle, double h, double target,
                             const RigidNode& a, const RigidNode& b) const {
    const Vector3d arm = middle.rotation * a.center;
    const Vector3d apart = arm + middle.position - b.center;
    const double length = apart.norm();
    if (!(length > 0.0)) return false;
    const Vector3d n = apart / length;
    const double across_boxes =
        (b.axes.transpose() * n).cwiseAbs().dot(b.half) +
        (a.axes.transpose() * (middle.rotation.transpose() * n))
            .cwiseAbs()
            .dot(a.half);
    // Or the balls, which hold the same.
    const double gap = length - std::min(across_boxes, a.radius + b.radius);
    const double needed = target + motion_.slack();
    if (!(gap > needed)) return false;
    const double reach = motion_.FromAxis(a.center) + a.radius;
    const double away =
        h * std::abs(n.dot(motion_.moved() + middle.turn.cross(arm))) +
        h * (motion_.rate() * a.radius + 0.5 * h * motion_.bend() * reach) *
            motion_.AcrossAxis(n);
    return gap - needed > away;
  }

  // Are the triangles shown to stay beyond the target on the part, or, where
  // rounding ends that, beyond *left, which is lowered?
  bool LooksBeyond(RigidPart* part, int robot, int obstacle, double relative,
                   double* left) {
    const TriangleCorners& a = robot_.corners[static_cast<std::size_t>(robot)];
    const TriangleCorners& b =
        obstacle_.corners[static_cast<std::size_t>(obstacle)];
    const RigidPose& middle = poses_.At(*part);
    const double slack = motion_.slack();
    const MovingTriangle moving(motion_, middle, part->half_width, a);
    if (part->hint.squaredNorm() > 0.0 &&
        moving.GapOnPart(part->hint, b) > Target(relative) + slack) {
      return true;
    }
    const Vector3d n = MeasureAt(part->Middle(), moving, robot, obstacle);
    const double target = Target(relative), bound = moving.bound();
    const double gap = moving.GapAlong(n, b);
    double finest = resolution_;
    if (gap > slack) {
      if (gap - bound > target + slack) return true;
      if (moving.GapOnPart(n, b) > target + slack) return true;
      part->hint = n;
      finest = 0.25 * (answer_.upper - target);
    } else {
      PairHint hint = PairHint::Zero();
      double same_bound = 0.0;
      if (LookAtTriangles(motion_, middle, 0.0, 0.0, kInfinity, a, b, &hint,
                          &same_bound) == PairSight::kMeet) {
        Offer(0.0, part->Middle(), robot, obstacle);
        return true;
      }
    }
    if (bound > finest && part->level < RigidDescent::kMaxHalvings) {
      return false;
    }
    *left = std::min(*left, std::max(0.0, gap - bound - slack));
    return true;
  }

  // Offers their distance; the direction of it, 1 long or 0.
  Vector3d MeasureAt(double t, const MovingTriangle& moving, int robot,
                     int obstacle) {
    const ClosestOffset closest = FindClosestOffset(
        moving.placed(), obstacle_.corners[static_cast<std::size_t>(obstacle)]);
    Offer(closest.offset.norm() + motion_.slack(), t, robot, obstacle);
    return closest.direction;
  }

  void Offer(double distance, double t, int robot, int obstacle) {
    if (!(distance < answer_.upper)) return;
    answer_.upper = distance;
    answer_.time = t;
    answer_.robot = robot;
    answer_.obstacle = obstacle;
  }

  // The half that is nearer in its middle is looked at first, as is the nearer
  // child: the sooner a small distance is seen the less is measured.
  void Halve(const RigidPart& part) {
    RigidPart first = part, last = part;
    first.level = last.level = part.level + 1;
    first.half_width = last.half_width = 0.5 * part.half_width;
    first.k = 2 * part.k;
    last.k = first.k + 1;
    PushByDistance(first, last);
  }

  void Open(const RigidPart& part, const RigidNode& a, const RigidNode& b) {
    const bool opens_robot = b.IsLeaf() || (!a.IsLeaf() && a.radius > b.radius);
    RigidPart first = part, last = part;
    (opens_robot ? first.robot : first.obstacle) =
        opens_robot ? a.left : b.left;
    (opens_robot ? last.robot : last.obstacle) =
        (opens_robot ? a.left : b.left) + 1;
    PushByDistance(first, last);
  }

  void PushByDistance(const RigidPart& one, const RigidPart& other) {
    const bool is_other_nearer = DistanceOf(other) < DistanceOf(one);
    stack_[size_++] = is_other_nearer ? one : other;
    stack_[size_++] = is_other_nearer ? other : one;
  }

  // Of the centres less the radii, in the middle: an order, no proof.
  double DistanceOf(const RigidPart& part) {
    const RigidNode& a = robot_.nodes[static_cast<std::size_t>(part.robot)];
    const RigidNode& b =
        obstacle_.nodes[static_cast<std::size_t>(part.obstacle)];
    const RigidPose& pose = poses_.At(part);
    return (pose.rotation * a.center + pose.position - b.center).norm() -
           a.radius - b.radius;
  }

  const RigidTree &robot_, &obstacle_;
  const FramedMotion& motion_;
  MiddlePoseCache poses_;
  const double resolution_, absolute_;
  const long max_tests_;
  RigidPart stack_[kStack];
  int size_ = 0;
  FramedClearance answer_;
};

}  // namespace

FramedClearance SearchClearance(const RigidSides& sides,
                                const FramedMotion& motion, double relative,
                                double absolute, double known, long max_tests) {
  ClearanceSearch search(sides, motion, absolute, known, max_tests);
  // Coarse passes see small distances soon, all along the way, and leave a
  // bound where a finer one is too long.
  bool goes_on = true;
  for (double coarse = 0.5;
       goes_on && coarse > relative && search.IsCoarse(coarse);
       coarse *= kFinerBy) {
    goes_on = search.Pass(coarse);
  }
  if (goes_on) search.Pass(relative);
  FramedClearance answer = search.Answer(relative);
  if (answer.lower > 0.0 && IsInsideAtStart(sides, motion)) {
    const long tests = answer.tests;
    answer = FramedClearance();
    answer.is_resolved = true;
    answer.tests = tests;
  }
  return answer;
}

}  // namespace phongpd::internal
