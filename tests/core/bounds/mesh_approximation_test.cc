// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/mesh_approximation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "core/bounds/convex_hull.h"
#include "core/bounds/solid_distance.h"
#include "core/bvh/triangle_bvh.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The other route: d(x, solid) by winding number and closest point, at random
// points of the other solid and of its surface.
double SampledDeviation(const TriangleMesh& from, const TriangleMesh& to,
                        int samples) {
  const TriangleBvh tree(to);
  std::mt19937_64 random(11);
  double largest = 0.0;
  const auto look = [&](const Vector3d& x) {
    if (testing::WindingNumber(to, x) > 0.5) return;
    largest = std::max(largest, tree.FindClosest(x).distance);
  };
  for (const Vector3d& v : from.vertices) look(v);
  for (int i = 0; i < samples; ++i) {
    look(testing::RandomSurfacePoint(from, &random).position);
    const Vector3d x = testing::RandomPoint(ComputeBounds(from), &random);
    if (testing::WindingNumber(from, x) > 0.5) look(x);
  }
  return largest;
}

void ExpectBounds(const ApproximateMesh& approximate, const TriangleMesh& solid,
                  double diagonal, double relative = 0.26) {
  const double sampled =
      std::max(SampledDeviation(approximate.mesh, solid, 1000),
               SampledDeviation(solid, approximate.mesh, 1000));
  EXPECT_LE(sampled, approximate.bound + 1e-13 * diagonal);
  EXPECT_LE(approximate.lower_bound, approximate.bound);
  // As sharp as the search promises.
  EXPECT_LE(approximate.bound,
            std::max((1 + relative) * approximate.lower_bound,
                     approximate.lower_bound + 1.1e-3 * diagonal));
}

TEST(SolidDeviation, OfAFilledCavityIsItsDepth) {
  // No point of the filled cube's surface is off the vessel.
  const TriangleMesh vessel = MakeVessel(4, 3, 0);
  const TriangleMesh cube = MakeBox({-2, -2, -2}, {2, 2, 2});
  const DistanceBounds filled = SolidDeviation(cube, vessel);
  EXPECT_LE(filled.lower, 1.5);
  EXPECT_GE(filled.upper, 1.5);
  EXPECT_LE(filled.upper, 1.5 * 1.1 * 1.1);
  EXPECT_LE(SolidDeviation(vessel, cube).upper, 1e-3 * 7.0);
  EXPECT_LE(SurfaceDeviation(cube, vessel).upper, 1e-3 * 7.0);
}

TEST(SolidDeviation, OfATranslatedBoxIsTheShift) {
  const TriangleMesh box = MakeBox({-1, -2, -3}, {1, 2, 3});
  for (const Vector3d& shift :
       {Vector3d(0.5, 0, 0), Vector3d(0.1, -0.2, 0.3), Vector3d(9, 0, 0)}) {
    const DistanceBounds bounds = SolidDeviation(Translated(box, shift), box);
    EXPECT_LE(bounds.lower, shift.norm() * (1 + 1e-12));
    EXPECT_GE(bounds.upper, shift.norm() * (1 - 1e-12));
    EXPECT_LE(bounds.upper, 1.1 * bounds.lower + 1e-3 * 18);
  }
}

TEST(SolidDeviation, TakesOverlappingComponentsAsTheirUnion) {
  const TriangleMesh bars = Joined(MakeBox({-2, -1, -1}, {2, 1, 1}),
                                   MakeBox({-1, -2, -1}, {1, 2, 1}));
  // The overlap is inside, although two shells bound it.
  EXPECT_LE(SolidDeviation(MakeBox({-1, -1, -1}, {1, 1, 1}), bars).upper,
            1e-3 * 6);
  const DistanceBounds corner =
      SolidDeviation(MakeBox({-2, -2, -1}, {2, 2, 1}), bars);
  EXPECT_LE(corner.lower, 1.0);
  EXPECT_GE(corner.upper, 1.0);
}

TEST(ConvexHull, OfConvexSolidsChangesNothing) {
  for (const TriangleMesh& solid :
       {MakeBox({-1, -2, 0}, {3, 1, 1}), MakeUvBall(1.0, 24, 22),
        MakeCone(0.8, 1.6, 40), Rotated(MakePrism(1, 3, 7), GenericRotation()),
        Scaled(MakeIcoBall(1.0, 3), 1e-6)}) {
    const ApproximateMesh hull = ConvexHull(solid);
    const double diagonal = ComputeBounds(solid).Diagonal();
    EXPECT_LE(hull.bound, 1e-12 * diagonal);
    EXPECT_TRUE(hull.is_conservative);
    EXPECT_NEAR(SignedVolume(hull.mesh), SignedVolume(solid),
                1e-12 * std::pow(diagonal, 3));
  }
}

TEST(ConvexHull, BoundsTheDistanceOfEveryPointOfTheHull) {
  for (const TriangleMesh& solid :
       {MakeStar(0.5, 1.2), MakeL(3, 1, 1), MakeU(3, 0.5, 1),
        MakeTorus(2, 0.6, 24, 12), MakeVessel(4, 3, 0)}) {
    ExpectBounds(ConvexHull(solid), solid, ComputeBounds(solid).Diagonal());
  }
  // In the hull of the L, the middle of the long edge across: (3,1)-(1,3) is
  // 2·√2 long and ends where the legs do; the corner (1,1) is √2 away.
  const ApproximateMesh hull = ConvexHull(MakeL(3, 1, 1));
  EXPECT_LE(hull.lower_bound, 1.0 + 1e-12);
  EXPECT_GE(hull.bound, 1.0 - 1e-12);
}

// CGAL's own order of facets varies from run to run with where they lie in
// memory; the order of the input is what a test can vary.
TEST(ConvexHull, IsTheSameInWhateverOrderTheInputComes) {
  std::mt19937 random(4);
  TriangleMesh mesh = MakeIcoBall(1.0, 2);
  const TriangleMesh expected = internal::HullOfVertices(mesh);
  EXPECT_EQ(expected.triangles.size(), mesh.triangles.size());
  for (int round = 0; round < 20; ++round) {
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    std::vector<int> place(mesh.vertices.size());
    std::iota(place.begin(), place.end(), 0);
    std::shuffle(place.begin(), place.end(), random);
    TriangleMesh moved = mesh;
    for (std::size_t v = 0; v < place.size(); ++v) {
      moved.vertices[static_cast<std::size_t>(place[v])] = mesh.vertices[v];
    }
    for (Triangle& t : moved.triangles) {
      for (int& v : t) v = place[static_cast<std::size_t>(v)];
    }
    const TriangleMesh hull = internal::HullOfVertices(moved);
    EXPECT_EQ(hull.vertices, expected.vertices);
    EXPECT_EQ(hull.triangles, expected.triangles);
  }
}

TEST(Decimate, BoundsTheDeviationOfABall) {
  const TriangleMesh ball = MakeIcoBall(1.0, 3);
  double last = 0.0;
  for (const std::size_t target : {640, 320, 100}) {
    const ApproximateMesh coarse = Decimate(ball, target);
    EXPECT_LE(coarse.mesh.triangles.size(), target);
    EXPECT_FALSE(coarse.is_conservative);
    EXPECT_NO_THROW(MakeSolid(coarse.mesh, "coarse"));
    ExpectBounds(coarse, ball, 2.0);
    EXPECT_GT(coarse.bound, last);
    last = coarse.bound;
  }
  // Chords of N equal triangles: sagitta ≈ 4π/(N·√3)·…; within a factor.
  EXPECT_LT(last, 0.2);
  EXPECT_GT(last, 0.01);
}

TEST(Decimate, KeepsSolidsOfAnyGenusAndSeveralParts) {
  for (const TriangleMesh& solid :
       {MakeKnot(1.0, 0.3, 96, 8), MakeWrench(), MakeTorus(2, 0.6, 32, 16),
        Joined(MakeIcoBall(1, 2),
               Translated(MakeIcoBall(1, 2), Vector3d(0.5, 0, 0)))}) {
    const std::size_t target = solid.triangles.size() / 4;
    const ApproximateMesh coarse = Decimate(solid, target);
    EXPECT_LE(coarse.mesh.triangles.size(), target) << coarse.note;
    ExpectBounds(coarse, solid, ComputeBounds(solid).Diagonal());
  }
}

TEST(Decimate, LeavesSmallMeshesAloneAndRefusesNonsense) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  const ApproximateMesh same = Decimate(box, 12);
  EXPECT_EQ(same.mesh.triangles, box.triangles);
  EXPECT_EQ(same.bound, 0.0);
  EXPECT_TRUE(same.is_conservative);
  EXPECT_THROW(Decimate(box, 3), InputError);
}

TEST(WrapSolid, EnclosesItsInputWithABound) {
  for (const TriangleMesh& solid :
       {MakeStar(0.5, 1.2), Scaled(MakeWrench(), 1e-3),
        Translated(MakeTorus(2, 0.6, 24, 12), Vector3d(1e3, 0, -1e3))}) {
    const ApproximateMesh wrap = WrapSolid(solid, 0.05);
    const double diagonal = ComputeBounds(solid).Diagonal();
    for (const Vector3d& v : solid.vertices) {
      EXPECT_GT(testing::WindingNumber(wrap.mesh, v), 0.5);
    }
    EXPECT_TRUE(wrap.is_conservative);
    ExpectBounds(wrap, solid, diagonal);
    EXPECT_LT(wrap.bound, 0.06 * diagonal);
    EXPECT_GE(wrap.bound, 0.005 * diagonal);  // the offset
  }
}

TEST(WrapSolid, SaysThatItFillsACavity) {
  EXPECT_GE(WrapSolid(MakeVessel(4, 3, 0), 0.1).bound, 1.5);
}

TEST(WrapSolid, RefusesAlphasThatAreNone) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  for (const double alpha : {0.0, -1.0, 1e-4, 1.5, std::nan("")}) {
    EXPECT_THROW(WrapSolid(box, alpha), InputError) << alpha;
  }
}

TEST(WrapTriangles, EnclosesRandomSoups) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 5; ++i) {
    TriangleMesh soup;
    for (int t = 0; t < 8; ++t) {
      for (int k = 0; k < 3; ++k) {
        soup.vertices.push_back(testing::RandomPoint(
            {Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}, &random));
      }
      soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const ApproximateMesh wrap = WrapTriangles(soup, 0.1);
    const TriangleBvh inside(wrap.mesh);
    for (int s = 0; s < 200; ++s) {
      EXPECT_EQ(
          inside.Locate(testing::RandomSurfacePoint(soup, &random).position),
          Location::kInside);
    }
    const TriangleBvh tree(soup);
    for (const Vector3d& v : wrap.mesh.vertices) {
      EXPECT_LE(tree.FindClosest(v).distance, wrap.bound);
    }
    EXPECT_FALSE(wrap.note.empty());
  }
}

}  // namespace
}  // namespace phongpd
