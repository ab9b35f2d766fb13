// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/pose_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"

namespace phongpd::internal {
namespace {

// Of the angle between two rows of one sample.
const double kSameDirection = std::cos(25.0 * kPi / 180.0);

std::vector<Solid> SolidsOf(const std::vector<TriangleMesh>& meshes,
                            const char* name) {
  std::vector<Solid> solids;
  for (const TriangleMesh& mesh : meshes) {
    solids.push_back(MakeSolid(mesh, name));
  }
  return solids;
}

}  // namespace

PoseRows::PoseRows(const RigidModel& model, int rows, double range,
                   bool is_tracked)
    : model_(model), rows_(rows), range_(range) {
  try {
    const std::vector<Solid> robot = SolidsOf(model.robot, "robot");
    const std::vector<Solid> obstacles = SolidsOf(model.obstacles, "obstacle");
    for (const Solid& a : robot) {
      for (const Solid& b : obstacles) {
        Pair& pair = pairs_.emplace_back();
        if (is_tracked) {
          pair.tracked.emplace(a, b);
        } else {
          pair.nearest.emplace(a, b);
        }
      }
    }
  } catch (const InputError&) {  // surfaces bound nothing: no depth
    pairs_.clear();
  }
}

bool PoseRows::HasDepth() const { return !pairs_.empty(); }

bool PoseRows::At(const RobotPose& pose, const PoseTracks& before,
                  PoseTracks* after, PoseRowEntries* entries) {
  if (model_.judge.Check(RigidMotion(pose, pose)).IsFree()) {
    after->clear();
    Gaps(pose, entries);
    return true;
  }
  return HasDepth() && Depths(pose, before, after, entries);
}

void PoseRows::Gaps(const RobotPose& pose, PoseRowEntries* entries) {
  long tests = 0;
  FindContacts(model_.robot_surface, model_.obstacle_surface, pose, range_,
               &contacts_, &tests);
  std::sort(
      contacts_.begin(), contacts_.end(),
      [](const PoseContact& a, const PoseContact& b) { return a.gap < b.gap; });
  std::array<Vector6, kMaxPoseRows> directions;
  std::size_t count = 0;
  for (const PoseContact& contact : contacts_) {
    if (count == static_cast<std::size_t>(rows_)) break;
    PoseRowEntry entry;
    entry.value = contact.gap;
    entry.by_pose << contact.normal, contact.arm.cross(contact.normal);
    Vector6 direction = entry.by_pose;
    direction.tail<3>() /= model_.gyration;
    direction.normalize();
    const bool is_known = std::any_of(
        directions.begin(), directions.begin() + static_cast<long>(count),
        [&](const Vector6& d) { return d.dot(direction) > kSameDirection; });
    if (is_known) continue;
    directions[count] = direction;
    (*entries)[count++] = entry;
  }
  for (; count < static_cast<std::size_t>(rows_); ++count) {
    (*entries)[count] = {range_, Vector6::Zero()};
  }
}

bool PoseRows::Depths(const RobotPose& pose, const PoseTracks& before,
                      PoseTracks* after, PoseRowEntries* entries) {
  depths_.clear();
  PoseTracks tracks(pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    ++queries_;
    const PoseRowValue row =
        pairs_[i].tracked
            ? pairs_[i].tracked->At(
                  pose, i < before.size() ? before[i] : PoseTrack(), &tracks[i])
            : pairs_[i].nearest->At(pose);
    // A way out that suffices is no depth, but has its sign.
    PoseRowEntry entry;
    entry.value = row.value;
    entry.by_pose << row.by_translation, row.by_rotation;
    depths_.push_back(entry);
  }
  *after = std::move(tracks);
  std::sort(depths_.begin(), depths_.end(),
            [](const PoseRowEntry& a, const PoseRowEntry& b) {
              return a.value < b.value;
            });
  for (std::size_t k = 0; k < static_cast<std::size_t>(rows_); ++k) {
    const bool is_there = k < depths_.size() && depths_[k].value < 0.0;
    (*entries)[k] = is_there ? depths_[k] : depths_.front();
  }
  return true;
}

}  // namespace phongpd::internal
