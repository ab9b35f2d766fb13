// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "constraints/tracked_pose_row.h"
#include "planners/rigid/object_norm.h"
#include "planners/rigid/pose_contacts.h"
#include "planners/rigid/rigid_model.h"

namespace phongpd::internal {

inline constexpr int kMaxPoseRows = 8;

// One value of a row at a pose, user's unit: all rows ≥ 0 where it is free.
struct PoseRowEntry {
  double value = 0.0;
  Vector6 by_pose = Vector6::Zero();  // ∂/∂p, ∂/∂δ of a turn δ about the origin
};
using PoseRowEntries = std::array<PoseRowEntry, kMaxPoseRows>;

// What a sample has tracked: one direction for each pair of meshes.
using PoseTracks = std::vector<PoseTrack>;

// K rows of a robot at a pose, of all its meshes and all obstacles:
//
//   free        the gaps of the K nearest pairs of triangles within `range`
//               whose rows (n, r × n/L) differ by 25 degrees or more; what is
//               missing is `range` and has no derivative
//   not free    the signed distance of each pair of meshes that is below 0
//               (TrackedPoseRow), the deepest first; what is missing repeats it
//
// So the sign of row 0 is exact, and a solver sees every wall of a passage.
class PoseRows {
 public:
  // K in [1, kMaxPoseRows].  The model must outlive this.
  PoseRows(const RigidModel& model, int rows, double range, bool is_tracked);

  int rows() const { return rows_; }
  // Are all meshes solids?  If not there is no depth (At).
  bool HasDepth() const;

  // False where it is not free and has no depth.  `after` may be `before`.
  bool At(const RobotPose& pose, const PoseTracks& before, PoseTracks* after,
          PoseRowEntries* entries);

  long queries() const { return queries_; }  // of depths

 private:
  struct Pair {
    std::optional<PoseRow> nearest;
    std::optional<TrackedPoseRow> tracked;
  };

  void Gaps(const RobotPose& pose, PoseRowEntries* entries);
  bool Depths(const RobotPose& pose, const PoseTracks& before,
              PoseTracks* after, PoseRowEntries* entries);

  const RigidModel& model_;
  const int rows_;
  const double range_;
  std::vector<Pair> pairs_;  // empty: there is no depth
  std::vector<PoseContact> contacts_;
  std::vector<PoseRowEntry> depths_;
  long queries_ = 0;
};

}  // namespace phongpd::internal
