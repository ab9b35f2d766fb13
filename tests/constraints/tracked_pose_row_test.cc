// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: PoseRow where nothing penetrates; integrals in closed form; how much
// directions change from step to step where Euclid's flips.
#include "constraints/tracked_pose_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;

Solid Slab() {
  return MakeSolid(MakeBox({-1.0, -0.8, -0.5}, {1.0, 0.8, 0.5}), "slab");
}

Solid Bar() {
  return MakeSolid(MakeBox({-0.4, -0.2, -0.25}, {0.4, 0.2, 0.25}), "bar");
}

// Through the middle of the slab, where the nearest way out changes from up to
// down, turning on the way.
RobotPose Through(double t) {
  return {Vector3d(0.1, 0.05, 0.2 - 0.4 * t),
          Quaterniond(
              AngleAxisd(0.2 + 0.5 * t, Vector3d(1.0, 1.0, 0.3).normalized()))};
}

struct Changes {
  double direction = 0.0, torque = 0.0;  // the largest of a step
  double least_cosine = 1.0;             // of the first and the last direction
};

Changes ChangesAlong(const TrackedPoseRow* tracked, const PoseRow* row,
                     int steps) {
  Changes changes;
  PoseTrack track;
  Vector3d first, direction, torque;
  for (int i = 0; i <= steps; ++i) {
    const RobotPose pose = Through(static_cast<double>(i) / steps);
    const PoseRowValue value =
        tracked != nullptr ? tracked->At(pose, track, &track) : row->At(pose);
    EXPECT_EQ(value.status, DepthStatus::kPenetrating);
    EXPECT_NEAR(value.by_translation.norm(), 1.0, 1e-12);
    if (i == 0) {
      first = value.by_translation;
    } else {
      changes.direction = std::max(changes.direction,
                                   (value.by_translation - direction).norm());
      changes.torque =
          std::max(changes.torque, (value.by_rotation - torque).norm());
    }
    direction = value.by_translation;
    torque = value.by_rotation;
  }
  changes.least_cosine = first.dot(direction);
  return changes;
}

TEST(TrackedPoseRow, IsContinuousAcrossTheMedialAxisWhereEuclidFlips) {
  const PoseRow nearest(Bar(), Slab());
  const TrackedPoseRow tracked(Bar(), Slab());
  const Changes flips = ChangesAlong(nullptr, &nearest, 16);
  EXPECT_GT(flips.direction, 1.9);  // at any step
  const Changes coarse = ChangesAlong(&tracked, nullptr, 16);
  const Changes fine = ChangesAlong(&tracked, nullptr, 32);
  EXPECT_LT(coarse.direction, 0.3);
  EXPECT_LT(fine.direction, 0.65 * coarse.direction + 1e-9);
  EXPECT_LT(fine.torque, 0.65 * coarse.torque + 1e-9);
  // It still goes out where it began to.
  EXPECT_GT(fine.least_cosine, 0.7);
  EXPECT_LT(flips.least_cosine, -0.7);
}

TEST(TrackedPoseRow, HasTheValueOfPoseRowAndIsPoseRowWhereItIsFree) {
  const PoseRow nearest(Bar(), Slab());
  const TrackedPoseRow tracked(Bar(), Slab());
  for (const double height : {1.4, 0.9, 0.4, 0.1}) {
    RobotPose pose = Through(0.3);
    pose.position.z() = height;
    const PoseRowValue a = nearest.At(pose);
    PoseTrack after;
    const PoseRowValue b = tracked.At(pose, PoseTrack(), &after);
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(after.direction, b.by_translation);
    if (a.status == DepthStatus::kSeparate) {
      EXPECT_EQ(a.by_translation, b.by_translation);
      EXPECT_EQ(a.by_rotation, b.by_rotation);
      EXPECT_EQ(b.source, RotationSource::kContact);
    } else {
      EXPECT_EQ(b.source, RotationSource::kGaps);
    }
  }
}

// Along the tracked direction the solids come apart: so far as the direction
// is from Euclid's, and no farther than the slab is thick.
TEST(TrackedPoseRow, LeadsOut) {
  const PoseRow nearest(Bar(), Slab());
  const TrackedPoseRow tracked(Bar(), Slab());
  for (const double t : {0.0, 0.2, 0.45}) {
    RobotPose pose = Through(t);
    PoseTrack track;
    double way = 0.0;
    for (int i = 0; i < 200; ++i) {
      const PoseRowValue row = tracked.At(pose, track, &track);
      if (row.status != DepthStatus::kPenetrating) break;
      const double step = std::max(-row.value, 1e-3);
      pose.position += step * row.by_translation;
      way += step;
    }
    EXPECT_NE(nearest.At(pose).status, DepthStatus::kPenetrating);
    EXPECT_LT(way, 1.3 * -nearest.At(Through(t)).value + 0.02);
  }
}

TEST(TrackedPoseRow, RefusesPosesThatAreNone) {
  const TrackedPoseRow row(Bar(), Slab());
  PoseTrack track;
  EXPECT_THROW(
      row.At({Vector3d::Constant(NAN), Quaterniond::Identity()}, track, &track),
      InputError);
}

}  // namespace
}  // namespace phongpd
