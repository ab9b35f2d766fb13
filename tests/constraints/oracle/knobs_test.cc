// SPDX-License-Identifier: GPL-3.0-or-later
// Approximate contact spaces against the exact ones, and operands that are no
// solids.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "constraints/oracle/collision_oracle.h"
#include "core/bounds/solid_distance.h"
#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/contact/joined_contact_spaces.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/oracle_of.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

void ExpectSound(const ContactSpaceReport& report) {
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_GT(report.volume, 0.0);
}

bool Says(const ContactSpaceReport& report, const std::string& words) {
  return std::any_of(report.warnings.begin(), report.warnings.end(),
                     [&words](const std::string& line) {
                       return line.find(words) != std::string::npos;
                     });
}

// At random points: the approximate solid is within its bound of the exact
// one, and contains it where it says so.
void ExpectWithinBound(const TriangleMesh& robot, const TriangleMesh& obstacle,
                       const ContactSpace& c, int samples) {
  ExpectSound(c.report());
  const auto oracle = testing::OracleOf<CollisionOracle>(robot, obstacle);
  const ContactSpace exact = BuildContactSpace(robot, obstacle);
  const TriangleBvh exact_tree(exact.mesh()), tree(c.mesh());
  const BoundingBox box = ComputeBounds(c.mesh());
  std::mt19937_64 random(19);
  const double bound = c.report().approximation.bound * (1 + 1e-12);
  int added = 0;
  for (int i = 0; i < samples; ++i) {
    const Vector3d q = testing::RandomPoint(box, &random);
    const bool is_in = testing::WindingNumber(c.mesh(), q) > 0.5;
    const bool is_hit = oracle.Collides(q);
    if (is_in && !is_hit) {
      ++added;
      EXPECT_LE(exact_tree.FindClosest(q).distance, bound) << q.transpose();
    }
    if (is_hit && !is_in) {
      EXPECT_FALSE(c.report().approximation.is_conservative) << q.transpose();
      EXPECT_LE(tree.FindClosest(q).distance, bound) << q.transpose();
    }
  }
  EXPECT_GT(added, 0);
}

TEST(Knobs, NoneIsExact) {
  const ContactSpace c = BuildContactSpace(Cube(1), MakeL(3, 1, 1));
  EXPECT_EQ(KindsOf(c.report().approximation), "none");
  EXPECT_EQ(c.report().approximation.bound, 0.0);
  EXPECT_TRUE(c.report().approximation.is_conservative);
  EXPECT_TRUE(c.report().warnings.empty());
}

TEST(Knobs, RobotHullContainsTheExactContactSpace) {
  const TriangleMesh robot = MakeStar(0.5, 1.2),
                     torus = MakeTorus(2, 0.6, 16, 8);
  ContactSpaceOptions options;
  options.robot_hull = true;
  const ContactSpace c = BuildContactSpace(robot, torus, options);
  EXPECT_EQ(KindsOf(c.report().approximation), "robot-hull");
  EXPECT_TRUE(c.report().approximation.is_conservative);
  ExpectWithinBound(robot, torus, c, 1500);
}

TEST(Knobs, RobotHullOfAConvexRobotChangesNothing) {
  const TriangleMesh robot = MakeCone(0.8, 1.6, 20), axes = MakeAxes(2, 0.2);
  ContactSpaceOptions options;
  options.robot_hull = true;
  const ContactSpace hull = BuildContactSpace(robot, axes, options);
  const ContactSpace exact = BuildContactSpace(robot, axes);
  EXPECT_LE(hull.report().approximation.bound, 1e-12);
  EXPECT_NEAR(hull.report().volume, exact.report().volume, 1e-9);
}

TEST(Knobs, DecimationStaysWithinItsBound) {
  const TriangleMesh robot = MakeIcoBall(0.5, 2),
                     knot = MakeKnot(1, 0.3, 48, 8);
  ContactSpaceOptions options;
  options.target_faces = 150;
  options.robot_name = "ball";
  const ContactSpace c = BuildContactSpace(robot, knot, options);
  const Approximation& a = c.report().approximation;
  EXPECT_EQ(KindsOf(a), "decimation");
  EXPECT_FALSE(a.is_conservative);
  ASSERT_EQ(a.steps.size(), 2U);
  EXPECT_EQ(a.bound, a.steps[0].bound + a.steps[1].bound);
  EXPECT_LE(a.steps[0].triangles_after, 150U);
  EXPECT_TRUE(Says(c.report(), "ball: decimated"));
  ExpectWithinBound(robot, knot, c, 1500);
}

TEST(Knobs, WrapContainsTheExactContactSpace) {
  const TriangleMesh robot = MakeStar(0.3, 0.6), u = MakeU(3, 0.5, 1);
  ContactSpaceOptions options;
  options.wrap_alpha = 0.1;
  const ContactSpace c = BuildContactSpace(robot, u, options);
  EXPECT_EQ(KindsOf(c.report().approximation), "alpha-wrap");
  EXPECT_EQ(c.report().approximation.steps.size(), 2U);
  EXPECT_TRUE(c.report().approximation.is_conservative);
  ExpectWithinBound(robot, u, c, 1500);
}

TEST(Knobs, OfSeveralSpacesAllAreNamed) {
  ContactSpaceOptions hull, wrapped;
  hull.robot_hull = true;
  wrapped.wrap_alpha = 0.1;
  TriangleMesh far = MakeU(3, 0.5, 1);
  for (Vector3d& v : far.vertices) v.x() += 20.0;
  const ContactSpace joined = JoinedContactSpaces(
      {BuildContactSpace(MakeStar(0.3, 0.6), MakeU(3, 0.5, 1), hull),
       BuildContactSpace(MakeStar(0.3, 0.6), far, wrapped),
       BuildContactSpace(Cube(1), Cube(1))});
  EXPECT_EQ(KindsOf(joined.report().approximation), "alpha-wrap+robot-hull");
}

TEST(Knobs, SeveralAreNamedTogetherAndTheirBoundsAdded) {
  ContactSpaceOptions options;
  options.wrap_alpha = 0.2;
  options.robot_hull = true;
  options.target_faces = 100;
  options.outer_shell_only = true;
  const ContactSpace c =
      BuildContactSpace(MakeStar(0.3, 0.6), MakeVessel(4, 3, 0), options);
  ExpectSound(c.report());
  const Approximation& a = c.report().approximation;
  EXPECT_EQ(KindsOf(a), "alpha-wrap+robot-hull+decimation+outer-shell");
  double sum = 0.0;
  for (const ApproximationStep& step : a.steps) sum += step.bound;
  EXPECT_EQ(a.bound, sum);
  EXPECT_GE(a.bound, 1.5);  // the vessel's cavity is filled
}

TEST(Knobs, OuterShellCountsWhatItDrops) {
  ContactSpaceOptions options;
  options.outer_shell_only = true;
  const ContactSpace c =
      BuildContactSpace(Cube(1), MakeVessel(4, 3, 0), options);
  const Approximation& a = c.report().approximation;
  EXPECT_EQ(KindsOf(a), "outer-shell");
  EXPECT_EQ(a.bound, 0.0);
  ASSERT_EQ(a.steps.size(), 1U);
  EXPECT_EQ(a.steps[0].dropped_cavities, 1);
}

TEST(BadOperands, AreRefusedByNameOrRepaired) {
  TriangleMesh crossing = MakeIcoBall(1.0, 1);
  crossing.vertices[0] *= -2.0;
  TriangleMesh open = Cube(2);
  open.triangles.pop_back();
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  for (const TriangleMesh& bad : {crossing, open, one}) {
    for (const bool is_robot : {true, false}) {
      ContactSpaceOptions options;
      (is_robot ? options.robot_name : options.obstacle_name) = "bad.off";
      const auto build = [&] {
        return is_robot ? BuildContactSpace(bad, Cube(1), options)
                        : BuildContactSpace(Cube(1), bad, options);
      };
      for (const Repair repair : {Repair::kReject, Repair::kSafe}) {
        options.repair = repair;
        const std::string what = testing::ErrorOf([&] { build(); });
        EXPECT_EQ(what.rfind("bad.off: ", 0), 0U);
      }
      options.repair = Repair::kWrap;
      options.wrap_alpha = 0.2;
      const ContactSpace c = build();
      ExpectSound(c.report());
      EXPECT_EQ(KindsOf(c.report().approximation), "alpha-wrap");
      const auto& steps = c.report().approximation.steps;
      ASSERT_EQ(steps.size(), 2U);
      EXPECT_EQ(steps[0].is_surface_bound, is_robot);
      EXPECT_EQ(steps[1].is_surface_bound, !is_robot);
      EXPECT_GT(c.report().approximation.bound, 0.0);
      EXPECT_TRUE(Says(c.report(), "bad.off: wrapped"));
    }
  }
}

TEST(BadOperands, SafeRepairGivesTheExactContactSpace) {
  TriangleMesh doubled = Joined(Cube(1), Cube(1));
  std::swap(doubled.triangles[3][0], doubled.triangles[3][1]);
  ContactSpaceOptions options;
  options.repair = Repair::kSafe;
  const ContactSpace c = BuildContactSpace(Cube(1), doubled, options);
  EXPECT_EQ(c.report().volume, 8.0);
  EXPECT_EQ(KindsOf(c.report().approximation), "none");
  EXPECT_EQ(c.report().obstacle_repair.duplicate_faces, 12U);
  EXPECT_TRUE(Says(c.report(), "obstacle: 12 duplicate faces removed"));
}

TEST(BadOperands, OfVeryDifferentSizesAreReported) {
  for (const double ratio : {1e6, 1e9}) {
    const TriangleMesh small = Scaled(MakeIcoBall(1.0, 3), 1.0 / ratio);
    const TriangleMesh large = MakeL(3, 1, 1);
    try {
      const ContactSpace c = BuildContactSpace(small, large);
      ExpectSound(c.report());
      EXPECT_TRUE(Says(c.report(), "robot: coordinates are rounded to"));
      EXPECT_NEAR(c.report().volume, SignedVolume(large), 25.0 / ratio);
    } catch (const InputError& error) {  // rounded to nonsense
      EXPECT_GT(ratio, 1e8) << error.what();
      EXPECT_NE(std::string(error.what()).find("robot"), std::string::npos);
    }
  }
  EXPECT_THROW(BuildContactSpace(Scaled(Cube(1), 1e-13), Cube(1)), InputError);
  EXPECT_THROW(BuildContactSpace(Cube(1), Scaled(Cube(1), 1e-13)), InputError);
}

TEST(BadOperands, TooThinForTheGridAreRefused) {
  // A plate of 1e-13 of its side: both faces fall onto one another.
  const TriangleMesh plate = MakeBox({0, 0, 0}, {1, 1, 1e-13});
  EXPECT_THROW(BuildContactSpace(Cube(1), plate), InputError);
}

TEST(BadOperands, FarFromTheOriginLoseWhatDoublesLose) {
  const Vector3d far(1e6, -1e6, 1e6);
  const TriangleMesh star = MakeStar(0.5, 1.2);
  const double volume = BuildContactSpace(star, Cube(2)).report().volume;
  const ContactSpace c =
      BuildContactSpace(Translated(star, far), Translated(Cube(2), -far));
  ExpectSound(c.report());
  EXPECT_NEAR(c.report().volume, volume, 1e-8 * volume);
}

}  // namespace
}  // namespace phongpd
