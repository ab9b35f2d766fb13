// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: every pair of facets, corner by corner, in rationals.
#include "core/minkowski/arrangement/plane_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/minkowski/operands/grid_frame.h"
#include "problems/shapes/shapes.h"
#include "tests/support/rationals.h"

namespace phongpd {
namespace {

// No namespace of a std::array finds them.
using internal::operator-;

using internal::Convolution;
using internal::ConvolutionFacet;
using internal::GridPlane;
using internal::PlaneGroups;
using testing::Rational;

Convolution ConvolutionOf(const TriangleMesh& robot,
                          const TriangleMesh& obstacle) {
  const internal::GridFrame frame = internal::PlaceOnGrid(robot, obstacle);
  return internal::ReducedConvolution(
      internal::MakeGridSolid(frame.obstacle, obstacle.triangles, false,
                              "obstacle"),
      internal::MakeGridSolid(frame.robot, robot.triangles, true, "robot"));
}

GridPlane PlaneOf(const Convolution& c, const ConvolutionFacet& f) {
  const auto at = [&](std::size_t k) {
    return c.points[static_cast<std::size_t>(f.corners[k])];
  };
  const internal::GridNormal n = internal::Cross(at(1) - at(0), at(2) - at(0));
  return {n, internal::Dot(n, at(0))};
}

bool LieInOnePlane(const Convolution& c, const ConvolutionFacet& f,
                   const ConvolutionFacet& g) {
  const GridPlane plane = PlaneOf(c, f);
  for (const int corner : g.corners) {
    const internal::GridPoint& p = c.points[static_cast<std::size_t>(corner)];
    if (testing::Height(plane, testing::ToRational(p)) != 0) return false;
  }
  return true;
}

bool FaceAlike(const Convolution& c, const ConvolutionFacet& f,
               const ConvolutionFacet& g) {
  Rational dot = 0;
  const GridPlane a = PlaneOf(c, f), b = PlaneOf(c, g);
  for (std::size_t k = 0; k < 3; ++k) {
    dot += testing::ToRational(a.normal[k]) * testing::ToRational(b.normal[k]);
  }
  return dot > 0;
}

// By Euclid, ≥ 0.
internal::Int128 CommonDivisor(internal::Int128 a, internal::Int128 b) {
  while (b != 0) {
    a %= b;
    std::swap(a, b);
  }
  return a < 0 ? -a : a;
}

void ExpectTruth(const Convolution& c) {
  const PlaneGroups groups = internal::GroupByPlane(c);
  const std::size_t count = c.facets.size();
  ASSERT_EQ(groups.of_facet.size(), count);
  ASSERT_EQ(groups.reversed.size(), count);
  ASSERT_EQ(groups.planes.size(), groups.members.size());
  int wrong = 0, pairs = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool together = groups.of_facet[i] == groups.of_facet[j];
      wrong += together != LieInOnePlane(c, c.facets[i], c.facets[j]);
      if (!together) continue;
      ++pairs;
      wrong += (groups.reversed[i] == groups.reversed[j]) !=
               FaceAlike(c, c.facets[i], c.facets[j]);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(pairs, 0);
  // Numbered by first appearance, members in order, each facet once.
  int next = 0;
  std::size_t members = 0;
  for (const int g : groups.of_facet) {
    ASSERT_LE(g, next);
    next += g == next ? 1 : 0;
  }
  EXPECT_EQ(static_cast<std::size_t>(next), groups.members.size());
  for (std::size_t g = 0; g < groups.members.size(); ++g) {
    EXPECT_TRUE(
        std::is_sorted(groups.members[g].begin(), groups.members[g].end()));
    members += groups.members[g].size();
    for (const int f : groups.members[g]) {
      EXPECT_EQ(groups.of_facet[static_cast<std::size_t>(f)],
                static_cast<int>(g));
    }
    // The plane itself: through a member, coprime, first component positive.
    const GridPlane& plane = groups.planes[g];
    const auto first = static_cast<std::size_t>(groups.members[g][0]);
    const ConvolutionFacet& facet = c.facets[first];
    for (const int corner : facet.corners) {
      EXPECT_EQ(internal::Dot(plane.normal,
                              c.points[static_cast<std::size_t>(corner)]),
                plane.offset);
    }
    internal::Int128 divisor = 0;
    int lead = 0;
    for (const internal::Int128 x : plane.normal) {
      divisor = CommonDivisor(divisor, x);
      if (lead == 0) lead = internal::Sign(x);
    }
    EXPECT_TRUE(divisor == 1);
    EXPECT_EQ(lead, 1);
    int facet_lead = 0;
    for (const internal::Int128 x : facet.normal) {
      if (facet_lead == 0) facet_lead = internal::Sign(x);
    }
    EXPECT_EQ(groups.reversed[first] != 0, facet_lead < 0);
  }
  EXPECT_EQ(members, count);
}

TEST(PlaneGroups, HoldWhatLiesInOnePlaneAndNothingElse) {
  ExpectTruth(ConvolutionOf(MakeBox({-1, -1, -1}, {1, 1, 1}),
                            MakeBox({-2, -2, -2}, {2, 2, 2})));
  ExpectTruth(ConvolutionOf(MakeL(3, 1, 1), MakeAxes(1.5, 0.5)));
  ExpectTruth(ConvolutionOf(MakeCone(0.8, 1.6, 8), MakeL(3, 1, 1)));
  // No lattice: coordinates of 38 bits.
  ExpectTruth(ConvolutionOf(MakeIcoBall(0.3, 1), MakeTorus(2, 0.6, 8, 6)));
}

TEST(PlaneGroups, OfTwoBoxesAreSix) {
  const PlaneGroups groups = internal::GroupByPlane(ConvolutionOf(
      MakeBox({-1, -1, -1}, {1, 1, 1}), MakeBox({-2, -2, -2}, {2, 2, 2})));
  EXPECT_EQ(groups.members.size(), 6U);
}

// One step beside each other, and one plane seen from both sides, with normals
// whose common divisors differ, at the largest coordinates.
TEST(PlaneGroups, TellPlanesApartByOneGridStep) {
  const std::int64_t n = (std::int64_t{1} << 38) - 1;
  Convolution c;
  const auto add = [&c](const internal::GridPoint& a,
                        const internal::GridPoint& b,
                        const internal::GridPoint& p) {
    const int first = static_cast<int>(c.points.size());
    for (const internal::GridPoint& corner : {a, b, p}) {
      c.points.push_back(corner);
    }
    ConvolutionFacet facet;
    facet.corners = {first, first + 1, first + 2};
    facet.normal = internal::Cross(b - a, p - a);
    c.facets.push_back(facet);
  };
  add({-n, -n, n}, {n, -n, n}, {n, n, n});
  add({0, 0, n - 1}, {1, 0, n - 1}, {0, 1, n - 1});  // a step below
  add({5, 5, n}, {5, 6, n}, {6, 5, n});              // from behind
  add({-n, n, -n}, {n, -n, -n}, {n, n, -n});
  const PlaneGroups groups = internal::GroupByPlane(c);
  EXPECT_EQ(groups.of_facet, (std::vector<int>{0, 1, 0, 2}));
  EXPECT_EQ(groups.reversed[0], 0);
  EXPECT_EQ(groups.reversed[2], 1);
  EXPECT_TRUE((groups.planes[0] == GridPlane{{0, 0, 1}, n}));
  EXPECT_TRUE((groups.planes[1] == GridPlane{{0, 0, 1}, n - 1}));
  EXPECT_TRUE((groups.planes[2] == GridPlane{{0, 0, 1}, -n}));
}

}  // namespace
}  // namespace phongpd
