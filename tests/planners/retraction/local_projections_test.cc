// SPDX-License-Identifier: GPL-3.0-or-later
// Local minima of the distance to a surface, against sampling it.
#include "planners/retraction/local_projections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/bvh/triangle_bvh.h"
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
  constexpr double kSmall = 1e-6;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const TriangleMesh& mesh :
       {MakeU(2.0, 0.3, 0.6), MakeTorus(1.5, 0.4, 24, 10),
        MakePlateWithHole(3.0, 0.2, 1.0)}) {
    const TriangleBvh surface(mesh);
    const auto closest = [&](const Vector3d& x) -> Vector3d {
      const TriangleBvh::Closest found = surface.FindClosest(x);
      const Triangle& t =
          mesh.triangles[static_cast<std::size_t>(found.triangle)];
      Vector3d point = Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        point += found.lambda[static_cast<Eigen::Index>(k)] *
                 mesh.vertices[static_cast<std::size_t>(t[k])];
      }
      return point;
    };
    int several = 0;
    for (int i = 0; i < 200; ++i) {
      const double x = unit(random), y = unit(random), z = unit(random);
      const Vector3d q(x, y, 0.2 * z);
      const std::vector<LocalProjection> found = Find(mesh, q);
      ASSERT_FALSE(found.empty());
      several += found.size() > 1 ? 1 : 0;
      EXPECT_NEAR(found.front().distance, surface.FindClosest(q).distance,
                  1e-14);
      for (const LocalProjection& p : found) {
        for (int k = 0; k < 20; ++k) {
          const double a = unit(random), b = unit(random), c = unit(random);
          const Vector3d beside = closest(p.point + kSmall * Vector3d(a, b, c));
          EXPECT_GE((beside - q).norm(), p.distance - 1e-12);
        }
      }
    }
    EXPECT_GT(several, 100);
  }
}

}  // namespace
}  // namespace phongpd
