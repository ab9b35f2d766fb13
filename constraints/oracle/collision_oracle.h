// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/solid/solid.h"

namespace phongpd {

// Does the robot A, moved by q, collide with the obstacle B?  A second opinion
// for tests and baselines: FCL finds whether triangles of the original meshes
// intersect, and an exact test of one vertex of each component finds whether
// one solid lies inside the other.  No contact space is used, so that a fault
// of those cannot hide here.  Nothing else in the library needs this class.
//
// A solid is { p : w(p) > 0 }: w(p) is the number of bodies that contain p
// minus the number of cavities that contain it.  Bodies may overlap.
class CollisionOracle {
 public:
  // Throws InputError for a solid without triangles.
  CollisionOracle(const Solid& robot, const Solid& obstacle);
  ~CollisionOracle();
  CollisionOracle(CollisionOracle&&) noexcept;
  CollisionOracle& operator=(CollisionOracle&&) noexcept;

  // Do A + q and B share a point?  q in the user's unit.  If only the surfaces
  // touch, the answer depends on FCL's rounding.  Throws InputError if q is not
  // finite.  Thread-safe.
  bool Collides(const Eigen::Vector3d& q) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
