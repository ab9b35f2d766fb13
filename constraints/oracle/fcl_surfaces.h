// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// What FCL says of two meshes of which one moves, from box trees (OBBRSS) of
// their triangles.  Surfaces only: a mesh inside the other meets nothing.
// Decided in floating point.  Checks and baselines only.
//
// Vertices and configurations must be finite; the members below throw
// std::runtime_error where FCL does not answer.  Thread-safe.
class FclSurfaces {
 public:
  // How FCL decides a motion, with its own defaults otherwise.
  enum class Solver {
    kPlacements,               // at ten places of the way, its default
    kConservativeAdvancement,  // to the tolerance 1e-4
  };

  // Throws std::runtime_error if FCL cannot build a tree (it needs a triangle).
  FclSurfaces(const TriangleMesh& robot, const TriangleMesh& obstacle);
  ~FclSurfaces();
  FclSurfaces(FclSurfaces&&) noexcept;
  FclSurfaces& operator=(FclSurfaces&&) noexcept;

  // Do the surfaces of A + q and B share a point?
  bool Meet(const Eigen::Vector3d& q) const;

  // Do they anywhere on the straight motion a → b?
  bool Meet(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
            Solver solver) const;

  // The same of a robot that is put as a pose says, and of the motion from pose
  // to pose, the position linearly and the orientation the shorter way.  FCL
  // is told the point about which it turns: with its own constructor 0.7 reads
  // one that nobody set.
  bool Meet(const RobotPose& pose) const;
  bool Meet(const RobotPose& a, const RobotPose& b, Solver solver) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
