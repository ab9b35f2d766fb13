// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/mesh/triangle_mesh.h"

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
  // Both meshes as MakeSolid returns them.  Throws InputError if one has no
  // triangle or a vertex that is not finite.
  CollisionOracle(const TriangleMesh& robot, const TriangleMesh& obstacle);
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
