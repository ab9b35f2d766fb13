// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Where a derivative by rotation comes from.
enum class RotationSource {
  kContact,      // from the only contact there is: exact, to rounding
  kDifferences,  // several contacts at once: central differences of complete
                 // answers, good to about 1e-6 of the robot's size
  kGaps,         // of TrackedPoseRow: the lever of all that is near contact,
                 // no derivative
  kNone,         // the answer has no witness points: zero
};

// s and its derivatives at one pose.  User's unit; rotations in radians.
struct PoseRowValue {
  // −depth while penetrating, 0 touching, the clearance while separate.
  double value = 0.0;
  // ∂s/∂q, unit.
  Eigen::Vector3d by_translation = Eigen::Vector3d::Zero();
  // ∂s/∂ω at ω = 0, of the robot turned further to exp([ω]×)·R about q.
  Eigen::Vector3d by_rotation = Eigen::Vector3d::Zero();
  RotationSource source = RotationSource::kNone;
  DepthStatus status = DepthStatus::kSeparate;
  bool certified = false;  // Depth::certified
};

// One row s(q, R) ≥ m of a nonlinear program for a robot that moves and turns:
//
//   s(q, R) = signed Euclidean distance from q to C_cont(R), the contact space
//             of the robot turned by R
//
// Its sign is exact: s < 0 iff the solids overlap.  With the unit direction u
// (Depth::direction) and r = p_A − q from q to the witness p_A on the
// robot,
//
//   ∂s/∂q = u,        ∂s/∂ω = r × u                                 (1)
//
// for the closest points of separate solids, and for a contact of one pair of
// features: turning by ω moves their common plane n·x = n·(p_B − r) along u = n
// by n·(ω × r).  (1) does not hold if the nearest contact of a penetrating q is
// one at which the solids touch at several spots at once (a reflex edge or
// vertex of C_cont).  Then differences take its place, and `source` says so.  s
// has kinks where the nearest feature changes; the derivative there is that of
// one side.
//
// The depth is exact at each pose and nothing is computed in advance, so a
// value takes from some milliseconds to a tenth of a second: for few samples
// and small meshes.  It is Euclidean PD: its direction jumps on the medial axis
// (tracked_pose_row.h has one that does not), and s says nothing about poses
// between samples.
class PoseRow {
 public:
  // Throws InputError as DepthQuery does.
  PoseRow(const Solid& robot, const Solid& obstacle,
          const DepthOptions& options = {});

  // Throws InputError as DepthQuery::At does.  Thread-safe.
  PoseRowValue At(const RobotPose& pose) const;

 private:
  // The normal of the one contact that the features tell; zero: none does.
  Eigen::Vector3d ContactNormal(const RobotPose& pose,
                                const Depth& result) const;
  Eigen::Vector3d Differences(const RobotPose& pose) const;

  DepthQuery query_;
  Solid robot_, obstacle_;
};

}  // namespace phongpd
