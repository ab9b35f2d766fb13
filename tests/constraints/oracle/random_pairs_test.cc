// SPDX-License-Identifier: GPL-3.0-or-later
// Random pairs of solids, each checked by routes of its own, and every pair
// that ever failed.  The full run is part of contact_space_benchmark.
#include "tests/support/random_pairs.h"

#include <gtest/gtest.h>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/contact_space_check.h"
#include "tests/support/lattice_boxes.h"

namespace phongpd {
namespace {

void ExpectRight(PairKind kind, std::uint64_t seed) {
  SCOPED_TRACE(Name(kind) + ", seed " + std::to_string(seed));
  CheckOptions options;
  options.seed = seed;
  const CheckResult result =
      CheckContactSpace(MakeRandomPair(kind, seed), options);
  for (const std::string& failure : result.failures) ADD_FAILURE() << failure;
}

class RandomPairs : public ::testing::TestWithParam<PairKind> {};

TEST_P(RandomPairs, HaveRightContactSpaces) {
  const std::uint64_t count = GetParam() == PairKind::kManyBoxes  ? 2
                              : GetParam() == PairKind::kJittered ? 6
                                                                  : 10;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    ExpectRight(GetParam(), seed);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomPairs,
                         ::testing::ValuesIn(AllPairKinds()));

// The first hit of a ray from far away was a sheet behind the outermost one,
// closer than the ray's rounding: reported as a leak.
TEST(FormerFailures, OutermostSheetsCloserThanRounding) {
  ExpectRight(PairKind::kJittered, 8);
  ExpectRight(PairKind::kJittered, 141);
}

// Sums of components that share no edge each had an outside of their own,
// which counted as a cavity and was dropped with the cavities.
TEST(FormerFailures, PartsOfTheArrangementThatShareNoEdge) {
  ExpectRight(PairKind::kVertexTouch, 0);
  const auto cube = [](double x) { return MakeBox({x, 0, 0}, {x + 1, 1, 1}); };
  const TriangleMesh shell = Translated(MakeVessel(12, 10, 0), {3, 0, 0});
  const TriangleMesh far = Joined(cube(0), cube(5));
  ContactSpaceOptions options;
  for (const bool outer_only : {false, true}) {
    options.outer_shell_only = outer_only;
    // Two boxes apart, and both inside a shell: one cavity with two islands.
    const ContactSpace apart = BuildContactSpace(cube(0), far, options);
    EXPECT_EQ(apart.report().cavities, 0);
    EXPECT_EQ(apart.report().components, 2);
    EXPECT_EQ(apart.report().volume, 16.0);
    const ContactSpace islands =
        BuildContactSpace(cube(0), Joined(far, shell), options);
    EXPECT_EQ(islands.report().cavities, 1);
    EXPECT_EQ(islands.report().components, outer_only ? 1 : 4);
    EXPECT_NEAR(islands.report().volume,
                outer_only ? 13.0 * 13 * 13 : 13.0 * 13 * 13 - 9 * 9 * 9 + 16,
                1e-9);
  }
}

TEST(LatticeSumVolume, CountsTheSumOfTwoUnionsOfBoxes) {
  const LatticeBox unit = {{0, 0, 0}, {4, 4, 4}};
  const LatticeBox apart = {{40, 0, 0}, {44, 4, 2}};
  EXPECT_EQ(LatticeSumVolume({unit}, {unit}), 8.0);
  EXPECT_EQ(LatticeSumVolume({unit}, {unit, apart}), 8.0 + 2 * 2 * 1.5);
  EXPECT_EQ(LatticeSumVolume({unit, unit}, {unit, unit}), 8.0);
}

TEST(ContactSpaceCheck, FindsAWrongExpectation) {
  SolidPair pair = MakeRandomPair(PairKind::kAligned, 3);
  EXPECT_TRUE(CheckContactSpace(pair).failures.empty());
  *pair.volume += 1e-9;
  pair.cavities = 7;
  EXPECT_EQ(CheckContactSpace(pair).failures.size(), 2U);
}

// Two sheets met along a line with different vertices on it; dropping all of
// them as collinear left both with the same edge.
TEST(FormerFailures, SheetsAlongOneLineKeepDistinctEdges) {
  const SolidPair pair = MakeRandomPair(PairKind::kTilted, 337);
  for (const double factor : {1.0, 30603.115627672451, 6809615.2945323344}) {
    const ContactSpaceReport report =
        BuildContactSpace(Scaled(pair.robot, factor),
                          Scaled(pair.obstacle, factor))
            .report();
    EXPECT_TRUE(report.manifold) << "scaled by " << factor;
  }
}

// Judging points were face middles: on a lattice their rays ran exactly into
// edges and passed between two faces, so a free cell was judged at a point of
// an occupied one.
TEST(FormerFailures, JudgingPointsOnALattice) {
  ExpectRight(PairKind::kManyBoxes, 71);
  ExpectRight(PairKind::kManyBoxes, 86);
  ExpectRight(PairKind::kManyBoxes, 1006);
  ExpectRight(PairKind::kManyBoxes, 1026);
}

// A solid touched itself along a line inside a planar patch.  Its other sheet,
// all collinear vertices dropped, had an edge there that was a diagonal of the
// patch's triangulation: an edge with four triangles.
TEST(FormerFailures, MergedEdgesAreNoDiagonalsOfAThirdPatch) {
  ExpectRight(PairKind::kJittered, 1192);
}

// Between sheets 1e-9 apart, these points are the third of a grid step off the
// surface; measured from needles they looked 12 to 52 steps away, where the
// grid excuses nothing.
TEST(FormerFailures, PointsBesideNeedles) {
  const auto expect_near = [](PairKind kind, std::uint64_t seed,
                              const Eigen::Vector3d& q) {
    const SolidPair pair = MakeRandomPair(kind, seed);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    EXPECT_LT(TriangleBvh(space.mesh()).FindClosest(q).distance,
              space.report().grid_step)
        << Name(kind) << ", seed " << seed;
  };
  expect_near(PairKind::kTilted, 111,
              {-0.64793837504829233, 4.4335425071120982, -3.863143357054831});
  expect_near(PairKind::kTilted, 111,
              {-0.6479383751423281, 4.4335425069869352, -3.8631433571687537});
  expect_near(PairKind::kJittered, 245,
              {-0.28848730371056419, -2.1220463739449675, 3.5233073046445482});
  ExpectRight(PairKind::kTilted, 111);
  ExpectRight(PairKind::kJittered, 245);
}

}  // namespace
}  // namespace phongpd
