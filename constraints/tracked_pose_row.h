// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "constraints/pose_row.h"

namespace phongpd {

// What is remembered from one pose of a motion to the next: the direction out
// of the obstacle.  A plain value that goes in and comes out.
struct PoseTrack {
  // d, unit; zero: none yet, so the direction of least depth is taken.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

// PoseRow with a direction and a lever arm that do not jump on the medial axis:
// for solvers that start from a colliding path and follow them out.  While the
// solids are separate or touch, the answer is PoseRow's, bit for bit.  While q
// penetrates C_obj, the value is PoseRow's, too, but
//
//   by_translation = d,       d ← normalise(d + ½ (n_ρ(q_c) − d))           (1)
//   by_rotation    = r̄ × d,   r̄ = GapLever's mean (gap_lever.h)
//
// q_c is the first contact on the ray from q along the previous d.  n_ρ is the
// smoothed normal of C_cont at q_c (smoothed_normal.h) with ρ = ½ |q_c − q|.
// r̄ is taken for the robot at q_c and measured from its origin; the reach δ of
// its mean is a quarter of the robot's reach.
//
// Ask the poses of a motion one after the other, each with the track that the
// one before gave.  Then d and r̄ change the less, the shorter the steps are:
// n_ρ, q_c and r̄ are continuous in the pose as long as the ray does not graze
// C_cont, and (1) goes half way to n_ρ in each step.  Without a track, (1) is
// repeated eight times from the direction of least depth.
//
// The price: (d, r̄ × d) is not the derivative of the value, whose gradient is
// Euclidean.  To first order, a small step along d separates the solids by the
// step times the cosine of the angle between the two directions.
//
// C_cont is modelled around q in every query, which takes from some
// milliseconds to tenths of a second: several times as long as PoseRow.
class TrackedPoseRow {
 public:
  // Throws InputError like PoseRow.
  TrackedPoseRow(const Solid& robot, const Solid& obstacle,
                 const DepthOptions& options = {});
  ~TrackedPoseRow();
  TrackedPoseRow(TrackedPoseRow&&) noexcept;
  TrackedPoseRow& operator=(TrackedPoseRow&&) noexcept;

  // `before` is the previous pose's track; *after is the one for the next pose.
  // `source` is kGaps where (1) holds.  Otherwise the answer is PoseRow's, and
  // *after its direction: the solids do not overlap, C_cont around q cannot be
  // modelled, or the ray meets nothing.  Throws InputError like PoseRow.
  // Thread-safe.
  PoseRowValue At(const RobotPose& pose, const PoseTrack& before,
                  PoseTrack* after) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
