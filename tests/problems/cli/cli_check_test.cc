// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a mesh, where, and what a repair makes of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/solid/mesh_defects.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Json = nlohmann::json;

class CliCheck : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    // A torus with a hole, two of whose triangles are doubled.
    TriangleMesh open = MakeTorus(2, 0.5, 24, 12);
    open.triangles.pop_back();
    WriteMesh(open, File("open.off"));
    TriangleMesh doubled = MakeBox({-1, -1, -1}, {1, 1, 1});
    doubled.triangles.push_back(doubled.triangles[3]);
    WriteMesh(doubled, File("doubled.off"));
  }
};

TEST_F(CliCheck, ASolidIsOne) {
  const Outcome outcome = Run("check ../box.off ../cone.off");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("box.off: 12 triangles, 8 vertices, 1 component, "
                             "genus 0, diagonal 3.46"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("a solid, volume 8\n"), std::string::npos);
  const Json found = Json::parse(Run("check ../box.off --json").out);
  EXPECT_EQ(found["solid"], true);
  EXPECT_EQ(found["volume"], 8.0);
  EXPECT_TRUE(found["defects"].empty());
}

TEST_F(CliCheck, PlacesOfDefectsAreCoordinatesAndMarkedTriangles) {
  for (const std::string file : {"bad.off", "bad.ply"}) {
    const Outcome outcome = Run("check ../open.off --json --defects " + file);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const Json found = Json::parse(outcome.out);
    EXPECT_EQ(found["solid"], false);
    EXPECT_EQ(found["genus"], 1);
    EXPECT_EQ(found["defect_counts"]["open edge"], 3);
    ASSERT_EQ(found["defects"].size(), 3U);
    const TriangleMesh mesh = ReadMesh(File("open.off"));
    const std::vector<MeshDefect> defects = FindDefects(mesh);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(found["defects"][i]["place"][2].get<double>(),
                defects[i].place.z());
    }
    const TriangleMesh marked = ReadMesh(Output(file));
    EXPECT_EQ(marked.triangles.size(), 3U);
    EXPECT_NE(Content(Output(file)).find(" 220 30 30\n"), std::string::npos);
  }
  const Outcome words = Run("check ../open.off");
  EXPECT_EQ(words.code, 1);
  EXPECT_NE(words.out.find("open edge: 3, at ("), std::string::npos);
  EXPECT_NE(words.out.find("NO SOLID: no closed surface"), std::string::npos);
}

TEST_F(CliCheck, RepairsAreWrittenAndTheirGenusIsSaid) {
  Outcome outcome = Run("check ../doubled.off --repair safe --output s.off");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("  1 duplicate face removed\n"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(ReadMesh(Output("s.off")).triangles.size(), 12U);
  // So coarse a wrap closes the torus' hole.
  TriangleMesh thin = MakeTorus(2, 1.97, 96, 48);
  thin.triangles.pop_back();
  WriteMesh(thin, File("thin.off"));
  outcome = Run("check ../thin.off --repair wrap --output w.off");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("the genus is 0 now, it was 1"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(SurfaceGenus(ReadMesh(Output("w.off"))), 0);
  std::filesystem::remove(Output("w.off"));
  std::filesystem::remove(Output("s.off"));
  ExpectRefused("check ../open.off --repair safe --output s.off",
                {"open.off", "3 boundary edges"});
  ExpectRefused("check ../box.off ../cone.off --output s.off",
                {"expected one mesh"});
  ExpectRefused("check ../box.off --defects d.stl", {"--defects", "d.stl"});
  ExpectRefused("check ../none.off", {"none.off"});
}

TEST_F(CliCheck, EveryCommandRepairsAndSaysSoWhereItRefuses) {
  WriteText("scene.json",
            R"({"robot": {"mesh": "cone.off"}, "obstacles":
                [{"mesh": "doubled.off"}], "start": [4, 0, 0],
                "goal": [0, 4, 0]})");
  const std::vector<std::string> commands = {
      "depth ../cone.off ../doubled.off",
      "minkowski ../cone.off ../doubled.off",
      "contact-space --robot ../cone.off --obstacle ../doubled.off",
      "motion --robot ../cone.off --obstacle ../doubled.off --from 0 0 0 --to "
      "1 0 0 --frames 2",
      "plan ../scene.json",
      "optimize ../scene.json",
      "view ../scene.json --json --html v.html"};
  for (const std::string& command : commands) {
    ExpectRefused(command, {"doubled.off", "repair safe or wrap", "--repair",
                            "phongpd check", "the first near ("});
  }
  for (const std::string& command : commands) {
    EXPECT_EQ(Run(command + " --repair safe").code, 0) << command;
  }
  WriteText("scene.json",
            R"({"robot": {"mesh": "cone.off"}, "obstacles":
                [{"mesh": "doubled.off", "repair": "safe"}],
                "start": [4, 0, 0], "goal": [0, 4, 0]})");
  const Outcome outcome = Run("plan ../scene.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 duplicate face removed"), std::string::npos)
      << outcome.err;
  std::filesystem::remove(Output("v.html"));
  ExpectRefused("plan ../scene.json --repair maybe", {"--repair", "maybe"});
}

}  // namespace
}  // namespace phongpd
