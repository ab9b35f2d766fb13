// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of what turns past what, poses sampled densely and judged
// in CGAL's exact kernel, and for motions that only translate the exact oracle.
#include "constraints/rigid/rigid_judge.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "constraints/motion_oracle.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/expect_refused.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::Cube;
using testing::ExpectRefused;
using testing::RandomRotation;
using testing::RandomVoxelSolid;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using LongVector = Eigen::Matrix<long double, 3, 1>;

RobotPose At(const Vector3d& position,
             const Quaterniond& orientation = Quaterniond::Identity()) {
  RobotPose pose;
  pose.position = position;
  pose.orientation = orientation;
  return pose;
}

Quaterniond AboutZ(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

// R(t) p + q(t) in long doubles, by the formula of Rodrigues: another route
// than quaternions.
Vector3d Placed(const RigidMotion& motion, double t, const Vector3d& p) {
  const LongVector rest = motion.start()
                              .orientation.normalized()
                              .toRotationMatrix()
                              .cast<long double>() *
                          p.cast<long double>();
  const LongVector u = motion.axis().cast<long double>();
  const long double angle = static_cast<long double>(t) * motion.angle();
  const LongVector turned = std::cos(angle) * rest +
                            std::sin(angle) * u.cross(rest) +
                            (1.0L - std::cos(angle)) * u.dot(rest) * u;
  const LongVector q =
      (1.0L - t) * motion.start().position.cast<long double>() +
      static_cast<long double>(t) * motion.end().position.cast<long double>();
  return (turned + q).cast<double>();
}

TriangleMesh PlacedMesh(TriangleMesh mesh, const RigidMotion& motion,
                        double t) {
  for (Vector3d& v : mesh.vertices) v = Placed(motion, t, v);
  return mesh;
}

bool MeetExactly(const TriangleMesh& a, int i, const TriangleMesh& b, int j) {
  const auto exact = [](const TriangleMesh& mesh, int triangle) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    const auto corner = [&](std::size_t k) {
      const Vector3d& v = mesh.vertices[static_cast<std::size_t>(t[k])];
      return Kernel::Point_3(v.x(), v.y(), v.z());
    };
    return Kernel::Triangle_3(corner(0), corner(1), corner(2));
  };
  const Kernel::Triangle_3 s = exact(a, i), t = exact(b, j);
  return !s.is_degenerate() && !t.is_degenerate() && CGAL::do_intersect(s, t);
}

// Surfaces, every pair of triangles whose boxes meet.
bool MeetExactly(const TriangleMesh& a, const TriangleMesh& b) {
  const auto box = [](const TriangleMesh& mesh, const Triangle& t) {
    BoundingBox out;
    out.min = out.max = mesh.vertices[static_cast<std::size_t>(t[0])];
    for (const int k : t) {
      const Vector3d& v = mesh.vertices[static_cast<std::size_t>(k)];
      out.min = out.min.cwiseMin(v);
      out.max = out.max.cwiseMax(v);
    }
    return out;
  };
  const auto apart = [](const BoundingBox& x, const BoundingBox& y) {
    return (x.min.array() > y.max.array()).any() ||
           (y.min.array() > x.max.array()).any();
  };
  const BoundingBox whole = ComputeBounds(b);
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    const BoundingBox own = box(a, a.triangles[i]);
    if (apart(own, whole)) continue;
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      if (!apart(own, box(b, b.triangles[j])) &&
          MeetExactly(a, static_cast<int>(i), b, static_cast<int>(j))) {
        return true;
      }
    }
  }
  return false;
}

// The triangles named do meet when it says, exactly.
void ExpectWitness(const TriangleMesh& robot, const TriangleMesh& obstacle,
                   const RigidMotion& motion, const RigidCheck& check) {
  ASSERT_EQ(check.outcome, RigidOutcome::kCollides);
  ASSERT_GE(check.robot_triangle, 0);
  EXPECT_TRUE(MeetExactly(PlacedMesh(robot, motion, check.time),
                          check.robot_triangle, obstacle,
                          check.obstacle_triangle))
      << check.time;
}

// A cube of side 2 that turns a quarter in front of a wall: its edge comes out
// to √2 at 45°, which is at no simple share of the way.
RigidMotion QuarterTurn(double begin) {
  return {At(Vector3d::Zero(), AboutZ(begin)),
          At(Vector3d::Zero(), AboutZ(begin + 0.5 * kPi))};
}

TEST(RigidJudge, KnowsACubeThatTurnsPastAWallDownToItsResolution) {
  const TriangleMesh cube = Cube(2.0);
  for (const double gap : {0.3, 1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 0.0}) {
    for (const double sign : {1.0, -1.0}) {
      for (const double begin : {-0.1, 0.0, 0.3, 0.7}) {
        const double x = std::sqrt(2.0) + sign * gap;
        const TriangleMesh wall = MakeBox({x, -5.1, -4.0}, {x + 1, 4.0, 3.7});
        const RigidJudge judge(cube, wall);
        const RigidMotion motion = QuarterTurn(begin);
        const RigidCheck check = judge.Check(motion);
        const bool is_free = sign > 0.0 && gap > 0.0;
        if (is_free) {
          EXPECT_NE(check.outcome, RigidOutcome::kCollides) << gap;
        } else {
          EXPECT_NE(check.outcome, RigidOutcome::kFree) << gap;
        }
        if (gap >= 1e-6) {
          EXPECT_NE(check.outcome, RigidOutcome::kUndecided)
              << sign * gap << ' ' << begin << ' ' << check.time;
          EXPECT_LE(check.tests, 20000);
        }
        if (check.outcome == RigidOutcome::kCollides) {
          ExpectWitness(cube, wall, motion, check);
        }
      }
    }
  }
}

// The same from anywhere in space, in other units, turned.
TEST(RigidJudge, SaysTheSameFarAwayTinyAndTurned) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 60; ++i) {
    const double offset = i % 3 == 0 ? 0.0 : 1e6;
    const double unit = i % 2 == 0 ? 1.0 : 1e-6;
    const Matrix3d rotation = RandomRotation(&random);
    const Quaterniond turned(rotation);
    const Vector3d at = unit * offset * rotation.col(0);
    const double gap = i % 4 < 2 ? 1e-5 : -1e-5;
    const double x = std::sqrt(2.0) + gap;
    TriangleMesh wall = MakeBox({x, -5.1, -4.0}, {x + 1.0, 4.0, 3.7});
    for (Vector3d& v : wall.vertices) v = unit * (rotation * v) + at;
    const RigidJudge judge(Scaled(Cube(2.0), unit), wall);
    const RigidMotion motion(
        At(at, (turned * AboutZ(0.1)).normalized()),
        At(at, (turned * AboutZ(0.1 + 0.5 * kPi)).normalized()));
    const RigidCheck check = judge.Check(motion);
    EXPECT_EQ(check.outcome,
              gap > 0.0 ? RigidOutcome::kFree : RigidOutcome::kCollides)
        << i;
  }
}

// A bar that turns whole: both ends of its way are far from the post.
TEST(RigidJudge, SeesAWholeTurn) {
  const TriangleMesh bar = MakeBox({0.0, -0.01, -0.01}, {2.0, 0.01, 0.01});
  for (const double place : {0.4, 1.7, 2.9, -2.2}) {
    const auto post = [&](double radius) {
      const Vector3d p(radius * std::cos(place), radius * std::sin(place), 0.0);
      const Vector3d half(1e-4, 1e-4, 1.0);
      return MakeBox(p - half, p + half);
    };
    const RigidMotion whole = RigidMotion::Turning(
        At(Vector3d::Zero()), Vector3d::Zero(), {0.0, 0.0, 2.0 * kPi});
    const RigidCheck hit = RigidJudge(bar, post(1.9)).Check(whole);
    EXPECT_EQ(hit.outcome, RigidOutcome::kCollides);
    const double angle = place < 0.0 ? place + 2.0 * kPi : place;
    EXPECT_NEAR(hit.time, angle / (2.0 * kPi), 0.01);
    EXPECT_TRUE(RigidJudge(bar, post(2.001)).Check(whole).IsFree());
    // From pose to pose it does not turn at all.
    const RigidMotion still(At(Vector3d::Zero()), whole.end());
    EXPECT_TRUE(RigidJudge(bar, post(1.9)).Check(still).IsFree());
  }
}

TEST(RigidJudge, JudgesAPoseAsAMotionOfNoLength) {
  const RigidJudge judge(Cube(2.0), Cube(2.0));
  const auto check = [&](const Vector3d& q) {
    return judge.Check({At(q, AboutZ(0.25 * kPi)), At(q, AboutZ(0.25 * kPi))})
        .outcome;
  };
  const double edge = 1.0 + std::sqrt(2.0);
  EXPECT_EQ(check({edge + 1e-6, 0.2, 0.3}), RigidOutcome::kFree);
  EXPECT_EQ(check({edge - 1e-6, 0.2, 0.3}), RigidOutcome::kCollides);
  EXPECT_NE(check({edge, 0.2, 0.3}), RigidOutcome::kFree);
}

TEST(RigidJudge, CallsNothingFreeThatTouches) {
  const RigidJudge judge(Cube(2.0), Cube(2.0));
  const auto check = [&](const Vector3d& a, const Vector3d& b) {
    return judge.Check({At(a), At(b)});
  };
  // Faces that slide on each other, edges and corners that pass.
  EXPECT_FALSE(check({-3, 0, 2}, {3, 0.3, 2}).IsFree());
  EXPECT_FALSE(check({-3, 2, 2}, {3, 2, 2}).IsFree());
  EXPECT_FALSE(check({2, 2, -4}, {2, 2, 4}).IsFree());
  EXPECT_FALSE(check({2, 2, 5}, {2, 2, 2}).IsFree());
  EXPECT_TRUE(check({-3, 0, 2.00001}, {3, 0.3, 2.00001}).IsFree());
  // Edges that cross in one point on the way, seen in the plane.
  const RigidCheck cross =
      RigidJudge(Cube(2.0), Cube(2.0))
          .Check({At({2, 0, 3}, AboutZ(0.3)), At({2, 0, 2}, AboutZ(0.3))});
  EXPECT_FALSE(cross.IsFree());
}

TEST(RigidJudge, KnowsWhoIsInsideOfWhom) {
  const TriangleMesh small = Cube(0.5), large = Cube(4.0);
  const RigidMotion motion(At({-0.5, 0, 0}), At({0.5, 0, 0}, AboutZ(1.0)));
  for (const bool swap : {false, true}) {
    const RigidCheck check =
        RigidJudge(swap ? large : small, swap ? small : large).Check(motion);
    EXPECT_EQ(check.outcome, RigidOutcome::kCollides);
    EXPECT_EQ(check.robot_triangle, -1);
    EXPECT_EQ(check.time, 0.0);
    // A room: faces turned over, a box with a cavity, or one without a lid.
    TriangleMesh room = Reversed(large);
    const auto in = [&](const TriangleMesh& around) {
      return RigidJudge(swap ? around : small, swap ? small : around)
          .Check(motion)
          .outcome;
    };
    EXPECT_EQ(in(room), RigidOutcome::kFree);
    EXPECT_EQ(in(MakeBoxShell({-3, -3, -3}, {3, 3, 3}, 1.0)),
              RigidOutcome::kFree);
    room = large;
    room.triangles.pop_back();
    EXPECT_EQ(in(room), RigidOutcome::kFree);
  }
  // A part without a lid that is inside of a solid, and a sheet.
  TriangleMesh sheet = small;
  sheet.triangles.resize(1);
  EXPECT_EQ(RigidJudge(sheet, large).Check(motion).outcome,
            RigidOutcome::kCollides);
}

TEST(RigidJudge, NamesTheMeshesAndTrianglesThatMeet) {
  std::vector<TriangleMesh> robot, obstacles;
  for (int i = 0; i < 3; ++i) {
    robot.push_back(Translated(Cube(1.0), {0.0, 3.0 * i, 0.0}));
    obstacles.push_back(
        Translated(MakeUvBall(0.9, 9, 7), {4.0, 3.0 * i - 9.0, 0.0}));
  }
  // Only the first of the robot's gets to the last of the others.
  const RigidJudge judge(robot, obstacles);
  const RigidMotion motion(At(Vector3d::Zero()),
                           At({4.3, -3.0, 0.2}, AboutZ(0.1)));
  const RigidCheck check = judge.Check(motion);
  ASSERT_EQ(check.outcome, RigidOutcome::kCollides);
  EXPECT_EQ(check.robot_mesh, 0);
  EXPECT_EQ(check.obstacle_mesh, 2);
  ExpectWitness(robot[0], obstacles[2], motion, check);
}

struct Tally {
  long cases = 0, free = 0, undecided = 0, wrong_free = 0, wrong_hit = 0;
};

// Against `poses` sampled on the way, all in the exact kernel.
void Compare(const RigidJudge& judge, const TriangleMesh& robot,
             const TriangleMesh& obstacle, const RigidMotion& motion, int poses,
             Tally* tally) {
  const RigidCheck check = judge.Check(motion);
  ++tally->cases;
  if (check.outcome == RigidOutcome::kUndecided) ++tally->undecided;
  if (check.outcome == RigidOutcome::kCollides && check.robot_triangle >= 0 &&
      !MeetExactly(PlacedMesh(robot, motion, check.time), check.robot_triangle,
                   obstacle, check.obstacle_triangle)) {
    ++tally->wrong_hit;
  }
  if (!check.IsFree()) return;
  ++tally->free;
  for (int k = 0; k <= poses; ++k) {
    const double t = static_cast<double>(k) / poses;
    if (MeetExactly(PlacedMesh(robot, motion, t), obstacle)) {
      ++tally->wrong_free;
      ADD_FAILURE() << "free, but collides at " << t;
      return;
    }
  }
}

RigidMotion RandomMotion(double spread, double turn, std::mt19937_64* random) {
  std::uniform_real_distribution<double> place(-spread, spread);
  const Vector3d a(place(*random), place(*random), place(*random));
  const Vector3d b(place(*random), place(*random), place(*random));
  const Vector3d axis = RandomRotation(random).col(0);
  std::uniform_real_distribution<double> angle(0.0, turn);
  return RigidMotion::Turning(At(a, Quaterniond(RandomRotation(random))), b,
                              angle(*random) * axis);
}

TEST(RigidJudge, CallsNoRandomMotionFreeThatAnExactPoseRefutes) {
  std::mt19937_64 random(7);
  Tally tally;
  const std::vector<PairKind>& kinds = AllPairKinds();
  const long pairs = testing::CampaignCases(40, 400);
  for (long i = 0; i < pairs; ++i) {
    TriangleMesh robot, obstacle;
    if (i % 2 == 0) {
      robot = RandomVoxelSolid(2, 0.6, &random);
      obstacle = RandomVoxelSolid(3, 0.5, &random);
    } else {
      const SolidPair pair =
          MakeRandomPair(kinds[static_cast<std::size_t>(i) % kinds.size()],
                         static_cast<std::uint64_t>(i));
      robot = pair.robot;
      obstacle = pair.obstacle;
      if (robot.triangles.size() * obstacle.triangles.size() > 20000) continue;
    }
    const double spread = 0.3 * ComputeBounds(robot).Diagonal() +
                          0.5 * ComputeBounds(obstacle).Diagonal();
    const RigidJudge judge(robot, obstacle);
    for (int k = 0; k < 60; ++k) {
      Compare(judge, robot, obstacle,
              RandomMotion(spread, k % 5 == 0 ? 2.0 * kPi : 1.0, &random), 60,
              &tally);
    }
    Compare(judge, robot, obstacle, RandomMotion(spread, 0.3, &random), 10'000,
            &tally);
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_GT(tally.free, tally.cases / 10);
  EXPECT_LT(tally.free, tally.cases * 9 / 10);
  EXPECT_LE(tally.undecided, tally.cases / 1000);
}

// From contact to contact, where most motions graze.
TEST(RigidJudge, CallsNoGrazingMotionFreeThatAnExactPoseRefutes) {
  std::mt19937_64 random(8);
  Tally tally;
  const long pairs = testing::CampaignCases(15, 150);
  for (long i = 0; i < pairs; ++i) {
    const TriangleMesh robot = RandomVoxelSolid(2, 0.6, &random);
    const TriangleMesh obstacle = RandomVoxelSolid(3, 0.5, &random);
    const RigidJudge judge(robot, obstacle);
    const double spread = 3.0;
    for (int k = 0; k < 100; ++k) {
      // Pushed on from free until no longer so, by halving.
      const RigidMotion way = RandomMotion(spread, 2.0, &random);
      const auto upto = [&](double t) {
        return RigidMotion::Turning(way.start(), way.At(t).position,
                                    t * way.turn());
      };
      double low = 0.0, high = 1.0;
      if (judge.Check(way).IsFree() || !judge.Check(upto(0.0)).IsFree()) {
        continue;
      }
      for (int step = 0; step < 26; ++step) {
        const double t = 0.5 * (low + high);
        (judge.Check(upto(t)).IsFree() ? low : high) = t;
      }
      Compare(judge, robot, obstacle, upto(low), 300, &tally);
      // And sideways from there.
      const RobotPose contact = way.At(low);
      const RigidMotion side = RigidMotion::Turning(
          contact, contact.position + 0.1 * RandomRotation(&random).col(0),
          0.1 * RandomRotation(&random).col(1));
      Compare(judge, robot, obstacle, side, 300, &tally);
    }
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_GE(tally.cases, 200);
  EXPECT_GT(tally.free, tally.cases / 2);
}

// Needles and slivers of any direction, 1e-7 thin.
TEST(RigidJudge, JudgesNeedles) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  Tally tally;
  for (int i = 0; i < 300; ++i) {
    const auto needles = [&] {
      TriangleMesh mesh;
      for (int k = 0; k < 4; ++k) {
        const Vector3d a(place(random), place(random), place(random));
        const Vector3d b(place(random), place(random), place(random));
        const Vector3d aside = 1e-7 * RandomRotation(&random).col(0);
        const Vector3d c = k % 2 == 0 ? a : Vector3d(0.5 * (a + b));
        mesh.vertices.insert(mesh.vertices.end(), {a, b, Vector3d(c + aside)});
        mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
      }
      return mesh;
    };
    const TriangleMesh robot = needles(), obstacle = needles();
    const RigidJudge judge(robot, obstacle);
    for (int k = 0; k < 10; ++k) {
      const RigidMotion motion = RandomMotion(1.0, 1.0, &random);
      Compare(judge, robot, obstacle, motion, 200, &tally);
    }
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_GT(tally.free, 300);
  EXPECT_LT(tally.free, 2700);
}

TEST(RigidJudge, AgreesWithTheExactOracleOnTranslations) {
  std::mt19937_64 random(10);
  long cases = 0, undecided = 0, free = 0;
  for (int i = 0; i < 40; ++i) {
    // Half of them in general position, half on a lattice.
    TriangleMesh a = RandomVoxelSolid(3, 0.5, &random);
    TriangleMesh b = RandomVoxelSolid(3, 0.6, &random);
    const bool is_general = i % 2 == 0;
    if (is_general) {
      a = Rotated(a, RandomRotation(&random));
      b = Rotated(b, RandomRotation(&random));
    }
    const RigidJudge judge(a, b);
    const MotionOracle oracle(MakeSolid(a, "a"), MakeSolid(b, "b"));
    for (int k = 0; k < 100; ++k) {
      std::uniform_real_distribution<double> place(-4.0, 4.0);
      Vector3d p(place(random), place(random), place(random));
      Vector3d q(place(random), place(random), place(random));
      if (!is_general && k % 2 == 0) {
        p = p.array().round();
        q = q.array().round();
      }
      const RigidCheck check = judge.Check({At(p), At(q)});
      const bool collides = oracle.Collides(p, q);
      ++cases;
      if (check.IsFree()) {
        ++free;
        EXPECT_FALSE(collides) << i << ' ' << k;
      }
      if (check.outcome == RigidOutcome::kCollides) {
        EXPECT_TRUE(collides);
      }
      if (check.outcome == RigidOutcome::kUndecided && is_general) ++undecided;
    }
  }
  EXPECT_EQ(cases, 4000);
  EXPECT_GT(free, 500);
  EXPECT_LE(undecided, 4);
}

TEST(RigidJudge, IsUndecidedWhereItMayLookNoFurther) {
  const RigidJudge judge(Cube(2.0), MakeIcoBall(1.0, 2));
  const RigidMotion motion(At({3.0, 0.0, 0.0}), At({-3.0, 2.4, 0.3}));
  const RigidCheck check = judge.Check(motion, 5);
  EXPECT_EQ(check.outcome, RigidOutcome::kUndecided);
  EXPECT_EQ(check.tests, 5);
  EXPECT_EQ(judge.Check(motion, 0).outcome, RigidOutcome::kUndecided);
  EXPECT_NE(judge.Check(motion).outcome, RigidOutcome::kUndecided);
}

TEST(RigidJudge, RefusesWhatIsNoMesh) {
  const TriangleMesh cube = Cube(1.0);
  ExpectRefused([&] { RigidJudge(TriangleMesh(), cube); },
                "rigid judge: robot: expected triangles, found none");
  ExpectRefused([&] { RigidJudge({cube}, std::vector<TriangleMesh>()); },
                "expected a mesh of the obstacle, found none");
  TriangleMesh bad = cube;
  bad.triangles[2][1] = 99;
  ExpectRefused(
      [&] {
        RigidJudge({cube}, {cube, bad});
      },
      "rigid judge: obstacle, mesh 1: expected indices of its 8 "
      "vertices, found 1 others");
  bad = cube;
  bad.vertices[3][0] = std::numeric_limits<double>::quiet_NaN();
  ExpectRefused([&] { RigidJudge(bad, cube); },
                "expected finite coordinates, found 1 vertices");
  ExpectRefused([&] { RigidJudge(Scaled(cube, 1e90), cube); }, "1e+80");
  const RigidJudge judge(cube, cube);
  ExpectRefused(
      [&] {
        judge.Check({At({1e300, 0, 0}), At({0, 0, 0})});
      },
      "expected a motion within 1e100 sizes of the meshes, found one to "
      "1e+300");
}

// Points, segments and a single triangle move, too.
TEST(RigidJudge, JudgesRobotsWithoutSize) {
  TriangleMesh point;
  point.vertices = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  point.triangles = {{0, 1, 2}};
  const RigidJudge judge(point, Cube(2.0));
  EXPECT_TRUE(judge.Check({At({-3, 0, 1.001}), At({3, 0, 1.001})}).IsFree());
  EXPECT_FALSE(judge.Check({At({-3, 0, 0.5}), At({3, 0, 0.5})}).IsFree());
  EXPECT_EQ(judge.Check({At({-0.3, 0, 0.5}), At({0.3, 0, 0.5})}).outcome,
            RigidOutcome::kCollides);
}

}  // namespace
}  // namespace phongpd
