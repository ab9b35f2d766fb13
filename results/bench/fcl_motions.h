// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::bench {

// FCL's continuous collision of two meshes, of which one translates.
class FclMotions {
 public:
  enum class Solver {
    kDefault,                  // ten placements on the way, as FCL comes
    kConservativeAdvancement,  // tolerance 1e-4, as FCL comes
  };

  FclMotions(const TriangleMesh& robot, const TriangleMesh& obstacle);
  ~FclMotions();
  FclMotions(FclMotions&&) noexcept;

  // Does FCL say that the motion a → b collides?  Surfaces only, so a should
  // be free.
  bool Collides(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                Solver solver) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::bench
