// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/motion_oracle.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/translated_triangles.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/oracle_of.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::Corners;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Facet = Kernel::Triangle_3;

Point Exact(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Another route: B against the eight facets of the prism that A sweeps, and
// against the three tetrahedra that fill it.
bool MeetsPrism(const Corners& a, const Corners& b, const Vector3d& p,
                const Vector3d& p2) {
  const Facet target(Exact(b[0]), Exact(b[1]), Exact(b[2]));
  std::vector<Point> low, high;
  for (const Vector3d& v : a) {
    low.push_back(Exact(v) + (Exact(p) - CGAL::ORIGIN));
    high.push_back(Exact(v) + (Exact(p2) - CGAL::ORIGIN));
  }
  const auto meets = [&](const Point& u, const Point& v, const Point& w) {
    return !CGAL::collinear(u, v, w) &&
           CGAL::do_intersect(Facet(u, v, w), target);
  };
  if (meets(low[0], low[1], low[2]) || meets(high[0], high[1], high[2])) {
    return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (meets(low[i], low[j], high[j]) || meets(low[i], high[j], high[i])) {
      return true;
    }
  }
  const std::size_t tetrahedra[3][4] = {
      {0, 1, 2, 5}, {0, 1, 4, 5}, {0, 3, 4, 5}};
  const auto corner = [&](std::size_t i) {
    return i < 3 ? low[i] : high[i - 3];
  };
  for (const auto& t : tetrahedra) {
    const Kernel::Tetrahedron_3 part(corner(t[0]), corner(t[1]), corner(t[2]),
                                     corner(t[3]));
    if (!part.is_degenerate() && !part.has_on_unbounded_side(target[0])) {
      return true;
    }
  }
  return false;
}

// Small integers, so that most cases are degenerate in some way; or tenths,
// whose differences are not exact.
Vector3d LatticePoint(int range, double step, std::mt19937_64* random) {
  std::uniform_int_distribution<int> digit(-range, range);
  const int x = digit(*random), y = digit(*random), z = digit(*random);
  return step * Vector3d(x, y, z);
}

Corners LatticeTriangle(int range, double step, std::mt19937_64* random) {
  for (;;) {
    const Corners t = {LatticePoint(range, step, random),
                       LatticePoint(range, step, random),
                       LatticePoint(range, step, random)};
    if (!internal::IsDegenerate(t)) return t;
  }
}

TEST(MovingTriangles, MeetWhenThePrismThatOneSweepsMeetsTheOther) {
  std::mt19937_64 random(7);
  long meeting = 0;
  const int cases = static_cast<int>(testing::CampaignCases(3000, 200000));
  for (int i = 0; i < cases; ++i) {
    const int range = 1 + i % 4;
    const double step = i % 2 == 0 ? 1.0 : 0.1;
    const Corners a = LatticeTriangle(range, step, &random);
    Corners b = LatticeTriangle(range, step, &random);
    const Vector3d p = LatticePoint(range, step, &random);
    const Vector3d p2 = i % 5 == 0 ? p : LatticePoint(range, step, &random);
    if (i % 3 == 0) {  // all in one plane
      b = {a[0] + p, a[1] + p2, a[2] + p};
      if (internal::IsDegenerate(b)) continue;
    }
    const bool truth = MeetsPrism(a, b, p, p2);
    EXPECT_EQ(internal::MeetWhileMoving(a, b, p, p2), truth) << "case " << i;
    meeting += truth ? 1 : 0;
  }
  EXPECT_GT(meeting, cases / 4);
  EXPECT_LT(meeting, cases);
}

TEST(MovingTriangles, WindingNumbersAreThoseOfSolidAngles) {
  std::mt19937_64 random(8);
  for (const TriangleMesh& mesh :
       {MakeTorus(1.0, 0.4, 12, 8), MakeU(2.0, 0.4, 1.0)}) {
    const BoundingBox box = ComputeBounds(mesh);
    for (int i = 0; i < 200; ++i) {
      const Vector3d x = testing::RandomPoint(box, &random);
      const Vector3d v = testing::RandomPoint(box, &random);
      int winding = 0;
      for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](int k) {
          return mesh.vertices[static_cast<std::size_t>(
              t[static_cast<std::size_t>(k)])];
        };
        winding += internal::UpwardCrossing({corner(0), corner(1), corner(2)},
                                            v, v - x, -1);
      }
      EXPECT_NEAR(testing::WindingNumber(mesh, x), winding, 1e-6);
    }
  }
}

TriangleMesh Box(double low, double high) {
  return MakeBox(Vector3d::Constant(low), Vector3d::Constant(high));
}

// C_obj of these two cubes is [−2, 2]³: its closed form is the truth.
bool SegmentMeetsBox(const Vector3d& a, const Vector3d& b) {
  double from = 0.0, to = 1.0;
  for (int k = 0; k < 3; ++k) {
    if (a[k] == b[k]) {
      if (std::abs(a[k]) > 2.0) return false;
      continue;
    }
    const double t1 = (-2.0 - a[k]) / (b[k] - a[k]);
    const double t2 = (2.0 - a[k]) / (b[k] - a[k]);
    from = std::max(from, std::min(t1, t2));
    to = std::min(to, std::max(t1, t2));
  }
  return from <= to;
}

TEST(MotionOracle, IsExactForTwoCubesOnALattice) {
  const MotionOracle oracle = testing::OracleOf(Box(-1.0, 1.0), Box(-1.0, 1.0));
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> digit(-5, 5);
  for (int i = 0; i < 3000; ++i) {
    // Steps of a power of two along x and y: fractions are exact.
    Vector3d a(digit(random), digit(random), digit(random));
    Vector3d b = a;
    const int k = i % 3, j = (i / 3) % 3;
    b[k] += i % 2 == 0 ? 4.0 : -8.0;
    if (j != k) b[j] += i % 4 < 2 ? 4.0 : -4.0;
    EXPECT_EQ(oracle.Collides(a, b), SegmentMeetsBox(a, b))
        << a.transpose() << " to " << b.transpose();
  }
}

TEST(MotionOracle, TellsTouchingFromAnUlpBeside) {
  const MotionOracle oracle = testing::OracleOf(Box(-1.0, 1.0), Box(-1.0, 1.0));
  const double beside = std::nextafter(2.0, 3.0);
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      for (const double other : {0.0, 2.0, 1.0 / 3.0}) {  // also edge, vertex
        Vector3d a = Vector3d::Constant(other), b = a;
        a[k] = b[k] = sign * 2.0;
        b[(k + 1) % 3] = -5.0;
        EXPECT_TRUE(oracle.Collides(a));
        EXPECT_TRUE(oracle.Collides(a, b));
        a[k] = b[k] = sign * beside;
        EXPECT_FALSE(oracle.Collides(a));
        EXPECT_FALSE(oracle.Collides(a, b));
      }
    }
  }
}

TEST(MotionOracle, KnowsCavitiesAndOverlappingBodies) {
  const TriangleMesh shell = Joined(Box(-3.0, 3.0), Reversed(Box(-2.0, 2.0)));
  const TriangleMesh ball = Box(-0.5, 0.5);
  const MotionOracle cavity = testing::OracleOf(ball, shell);
  EXPECT_FALSE(cavity.Collides({0, 0, 0}, {1.25, 1.25, 1.25}));
  EXPECT_TRUE(cavity.Collides({0, 0, 0}, {1.5, 0, 0}));  // touches
  EXPECT_TRUE(cavity.Collides({0, 0, 0}, {9, 9, 9}));
  EXPECT_FALSE(cavity.Collides({9, 9, 9}, {9, 9, -9}));
  // The robot's cavity holds the obstacle.
  EXPECT_FALSE(testing::OracleOf(shell, ball).Collides({0, 0, 0}, {1, 0, 0}));
  // A body in the cavity of another one: winding 1 there, 2 nowhere.
  const MotionOracle filled =
      testing::OracleOf(Box(-0.1, 0.1), Joined(shell, Box(-1.0, 1.0)));
  EXPECT_TRUE(filled.Collides({0, 0, 0}));
  EXPECT_FALSE(filled.Collides({1.5, 0, 0}));
  // Deep in two bodies that overlap, no surface near.
  const MotionOracle twice =
      testing::OracleOf(Box(-0.1, 0.1), Joined(Box(-2.0, 1.0), Box(-1.0, 2.0)));
  EXPECT_TRUE(twice.Collides({0, 0, 0}));
  EXPECT_TRUE(twice.Collides({1.5, 1.5, 1.5}));
  EXPECT_FALSE(twice.Collides({1.5, 1.5, -1.5}));
}

TEST(MotionOracle, SaysWhereSolidsMeetFirst) {
  const MotionOracle oracle = testing::OracleOf(Box(-1.0, 1.0), Box(-1.0, 1.0));
  const MotionMeeting meeting = oracle.FirstMeeting({-6, 0, 0}, {2, 0, 0});
  EXPECT_TRUE(meeting.found);
  EXPECT_NEAR(meeting.fraction, 0.5, 1e-14);
  EXPECT_GE(meeting.robot_triangle, 0);
  EXPECT_EQ(oracle.FirstMeeting({0.3, 0, 0}, {9, 0, 0}).fraction, 0.0);
  EXPECT_FALSE(oracle.FirstMeeting({-6, 3, 0}, {2, 3, 0}).found);
  const MotionMeeting turned = oracle.FirstMeeting({-6, -7, -8}, {2, 3, 5});
  EXPECT_NEAR(turned.fraction, 0.5, 1e-14);
}

TEST(MotionOracle, RefusesWhatIsNoPlaceOrSolid) {
  const Solid box = MakeSolid(Box(0.0, 1.0), "box");
  EXPECT_THROW(MotionOracle(box, Solid()), InputError);
  EXPECT_THROW(MotionOracle(Solid(), box), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MotionOracle(box, box).Collides({0, nan, 0}), InputError);
}

// Coordinates that intervals cannot hold go to the rationals.
TEST(MotionOracle, IsExactAtTheEndsOfTheRange) {
  for (const double scale : {1e-80, 1e-30, 1e30, 1e79}) {
    const double k = std::ldexp(1.0, std::ilogb(scale));
    const TriangleMesh cube = Scaled(Box(-1.0, 1.0), k);
    const MotionOracle oracle = testing::OracleOf(cube, cube);
    EXPECT_TRUE(oracle.Collides(k * Vector3d(2, -5, 0), k * Vector3d(2, 5, 0)));
    EXPECT_FALSE(oracle.Collides(k * Vector3d(std::nextafter(2.0, 3.0), -5, 0),
                                 k * Vector3d(std::nextafter(2.0, 3.0), 5, 0)));
  }
}

// Some motion within `distance` of this one that meets the obstacle?
bool MeetsNearby(const MotionOracle& oracle, const Vector3d& a,
                 const Vector3d& b, double distance) {
  for (int k = 0; k < 27; ++k) {
    const Vector3d v = distance * Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (oracle.Collides(a + v, b + v)) return true;
  }
  return false;
}

// The judge on contact spaces and this one share neither predicates nor data.
// They may differ only where the contact space was rounded.
TEST(MotionOracleCampaign, AgreesWithTheContactSpaceOfRandomPairs) {
  const long segments = testing::CampaignCases(150, 10000);
  const std::uint64_t seeds = testing::IsLongCampaign() ? 8 : 5;
  testing::CampaignRow row;
  row.item = "verification";
  row.subject = "random pairs and segments, originals against contact space";
  row.seed = 5;
  std::mt19937_64 random(row.seed);
  long free = 0, within_rounding = 0;
  for (const PairKind kind : AllPairKinds()) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const SolidPair pair = MakeRandomPair(kind, seed);
      const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
      const FreeSpace judge({space});
      const MotionOracle oracle = testing::OracleOf(pair.robot, pair.obstacle);
      BoundingBox box = ComputeBounds(space.mesh());
      const double diagonal = box.Diagonal();
      box.min.array() -= 0.2 * diagonal;
      box.max.array() += 0.2 * diagonal;
      double largest = 0.0;
      for (const TriangleMesh* mesh : {&pair.robot, &pair.obstacle}) {
        const BoundingBox b = ComputeBounds(*mesh);
        largest += b.min.cwiseAbs().cwiseMax(b.max.cwiseAbs()).maxCoeff();
      }
      const double rounding = 4.0 * space.report().grid_step + 4e-15 * largest;
      for (long i = 0; i < segments; ++i) {
        Vector3d a = testing::RandomPoint(box, &random);
        Vector3d b = testing::RandomPoint(box, &random);
        if (i % 2 == 0) {  // grazing: along the surface, 1 to 1e-15 L above it
          const auto at = testing::RandomSurfacePoint(space.mesh(), &random);
          a = at.position + std::pow(10.0, -static_cast<double>(i / 2 % 16)) *
                                diagonal * at.normal;
          b = a + 0.02 * at.normal.cross(b - a);
        }
        const bool is_free = judge.IsFree(a, b);
        ++row.cases;
        free += is_free ? 1 : 0;
        if (is_free != oracle.Collides(a, b)) continue;
        const bool is_close = is_free ? judge.Clearance(a, b) <= rounding
                                      : MeetsNearby(oracle, a, b, rounding);
        ++(is_close ? within_rounding : row.failures);
        EXPECT_TRUE(is_close) << Name(kind) << " " << seed << ", segment " << i
                              << ": space says " << (is_free ? "free" : "hit");
      }
    }
  }
  EXPECT_GT(free, row.cases / 10);
  EXPECT_LT(within_rounding, row.cases / 5);
  ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
