// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/solid/solid.h"

namespace phongpd {

// Do the solids A + q and B meet?  Answered from the original meshes by
// FCL's BVH triangle collision plus exact containment of one vertex per
// component, a route that shares nothing with the contact space.  Checks and
// baselines only: the product itself never needs it.
//
// A solid is { p : w(p) > 0 }, w counting the bodies that hold p less the
// cavities that hold it; bodies may overlap.
class CollisionOracle {
 public:
  // Throws InputError for a solid without triangles.
  CollisionOracle(const Solid& robot, const Solid& obstacle);
  ~CollisionOracle();
  CollisionOracle(CollisionOracle&&) noexcept;
  CollisionOracle& operator=(CollisionOracle&&) noexcept;

  // True when robot moved by q and obstacle share a point (surface contact is
  // decided by FCL's floating point).  Throws InputError if q is not finite.
  // Thread-safe.
  bool Collides(const Eigen::Vector3d& q) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
