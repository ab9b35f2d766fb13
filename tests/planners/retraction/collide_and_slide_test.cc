// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms around a box, sides of a plane, the exact path check.
#include "planners/retraction/collide_and_slide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "constraints/oracle/collision_oracle.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/passages.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;
using testing::BoxModel;
using testing::Cube;

constexpr double kClearance = 1e-2;  // of the diagonal

TEST(CollideAndSlide, GoesStraightWhereNothingIsInTheWay) {
  const auto model = BoxModel();
  Path path;
  SlideCounters counters;
  const Vector3d a(1.5, 1.5, -1.5), b(1.5, -1.5, 1.5);
  EXPECT_EQ(CollideAndSlide(*model, kClearance, a, b, &path, &counters),
            SlideStatus::kReached);
  EXPECT_EQ(path, (Path{a, b}));
  EXPECT_EQ(counters.segment_checks, 1u);
  EXPECT_EQ(counters.rays, 0u);
}

TEST(CollideAndSlide, SlidesAlongAFaceAndRoundItsEdge) {
  const auto model = BoxModel();
  const double standoff = kClearance * model->diagonal();
  Path path;
  SlideCounters counters;
  const Vector3d a(-1.8, -0.6, 0.1), b(1.2, 1.7, 0.1);
  ASSERT_EQ(CollideAndSlide(*model, kClearance, a, b, &path, &counters),
            SlideStatus::kReached);
  ASSERT_GE(path.size(), 3u);
  // The first stop is in front of the face x = −1.
  EXPECT_NEAR(path[1].x(), -1.0 - standoff, 1e-12);
  EXPECT_TRUE(CheckPath(model->free_space(), path).free);
}

TEST(CollideAndSlide, StopsWhereNoSlideComesCloser) {
  const auto model = BoxModel();
  Path path;
  SlideCounters counters;
  // Straight through the box: its projection on the face is the end.
  EXPECT_EQ(CollideAndSlide(*model, kClearance, {-1.8, 0.2, 0.3},
                            {1.8, 0.1, 0.0}, &path, &counters),
            SlideStatus::kStopped);
  EXPECT_LT((path.back() - Vector3d(-1.0 - 1e-2 * model->diagonal(), 0.1, 0.0))
                .norm(),
            1e-9);
  // A target inside the box, and one beyond the bounds.
  EXPECT_EQ(CollideAndSlide(*model, kClearance, {-1.8, 0.2, 0.3},
                            {0.0, 0.1, 0.0}, &path, &counters),
            SlideStatus::kStopped);
  EXPECT_EQ(CollideAndSlide(*model, kClearance, {-1.8, 0.2, 0.3},
                            {-5.0, 0.1, 1.9}, &path, &counters),
            SlideStatus::kStopped);
  EXPECT_LT(path.back().x(), -1.9);
}

TEST(CollideAndSlide, FollowsTheCreaseOfTwoPlanes) {
  // An L: the slide along one leg runs into the other and goes up the crease.
  const auto model = std::make_shared<const ContactModel>(
      std::vector<ContactSpace>{
          BuildContactSpace(Cube(0.01), MakeL(2.0, 0.5, 2.0))},
      BoundingBox{Vector3d::Constant(-3.0), Vector3d::Constant(3.0)});
  Path path;
  SlideCounters counters;
  const SlideStatus status = CollideAndSlide(
      *model, kClearance, {1.5, 1.6, 0.2}, {-0.5, -0.7, 2.6}, &path, &counters);
  EXPECT_EQ(status, SlideStatus::kReached);
  EXPECT_TRUE(CheckPath(model->free_space(), path).free);
  EXPECT_GE(path.size(), 4u);
}

TEST(CollideAndSlide, RefusesWhatIsNotFree) {
  const auto model = BoxModel();
  Path path;
  SlideCounters counters;
  EXPECT_EQ(CollideAndSlide(*model, kClearance, {0.0, 0.0, 0.0},
                            {1.5, 0.0, 0.0}, &path, &counters),
            SlideStatus::kInvalid);
  EXPECT_TRUE(path.empty());
  EXPECT_EQ(CollideAndSlide(*model, kClearance, {1.5, 0.0, 0.0},
                            {std::nan(""), 0.0, 0.0}, &path, &counters),
            SlideStatus::kInvalid);
  for (const double clearance : {std::nan(""), -1.0, 0.0, 1.5}) {
    EXPECT_THROW(CollideAndSlide(*model, clearance, {1.5, 0.0, 0.0},
                                 {1.5, 0.5, 0.0}, &path, &counters),
                 InputError)
        << clearance;
  }
}

// From the middle of a hole both ways out are one slide each, whatever the
// width.
TEST(CollideAndSlide, LeavesChannelsOfAnyWidth) {
  for (const int turned : {0, 1}) {
    for (const double delta : {1e-2, 1e-3, 2e-4, 2e-5}) {
      const testing::Passage passage =
          testing::MakePassage("hole", delta, turned);
      const Path& witness = passage.scene.witness;
      ASSERT_GE(witness.size(), 4u);
      const Vector3d middle = 0.5 * (witness[1] + witness[2]);
      Path path;
      SlideCounters counters;
      for (const Vector3d& end : {passage.scene.start, passage.scene.goal}) {
        ASSERT_EQ(CollideAndSlide(*passage.model, kClearance, middle, end,
                                  &path, &counters),
                  SlideStatus::kReached)
            << turned << ' ' << delta;
        EXPECT_TRUE(CheckPath(passage.model->free_space(), path).free);
      }
    }
  }
}

// Slides between random places near the contact surface: every path exactly
// free, every point off the surface by the floor and closer to the target
// than the one before, and nobody on the other side of a closed plate.
TEST(CollideAndSlide, NeverTunnelsThroughClosedPassages) {
  int runs = 0, crossed = 0, unfree = 0;
  for (const char* family : {"hole", "keyhole"}) {
    for (const int turned : {0, 1}) {
      const testing::Passage passage =
          testing::MakePassage(family, -1e-4, turned);
      const auto& model = passage.model;
      // Start and goal lie symmetrically to the plate, which holds 0.
      const Vector3d across = passage.scene.goal - passage.scene.start;
      const Retraction retraction(model);
      for (int seed = 0; seed < 20; ++seed, ++runs) {
        std::mt19937_64 random(static_cast<std::uint64_t>(seed));
        RetractionScratch scratch;
        SlideCounters counters;
        // A walk whose targets are retracted samples.
        Vector3d at = passage.scene.start;
        Path path;
        for (int k = 0; k < 60; ++k) {
          retraction.Retract(UniformPoint(model->region(), &random), &random,
                             &scratch);
          if (scratch.points.empty()) continue;
          const Vector3d b = scratch.points[random() % scratch.points.size()].q;
          const SlideStatus status =
              k % 2 == 0
                  ? CollideAndSlide(*model, kClearance, at, b, &path, &counters)
                  : StepRetract(retraction, at, b, &random, &scratch, &path,
                                &counters);
          ASSERT_NE(status, SlideStatus::kInvalid);
          unfree += !CheckPath(model->free_space(), path).free;
          for (std::size_t i = 1; i < path.size(); ++i) {
            ASSERT_LE((b - path[i]).norm(), (b - path[i - 1]).norm());
            ASSERT_TRUE(path[i] == b || model->free_space().Clearance(
                                            path[i]) >= model->floor());
          }
          at = path.back();
          crossed += across.dot(at) > 0.0;
        }
      }
    }
  }
  EXPECT_GE(runs, 60);
  EXPECT_EQ(crossed, 0);
  EXPECT_EQ(unfree, 0);
}

TEST(StepRetract, FollowsAFaceWithBothMetrics) {
  const auto model = BoxModel();
  std::mt19937_64 random(1);
  RetractionScratch scratch;
  SlideCounters counters;
  Path path;
  for (const RetractionMetric metric :
       {RetractionMetric::kPhong, RetractionMetric::kEuclidean}) {
    RetractionOptions options;
    options.metric = metric;
    const Retraction retraction(model, options);
    const bool euclidean = metric == RetractionMetric::kEuclidean;
    EXPECT_EQ(StepRetract(retraction, {-1.8, -0.6, 0.1}, {-0.2, 1.7, 0.1},
                          &random, &scratch, &path, &counters),
              euclidean ? SlideStatus::kReached : SlideStatus::kStopped);
    EXPECT_TRUE(CheckPath(model->free_space(), path).free);
    EXPECT_GT(path.size(), 10u);
    EXPECT_GT(path.back().y(), 0.95);
  }
}

}  // namespace
}  // namespace phongpd
