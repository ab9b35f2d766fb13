// SPDX-License-Identifier: GPL-3.0-or-later
// Every "how deep" in the same words.  Truth: DepthQuery, which builds no
// contact space.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"
#include "core/contact/depth.h"
#include "core/mesh/mesh_io.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "core/projection/window_phong.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

// As design notes and README have it.
using DepthOfFiles = testing::TemporaryFolder;

TEST_F(DepthOfFiles, IsOneLine) {
  const std::string a = At("a.stl"), b = At("b.stl");
  WriteMesh(Cube(1), a);
  WriteMesh(Cube(2), b);
  const RobotPose pose = {Vector3d(1.25, 0, 0)};
  const Depth d = PenetrationDepth(ReadSolid(a), ReadSolid(b), pose);
  EXPECT_EQ(d.status, DepthStatus::kPenetrating);
  EXPECT_NEAR(d.depth, 0.25, 1e-12);
  EXPECT_NEAR(d.SignedDistance(), -0.25, 1e-12);
  EXPECT_TRUE(d.certified);
}

TEST(Depth, OfMetricsAndTrackersIsThatOfTheQuery) {
  const TriangleMesh robot = MakeStar(0.3, 0.7);
  const TriangleMesh obstacle = Rotated(MakeU(2, 0.5, 1), GenericRotation());
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const EuclideanMetric euclidean(space);
  const PhongMetric phong(space);
  const PenetrationTracker tracker(space);
  const DepthQuery query(robot, obstacle);
  const double near = 1e-12 * space.length();
  std::mt19937_64 random(11);
  PenetrationTracker::State state;
  int penetrating = 0, separate = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d q = testing::RandomPoint(space.bounds(), &random);
    const Depth truth = query.At(q);
    const Depth least = euclidean.Query(q).ToDepth();
    const Depth own = phong.Query(q).ToDepth();
    const Depth followed = tracker.Step(q, &state).ToDepth();
    ASSERT_EQ(least.status, truth.status) << q.transpose();
    ASSERT_EQ(own.status, truth.status) << q.transpose();
    ASSERT_EQ(followed.status, truth.status) << q.transpose();
    EXPECT_NEAR(least.depth, truth.depth, near);
    EXPECT_NEAR(least.clearance, truth.clearance, near);
    EXPECT_NEAR(own.clearance, truth.clearance, near);
    EXPECT_GE(own.depth, truth.depth - near);
    EXPECT_GE(followed.depth, truth.depth - near);
    EXPECT_NEAR(followed.explored_radius, truth.depth, near);
    EXPECT_NEAR(own.SignedDistance(), phong.Query(q).signed_distance, 0.0);
    const bool is_in = truth.status == DepthStatus::kPenetrating;
    EXPECT_EQ(own.certified, !is_in);
    EXPECT_EQ(followed.clearance, 0.0);
    if (is_in) {
      EXPECT_NEAR((q + own.depth * own.direction - own.contact).norm(), 0,
                  near);
      EXPECT_NEAR(
          (q + followed.depth * followed.direction - followed.contact).norm(),
          0, near);
    }
    is_in ? ++penetrating : ++separate;
  }
  EXPECT_GT(penetrating, 30);
  EXPECT_GT(separate, 30);
}

TEST(Depth, IsTouchingOnTheContactSpaceToAll) {
  const ContactSpace space = BuildContactSpace(Cube(1), Cube(2));
  const Vector3d q(1.5, 0.25, 0.125);
  PenetrationTracker::State state;
  EXPECT_EQ(DepthQuery(Cube(1), Cube(2)).At(q).status, DepthStatus::kTouching);
  for (const Depth& d :
       {EuclideanMetric(space).Query(q).ToDepth(),
        PhongMetric(space).Query(q).ToDepth(),
        PenetrationTracker(space).Step(q, &state).ToDepth(),
        WindowPhong(ConvolutionModel(Cube(1), Cube(2))).At(q).ToDepth()}) {
    EXPECT_EQ(d.status, DepthStatus::kTouching);
    EXPECT_EQ(d.SignedDistance(), 0.0);
    EXPECT_TRUE(d.certified);
  }
}

TEST(Depth, IsInvalidWhereTheConfigurationIsNot) {
  const ContactSpace space = BuildContactSpace(Cube(1), Cube(2));
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    const Vector3d q(0, bad, 0);
    PenetrationTracker::State state;
    for (const Depth& d :
         {EuclideanMetric(space).Query(q).ToDepth(),
          PhongMetric(space).Query(q).ToDepth(),
          PenetrationTracker(space).Step(q, &state).ToDepth(),
          WindowPhong(ConvolutionModel(Cube(1), Cube(2))).At(q).ToDepth()}) {
      EXPECT_STREQ(ToString(d.status), "invalid");
      EXPECT_EQ(d.SignedDistance(), 0.0);
      EXPECT_FALSE(d.certified);
    }
  }
}

// Of windows: what they took, beside PhongMetric's answer.
TEST(Depth, OfWindowsSaysWhatWasBuilt) {
  const TriangleMesh robot = Cube(0.5), obstacle = MakeTorus(2, 0.6, 12, 6);
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.0;
  WindowPhong window(ConvolutionModel(robot, obstacle), options);
  const Vector3d q(2.3, 0.05, 0.1);
  const Depth whole = PhongMetric(space, options).Query(q).ToDepth();
  const Depth found = window.At(q).ToDepth();
  ASSERT_EQ(whole.status, DepthStatus::kPenetrating);
  EXPECT_EQ(found.status, whole.status);
  EXPECT_NEAR(found.depth, whole.depth, 1e-9);
  EXPECT_NE(found.level, DepthLevel::kNone);
  EXPECT_GT(found.arranged_faces, 0U);
}

}  // namespace
}  // namespace phongpd
