// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/robot_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"
#include "core/solid/mesh_check.h"
#include "problems/meshes/any_mesh.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// A cube of side 2e in the middle of a link's frame tells where that is.
constexpr double kHalf = 0.01;

std::string Cube(const std::string& link) {
  return "<link name='" + link +
         "'><collision><geometry><box size='0.02 0.02 0.02'/></geometry>"
         "</collision></link>";
}

std::string Joint(const std::string& name, const std::string& type,
                  const std::string& parent, const std::string& child,
                  const std::string& more) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" +
         parent + "'/><child link='" + child + "'/>" + more + "</joint>";
}

// In the plane z = 0: a shoulder at the origin, an upper arm of length 2, an
// elbow, a forearm of length 1.5, a slide along it, and a tip at its end.
std::string Arm() {
  return "<robot name='arm'>" + Cube("base") + Cube("upper") + Cube("fore") +
         Cube("slide") + Cube("tip") +
         Joint("shoulder", "continuous", "base", "upper",
               "<axis xyz='0 0 1'/>") +
         Joint("elbow", "revolute", "upper", "fore",
               "<origin xyz='2 0 0'/><axis xyz='0 0 3'/>"
               "<limit lower='-2' upper='2' effort='1' velocity='1'/>") +
         Joint("reach", "prismatic", "fore", "slide",
               "<origin xyz='1.5 0 0'/><limit lower='0' upper='0.5'/>") +
         Joint("end", "fixed", "slide", "tip", "<origin xyz='0 0 0.25'/>") +
         "</robot>";
}

class RobotPose : public testing::TemporaryFolder {
 protected:
  void PutArm(const std::string& text) {
    std::ofstream(At("arm.urdf")) << text;
  }

  // The middles of the links' cubes at these joint values.
  std::vector<Vector3d> Middles(const std::string& values) {
    const TriangleMesh mesh = ReadAnyMesh(At("arm.urdf@") + values, &notes_);
    std::vector<Vector3d> middles;
    for (std::size_t v = 0; v < mesh.vertices.size(); v += 8) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t k = 0; k < 8; ++k) sum += mesh.vertices[v + k];
      middles.push_back(sum / 8.0);
      for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_NEAR((mesh.vertices[v + k] - middles.back()).norm(),
                    std::sqrt(3.0) * kHalf, 1e-12);
      }
    }
    return middles;
  }

  void ExpectRefused(const std::string& values, const std::string& words) {
    const std::string what =
        testing::ErrorOf([&] { ReadAnyMesh(At("arm.urdf@") + values); });
    EXPECT_EQ(what.rfind(At("arm.urdf"), 0), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find(words), std::string::npos) << what;
  }

  std::vector<std::string> notes_;
};

TEST_F(RobotPose, PutsLinksWhereTheClosedFormOfAPlanarArmHasThem) {
  PutArm(Arm());
  for (const double a : {0.0, 0.7, -2.5, 9.0}) {
    for (const double b : {0.0, 1.1, -1.9}) {
      for (const double r : {0.0, 0.4}) {
        const std::vector<Vector3d> middles = Middles(
            "shoulder=" + std::to_string(a) + ",elbow=" + std::to_string(b) +
            ",reach=" + std::to_string(r));
        const Vector3d along(std::cos(a + b), std::sin(a + b), 0.0);
        const Vector3d elbow = 2.0 * Vector3d(std::cos(a), std::sin(a), 0.0);
        const Vector3d slide = elbow + (1.5 + r) * along;
        ASSERT_EQ(middles.size(), 5u);
        EXPECT_LE(middles[0].norm(), 1e-12);
        EXPECT_LE(middles[1].norm(), 1e-12);
        EXPECT_LE((middles[2] - elbow).norm(), 1e-12);
        EXPECT_LE((middles[3] - slide).norm(), 1e-12);
        EXPECT_LE((middles[4] - slide - Vector3d(0, 0, 0.25)).norm(), 1e-12);
      }
    }
  }
}

TEST_F(RobotPose, TurnsCubesAsWell) {
  PutArm(Arm());
  // A quarter of a turn maps a cube on itself, an eighth makes it √2 wide.
  const TriangleMesh mesh =
      ReadAnyMesh(At("arm.urdf@shoulder=") + std::to_string(std::atan(1.0)));
  double reach = 0.0;
  for (std::size_t v = 8; v < 16; ++v) {  // of the upper arm, at the origin
    reach = std::max(reach, mesh.vertices[v].x());
  }
  EXPECT_NEAR(reach, std::sqrt(2.0) * kHalf, 1e-7);
}

TEST_F(RobotPose, JointsThatAreNotNamedAreAtZeroAndAllIsTold) {
  PutArm(Arm());
  const std::vector<Vector3d> middles = Middles("");
  EXPECT_LE((middles[4] - Vector3d(3.5, 0, 0.25)).norm(), 1e-12);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_NE(notes_[0].find("5 collision shapes of 5 links at shoulder = 0, "
                           "elbow = 0, reach = 0, in the frame of 'base'"),
            std::string::npos)
      << notes_[0];
}

// Origins turn by Rz(yaw) · Ry(pitch) · Rx(roll), and axes are those of the
// joint's frame.
TEST_F(RobotPose, OriginsTurnAxes) {
  const double h = 2.0 * std::atan(1.0);  // a quarter of a turn
  PutArm("<robot>" + Cube("a") + Cube("b") + Cube("c") +
         Joint("j", "prismatic", "a", "b",
               "<origin xyz='1 2 3' rpy='" + FormatDouble(h) + " 0 " +
                   FormatDouble(h) +
                   "'/><axis xyz='0 1 0'/><limit lower='-9' upper='9'/>") +
         Joint("k", "fixed", "b", "c", "<origin xyz='1 0 0'/>") + "</robot>");
  const std::vector<Vector3d> middles = Middles("j=4");
  // Rz(90°)·Rx(90°) takes y to z and x to y.
  EXPECT_LE((middles[1] - Vector3d(1, 2, 7)).norm(), 1e-12);
  EXPECT_LE((middles[2] - Vector3d(1, 3, 7)).norm(), 1e-12);
}

TEST_F(RobotPose, MimickingJointsFollow) {
  PutArm("<robot>" + Cube("a") + Cube("b") + Cube("c") +
         Joint("left", "prismatic", "a", "b", "<limit lower='0' upper='1'/>") +
         Joint("right", "prismatic", "a", "c",
               "<limit lower='-1' upper='1'/>"
               "<mimic joint='left' multiplier='-2' offset='0.25'/>") +
         "</robot>");
  const std::vector<Vector3d> middles = Middles("left=0.5");
  EXPECT_LE((middles[1] - Vector3d(0.5, 0, 0)).norm(), 1e-12);
  EXPECT_LE((middles[2] - Vector3d(-0.75, 0, 0)).norm(), 1e-12);
  ExpectRefused("left=1",
                "joint 'right': expected a value in [-1, 1] m, "
                "found -1.75");
  ExpectRefused("right=0", "found one that mimics; set 'left'");
}

TEST_F(RobotPose, IsReadWhereverMeshesAre) {
  PutArm(Arm());
  std::ofstream(At("scene.json"))
      << R"({"robot": {"shape": {"type": "ball", "radius": 0.1, "triangles": 80}},
             "obstacles": [{"id": "arm", "mesh": "arm.urdf@elbow=1.5"}],
             "bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]},
             "start": [-5, 0, 0], "goal": [5, 0, 0]})";
  const Scene scene = SceneSource(At("scene.json"), At("")).Load();
  EXPECT_EQ(scene.workspace.obstacles[0].mesh().triangles.size(), 60u);
}

TEST_F(RobotPose, RefusesWhatItDoesNotKnowInOneLine) {
  PutArm(Arm());
  ExpectRefused("elbow=2.1",
                "joint 'elbow': expected a value in [-2, 2] rad, found 2.1");
  ExpectRefused("reach=-0.1", "expected a value in [0, 0.5] m, found -0.1");
  ExpectRefused("elbwo=1", "did you mean elbow?");
  ExpectRefused("end=1", "found a fixed one");
  ExpectRefused("elbow", "expected FILE@JOINT=VALUE");
  ExpectRefused("elbow=x", "'elbow'");
  ExpectRefused("elbow=nan", "expected a finite number");
  ExpectRefused("elbow=1,elbow=1", "expected one value, found two");
  const auto two = [](const std::string& joint) {
    return "<robot>" + Cube("a") + Cube("b") + joint + "</robot>";
  };
  PutArm(two(Joint("j", "revolute", "a", "b", "<limit lower='1' upper='2'/>")));
  ExpectRefused("", "found 0, which it has unless it is set");
  PutArm(two(Joint("j", "floating", "a", "b", "")));
  ExpectRefused("",
                "expected the type fixed, revolute, continuous or "
                "prismatic, found 'floating'");
  PutArm(two(Joint("j", "fixed", "a", "c", "")));
  ExpectRefused("", "found 'c', which is no link");
  PutArm(two(Joint("j", "fixed", "a", "b", "") +
             Joint("k", "fixed", "b", "a", "")));
  ExpectRefused("", "found a circle");
  PutArm(two(""));
  ExpectRefused("", "expected one link without a parent, found 2: a, b");
  PutArm(two(Joint("j", "continuous", "a", "b", "<axis xyz='0 0 0'/>")));
  ExpectRefused("", "expected an <axis> with a direction");
  PutArm(two(Joint("j", "continuous", "a", "b", "<mimic joint='j'/>")));
  ExpectRefused("", "joint 'j': expected a joint to mimic, found a circle");
  PutArm(
      "<robot><link name='a'><collision><geometry><box size='1e308 1 1'/>"
      "</geometry></collision></link></robot>");
  ExpectRefused("", "#a: MakeBox: max - min must be a length");
  PutArm("<robot>" + Cube("a") +
         "<link name='b'><collision><origin xyz='1.5e308 0 0'/><geometry>"
         "<box size='1 1 1'/></geometry></collision></link>" +
         Joint("j", "fixed", "a", "b", "<origin xyz='1.5e308 0 0'/>") +
         "</robot>");
  ExpectRefused("", "found lengths that overflow");
  PutArm(
      "<robot><link name='a'><collision><geometry>"
      "<mesh filename='arm.urdf@'/></geometry></collision></link></robot>");
  ExpectRefused("", "expected a mesh file, found arm.urdf@");
  std::ofstream(At("r.sdf")) << "<sdf><model><link name='a'><collision>"
                                "<geometry><sphere><radius>1</radius></sphere>"
                                "</geometry></collision></link></model></sdf>";
  EXPECT_THROW(ReadAnyMesh(At("r.sdf@")), InputError);
}

}  // namespace
}  // namespace phongpd
