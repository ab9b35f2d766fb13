// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/tracked_pose_row.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "constraints/gap_lever.h"
#include "constraints/smoothed_exit.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr double kRho = 0.5;     // ρ, of the way to the contact
constexpr double kFollow = 0.5;  // of (1)
constexpr int kColdSteps = 8;
constexpr double kDelta = 0.25;  // δ, of the reach

double ReachOf(const TriangleMesh& robot) {
  double reach = 0.0;
  for (const Vector3d& v : robot.vertices) reach = std::max(reach, v.norm());
  return reach;
}

}  // namespace

struct TrackedPoseRow::Impl {
  Impl(const Solid& the_robot, const Solid& the_obstacle,
       const DepthOptions& options)
      : row(the_robot, the_obstacle, options),
        robot(the_robot),
        obstacle(the_obstacle),
        levers(robot.mesh(), obstacle.mesh(), kDelta * ReachOf(robot.mesh())) {}

  // Of a pose that penetrates: false where (1) has no answer.
  bool Follow(const RobotPose& pose, const PoseTrack& before,
              PoseRowValue* value) const {
    const ConvolutionModel model(
        Rotated(robot.mesh(), pose.orientation.normalized().toRotationMatrix()),
        obstacle.mesh());
    internal::SmoothedExit exits(model, pose.position, -value->value);
    const bool is_cold = before.direction.isZero(0.0);
    Vector3d d =
        is_cold ? value->by_translation : before.direction.stableNormalized();
    RobotPose touching = pose;
    for (int step = 0; step < (is_cold ? kColdSteps : 1); ++step) {
      const internal::Exit exit = exits.Along(d, kRho);
      const Vector3d next = d + kFollow * (exit.normal - d);
      if (!exit.is_found || !(next.norm() > 0.0)) return false;
      d = next.normalized();
      touching.position = exit.contact;
    }
    value->by_translation = d;
    Vector3d lever = Vector3d::Zero();  // of nothing near: none
    levers.At(touching, &lever);
    value->by_rotation =
        (pose.orientation.normalized() * lever).cross(value->by_translation);
    value->source = RotationSource::kGaps;
    return true;
  }

  PoseRow row;
  Solid robot, obstacle;
  GapLever levers;
};

TrackedPoseRow::TrackedPoseRow(const Solid& robot, const Solid& obstacle,
                               const DepthOptions& options)
    : impl_(std::make_unique<Impl>(robot, obstacle, options)) {}
TrackedPoseRow::~TrackedPoseRow() = default;
TrackedPoseRow::TrackedPoseRow(TrackedPoseRow&&) noexcept = default;
TrackedPoseRow& TrackedPoseRow::operator=(TrackedPoseRow&&) noexcept = default;

PoseRowValue TrackedPoseRow::At(const RobotPose& pose, const PoseTrack& before,
                                PoseTrack* after) const {
  PoseRowValue value = impl_->row.At(pose);
  if (value.status == DepthStatus::kPenetrating && value.certified) {
    try {
      impl_->Follow(pose, before, &value);
    } catch (const std::logic_error&) {  // walls too thin to be judged
    }
  }
  after->direction = value.by_translation;
  return value;
}

}  // namespace phongpd
