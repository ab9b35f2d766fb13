// SPDX-License-Identifier: GPL-3.0-or-later
// The range of lengths in which results keep their meaning, up to its ends.
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <string>
#include <vector>

#include "core/bounds/mesh_repair.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_range.h"
#include "core/minkowski/operands/canonical_frame.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

bool IsScaled(const PenetrationResult& a, const PenetrationResult& b,
              double scale) {
  return a.status == b.status && a.inside == b.inside &&
         a.triangle == b.triangle &&
         a.signed_distance * scale == b.signed_distance &&
         a.contact * scale == b.contact && a.direction == b.direction &&
         a.gradient == b.gradient;
}

// By powers of two no bit of a mantissa changes, so nothing else may.
TEST(Range, IsTheSameContactSpaceAtEveryPowerOfTwo) {
  const TriangleMesh cone = MakeCone(0.8, 1.6, 8), u = MakeU(3, 1, 1);
  const ContactSpace one = BuildContactSpace(cone, u);
  const PhongMetric metric = testing::UnsmoothedPhong(one);
  for (const int power : {-264, -200, -100, 100, 200, 262}) {
    const double scale = std::ldexp(1.0, power);
    const ContactSpace space =
        BuildContactSpace(Scaled(cone, scale), Scaled(u, scale));
    ASSERT_EQ(space.mesh().triangles, one.mesh().triangles) << power;
    EXPECT_EQ(space.mesh().vertices, Scaled(one.mesh(), scale).vertices)
        << power;
    EXPECT_EQ(space.report().volume,
              std::ldexp(one.report().volume, 3 * power));
    EXPECT_EQ(space.report().worst_quality, one.report().worst_quality);
    const PhongMetric scaled = testing::UnsmoothedPhong(space);
    int differ = 0, inside = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vector3d q(1.5 * std::sin(1.1 * i), 1.5 * std::cos(2.3 * i),
                       1.5 * std::sin(0.7 * i + 1));
      const PenetrationResult result = metric.Query(q);
      inside += result.inside;
      differ += !IsScaled(result, scaled.Query(q * scale), scale);
    }
    EXPECT_EQ(differ, 0) << power;
    EXPECT_GT(inside, 200);
  }
}

// Solids turned alike are turned back first, by a frame made of areas, whose
// squares leave the range of doubles long before the lengths do.
TEST(Range, IsTheSameCanonicalFrameAtEveryPowerOfTwo) {
  const Eigen::Matrix3d turn = GenericRotation();
  const TriangleMesh robot = Rotated(MakeL(0.5, 0.2, 0.3), turn),
                     obstacle = Rotated(MakeU(3, 1, 1), turn);
  const internal::CanonicalFrame one =
      internal::ChooseCanonicalFrame(robot, obstacle);
  ASSERT_TRUE(one.used);
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  for (const int power : {-264, -260, -256, -100, 100, 256, 262}) {
    const double scale = std::ldexp(1.0, power);
    const TriangleMesh robot_there = Scaled(robot, scale),
                       obstacle_there = Scaled(obstacle, scale);
    const internal::CanonicalFrame frame =
        internal::ChooseCanonicalFrame(robot_there, obstacle_there);
    EXPECT_TRUE(frame.used) << power;
    EXPECT_EQ(frame.rotation, one.rotation) << power;
    const ContactSpace there = BuildContactSpace(robot_there, obstacle_there);
    EXPECT_EQ(there.mesh().triangles, space.mesh().triangles) << power;
    EXPECT_EQ(there.mesh().vertices, Scaled(space.mesh(), scale).vertices)
        << power;
  }
}

TEST(Range, HoldsTheLargestFloats) {
  const Vector3d corner = Vector3d::Constant(FLT_MAX);
  const TriangleMesh box = MakeBox(-corner, corner);
  const ContactSpace space = BuildContactSpace(box, box);
  const double edge = 4.0 * static_cast<double>(FLT_MAX);
  EXPECT_NEAR(space.report().volume / (edge * edge * edge), 1.0, 1e-14);
  const PenetrationResult result =
      EuclideanMetric(space).Query(Vector3d(0.5 * FLT_MAX, 0, 0));
  EXPECT_TRUE(result.inside);
  EXPECT_NEAR(result.signed_distance / FLT_MAX, -1.5, 1e-15);
}

std::string Refusal(const TriangleMesh& mesh, Repair repair) {
  return testing::ErrorOf([&] { RepairSolid(mesh, "mesh", repair); },
                          "accepted");
}

TEST(Range, EndsByNameWithTheValueAndTheLimit) {
  for (const Repair repair : {Repair::kReject, Repair::kSafe, Repair::kWrap}) {
    TriangleMesh mesh = MakeBox({-1, -1, -1}, {1, 1, 1});
    mesh.vertices[6].y() = -1.5e80;
    EXPECT_EQ(Refusal(mesh, repair),
              "mesh: size out of range; expected coordinates of at most "
              "1e+80, found 1.5e+80 at vertex 6 (from 0); use another unit");
    mesh.vertices[6].y() = DBL_MAX;
    EXPECT_NE(Refusal(mesh, repair).find("found 1.79769e+308"),
              std::string::npos);
    // Nobody uses it.
    mesh = MakeBox({-1, -1, -1}, {1, 1, 1});
    mesh.vertices.emplace_back(DBL_MAX, 0, 0);
    EXPECT_EQ(Refusal(mesh, repair), "accepted");
  }
  const TriangleMesh large = Scaled(MakeBox({-1, -1, -1}, {1, 1, 1}), 0.9e80);
  EXPECT_NE(Refusal(large, Repair::kReject)
                .find("expected a diagonal between 1e-80 and 1e+80"),
            std::string::npos);
}

// The distance to a unit box along an axis and along a diagonal.
TEST(Range, OfQueriesIsAllDoubles) {
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  const EuclideanMetric euclidean(TakeAsContactSpace(box));
  const PhongMetric phong = testing::UnsmoothedPhong(TakeAsContactSpace(box));
  for (const double x : {1e10, 1e100, 1e155, 1e200, 1e300, 1e307, DBL_MAX}) {
    for (const Vector3d& q : {Vector3d(x, 0, 0), Vector3d(-x, x, x)}) {
      for (const PenetrationResult& result :
           {euclidean.Query(q), phong.Query(q)}) {
        const double length = (q / x).norm();
        EXPECT_EQ(result.status, QueryStatus::kOk);
        EXPECT_FALSE(result.inside);
        EXPECT_LT((result.direction - q / x / length).norm(), 1e-9) << x;
        EXPECT_EQ(result.gradient, result.direction);
        // Of all doubles the nearest, where there is no larger one.
        const double ratio = result.signed_distance / x;
        EXPECT_NEAR(ratio, std::min(length, DBL_MAX / x), 1e-9) << x;
      }
    }
  }
}

}  // namespace
}  // namespace phongpd
