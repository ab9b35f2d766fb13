// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/ompl_app_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/pi.h"
#include "problems/meshes/any_mesh.h"
#include "problems/scenes/scene_source.h"
#include "tests/problems/meshes/mesh_files.h"
#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Block;

constexpr char kProblem[] =
    "# a comment\n[problem]\nname = block\nrobot = robot.off\n"
    "world = world.off\nstart.x = 1\nstart.y = -2\nstart.z=3.5\n"
    "start.theta = 1.5707963267948966\nstart.axis.x = 0\nstart.axis.y = 0\n"
    "start.axis.z = 2\ngoal.x = 4 # of the goal\ngoal.y = 5\ngoal.z = 6\n"
    "goal.theta = 0\nvolume.min.x = -9\nvolume.min.y = -8\n"
    "volume.min.z = -7\nvolume.max.x = 9\nvolume.max.y = 8\n"
    "volume.max.z = 7\nsampler=obstacle_based\n\n[benchmark]\n"
    "time_limit=30.0\n\n[planner]\nrrt.range=10\nstart.x = 77\n";

class OmplAppProblem : public testing::TemporaryFolder {
 protected:
  void SetUp() override {
    testing::TemporaryFolder::SetUp();
    WriteMesh(Block(), At("robot.off"));
    WriteMesh(Block(), At("world.off"));
  }

  TurningScene Read(const std::string& text) const {
    return ParseOmplAppProblem(text, At("block.cfg"));
  }

  static std::string With(const std::string& line, const std::string& other) {
    std::string text = kProblem;
    return text.replace(text.find(line), line.size(), other);
  }

  void ExpectRefused(const std::string& text, const std::string& sentence) {
    EXPECT_EQ(testing::ErrorOf([&] { Read(text); }, "read"),
              At("block.cfg") + ": " + sentence);
  }
};

TEST_F(OmplAppProblem, TurnsAboutTheMeanOfItsVertices) {
  const TurningScene scene = Read(kProblem);
  EXPECT_EQ(scene.name, "block");
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& v : scene.robot.vertices) mean += v;
  EXPECT_LE(mean.norm(), 1e-14);
  const BoundingBox robot = ComputeBounds(scene.robot);
  EXPECT_LE((robot.max - Vector3d(1.0, 0.25, 2.0)).norm(), 1e-14);
  ASSERT_EQ(scene.obstacles.size(), 1u);
  EXPECT_EQ(ComputeBounds(scene.obstacles[0].mesh).max,
            Vector3d(1.5, 0.75, 3.0));
  EXPECT_EQ(scene.start.position, Vector3d(1, -2, 3.5));
  EXPECT_LE(
      (scene.start.orientation * Vector3d::UnitX() - Vector3d::UnitY()).norm(),
      1e-15);
  EXPECT_EQ(scene.goal.position, Vector3d(4, 5, 6));
  EXPECT_EQ(scene.goal.orientation.w(), 1.0);
  EXPECT_EQ(scene.bounds.min, Vector3d(-9, -8, -7));
  EXPECT_EQ(scene.bounds.max, Vector3d(9, 8, 7));
}

// The block has its edges along the axes; a corner's mean is over its normals.
TEST_F(OmplAppProblem, TakesColladaAsAssimpTurnsAndScalesIt) {
  Put("world.dae", testing::Collada(Block(),
                                    "<unit name=\"inch\" meter=\"0.5\"/>"
                                    "<up_axis>Z_UP</up_axis>"));
  Put("robot.dae", testing::Collada(Block(), "<up_axis>Z_UP</up_axis>"));
  std::string text = With("world.off", "world.dae");
  text.replace(text.find("robot.off"), 9, "robot.dae");
  const TurningScene scene = Read(text);
  // (x, y, z) of the file is (x, z, -y) where up is Y.
  const BoundingBox file = ComputeBounds(ReadAnyMesh(At("world.dae")));
  const BoundingBox world = ComputeBounds(scene.obstacles[0].mesh);
  EXPECT_LE((world.min - 0.5 * Vector3d(file.min[0], file.min[2], -file.max[1]))
                .norm(),
            1e-6);
  EXPECT_LE((world.max - 0.5 * Vector3d(file.max[0], file.max[2], -file.min[1]))
                .norm(),
            1e-6);
  const BoundingBox robot = ComputeBounds(scene.robot);
  EXPECT_LE((robot.max - Vector3d(1.0, 2.0, 0.25)).norm(), 1e-6);
  EXPECT_LE((robot.min + robot.max).norm(), 1e-6);
}

TEST_F(OmplAppProblem, TellsWhichMeshHasNoInside) {
  EXPECT_TRUE(Read(kProblem).warnings.empty());
  TriangleMesh open = Block();
  open.triangles.pop_back();
  WriteMesh(open, At("world.off"));
  const std::vector<std::string> warnings = Read(kProblem).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].rfind(At("world.off") + ": ", 0), 0u) << warnings[0];
  EXPECT_NE(warnings[0].find("its triangles are judged as they are"),
            std::string::npos)
      << warnings[0];
}

TEST_F(OmplAppProblem, IsASceneOfARobotThatTurns) {
  Put("block.cfg", kProblem);
  const SceneSource source(At("block.cfg"));
  EXPECT_TRUE(source.turns());
  EXPECT_FALSE(source.is_family());
  EXPECT_EQ(source.label(), "block");
  EXPECT_EQ(source.LoadTurning().obstacles.size(), 1u);
  EXPECT_EQ(source.Digest(), SceneSource(At("block.cfg")).Digest());
  EXPECT_EQ(testing::ErrorOf([&] { source.Load(); }),
            At("block.cfg") +
                ": expected a scene of a robot that translates, found a "
                "problem of OMPL.app, whose robot turns; plan takes it");
}

TEST_F(OmplAppProblem, IsToldByItsFirstSection) {
  EXPECT_TRUE(IsOmplAppProblem(kProblem));
  EXPECT_TRUE(IsOmplAppProblem("\n; of OMPL\r\n [problem]\r\n"));
  EXPECT_FALSE(IsOmplAppProblem("[planner]\n[problem]\n"));
  EXPECT_FALSE(IsOmplAppProblem("{ \"robot\": [\"problem\"] }\n[problem]\n"));
  EXPECT_FALSE(IsOmplAppProblem(""));
}

TEST_F(OmplAppProblem, RefusesWhatIsMissingOrNoNumber) {
  ExpectRefused(With("start.x = 1\n", ""),
                "start.x: expected a number, found nothing");
  ExpectRefused(With("goal.z = 6\n", ""),
                "goal.z: expected a number, found nothing");
  ExpectRefused(With("goal.theta = 0\n", "goal.theta = 1\n"),
                "goal.axis.x: expected a number, found nothing");
  ExpectRefused(With("start.axis.z = 2\n", "start.axis.z = 0\n"),
                "start.axis: expected a direction to turn about, found 0 0 0");
  ExpectRefused(
      With("volume.max.y = 8\n", "volume.max.y = -8\n"),
      "volume: expected min below max in each coordinate, found others");
  ExpectRefused(With("volume.max.z = 7\n", ""),
                "volume.max.z: expected a number, found nothing");
  ExpectRefused(With("robot = robot.off\n", "robot =\n"),
                "robot: expected a mesh file beside this one, found nothing");
  ExpectRefused(With("name = block\n", "control = kinematic_car\n"),
                "control: expected none of a rigid body, found one of another "
                "vehicle");
  for (const char* number : {"one", "nan", "inf", "1e999", "1 2"}) {
    const std::string what = testing::ErrorOf([&] {
      Read(With("start.y = -2", std::string("start.y = ") + number));
    });
    EXPECT_EQ(what.rfind(At("block.cfg") + ": start.y: expected ", 0), 0u)
        << what;
  }
}

TEST_F(OmplAppProblem, RefusesMeshesThatAreMissingOrElsewhere) {
  const std::string missing =
      testing::ErrorOf([&] { Read(With("world.off", "worlds.off")); });
  EXPECT_EQ(missing,
            At("block.cfg") + ": world: " + At("worlds.off") +
                ": expected a mesh file, found nothing; check the path");
  Put("half.dae", "<COLLADA");
  const std::string half =
      testing::ErrorOf([&] { Read(With("robot.off", "half.dae")); });
  EXPECT_EQ(half.rfind(At("block.cfg") + ": robot: " + At("half.dae"), 0), 0u)
      << half;
  const std::string outside = testing::ErrorOf([&] {
    ParseOmplAppProblem(With("robot.off", "../../etc/passwd"), At("block.cfg"),
                        folder_.string());
  });
  EXPECT_NE(outside.find("robot: expected a mesh file below the root"),
            std::string::npos)
      << outside;
}

}  // namespace
}  // namespace phongpd
