// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TriangleMesh Box(const Vector3d& center, const Vector3d& size) {
  return MakeBox(center - 0.5 * size, center + 0.5 * size);
}

// A cube among a wall and a post that meet, and a box out of reach.
Workspace Crowd() {
  Workspace workspace;
  workspace.robot = MakeSolid(Box({0, 0, 0}, {0.2, 0.2, 0.2}), "robot");
  workspace.obstacles = {MakeSolid(Box({0, 0, 0}, {0.2, 1, 1}), "wall"),
                         MakeSolid(Box({0.2, 0, 0}, {0.4, 0.4, 2}), "post"),
                         MakeSolid(Box({5, 0, 0}, {1, 1, 1}), "far")};
  workspace.bounds = {{-2, -2, -2}, {2, 2, 2}};
  return workspace;
}

TEST(Diagnosis, AgreesWithFclOnWhatIsMet) {
  const Workspace workspace = Crowd();
  std::mt19937_64 random(4);
  int met = 0, both = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d q =
        RandomPoint({{-0.6, -0.8, -1.4}, {0.8, 0.8, 1.4}}, &random);
    std::string expected, found;
    for (const Solid& obstacle : workspace.obstacles) {
      const CollisionOracle oracle(workspace.robot, obstacle);
      if (oracle.Collides(q)) expected += obstacle.name() + ' ';
    }
    const Diagnosis diagnosis = Diagnose(workspace, q);
    for (const auto& contact : diagnosis.contacts) found += contact.name + ' ';
    EXPECT_EQ(found, expected) << q.transpose();
    EXPECT_EQ(diagnosis.IsFree(), expected.empty());
    met += !expected.empty();
    both += expected == "wall post ";
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(both, 15);
}

TEST(Diagnosis, SaysWhatIsWrongInOneSentence) {
  const Workspace workspace = Crowd();
  const auto text = [&](const Vector3d& q) {
    return Diagnose(workspace, q).Text("goal");
  };
  EXPECT_EQ(text({-1, 0, 0}), "");
  EXPECT_EQ(text({-0.0625, 0, 0.25}),
            "goal (-0.0625,0,0.25) is at most 0.138 deep in wall, at most "
            "0.0375 deep in post");
  EXPECT_EQ(text({0.25, 0, 0.9}),
            "goal (0.25,0,0.9) is at most 0.2 deep in post");
  EXPECT_EQ(text({-0.2, 0.3, 0}), "goal (-0.2,0.3,0) is touching wall");
  EXPECT_EQ(text({5, 0, -2}),
            "goal (5,0,-2) is not strictly within the bounds: x is 3 above the "
            "maximum 2, z is on the minimum -2");
  EXPECT_EQ(text({5, 0, 0}),
            "goal (5,0,0) is not strictly within the bounds: x is 3 above the "
            "maximum 2; it is at most 0.6 deep in far");
  EXPECT_EQ(text({0, -2.125, 0}),
            "goal (0,-2.125,0) is not strictly within the bounds: y is 0.125 "
            "below the minimum -2");
}

TEST(Diagnosis, RoundsDepthsUp) {
  Diagnosis diagnosis;
  diagnosis.contacts.resize(1);
  diagnosis.contacts[0].name = "a";
  const auto said = [&](double depth) {
    diagnosis.contacts[0].depth_at_most = depth;
    const std::string text = diagnosis.Text("q");
    const std::size_t from = text.find("most ") + 5;
    return text.substr(from, text.find(" deep") - from);
  };
  EXPECT_EQ(said(0.1), "0.1");
  EXPECT_EQ(said(0.1 + 0.2), "0.3");  // 4e-17 more than 0.3
  EXPECT_EQ(said(0.12341), "0.124");
  EXPECT_EQ(said(99.91), "100");
  EXPECT_EQ(said(1234.0), "1.24e+03");
  EXPECT_EQ(said(1.0001e-7), "1.01e-07");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-9.0, 9.0);
  for (int i = 0; i < 1000; ++i) {
    const double depth = std::pow(10.0, exponent(random));
    const double shown = std::stod(said(depth));
    EXPECT_GE(shown, depth);
    EXPECT_LE(shown, 1.0101 * depth);
  }
}

TEST(Diagnosis, NamesFiveObstaclesAndCountsTheRest) {
  Workspace workspace;
  workspace.robot = MakeSolid(Box({0, 0, 0}, {4, 4, 4}), "robot");
  for (int i = 0; i < 8; ++i) {
    workspace.obstacles.push_back(
        MakeSolid(Box({0.1 * i, 0, 0}, {1, 1, 1}), "b" + std::to_string(i)));
  }
  const Diagnosis diagnosis = Diagnose(workspace, {0, 0, 0});
  EXPECT_EQ(diagnosis.contacts.size(), 8U);
  const std::string text = diagnosis.Text("start");
  EXPECT_NE(text.find(" b4, and meets 3 more obstacles"), std::string::npos)
      << text;
  EXPECT_EQ(text.find(" b5"), std::string::npos) << text;
}

TEST(Diagnosis, RefusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Diagnose(Crowd(), {0, nan, 0}), InputError);
}

}  // namespace
}  // namespace phongpd
