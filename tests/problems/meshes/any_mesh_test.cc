// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/any_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/pi.h"
#include "core/solid/solid.h"
#include "tests/problems/meshes/mesh_files.h"
#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Block;

class AnyMesh : public testing::TemporaryFolder {
 protected:
  // A solid of the block's size and place after a shift.
  void ExpectBlock(const std::string& name, const Vector3d& shift,
                   const std::vector<std::string>& words, double scale = 1.0) {
    std::vector<std::string> warnings;
    MeshReport report;
    const TriangleMesh mesh =
        MakeSolid(ReadAnyMesh(At(name), &warnings), name, &report);
    EXPECT_EQ(mesh.triangles.size(), 12u) << name;
    EXPECT_EQ(mesh.vertices.size(), 8u) << name;
    EXPECT_NEAR(SignedVolume(mesh), 4.0 * scale * scale * scale, 1e-12) << name;
    const BoundingBox box = ComputeBounds(mesh);
    const Vector3d min(-0.5, 0.25, -1.0), max(1.5, 0.75, 3.0);
    EXPECT_LE((box.min - scale * (min + shift)).norm(), 1e-12) << name;
    EXPECT_LE((box.max - scale * (max + shift)).norm(), 1e-12) << name;
    EXPECT_TRUE(report.warnings.empty()) << report.warnings.front();
    std::string all;
    for (const std::string& line : warnings) all += line + '\n';
    for (const std::string& word : words) {
      EXPECT_NE(all.find(word), std::string::npos) << word << " in\n" << all;
    }
  }

  void ExpectRefused(const std::string& name,
                     const std::vector<std::string>& words,
                     const std::string& root = "") {
    const std::string what =
        testing::ErrorOf([&] { ReadAnyMesh(At(name), nullptr, root); });
    EXPECT_EQ(what.rfind(folder_.string(), 0), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    for (const std::string& word : words) {
      EXPECT_NE(what.find(word), std::string::npos) << word << " in " << what;
    }
  }
};

TEST_F(AnyMesh, ReadsCOLLADAInItsOwnUnitAndAxesAndSaysThem) {
  const std::string inches =
      "<unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis>";
  Put("block.dae", testing::Collada(Block(), inches));
  ExpectBlock(
      "block.dae", {2, 0, 0},
      {"single precision", "unit 0.0254 m", "Z_UP", "nothing is scaled"});
  Put("plain.dae", testing::Collada(Block(), ""));
  ExpectBlock("plain.dae", {2, 0, 0}, {"unit 1 m", "Y_UP"});
  Put("up.DAE", testing::Collada(Block(), "<up_axis>X_UP</up_axis>"));
  ExpectBlock("up.DAE", {2, 0, 0}, {"X_UP"});
}

TEST_F(AnyMesh, ReadsGlTFWithItsNodesTransforms) {
  Put("block.glb", testing::Glb(Block()));
  ExpectBlock("block.glb", {2, 0, 0}, {"metres, Y up", "single precision"});
  Put("block.gltf", testing::GltfJson(Block(), "\"uri\":\"block.bin\","));
  Put("block.bin", testing::GltfBuffer(Block()));
  ExpectBlock("block.gltf", {2, 0, 0}, {"metres, Y up"});
}

TEST_F(AnyMesh, ReadsThreeMFWithItsItemsTransforms) {
  Put("block.3mf", testing::ThreeMf(Block()));
  ExpectBlock("block.3mf", {2, 0, 0}, {"millimetres", "single precision"});
}

TEST_F(AnyMesh, ReadsTheOtherFormatsAsReadMeshDoes) {
  const TriangleMesh block = Translated(Block(), Vector3d(0.1, 0, 1e-9));
  WriteMesh(block, At("block.off"));
  std::vector<std::string> warnings;
  EXPECT_EQ(ReadAnyMesh(At("block.off"), &warnings).vertices, block.vertices);
  EXPECT_TRUE(warnings.empty());
  for (const char* name : {"a.off", "a.GLB", "r.urdf#arm", "r.sdf", "a.3mf"}) {
    EXPECT_TRUE(NamesMesh(name)) << name;
  }
  for (const char* name : {"a.json", "a", "a.pcs", "a.urdf.txt"}) {
    EXPECT_FALSE(NamesMesh(name)) << name;
  }
}

TEST_F(AnyMesh, RefusesFilesThatAreBrokenInOneLine) {
  ExpectRefused("none.dae", {"expected a mesh file, found nothing"});
  Put("empty.glb", "");
  ExpectRefused("empty.glb", {"an empty file"});
  Put("text.dae", "no XML at all");
  ExpectRefused("text.dae", {"XML"});
  Put("text.3mf", "no zip at all");
  ExpectRefused("text.3mf", {"Assimp"});
  const std::string glb = testing::Glb(Block());
  Put("cut.glb", glb.substr(0, glb.size() / 2));
  ExpectRefused("cut.glb", {"expected"});
  std::string nan = glb;
  const float quiet = std::numeric_limits<float>::quiet_NaN();
  const std::size_t first = glb.find("BIN") + 4;
  std::memcpy(nan.data() + first, &quiet, sizeof quiet);
  Put("nan.glb", nan);
  ExpectRefused("nan.glb", {"expected"});
  std::string index = glb;
  const std::uint32_t far = 4'000'000'000u;
  std::memcpy(index.data() + first + 12 * 8, &far, sizeof far);
  Put("index.glb", index);
  ExpectRefused("index.glb", {"expected 12 triangles", "found 11"});
  Put("bomb.dae",
      testing::Collada(Block(), "")
          .replace(testing::Collada(Block(), "").find("count=\"24\""), 10,
                   "count=\"4000000000\""));
  ExpectRefused("bomb.dae", {"expected"});
}

TEST_F(AnyMesh, KeepsBuffersOfGlTFBesideTheFile) {
  Put("outside.bin", testing::GltfBuffer(Block()));
  std::filesystem::create_directory(folder_ / "in");
  for (const std::string uri :
       {"../outside.bin", "/etc/passwd", "%2e%2e/outside.bin", "file:///x"}) {
    Put("in/block.gltf",
        testing::GltfJson(Block(), "\"uri\":\"" + uri + "\","));
    ExpectRefused("in/block.gltf", {"a file beside or below it"});
  }
}

const char kUrdf[] = R"(<robot name="r">
  <link name="base"><visual/></link>
  <link name="arm">
    <collision><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
      <geometry><box size="4 2 1"/></geometry></collision>
    <collision><geometry><sphere radius="0.5"/></geometry></collision>
  </link>
  <link name="tool">
    <collision><geometry><mesh filename="part.off" scale="0.5 0.5 -0.5"/>
    </geometry></collision></link>
  <link name="drum"><collision><geometry><cylinder radius="1" length="2"/>
    </geometry></collision></link>
</robot>)";

TEST_F(AnyMesh, ReadsLinksOfURDF) {
  Put("r.urdf", kUrdf);
  WriteMesh(Block(), At("part.off"));
  std::vector<std::string> warnings;
  const TriangleMesh arm =
      MakeSolid(ReadAnyMesh(At("r.urdf#arm"), &warnings), "arm");
  EXPECT_EQ(arm.triangles.size(), 12u + 1280u);
  // The box's long side lies along y after a quarter of a turn.
  const BoundingBox box = ComputeBounds(arm);
  EXPECT_NEAR(box.max.x(), 2.0, 1e-12);
  EXPECT_NEAR(box.max.y(), 4.0, 1e-12);
  EXPECT_NEAR(box.max.z(), 3.5, 1e-12);
  EXPECT_NEAR(box.min.z(), -0.5, 1e-12);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("2 collision shapes of link 'arm'"),
            std::string::npos);
  EXPECT_NE(warnings[0].find("no joint or link pose"), std::string::npos);
  // A mirroring scale leaves the outside outside.
  const TriangleMesh tool = ReadAnyMesh(At("r.urdf#tool"));
  EXPECT_NEAR(SignedVolume(tool), 0.5, 1e-12);
  EXPECT_NEAR(ComputeBounds(tool).min.z(), -1.5, 1e-12);
  // A regular polygon of 64 corners in the circle.
  const TriangleMesh drum = ReadAnyMesh(At("r.urdf#drum"));
  EXPECT_NEAR(SignedVolume(drum), 64.0 * std::sin(2.0 * kPi / 64.0), 1e-12);
}

TEST_F(AnyMesh, FindsMeshesOfPackagesAndScalesCOLLADAToMetres) {
  std::filesystem::create_directories(folder_ / "robo/urdf");
  std::filesystem::create_directories(folder_ / "robo/meshes");
  Put("robo/meshes/block.dae",
      testing::Collada(Block(), "<unit meter=\"0.001\"/>"));
  Put("robo/urdf/r.urdf",
      R"(<robot name="r"><link name="a"><collision><geometry>
         <mesh filename="package://robo/meshes/block.dae"/>
         </geometry></collision></link></robot>)");
  ExpectBlock("robo/urdf/r.urdf", {2, 0, 0}, {"to metres"}, 0.001);
  ReadAnyMesh(At("robo/urdf/r.urdf"), nullptr, At("robo"));
  ExpectRefused("robo/urdf/r.urdf", {"below the root"}, At("robo/urdf"));
}

TEST_F(AnyMesh, ReadsLinksOfSDF) {
  Put("r.sdf", R"(<sdf version="1.6"><world name="w"><model name="m">
    <link name="a"><pose>9 9 9 0 0 0</pose><collision name="c">
      <pose>1 0 0 0 0 0</pose>
      <geometry><box><size>2 2 2</size></box></geometry></collision></link>
    </model></world></sdf>)");
  const BoundingBox box = ComputeBounds(ReadAnyMesh(At("r.sdf")));
  EXPECT_EQ(box.min, Vector3d(0, -1, -1));
  EXPECT_EQ(box.max, Vector3d(2, 1, 1));
}

TEST_F(AnyMesh, RefusesLinksThatAreNone) {
  Put("r.urdf", kUrdf);
  ExpectRefused("r.urdf", {"no link's name", "arm, tool, drum"});
  ExpectRefused("r.urdf#amr", {"none of this name", "did you mean arm?"});
  ExpectRefused("r.urdf#base", {"none of this name"});
  ExpectRefused("r.urdf#tool", {"part.off", "nothing"});
  const auto link = [](const std::string& geometry) {
    return "<robot><link name='a'><collision><geometry>" + geometry +
           "</geometry></collision></link></robot>";
  };
  Put("bad.urdf", link("<box size='1 0 1'/>"));
  ExpectRefused("bad.urdf", {"box size: expected lengths > 0, found 1 0 1"});
  Put("bad.urdf", link("<box size='1 nan 1'/>"));
  ExpectRefused("bad.urdf", {"expected a finite number"});
  Put("bad.urdf", link("<sphere/>"));
  ExpectRefused("bad.urdf", {"sphere radius: expected a length, found none"});
  Put("bad.urdf", link("<capsule radius='1' length='1'/>"));
  ExpectRefused("bad.urdf", {"found <capsule>"});
  Put("bad.urdf", link("<mesh filename='package://other/a.off'/>"));
  ExpectRefused("bad.urdf", {"package://other/a.off", "on the way up"});
  Put("bad.urdf", "<robot><link");
  ExpectRefused("bad.urdf", {"expected XML"});
  Put("bad.urdf", "<mujoco/>");
  ExpectRefused("bad.urdf", {"found <mujoco>"});
}

}  // namespace
}  // namespace phongpd
