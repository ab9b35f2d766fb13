// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/solid.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"
#include "core/contact/depth.h"
#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

TriangleMesh Box(double side) {
  return MakeBox(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(side));
}

TEST(Solid, SharesItsMeshUnderAnyName) {
  const Solid box = MakeSolid(Box(1.0), "box.off");
  const Solid other = box.Named("lid");
  EXPECT_EQ(box.name(), "box.off");
  EXPECT_EQ(other.name(), "lid");
  EXPECT_EQ(&box.mesh(), &other.mesh());
  EXPECT_EQ(box.report().volume, 1.0);
  EXPECT_TRUE(box.HasSameMesh(MakeSolid(Box(1.0), "again")));
  EXPECT_FALSE(box.HasSameMesh(MakeSolid(Box(2.0), "larger")));
}

// The union, part by part: as a check of the joined mesh finds it.
TEST(JoinedSolids, AreWhatACheckOfTheirMeshesMakes) {
  MeshReport checked;
  const std::vector<Solid> parts = {
      MakeSolid(Box(1.0), "box"), MakeSolid(MakeU(2.0, 0.5, 1.0), "u"),
      MakeSolid(Joined(Box(9.0),
                       Reversed(Translated(Box(3.0), Eigen::Vector3d::Ones()))),
                "shell")};
  TriangleMesh mesh;
  for (const Solid& part : parts) mesh = Joined(mesh, part);
  const Solid again = MakeSolid(mesh, "all", &checked);
  const Solid joined = JoinedSolids(parts, "all");
  EXPECT_TRUE(joined.HasSameMesh(again));
  EXPECT_EQ(joined.name(), "all");
  EXPECT_EQ(joined.report().triangles, checked.triangles);
  EXPECT_EQ(joined.report().vertices, checked.vertices);
  EXPECT_EQ(joined.report().components, checked.components);
  EXPECT_NEAR(joined.report().volume, checked.volume, 1e-12);
  EXPECT_TRUE(JoinedSolids({}, "none").IsEmpty());
}

// Whoever takes a solid calls it by its name, and does not take none.
TEST(Solid, IsNamedByWhatRefusesIt) {
  const Solid box = MakeSolid(Box(1.0), "box");
  const Solid none, named = none.Named("lid");
  const std::vector<std::string> said = {
      testing::ErrorOf([&] { BuildContactSpace(none, box); }),
      testing::ErrorOf([&] { BuildContactSpace(box, none); }),
      testing::ErrorOf([&] { ConvolutionModel(none, box); }),
      testing::ErrorOf([&] { DepthQuery(none, box); }),
      testing::ErrorOf([&] { DepthQuery(box, named); })};
  EXPECT_EQ(said[0], "robot: expected a solid, found no triangle");
  EXPECT_EQ(said[1], "obstacle: expected a solid, found no triangle");
  EXPECT_EQ(said[2], said[0]);
  EXPECT_EQ(said[3], said[0]);
  EXPECT_EQ(said[4], "lid: expected a solid, found no triangle");
  // Details below the grid of the other: by its own name, too.
  const Solid speck = MakeSolid(Box(1e-14), "speck");
  const std::string lost = testing::ErrorOf(
      [&] { BuildContactSpace(speck, MakeSolid(Box(1.0), "box")); });
  EXPECT_EQ(lost.rfind("speck: ", 0), 0U) << lost;
}

// A solid gives the bytes that its mesh gives.
TEST(Solid, IsBuiltLikeItsMesh) {
  const TriangleMesh ball = MakeIcoBall(0.5, 1), u = MakeU(2.0, 0.5, 1.0);
  const ContactSpace of_meshes = BuildContactSpace(ball, u);
  const ContactSpace of_solids =
      BuildContactSpace(MakeSolid(ball, "ball"), MakeSolid(u, "u"));
  EXPECT_EQ(of_meshes.mesh().vertices, of_solids.mesh().vertices);
  EXPECT_EQ(of_meshes.mesh().triangles, of_solids.mesh().triangles);
  EXPECT_EQ(of_meshes.plane(), of_solids.plane());
  EXPECT_EQ(of_solids.report().robot.triangles, ball.triangles.size());
}

TEST(ReadSolid, IsCalledByItsPath) {
  const std::string path = ::testing::TempDir() + "phongpd_read_solid.off";
  WriteMesh(Box(2.0), path);
  const Solid box = ReadSolid(path);
  EXPECT_EQ(box.name(), path);
  EXPECT_EQ(box.report().volume, 8.0);
  EXPECT_EQ(testing::ErrorOf([] {
              ReadSolid("nowhere.off");
            }).rfind("nowhere.off", 0),
            0U);
}

}  // namespace
}  // namespace phongpd
