// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: collision of the original solids, by FCL.
#include <gtest/gtest.h>

#include <random>

#include "constraints/oracle/collision_oracle.h"
#include "core/contact/contact_space.h"
#include "problems/shapes/shapes.h"
#include "tests/support/oracle_of.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The surface must separate what the oracle calls free from what it calls
// hit: everywhere, and a hair to either side of it.
void ExpectSeparates(const TriangleMesh& robot, const TriangleMesh& obstacle,
                     const TriangleMesh& surface, int samples) {
  const auto oracle = testing::OracleOf<CollisionOracle>(robot, obstacle);
  const BoundingBox box = ComputeBounds(surface);
  std::mt19937_64 random(7);
  for (int i = 0; i < samples; ++i) {
    const Vector3d q = testing::RandomPoint(box, &random);
    EXPECT_EQ(oracle.Collides(q), testing::WindingNumber(surface, q) > 0.5)
        << q.transpose();
  }
  for (const double relative : {1e-6, 1e-9}) {
    const double step = relative * box.Diagonal();
    for (int i = 0; i < samples; ++i) {
      const auto at = testing::RandomSurfacePoint(surface, &random);
      EXPECT_FALSE(oracle.Collides(at.position + step * at.normal))
          << at.position.transpose() << " out by " << step;
      EXPECT_TRUE(oracle.Collides(at.position - step * at.normal))
          << at.position.transpose() << " in by " << step;
    }
  }
}

TEST(ContactSpace, SeparatesFreeFromHitForGenericSolids) {
  const TriangleMesh robot = MakeStar(0.5, 1.2);
  const TriangleMesh obstacle =
      Rotated(MakeTorus(2, 0.6, 16, 8), GenericRotation());
  const ContactSpace c = BuildContactSpace(robot, obstacle);
  EXPECT_TRUE(c.report().closed);
  EXPECT_TRUE(c.report().manifold);
  ExpectSeparates(robot, obstacle, c.mesh(), 1000);
}

}  // namespace
}  // namespace phongpd
