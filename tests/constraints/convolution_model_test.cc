// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: exact motion checks and distances on the whole contact space.
#include "core/contact/convolution_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "core/minkowski/convolution/convolution_space.h"
#include "core/minkowski/operands/grid_pair.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/hidden_pairs.h"
#include "tests/support/named_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;
using testing::NamedPair;

std::vector<NamedPair> Pairs() {
  std::vector<NamedPair> pairs = testing::SmallPairs();
  const std::vector<NamedPair> more = {
      {"ball and wrench", MakeUvBall(0.3, 8, 6), MakeWrench(1, 12, 12, 8, 8)},
      {"star and knot", MakeStar(0.3, 0.7), MakeKnot(0.5, 0.2, 32, 6)},
      {"blob and plate", MakeBlob(0.4, 1, 0.35, 1),
       MakePlateWithRoundHole(3, 0.3, 1.2, 12)},
      {"turned L far away and torus",
       Rotated(MakeL(1, 0.3, 0.5), GenericRotation()),
       Translated(MakeTorus(2, 0.6, 12, 6), {1e3, -2e3, 5e2})},
      {"axes and shell", MakeAxes(0.5, 0.05), MakeVessel(4, 3, 0)},
      {"prism and scan", MakePrism(0.4, 1, 6),
       MakeScan(MakeTorus(2, 0.7, 12, 8), 0.8, 0.002, 3)},
  };
  pairs.insert(pairs.end(), more.begin(), more.end());
  return pairs;
}

// The same free space by its contact space and by the convolution alone.
struct Spaces {
  Spaces(const TriangleMesh& robot, const TriangleMesh& obstacle)
      : contact(BuildContactSpace(robot, obstacle)),
        truth({contact}),
        model(robot, obstacle),
        found(FreeSpace::OfConvolutions({model})) {}

  ContactSpace contact;
  FreeSpace truth;
  ConvolutionModel model;
  FreeSpace found;
};

struct Counts {
  int free = 0, blocked = 0, distances = 0;
};

// Everything that is asked of a segment, of both.
void Compare(const FreeSpace& found, const FreeSpace& truth, const Vector3d& a,
             const Vector3d& b, double diagonal, Counts* counts) {
  const bool is_free = truth.IsFree(a, b);
  ASSERT_EQ(found.IsFree(a), truth.IsFree(a)) << a.transpose();
  ASSERT_EQ(found.IsFree(a, b), is_free)
      << a.transpose() << " to " << b.transpose();
  (is_free ? counts->free : counts->blocked) += 1;
  const MotionCheck check = found.Check(a, b), expected = truth.Check(a, b);
  ASSERT_EQ(check.free, is_free);
  ASSERT_EQ(check.obstacle, expected.obstacle);
  EXPECT_NEAR((check.fraction - expected.fraction) * (b - a).norm(), 0.0,
              1e-12 * diagonal);
  if (!truth.IsFree(a)) {
    EXPECT_EQ(found.Clearance(a), 0.0);
    return;
  }
  EXPECT_NEAR(found.Clearance(a), truth.Clearance(a), 1e-12 * diagonal);
  EXPECT_NEAR(found.Clearance(a, b), truth.Clearance(a, b), 1e-12 * diagonal);
  ++counts->distances;
}

TEST(ConvolutionModel, AgreesWithTheContactSpaceOnEverySegment) {
  std::mt19937_64 random(4);
  Counts counts;
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const Spaces spaces(pair.robot, pair.obstacle);
    const auto& [space, truth, model, found] = spaces;
    EXPECT_EQ(model.Mesh().triangles.size(),
              space.report().convolution_triangles);
    EXPECT_EQ(model.report().grid_step, space.report().grid_step);
    const double diagonal = space.bounds().Diagonal();
    EXPECT_LT((model.bounds().min - space.bounds().min).norm(),
              1e-12 * diagonal);
    EXPECT_LT((model.bounds().max - space.bounds().max).norm(),
              1e-12 * diagonal);
    for (int i = 0; i < 600; ++i) {
      const Vector3d a = testing::RandomPoint(space.bounds(), &random);
      Vector3d b = testing::RandomPoint(space.bounds(), &random);
      if (i % 2 == 0) b = a + 0.1 * (b - a);
      if (i % 100 == 0) b = a;
      Compare(found, truth, a, b, diagonal, &counts);
      if (HasFatalFailure()) return;
      if (!truth.IsFree(a)) continue;
      const ConvolutionModel::Nearest nearest = model.FindNearest(a);
      EXPECT_NEAR((nearest.point - a).norm(), nearest.distance,
                  1e-12 * diagonal);
      EXPECT_NEAR(truth.Clearance(nearest.point), 0.0, 1e-12 * diagonal);
    }
  }
  EXPECT_GT(counts.free, 1000);
  EXPECT_GT(counts.blocked, 1000);
  EXPECT_GT(counts.distances, 1000);
}

TEST(ConvolutionSpace, AgreesWithTheContactSpaceOnEverySegment) {
  std::mt19937_64 random(4);
  int free = 0, blocked = 0;
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    const FreeSpace truth({space});
    const internal::GridPair grid =
        internal::MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const internal::ConvolutionSpace convolution(grid);
    const BoundingBox box = space.bounds();
    for (int i = 0; i < 2000; ++i) {
      const Vector3d a = testing::RandomPoint(box, &random);
      Vector3d b = testing::RandomPoint(box, &random);
      if (i % 2 == 0) b = a + 0.1 * (b - a);
      ASSERT_EQ(convolution.IsFree(a), truth.IsFree(a)) << a.transpose();
      ASSERT_EQ(convolution.IsFree(a, b), truth.IsFree(a, b))
          << a.transpose() << " to " << b.transpose();
      truth.IsFree(a, b) ? ++free : ++blocked;
      if (!truth.IsFree(a)) continue;
      const internal::ConvolutionSpace::Nearest nearest =
          convolution.FindNearest(a);
      EXPECT_NEAR(nearest.distance, truth.Clearance(a), 1e-12 * box.Diagonal());
      EXPECT_NEAR((nearest.point - a).norm(), nearest.distance,
                  1e-12 * box.Diagonal());
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_GT(blocked, 500);
}

// Along faces, through edges and corners of C_cont.
TEST(ConvolutionModel, AgreesWithTheContactSpaceWhereItIsTouched) {
  std::mt19937_64 random(5);
  Counts counts;
  for (const NamedPair& pair : {
           NamedPair{"cubes", Cube(0.5), Cube(1.5)},
           NamedPair{"cube and hollow shell", Cube(1), MakeVessel(4, 3, 0)},
           NamedPair{"peg and its hole",
                     MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}),
                     MakePlateWithHole(4, 1, 1)},
           NamedPair{"L and U", MakeL(1, 0.25, 0.5), MakeU(2, 0.5, 1)},
           NamedPair{"axes and plate", MakeAxes(0.5, 0.125),
                     MakePlateWithHole(4, 1, 2)},
       }) {
    SCOPED_TRACE(pair.name);
    const Spaces spaces(pair.robot, pair.obstacle);
    const auto& [space, truth, model, found] = spaces;
    const std::vector<Vector3d>& corners = space.mesh().vertices;
    // Coordinates of corners, mixed, half a cube off, or kept.
    const auto pick = [&] {
      Vector3d q;
      for (int k = 0; k < 3; ++k) {
        q[k] = corners[random() % corners.size()][k];
        if (random() % 2 == 0) q[k] += random() % 2 == 0 ? 0.25 : -0.25;
      }
      return q;
    };
    for (int i = 0; i < 3000; ++i) {
      const Vector3d a = pick();
      Vector3d b = pick();
      for (int k = 0; k < 3; ++k) {
        if (random() % 2 == 0) b[k] = a[k];
      }
      Compare(found, truth, a, b, space.bounds().Diagonal(), &counts);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(counts.free, 1000);
  EXPECT_GT(counts.blocked, 5000);
}

// Behind their planes are all facets nearby, and they are as near as C_cont.
TEST(ConvolutionModel, FindsTheSeparatorsOfASegment) {
  std::mt19937_64 random(7);
  std::size_t told = 0, around = 0;
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const Spaces spaces(pair.robot, pair.obstacle);
    const auto& [contact, truth, model, found] = spaces;
    const TriangleMesh facets = model.Mesh();
    const double size = contact.bounds().Diagonal(), slack = 1e-9 * size;
    for (int i = 0; i < 200; ++i) {
      const Vector3d a = testing::RandomPoint(model.bounds(), &random);
      const Vector3d b =
          a + 0.1 * (testing::RandomPoint(model.bounds(), &random) - a);
      if (!truth.IsFree(a, b)) continue;
      const double radius = 0.1 * size;
      const auto near = found.FindSeparators(a, b, radius, slack);
      const auto expected = truth.FindSeparators(a, b, radius, slack);
      ASSERT_EQ(near.empty(), expected.empty());
      if (near.empty()) continue;
      EXPECT_NEAR(near.front().distance, expected.front().distance,
                  1e-12 * size);
      for (std::size_t k = 0; k < near.size(); ++k) {
        ASSERT_TRUE(k == 0 || near[k - 1].distance <= near[k].distance);
        for (const Vector3d& q : near[k].corners) {
          ASSERT_LE(near[k].normal.dot(q), near[k].level);
        }
        // Closer than that, rounding turns the normal.
        if (near[k].distance < 1e-5 * size) continue;
        for (const Vector3d& q : {a, b}) {
          ASSERT_GE(near[k].normal.dot(q),
                    near[k].level + near[k].distance - 1e-10 * size);
        }
      }
      for (const Triangle& t : facets.triangles) {
        std::array<Vector3d, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
          corners[k] = facets.vertices[t[k]];
        }
        if (SeparatorOf(corners, a, b).distance > 0.999 * radius) continue;
        ++around;
        ASSERT_TRUE(
            std::any_of(near.begin(), near.end(), [&](const Separator& plane) {
              return std::all_of(
                  corners.begin(), corners.end(), [&](const Vector3d& q) {
                    return plane.normal.dot(q) <= plane.level + 2.0 * slack;
                  });
            }));
      }
      told += near.size();
    }
  }
  EXPECT_GT(told, 1000U);
  EXPECT_GT(around, 20U * told);
}

TEST(ConvolutionModel, StopsAtTheBounds) {
  const BoundingBox bounds = {Vector3d::Constant(-3), Vector3d::Constant(3)};
  const FreeSpace space = FreeSpace::OfConvolutions(
      {ConvolutionModel(Cube(0.5), Cube(1.5))}, bounds);
  EXPECT_TRUE(space.spaces().empty());
  EXPECT_EQ(space.convolutions().size(), 1U);
  EXPECT_FALSE(space.IsFree({3, 0, 0}));
  EXPECT_FALSE(space.IsFree({1, 0.2, 0.3}));
  EXPECT_EQ(space.Clearance({2.5, 0, 0}), 0.5);
  EXPECT_EQ(space.Clearance({1.5, 0, 0}), 0.5);
  EXPECT_FALSE(space.IsFree({2, 2, 2}, {6, 2.5, 2}));
  MotionCheck check = space.Check({2, 2, 2}, {6, 2.5, 2});
  EXPECT_DOUBLE_EQ(check.fraction, 0.25);
  EXPECT_EQ(check.obstacle, MotionCheck::kBounds);
  check = space.Check({-2, 0.3, 0.1}, {2, 0.3, 0.1});
  EXPECT_DOUBLE_EQ(check.fraction, 0.25);
  EXPECT_EQ(check.obstacle, 0);
  EXPECT_EQ(check.triangle, -1);
}

TEST(ConvolutionModel, HasNothingFreeAtPointsThatAreNotFinite) {
  const ConvolutionModel model(Cube(0.5), Cube(1.5));
  const FreeSpace space = FreeSpace::OfConvolutions({model});
  const Vector3d q(3, 0, 0);
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL,
                             std::numeric_limits<double>::max()}) {
    const Vector3d bad(3, value, 0);
    EXPECT_FALSE(space.IsFree(bad));
    EXPECT_FALSE(space.IsFree(q, bad));
    EXPECT_FALSE(space.IsFree(bad, q));
    EXPECT_EQ(space.Check(q, bad).fraction, 0.0);
    EXPECT_FALSE(space.Check(q, bad).free);
    EXPECT_EQ(space.Clearance(bad), 0.0);
    EXPECT_EQ(space.Clearance(q, bad), 0.0);
    EXPECT_TRUE(space.FindSeparators(q, bad, 1.0, 0.0).empty());
    EXPECT_EQ(model.FindNearest(bad).distance, 0.0);
    EXPECT_EQ(model.FirstContact(q, bad), 0.0);
    EXPECT_EQ(model.FirstContact(bad, q), 0.0);
  }
  EXPECT_EQ(model.FindNearest({std::nan(""), 0, 0}).point, Vector3d::Zero());
}

TEST(ConvolutionModel, RefusesWhatItCannotBuild) {
  ContactSpaceOptions options;
  options.outer_shell_only = true;
  EXPECT_THROW(ConvolutionModel(Cube(1), Cube(1), options), InputError);
  TriangleMesh open = Cube(1);
  open.triangles.pop_back();
  EXPECT_THROW(ConvolutionModel(open, Cube(1)), InputError);
  options = {};
  options.max_seconds = 1e-9;
  EXPECT_THROW(ConvolutionModel(Cube(1), Cube(1), options), BuildRefusal);
}

// Many pairs with much that is hidden, overlapping components and cavities; in
// the long form a million segments.
TEST(ConvolutionModelCampaign, AgreesWithTheContactSpaceOnManySegments) {
  const std::vector<HiddenPair> pairs = HiddenPairs(1);
  const auto every = static_cast<std::size_t>(testing::CampaignCases(4, 1));
  const long segments = testing::CampaignCases(400, 25000);
  testing::CampaignRow row;
  row.item = "5 exact motion checks";
  row.subject = "free space in cells beside the contact space, " +
                std::to_string(pairs.size()) + " pairs";
  row.bound = 1e-12;
  row.unit = "L";
  row.seed = 14;
  std::mt19937_64 random(row.seed);
  long free = 0;
  for (std::size_t p = 0; p < pairs.size(); p += every) {
    SCOPED_TRACE(pairs[p].name);
    const Spaces spaces(pairs[p].robot, pairs[p].obstacle);
    const auto& [space, truth, model, found] = spaces;
    for (long i = 0; i < segments; ++i) {
      const Vector3d a = testing::RandomPoint(space.bounds(), &random);
      Vector3d b = testing::RandomPoint(space.bounds(), &random);
      if (i % 2 == 0) b = a + 0.1 * (b - a);
      const bool is_free = truth.IsFree(a, b);
      free += is_free ? 1 : 0;
      row.failures += found.IsFree(a, b) == is_free ? 0 : 1;
      if (is_free && i % 20 == 0) {
        row.worst = std::max(
            row.worst, std::abs(found.Clearance(a, b) - truth.Clearance(a, b)) /
                           space.length());
      }
      ++row.cases;
    }
  }
  EXPECT_EQ(row.failures, 0);
  EXPECT_LT(row.worst, row.bound);
  EXPECT_GT(free, row.cases / 10);
  testing::ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
