// SPDX-License-Identifier: GPL-3.0-or-later
// Local minima of the distance to a surface, against sampling it.
#include "planners/retraction/local_projections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

std::vector<LocalProjection> Find(const TriangleMesh& mesh, const Vector3d& q,
                                  double bound = 1e100) {
  LocalProjectionScratch scratch;
  std::vector<LocalProjection> found;
  FindLocalProjections(mesh, TriangleNeighbors(mesh), q, bound, &scratch,
                       &found);
  return found;
}

TEST(LocalProjections, OfABoxAreItsSixFacesNearestFirst) {
  const TriangleMesh box = MakeBox({-1, -2, -3}, {1, 2, 3});
  // On no diagonal; on the diagonals of faces, which are edges of the mesh.
  for (const Vector3d& q : {Vector3d(0.3, 0.5, -0.7), Vector3d(0, 0, 0)}) {
    const std::vector<LocalProjection> found = Find(box, q);
    ASSERT_EQ(found.size(), 6U);
    double before = 0.0;
    for (const LocalProjection& p : found) {
      EXPECT_GE(p.distance, before);
      before = p.distance;
      EXPECT_NEAR((p.point - q).norm(), p.distance, 1e-15);
      // Along one axis only.
      EXPECT_EQ(((p.point - q).array().abs() < 1e-15).count(), 2);
    }
    EXPECT_NEAR(found[0].distance, 1.0 - std::abs(q.x()), 1e-15);
  }
  EXPECT_EQ(Find(box, {0, 0, 0}, 2.5).size(), 4U);
  EXPECT_EQ(Find(box, {0, 0, 0}, 0.5).size(), 0U);
}

// Inside a hollow of a solid corners are convex seen from q: from within
// nothing but faces can be least, from outside edges and corners as well.
TEST(LocalProjections, OutsideABoxAreItsNearestCornerOrEdgeOnce) {
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  const std::vector<LocalProjection> corner = Find(box, {2, 3, 4});
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_LT((corner[0].point - Vector3d(1, 1, 1)).norm(), 1e-15);
  const std::vector<LocalProjection> edge = Find(box, {2, 3, 0.25});
  ASSERT_EQ(edge.size(), 1U);
  EXPECT_LT((edge[0].point - Vector3d(1, 1, 0.25)).norm(), 1e-15);
}

// No point of the surface within a small way is nearer, and the nearest one of
// all is the first.
TEST(LocalProjections, AreLeastAmongTheirSurroundingsOnAnyMesh) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const TriangleMesh& mesh :
       {MakeU(2.0, 0.3, 0.6), MakeTorus(1.5, 0.4, 24, 10),
        MakePlateWithHole(3.0, 0.2, 1.0)}) {
    std::vector<Vector3d> samples;
    for (int i = 0; i < 20000; ++i) {
      samples.push_back(RandomSurfacePoint(mesh, &random).position);
    }
    int several = 0;
    for (int i = 0; i < 40; ++i) {
      const Vector3d q(unit(random), unit(random), 0.2 * unit(random));
      const std::vector<LocalProjection> found = Find(mesh, q);
      ASSERT_FALSE(found.empty());
      several += found.size() > 1 ? 1 : 0;
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3d& x : samples) {
        least = std::min(least, (x - q).norm());
        for (const LocalProjection& p : found) {
          if ((x - p.point).norm() > 0.02) continue;
          EXPECT_GE((x - q).norm(), p.distance * (1.0 - 1e-9));
        }
      }
      EXPECT_LE(found.front().distance, least);
    }
    EXPECT_GT(several, 20);
  }
}

}  // namespace
}  // namespace phongpd
