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
// original meshes, for points and for whole straight motions: triangles of the
// robot, swept along the motion, are tested against those of the obstacle
// (translated_triangles.h); if no surfaces meet, one vertex of each component
// is tested against the other solid.  There is no contact space, no rounding of
// A + q and no resolution.  So it is a second opinion on what was planned in
// contact spaces, with which it shares the box tree and nothing else.
//
// A solid is { p : w(p) > 0 } and its surface; w(p) is the number of bodies
// around p less the number of cavities around it.  Bodies may overlap.  Solids
// that touch do meet.  A pair of triangles that come close takes about a
// microsecond.
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

  // Are the surfaces apart for all q of the hull (curve_hull.h)?  If not, the
  // gap of a pair of triangles for which it is not proved.
  internal::HullGap FindHullGap(const internal::CurveHull& hull) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
