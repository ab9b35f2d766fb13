// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/solid/solid.h"

namespace phongpd {
namespace internal {
class CurveHull;
struct HullGap;
}  // namespace internal

// Where two solids meet during a straight motion of one of them.
struct MotionMeeting {
  bool found = false;          // exact
  double fraction = 1.0;       // of the way to the first meeting, rounded
  int robot_triangle = -1;     // −1: one solid holds a part of the other,
  int obstacle_triangle = -1;  // or there is no meeting
};

// Does a translating solid A meet a fixed solid B?  Decided exactly, on the
// original meshes, for points and for whole straight motions: robot triangles
// swept along the motion against obstacle triangles
// (translated_triangles.h), and, where no surfaces meet, one vertex a
// component against the other solid.  There is no contact space, no rounding
// of A + q and no resolution: a second opinion on what is planned in contact
// spaces, with which it shares the box tree and nothing else.
//
// A solid is { p : w(p) > 0 } and its surface, w counting the bodies that hold
// p less the cavities that hold it; bodies may overlap.  Solids that touch
// meet.  Costs about a microsecond a pair of triangles that come close.
class MotionOracle {
 public:
  // Throws InputError if one is empty.
  MotionOracle(const Solid& robot, const Solid& obstacle);
  ~MotionOracle();
  MotionOracle(MotionOracle&&) noexcept;
  MotionOracle& operator=(MotionOracle&&) noexcept;

  // Exact: do A + q and B share a point, for q, or for some q between a and b?
  // Throw InputError if a point is not finite.  Thread-safe.
  bool Collides(const Eigen::Vector3d& q) const;
  bool Collides(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // The same, and where they meet first; slower, where they do.
  MotionMeeting FirstMeeting(const Eigen::Vector3d& a,
                             const Eigen::Vector3d& b) const;

  // Are the surfaces apart for all q of the hull (curve_hull.h)?  Else the gap
  // of a pair of triangles for which that is not proved.
  internal::HullGap FindHullGap(const internal::CurveHull& hull) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
