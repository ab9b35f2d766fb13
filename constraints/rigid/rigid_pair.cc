// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "constraints/rigid/closest_offset.h"
#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of a direction's square, by the edges that it is made of: below it is noise.
constexpr double kNoDirection = 1e-24;
// Of corners that a meeting must stand, in slacks.
constexpr double kFirmSlacks = 2.0;

// The certificate (2) of a pair of triangles, direction by direction.
class DirectionSearch {
 public:
  DirectionSearch(const FramedMotion& motion, const RigidPose& middle, double h,
                  double gap, const TriangleCorners& robot,
                  const TriangleCorners& obstacle)
      : motion_(motion),
        h_(h),
        needed_(gap + motion.slack()),
        obstacle_(obstacle) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d arm = middle.rotation * robot[i];
      placed_[i] = arm + middle.position;
      speed_[i] = motion.moved() + middle.turn.cross(arm);
      from_axis_[i] = motion.FromAxis(robot[i]);
      farthest = std::max(farthest, from_axis_[i]);
    }
    bend_ = 0.5 * h * h * motion.bend();
    bound_ = h * (motion.distance() + motion.rate() * farthest);
  }

  // True as soon as a direction proves them apart, `first` before all others.
  // Where the motion is above `coarse` these are left to the halves, after the
  // one along the distance, and that too where `first` is likely to do it for
  // half of the part.
  bool Run(const PairHint& first, double coarse) {
    if (first.squaredNorm() > 0.0) {
      if (TryUnit(first)) return true;
      if (bound_ > coarse && half_margin_ > needed_) return false;
      if (TryClosest()) return true;
      if (bound_ > coarse) return false;
    }
    std::array<Vector3d, 3> e, f;
    for (std::size_t i = 0; i < 3; ++i) {
      e[i] = placed_[(i + 1) % 3] - placed_[i];
      f[i] = obstacle_[(i + 1) % 3] - obstacle_[i];
    }
    const Vector3d m = e[0].cross(e[1]), n = f[0].cross(f[1]);
    const double a = std::max({e[0].squaredNorm(), e[1].squaredNorm()});
    const double b = std::max({f[0].squaredNorm(), f[1].squaredNorm()});
    if (Try(n, b * b) || Try(m, a * a)) return true;
    for (const Vector3d& x : e) {
      for (const Vector3d& y : f) {
        if (Try(x.cross(y), a * b)) return true;
      }
    }
    for (const Vector3d& x : e) {
      if (Try(m.cross(x), a * a * a)) return true;
    }
    for (const Vector3d& y : f) {
      if (Try(n.cross(y), b * b * b)) return true;
    }
    // Corners and slivers show themselves along their distance.
    return is_apart_ && !(first.squaredNorm() > 0.0) && TryClosest();
  }

  // Some direction parts them at the middle, to rounding.
  bool is_apart() const { return is_apart_; }
  double bound() const { return bound_; }
  const TriangleCorners& placed() const { return placed_; }
  // That lacked least; 0 where none parts them at the middle.
  const Vector3d& best_direction() const { return best_direction_; }

 private:
  bool Try(const Vector3d& direction, double scale) {
    const double squared = direction.squaredNorm();
    if (!(squared > kNoDirection * scale)) return false;
    return TryUnit(direction / std::sqrt(squared));
  }

  bool TryUnit(const Vector3d& n) {
    const double x[3] = {n.dot(placed_[0]), n.dot(placed_[1]),
                         n.dot(placed_[2])};
    const double y[3] = {n.dot(obstacle_[0]), n.dot(obstacle_[1]),
                         n.dot(obstacle_[2])};
    const double above =
        std::min({x[0], x[1], x[2]}) - std::max({y[0], y[1], y[2]});
    const double below =
        std::min({y[0], y[1], y[2]}) - std::max({x[0], x[1], x[2]});
    const double gap = std::max(above, below);
    half_margin_ = -kInfinity;
    if (!(gap > motion_.slack())) return false;
    is_apart_ = true;
    if (gap - needed_ > bound_) return true;
    const double bend = bend_ * motion_.AcrossAxis(n);
    double least = kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
      const double away =
          h_ * std::abs(n.dot(speed_[i])) + bend * from_axis_[i];
      least = std::min(least, above > below ? x[i] - away : -x[i] - away);
    }
    const double most = above > below ? std::max({y[0], y[1], y[2]})
                                      : -std::min({y[0], y[1], y[2]});
    const double margin = least - most;
    half_margin_ = 0.5 * (margin + gap);
    if (margin > most_margin_) {
      most_margin_ = margin;
      best_direction_ = n;
    }
    return margin > needed_;
  }

  bool TryClosest() {
    const Vector3d n = FindClosestOffset(placed_, obstacle_).direction;
    return n.squaredNorm() > 0.0 && TryUnit(n);
  }

  const FramedMotion& motion_;
  const double h_, needed_;
  const TriangleCorners& obstacle_;
  TriangleCorners placed_;
  std::array<Vector3d, 3> speed_;
  std::array<double, 3> from_axis_;
  double bend_ = 0.0, bound_ = 0.0;
  bool is_apart_ = false;
  double most_margin_ = -kInfinity;
  double half_margin_ = -kInfinity;  // of the last direction, at half h or so
  Vector3d best_direction_ = Vector3d::Zero();
};

// Do two triangles meet wherever within `moved` of their places the corners
// are?
class FirmMeeting {
 public:
  explicit FirmMeeting(double moved) : moved_(moved) {}

  bool Between(const TriangleCorners& a, const TriangleCorners& b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (RunsThrough(a[i], a[j], b) || RunsThrough(b[i], b[j], a)) return true;
    }
    return false;
  }

 private:
  bool RunsThrough(const Vector3d& p, const Vector3d& q,
                   const TriangleCorners& t) const {
    const int side = Side(t[0], t[1], t[2], p);
    if (side == 0 || Side(t[0], t[1], t[2], q) != -side) return false;
    const int turn = Side(p, q, t[0], t[1]);
    return turn != 0 && Side(p, q, t[1], t[2]) == turn &&
           Side(p, q, t[2], t[0]) == turn;
  }

  // The sign of (b − a) × (c − a) · (d − a); 0 where it could be another one.
  // Differences move by 2 `moved` and round by less, so that the determinant,
  // of u v w at most, moves by (u + m)(v + m)(w + m) − u v w, m = 4 `moved`.
  int Side(const Vector3d& a, const Vector3d& b, const Vector3d& c,
           const Vector3d& d) const {
    const Vector3d x = b - a, y = c - a, z = d - a;
    const double det = x.cross(y).dot(z);
    const double u = x.norm(), v = y.norm(), w = z.norm(), m = 4.0 * moved_;
    const double doubt =
        m * (u * v + v * w + w * u) + m * m * (u + v + w) + m * m * m;
    if (det > doubt) return 1;
    return det < -doubt ? -1 : 0;
  }

  double moved_;
};

}  // namespace

PairSight LookAtBoxes(const FramedMotion& motion, const RigidPose& middle,
                      double half_width, double gap, const RigidNode& robot,
                      const RigidNode& obstacle, double* motion_bound) {
  const double h = half_width;
  const Vector3d arm = middle.rotation * robot.center;
  const Vector3d apart = arm + middle.position - obstacle.center;
  const double needed = gap + motion.slack();
  const double reach = motion.FromAxis(robot.center) + robot.radius;
  *motion_bound = h * (motion.distance() + motion.rate() * reach);
  // Most boxes are along the axes of space, where nothing is to be turned.
  const Matrix3d turned = robot.is_turned
                              ? Matrix3d(middle.rotation * robot.axes)
                              : middle.rotation;
  const auto in_obstacle = [&](const auto& v) {
    using Value = std::decay_t<decltype(v)>;
    return obstacle.is_turned ? Value(obstacle.axes.transpose() * v) : v;
  };
  const Matrix3d size = in_obstacle(turned).cwiseAbs();
  // Along the axes of the obstacles' box, and of the robot's.
  const Vector3d g =
      in_obstacle(apart).cwiseAbs() - obstacle.half - size * robot.half;
  if (g.maxCoeff() - needed > *motion_bound) return PairSight::kApart;
  const Vector3d k = (turned.transpose() * apart).cwiseAbs() - robot.half -
                     size.transpose() * obstacle.half;
  const double best = std::max(g.maxCoeff(), k.maxCoeff()) - needed;
  if (best > *motion_bound) return PairSight::kApart;
  if (!(best > 0.0)) return PairSight::kUnknown;
  const Vector3d speed = motion.moved() + middle.turn.cross(arm);
  const double bend =
      h * (motion.rate() * robot.radius + 0.5 * h * motion.bend() * reach);
  const auto parts = [&](const Vector3d& gaps, const Vector3d& speeds,
                         const Vector3d& along) {
    const Vector3d away = h * speeds.cwiseAbs() + bend * motion.Across(along);
    return ((gaps - away).array() > needed).any();
  };
  return parts(g, in_obstacle(speed), in_obstacle(motion.axis())) ||
                 parts(k, turned.transpose() * speed,
                       turned.transpose() * motion.axis())
             ? PairSight::kApart
             : PairSight::kUnknown;
}

PairSight LookAtTriangles(const FramedMotion& motion, const RigidPose& middle,
                          double half_width, double gap, double coarse,
                          const TriangleCorners& robot,
                          const TriangleCorners& obstacle, PairHint* hint,
                          double* motion_bound) {
  DirectionSearch search(motion, middle, half_width, gap, robot, obstacle);
  *motion_bound = search.bound();
  if (search.Run(*hint, coarse)) return PairSight::kApart;
  *hint = search.best_direction();
  if (!search.is_apart() && FirmMeeting(kFirmSlacks * motion.slack())
                                .Between(search.placed(), obstacle)) {
    return PairSight::kMeet;
  }
  return PairSight::kUnknown;
}

}  // namespace phongpd::internal
