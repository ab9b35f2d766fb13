// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms on boxes and square channels, FCL on the input meshes.
#include "planners/retraction/retraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "constraints/oracle/collision_oracle.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/passages.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::BoxModel;
using testing::Cube;

Retraction Make(const std::shared_ptr<const ContactModel>& model,
                RetractionMetric metric, BranchChoice choice) {
  RetractionOptions options;
  options.metric = metric;
  options.choice = choice;
  return Retraction(model, options);
}

TEST(ContactModel, StandsOffByHalfTheGapAtMost) {
  const auto model = BoxModel();
  double distance = 0.0;
  const ContactModel::Facet facet =
      model->FindNearest({0.9, 0.1, 0.2}, &distance);
  EXPECT_NEAR(distance, -0.1, 1e-14);
  EXPECT_EQ(facet.normal, Vector3d::UnitX());
  EXPECT_NEAR(model->Standoff(facet, 0.01), 0.01, 1e-15);
  // The bound at x = 2 is 1 away.
  EXPECT_NEAR(model->Standoff(facet, 3.0), 0.5, 1e-14);
  EXPECT_NEAR(model->floor(), 1e-9 * 4.0 * std::sqrt(3.0), 1e-20);
}

TEST(SamplingRegion, IsTheBoxAroundTheCellsOfBothEnds) {
  // Rooms [−1, 0.9] and [1, 3] along x in a block, seen by a point robot.
  TriangleMesh mesh =
      MakeBox(Vector3d::Constant(-5.0), Vector3d::Constant(5.0));
  for (const auto& [min, max] :
       {std::make_pair(-1.0, 0.9), std::make_pair(1.0, 3.0)}) {
    mesh = Joined(mesh, Reversed(MakeBox({min, -1.0, -1.0}, {max, 1.0, 1.0})));
  }
  const Vector3d left(0.1, 0.2, 0.3), right(2.0, 0.1, 0.2);
  BoundingBox region = SamplingRegion(TakeAsContactSpace(mesh), left, left);
  EXPECT_EQ(region.min, Vector3d(-1.0, -1.0, -1.0));
  EXPECT_EQ(region.max, Vector3d(0.9, 1.0, 1.0));
  region = SamplingRegion(TakeAsContactSpace(mesh), left, right);
  EXPECT_EQ(region.min, Vector3d(-1.0, -1.0, -1.0));
  EXPECT_EQ(region.max, Vector3d(3.0, 1.0, 1.0));
}

TEST(SamplingRegion, LeavesRoomAroundWhatHasNoBounds) {
  const TriangleMesh mesh =
      MakeBox(Vector3d::Constant(-5.0), Vector3d::Constant(5.0));
  const BoundingBox region = SamplingRegion(TakeAsContactSpace(mesh),
                                            {-6.0, 0.0, 0.0}, {9.0, 0.0, 0.0});
  const double room = 0.1 * std::sqrt(15.0 * 15.0 + 2.0 * 100.0);
  EXPECT_NEAR(
      (region.min - Vector3d(-6.0 - room, -5.0 - room, -5.0 - room)).norm(),
      0.0, 1e-14);
  EXPECT_NEAR(
      (region.max - Vector3d(9.0 + room, 5.0 + room, 5.0 + room)).norm(), 0.0,
      1e-14);
}

TEST(ContactModel, FindsBoundsAsFacets) {
  const auto model = BoxModel();
  double distance = 0.0;
  ContactModel::Facet facet = model->FindNearest({0.1, -1.9, 0.2}, &distance);
  EXPECT_NEAR(distance, 0.1, 1e-14);
  EXPECT_EQ(facet.space, MotionCheck::kBounds);
  EXPECT_EQ(facet.normal, Vector3d::UnitY());
  facet = model->FindNearest({0.1, 0.3, 2.5}, &distance);
  EXPECT_NEAR(distance, -0.5, 1e-14);
  Vector3d q;
  double room = 0.0;
  ASSERT_TRUE(model->LiftOff(facet, 0.01, &q, &room));
  EXPECT_NEAR(q.z(), 1.99, 1e-14);
  EXPECT_NEAR(room, 0.01, 1e-14);
}

TEST(ContactModel, FindsNothingNearPointsThatAreNotFinite) {
  const BoundingBox bounds = {Vector3d::Constant(-2.0),
                              Vector3d::Constant(2.0)};
  const ContactModel bounds_only({}, bounds);
  const auto model = BoxModel();
  for (const ContactModel* one :
       {&bounds_only, static_cast<const ContactModel*>(model.get())}) {
    double distance = 0.0;
    const ContactModel::Facet facet =
        one->FindNearest({std::nan(""), 0.0, 0.0}, &distance);
    EXPECT_EQ(distance, -HUGE_VAL);
    EXPECT_EQ(facet.space, MotionCheck::kNone);
  }
}

TEST(SamplingRegion, RefusesWhatIsNoContactSpace) {
  const Vector3d q(3.0, 0.0, 0.0);
  TriangleMesh mesh = Cube(1.0);
  EXPECT_THROW(SamplingRegion(TakeAsContactSpace({}), q, -q), InputError);
  mesh.vertices[0].x() = std::nan("");
  EXPECT_THROW(SamplingRegion(TakeAsContactSpace(mesh), q, -q), InputError);
  mesh = Cube(1.0);
  mesh.triangles.pop_back();
  EXPECT_THROW(SamplingRegion(TakeAsContactSpace(mesh), q, -q), InputError);
}

// The normals of a cube's faces turn towards its corners, so a Phong line
// through q leaves by the nearest face and by the one opposite.
TEST(Retraction, ListsBothSidesOfACube) {
  const auto model = BoxModel();
  const Retraction all =
      Make(model, RetractionMetric::kPhong, BranchChoice::kAll);
  std::mt19937_64 random(1);
  RetractionScratch scratch;
  const Vector3d q(0.3, -0.2, 0.1);
  ASSERT_EQ(all.Retract(q, &random, &scratch), RetractionStatus::kRetracted);
  ASSERT_EQ(scratch.points.size(), 2u);
  for (const double side : {1.0, -1.0}) {
    const RetractedPoint& point = scratch.points[side > 0.0 ? 0 : 1];
    EXPECT_NEAR(point.contact.point.x(), side, 1e-12);
    EXPECT_LT((point.q - point.contact.point -
               side * all.clearance() * Vector3d::UnitX())
                  .norm(),
              1e-12);
    EXPECT_NEAR(point.room, all.clearance(), 1e-12);
  }
  EXPECT_EQ(scratch.counters.points, 2u);
  EXPECT_EQ(scratch.counters.retractions, 1u);
}

TEST(Retraction, GoesToTheNearestFaceWithTheEuclideanMetric) {
  const auto model = BoxModel();
  std::mt19937_64 random(1);
  RetractionScratch scratch;
  for (const BranchChoice choice :
       {BranchChoice::kAll, BranchChoice::kRandom, BranchChoice::kNearest}) {
    const Retraction nearest =
        Make(model, RetractionMetric::kEuclidean, choice);
    ASSERT_EQ(nearest.Retract({0.3, -0.4, 0.1}, &random, &scratch),
              RetractionStatus::kRetracted);
    ASSERT_EQ(scratch.points.size(), 1u);
    EXPECT_LT(
        (scratch.points[0].q - Vector3d(0.3, -1.0 - nearest.clearance(), 0.1))
            .norm(),
        1e-12);
  }
}

TEST(Retraction, TakesOnePointByEveryOtherChoice) {
  const auto model = BoxModel();
  std::mt19937_64 random(1);
  RetractionScratch scratch;
  std::set<int> random_sides, novel_sides;
  const auto side = [](const Vector3d& q) {
    int axis = 0;
    q.cwiseAbs().maxCoeff(&axis);
    return 2 * axis + (q[axis] > 0.0 ? 1 : 0);
  };
  const Retraction by_chance =
      Make(model, RetractionMetric::kPhong, BranchChoice::kRandom);
  const Retraction novel =
      Make(model, RetractionMetric::kPhong, BranchChoice::kNovelty);
  const Retraction shallow =
      Make(model, RetractionMetric::kPhong, BranchChoice::kNearest);
  RetractionScratch novel_scratch;
  for (int i = 0; i < 40; ++i) {
    const Vector3d q(0.3, -0.2, 0.1);
    ASSERT_EQ(by_chance.Retract(q, &random, &scratch),
              RetractionStatus::kRetracted);
    ASSERT_EQ(scratch.points.size(), 1u);
    random_sides.insert(side(scratch.points[0].q));
    ASSERT_EQ(novel.Retract(q, &random, &novel_scratch),
              RetractionStatus::kRetracted);
    ASSERT_EQ(novel_scratch.points.size(), 1u);
    novel_sides.insert(side(novel_scratch.points[0].q));
    ASSERT_EQ(shallow.Retract(q, &random, &scratch),
              RetractionStatus::kRetracted);
    EXPECT_EQ(side(scratch.points[0].q), 1);  // +x, at depth 0.7
  }
  EXPECT_EQ(random_sides, (std::set<int>{0, 1}));  // −x and +x
  EXPECT_EQ(novel_sides, (std::set<int>{0, 1}));
}

TEST(Retraction, FollowsAWarmBranchAndCountsItsEnds) {
  const auto model = BoxModel();
  const Retraction warm =
      Make(model, RetractionMetric::kPhong, BranchChoice::kWarm);
  std::mt19937_64 random(1);
  RetractionScratch scratch;
  // Starts nearest to +x and stays on that face.
  for (const double x : {0.8, 0.4, 0.2}) {
    const Vector3d q(x, 0.1, 0.05);
    ASSERT_EQ(warm.Retract(q, &random, &scratch), RetractionStatus::kRetracted);
    EXPECT_NEAR(scratch.points[0].contact.point.x(), 1.0, 1e-12) << x;
  }
  EXPECT_EQ(scratch.counters.branch_ends, 0u);
  warm.Retract({-3.0, 0.1, 0.05}, &random, &scratch);
  EXPECT_EQ(scratch.counters.branch_ends, 1u);
}

TEST(Retraction, SaysWhyThereIsNoPoint) {
  const auto model = BoxModel();
  std::mt19937_64 random(1);
  RetractionScratch scratch;
  const Retraction retraction(model);
  EXPECT_EQ(retraction.Retract({std::nan(""), 0.0, 0.0}, &random, &scratch),
            RetractionStatus::kInvalid);
  EXPECT_EQ(retraction.Retract({1.5, 0.0, 0.0}, &random, &scratch),
            RetractionStatus::kFree);
  ASSERT_EQ(scratch.points.size(), 1u);
  EXPECT_EQ(scratch.points[0].q, Vector3d(1.5, 0.0, 0.0));
  // All of the box's surface lies beyond these bounds, and in the last ones
  // farther away than their diagonal.
  const auto within = [&](double half) {
    const BoundingBox bounds = {Vector3d::Constant(-half),
                                Vector3d::Constant(half)};
    return Retraction(std::make_shared<const ContactModel>(
        std::vector<ContactSpace>{BuildContactSpace(Cube(0.5), Cube(1.5))},
        bounds));
  };
  EXPECT_EQ(within(0.5).Retract({0.1, 0.2, 0.3}, &random, &scratch),
            RetractionStatus::kNoClearance);
  EXPECT_EQ(within(0.2).Retract({0.0, 0.1, 0.1}, &random, &scratch),
            RetractionStatus::kNoProjection);
}

TEST(Retraction, RefusesOptionsOutOfRange) {
  const auto model = BoxModel();
  for (int bad = 0; bad < 3; ++bad) {
    RetractionOptions options;
    if (bad == 0) options.clearance = 0.0;
    if (bad == 1) options.clearance = 1.5;
    if (bad == 2) options.clearance = std::nan("");
    EXPECT_THROW(Retraction(model, options), InputError) << bad;
  }
  EXPECT_THROW(Retraction(nullptr), InputError);
  EXPECT_THROW(ContactModel(std::vector<ContactSpace>()), InputError);
}

// The plate's hole is a square channel of side δ around (y, z) = (0.25,
// −0.125): what is retracted into it is half way between two walls, and no
// closer to the other two than half of that.
TEST(Retraction, CentresPointsInAChannelOfAnyWidth) {
  for (const double delta : {1e-2, 1e-3, 2e-4, 2e-5}) {
    const auto model = testing::MakePassage("hole", delta).model;
    std::mt19937_64 random(3);
    for (const RetractionMetric metric :
         {RetractionMetric::kPhong, RetractionMetric::kEuclidean,
          RetractionMetric::kLocalEuclidean, RetractionMetric::kContactPoint,
          RetractionMetric::kContactPoints}) {
      const Retraction retraction = Make(model, metric, BranchChoice::kAll);
      RetractionScratch scratch;
      int in_channel = 0;
      for (int i = 0; i < 400; ++i) {
        // In the plate, near the hole, where the Euclidean metric finds it.
        const double angle = 0.1 + i;
        const double radius = 0.5 * delta * (1.5 + (i % 7));
        const Vector3d q(0.001 * (i % 50), 0.25 + radius * std::cos(angle),
                         -0.125 + radius * std::sin(angle));
        retraction.Retract(q, &random, &scratch);
        for (const RetractedPoint& point : scratch.points) {
          EXPECT_TRUE(model->free_space().IsFree(point.q));
          EXPECT_GE(point.room, model->floor());
          if (std::abs(point.q.x()) > 0.11) continue;
          EXPECT_LE(std::min(std::abs(point.q.y() - 0.25),
                             std::abs(point.q.z() + 0.125)),
                    1e-9);
          EXPECT_GE(point.room, 0.25 * delta - 1e-9);
          EXPECT_LE(point.room, 0.5 * delta + 1e-9);
          ++in_channel;
        }
      }
      EXPECT_GT(in_channel, 30)
          << delta << " metric " << static_cast<int>(metric);
    }
  }
}

TEST(Retraction, NeverLeavesTheFreeSpaceOfTheOriginalMeshes) {
  const testing::Passage passage = testing::MakePassage("tunnel", 1e-3, 1);
  const auto model = passage.model;
  const CollisionOracle oracle(passage.scene.workspace.robot,
                               MergedObstacle(passage.scene.workspace));
  std::mt19937_64 random(5);
  RetractionScratch scratch;
  std::size_t points = 0;
  for (const RetractionMetric metric :
       {RetractionMetric::kPhong, RetractionMetric::kEuclidean,
        RetractionMetric::kLocalEuclidean, RetractionMetric::kContactPoint,
        RetractionMetric::kContactPoints}) {
    const Retraction retraction = Make(model, metric, BranchChoice::kAll);
    for (int i = 0; i < 150; ++i) {
      retraction.Retract(testing::RandomPoint(model->region(), &random),
                         &random, &scratch);
      for (const RetractedPoint& point : scratch.points) {
        ASSERT_FALSE(oracle.Collides(point.q));
        ASSERT_TRUE(model->free_space().IsFree(point.q));
        ++points;
      }
    }
  }
  EXPECT_GT(points, 300u);
}

// In a cube: six faces are local minima of the distance; random points are as
// many as there are Phong branches, whose normals lean towards the corners.
TEST(Retraction, BaselinesHaveAsManyCandidatesAsTheyShould) {
  const auto model = std::make_shared<const ContactModel>(
      std::vector<ContactSpace>{BuildContactSpace(Cube(0.5), Cube(1.5))});
  std::mt19937_64 random(5);
  const Vector3d q(0.1, -0.2, 0.3);
  RetractionScratch phong, local, drawn, one;
  Make(model, RetractionMetric::kPhong, BranchChoice::kAll)
      .Retract(q, &random, &phong);
  Make(model, RetractionMetric::kLocalEuclidean, BranchChoice::kAll)
      .Retract(q, &random, &local);
  Make(model, RetractionMetric::kContactPoints, BranchChoice::kAll)
      .Retract(q, &random, &drawn);
  Make(model, RetractionMetric::kEuclidean, BranchChoice::kAll)
      .Retract(q, &random, &one);
  EXPECT_EQ(local.points.size(), 6U);
  EXPECT_EQ(drawn.points.size(), phong.points.size());
  EXPECT_GE(phong.points.size(), 1U);
  ASSERT_EQ(one.points.size(), 1U);
  // The nearest comes first.
  EXPECT_LT((local.points[0].q - one.points[0].q).norm(), 1e-12);
}

TEST(Retraction, HandlesSeveralContactSpaces) {
  // Two boxes that overlap in x ∈ [0.5, 1]: what leaves one may be in the
  // other, and must then leave that one too or be dropped.
  const std::vector<ContactSpace> spaces = {
      BuildContactSpace(Cube(0.5), Cube(1.5)),
      BuildContactSpace(Cube(0.5), Translated(Cube(1.5), {1.5, 0.0, 0.0}))};
  const auto model = std::make_shared<const ContactModel>(spaces);
  EXPECT_NEAR(model->diagonal(), Vector3d(3.5, 2.0, 2.0).norm(), 1e-12);
  std::mt19937_64 random(5);
  RetractionScratch scratch;
  for (const RetractionMetric metric :
       {RetractionMetric::kPhong, RetractionMetric::kEuclidean}) {
    const Retraction retraction = Make(model, metric, BranchChoice::kAll);
    int retracted = 0;
    for (const Vector3d& q :
         {Vector3d(0.75, 0.1, 0.2), Vector3d(0.45, 0.0, 0.3),
          Vector3d(-0.9, 0.1, 0.0), Vector3d(1.9, 0.2, -0.8)}) {
      const RetractionStatus status = retraction.Retract(q, &random, &scratch);
      // A projection from one box may end in the other for good.
      EXPECT_TRUE(status == RetractionStatus::kRetracted ||
                  status == RetractionStatus::kNoClearance);
      retracted += status == RetractionStatus::kRetracted;
      for (const RetractedPoint& point : scratch.points) {
        EXPECT_TRUE(model->free_space().IsFree(point.q));
        EXPECT_GE(point.room, model->floor());
      }
    }
    EXPECT_GE(retracted, 2);
  }
}

TEST(Retraction, RepeatsWithTheSeed) {
  const auto model = testing::MakePassage("tunnel", 1e-2).model;
  const Retraction retraction =
      Make(model, RetractionMetric::kPhong, BranchChoice::kRandom);
  std::vector<Vector3d> runs[2];
  for (std::vector<Vector3d>& run : runs) {
    std::mt19937_64 random(9);
    RetractionScratch scratch;
    for (int i = 0; i < 100; ++i) {
      retraction.Retract(testing::RandomPoint(model->region(), &random),
                         &random, &scratch);
      for (const RetractedPoint& point : scratch.points) run.push_back(point.q);
    }
  }
  EXPECT_EQ(runs[0], runs[1]);
}

}  // namespace
}  // namespace phongpd
