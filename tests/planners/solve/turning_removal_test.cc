// SPDX-License-Identifier: GPL-3.0-or-later
// A bayonet: a key whose bit lies across the slot below its plate, and whose
// head is above.  Truth: FCL at many moments of each way, which shares nothing
// with the judge; and what is held by construction.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "constraints/rigid/rigid_motion.h"
#include "core/solid/shrunk_solid.h"
#include "planners/solve/removal.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// A slot along x, 1.2 by 0.3, and a hole in which the shaft turns.
TriangleMesh Plate() {
  return MakeCells({-2, -0.6, -0.2, 0.2, 0.6, 2},
                   {-2, -0.2, -0.15, 0.15, 0.2, 2}, {0, 0.5},
                   {{"#####", "##.##", "#...#", "##.##", "#####"}});
}

// The bit along y, below the plate, `thick` across.
TriangleMesh Key(double thick) {
  const double t = 0.5 * thick;
  return MakeCells({-0.5, -t, -0.1, 0.1, t, 0.5}, {-0.5, -0.1, 0.1, 0.5},
                   {-0.3, -0.1, 0.7, 0.9},
                   {{".###.", ".###.", ".###."},
                    {".....", "..#..", "....."},
                    {"#####", "#####", "#####"}});
}

Solid Placed(const TriangleMesh& mesh, const Vector3d& at, const char* name) {
  return MakeSolid(Translated(mesh, at), name);
}

// Beside the rest at the end, and in none of it on the way.
void ExpectTurnsOut(const Removal& removal, const Solid& part,
                    const Solid& rest) {
  ASSERT_TRUE(removal.IsOut()) << removal.reason;
  EXPECT_TRUE(removal.needs_turns);
  EXPECT_TRUE(removal.path.empty());
  ASSERT_GE(removal.poses.size(), 2U);
  // Where it lies.
  EXPECT_EQ(removal.poses.front().position, removal.pivot);
  EXPECT_EQ(removal.poses.front().orientation.w(), 1.0);
  const Solid moved = removal.granted_least > 0.0
                          ? Shrunk(part, removal.granted_least).solid
                          : part;
  const TriangleMesh robot = Translated(moved.mesh(), -removal.pivot);
  int hits = 0;
  double turn = 0.0;
  for (std::size_t i = 0; i + 1 < removal.poses.size(); ++i) {
    const RigidMotion motion(removal.poses[i], removal.poses[i + 1]);
    turn += motion.angle();
    for (int k = 0; k <= 40; ++k) {
      const RobotPose pose = motion.At(k / 40.0);
      const Solid turned = MakeSolid(
          Rotated(robot, pose.orientation.toRotationMatrix()), "turned");
      hits += CollisionOracle(turned, rest).Collides(pose.position) ? 1 : 0;
    }
  }
  EXPECT_EQ(hits, 0);
  EXPECT_GT(turn, 1.2);  // nearly a quarter turn is least
  const RobotPose& last = removal.poses.back();
  const BoundingBox end = ComputeBounds(Translated(
      Rotated(robot, last.orientation.toRotationMatrix()), last.position));
  const BoundingBox box = ComputeBounds(rest);
  EXPECT_TRUE((end.min.array() > box.max.array()).any() ||
              (end.max.array() < box.min.array()).any());
}

TEST(TurningRemoval, TurnsABayonetOut) {
  // Far from the assembly's origin: it turns about its own middle.
  const Vector3d at(300, -200, 50);
  const Solid plate = Placed(Plate(), at, "plate");
  const Solid key = Placed(Key(0.24), at, "key");
  const Removal held = RemovePart(key, {plate});
  EXPECT_EQ(held.status, PathStatus::kInfeasibleProved);
  EXPECT_TRUE(held.needs_turns);
  RemovalOptions options;
  options.turn_seconds = 60.0;
  const Removal out = RemovePart(key, {plate}, options);
  ExpectTurnsOut(out, key, plate);
  EXPECT_EQ(out.granted_most, 0.0);
  EXPECT_GT(out.length, 1.0);
}

TEST(TurningRemoval, GrantsABitThatFillsItsSlotTheTolerance) {
  const Solid plate = Placed(Plate(), Vector3d::Zero(), "plate");
  const Solid key = Placed(Key(0.3), Vector3d::Zero(), "key");
  RemovalOptions options;
  options.turn_seconds = 1.0;
  const Removal tight = RemovePart(key, {plate}, options);
  EXPECT_EQ(tight.status, PathStatus::kTimeLimit);
  EXPECT_TRUE(tight.needs_turns);
  EXPECT_NE(tight.reason.find("no translation takes it out, proved"),
            std::string::npos)
      << tight.reason;
  EXPECT_NE(tight.reason.find("does not prove"), std::string::npos);
  options.turn_seconds = 60.0;
  options.tolerance = 0.03;
  const Removal out = RemovePart(key, {plate}, options);
  ExpectTurnsOut(out, key, plate);
  EXPECT_EQ(out.granted_least, 0.03);
  EXPECT_NEAR(out.granted_most, 0.03 * std::sqrt(3.0), 1e-12);
}

TEST(TurningRemoval, IsLookedForOnlyWhereNoPartComesOutWithout) {
  const Solid plate = Placed(Plate(), Vector3d::Zero(), "plate");
  const Solid key = Placed(Key(0.24), Vector3d::Zero(), "key");
  const Solid lid = MakeSolid(MakeBox({-2, -2, 1}, {2, 2, 1.5}), "lid");
  RemovalOptions options;
  const Disassembly held = Disassemble({key, plate, lid}, options);
  ASSERT_EQ(held.steps.size(), 1U);
  EXPECT_EQ(held.stuck.size(), 2U);
  EXPECT_TRUE(held.IsProved());
  options.turn_seconds = 60.0;
  const Disassembly out = Disassemble({key, plate, lid}, options);
  ASSERT_TRUE(out.IsComplete());
  ASSERT_EQ(out.steps.size(), 2U);
  EXPECT_EQ(out.steps[0].part, 2U);
  EXPECT_TRUE(out.steps[0].removal.poses.empty());
  EXPECT_EQ(out.steps[1].part, 0U);
  ExpectTurnsOut(out.steps[1].removal, key, plate);
}

TEST(TurningRemoval, DoesNotTurnWhatTranslates) {
  const Solid plate = Placed(Plate(), Vector3d::Zero(), "plate");
  const Solid peg = MakeSolid(MakeBox({-0.1, -0.1, -1}, {0.1, 0.1, 1}), "peg");
  RemovalOptions options;
  options.turn_seconds = 60.0;
  const Removal out = RemovePart(peg, {plate}, options);
  ASSERT_TRUE(out.IsOut());
  EXPECT_FALSE(out.needs_turns);
  EXPECT_TRUE(out.poses.empty());
  EXPECT_FALSE(out.path.empty());
}

TEST(TurningRemoval, SaysThatNothingWasFoundWhereNothingIs) {
  const Solid shell = MakeSolid(MakeVessel(4, 3, 0), "shell");
  const Solid core =
      MakeSolid(MakeBox({-1, -0.5, -0.5}, {1, 0.5, 0.5}), "core");
  RemovalOptions options;
  options.turn_seconds = 0.2;
  const Removal none = RemovePart(core, {shell}, options);
  EXPECT_EQ(none.status, PathStatus::kTimeLimit);
  EXPECT_TRUE(none.poses.empty());
  EXPECT_FALSE(none.IsOut());
  for (const double seconds : {-1.0, std::nan(""), 1e10}) {
    options.turn_seconds = seconds;
    testing::ExpectRefused([&] { RemovePart(core, {shell}, options); },
                           "turn_seconds: expected seconds in [0, 1e9]");
  }
}

}  // namespace
}  // namespace phongpd
