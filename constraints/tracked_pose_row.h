// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "constraints/pose_row.h"

namespace phongpd {

// The way out that a robot has taken, from one pose to the next: a value, in
// and out.
struct PoseTrack {
  // d, unit; zero: none yet, the nearest way out is taken.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

// PoseRow's value with a direction and a lever that do not jump on the medial
// axis: for solvers that follow them out of a collision.  Apart and touching it
// is PoseRow, bit for bit.  While q penetrates C_obj,
//
//   by_translation  d ← normalise(d + ½ (n_ρ(q_c) − d))                     (1)
//   by_rotation     r̄ × d,   r̄ = GapLever's mean (gap_lever.h)
//
// with q_c the first contact on the ray from q along the d before, n_ρ the
// smoothed normal of C_cont there (smoothed_normal.h) for ρ = ½ |q_c − q|, and
// r̄ of the robot at q_c, from its origin, with a reach of a quarter of its own.
//
// Along a motion whose rows are asked one after the other, each with the track
// of the one before, both change by less the shorter the steps: n_ρ, q_c and r̄
// are continuous in the pose as long as the ray does not graze C_cont, and (1)
// follows n_ρ half way a step.  It is a field of directions and no derivative
// of the value, which is Euclid's: to first order a step along it parts the
// solids by the cosine of their angle.  Without a track (1) is repeated eight
// times from the nearest way out.
//
// C_cont is modelled around q at every query: some milliseconds to tenths of a
// second, several times PoseRow's.
class TrackedPoseRow {
 public:
  // Throws InputError as PoseRow.
  TrackedPoseRow(const Solid& robot, const Solid& obstacle,
                 const DepthOptions& options = {});
  ~TrackedPoseRow();
  TrackedPoseRow(TrackedPoseRow&&) noexcept;
  TrackedPoseRow& operator=(TrackedPoseRow&&) noexcept;

  // Of the track before; *after is that for the next pose, also where the
  // answer is PoseRow's: then its direction.  Where what is around q cannot be
  // modelled, or the ray meets nothing, it is PoseRow's, too, and `source` is
  // not kGaps.  Throws InputError as PoseRow.  Thread-safe.
  PoseRowValue At(const RobotPose& pose, const PoseTrack& before,
                  PoseTrack* after) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
