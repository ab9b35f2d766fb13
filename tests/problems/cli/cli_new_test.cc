// SPDX-License-Identifier: GPL-3.0-or-later
// What phongpd new writes runs as it stands, and says what is guessed.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/solid/solid.h"
#include "problems/scenes/new_scene.h"
#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

class CliNew : public CliScenes {
 protected:
  // The scene of both meshes in run/scene.json, read by its reader.
  phongpd::Scene New(const std::string& robot,
                     const std::string& obstacle) const {
    std::filesystem::remove(Output("scene.json"));
    const Outcome outcome =
        Run("new " + robot + ' ' + obstacle + " -o scene.json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("guessed: unit "), std::string::npos)
        << outcome.out;
    return ReadScene(Output("scene.json"));
  }
};

// No box touches another: told by the boxes alone.
bool AreApart(const TriangleMesh& a, const Eigen::Vector3d& q,
              const TriangleMesh& b) {
  const BoundingBox moved = ComputeBounds(Translated(a, q));
  const BoundingBox other = ComputeBounds(b);
  return (moved.max.array() < other.min.array()).any() ||
         (moved.min.array() > other.max.array()).any();
}

// Both far from the origin, of sizes from a watch to a hall.
TEST_F(CliNew, ItsScenesRunAtOnceWhateverTheSizeAndPlaceOfTheMeshes) {
  for (const double scale : {1e-3, 1.0, 37.0, 1e4}) {
    const Eigen::Vector3d away = scale * Eigen::Vector3d(20.0, -7.0, 3.0);
    WriteMesh(Translated(Scaled(MakeCone(0.4, 0.8, 8), scale), away),
              File("a.off"));
    WriteMesh(Translated(Scaled(MakeBox({-1, -2, -1}, {1, 1, 3}), scale),
                         -0.5 * away),
              File("b.off"));
    const phongpd::Scene scene = New("../a.off", "../b.off");
    const TriangleMesh& robot = scene.workspace.robot.mesh();
    const TriangleMesh& obstacle = scene.workspace.obstacles.at(0).mesh();
    EXPECT_TRUE(AreApart(robot, scene.start, obstacle)) << scale;
    EXPECT_TRUE(AreApart(robot, scene.goal, obstacle)) << scale;
    EXPECT_FALSE(AreApart(robot, 0.5 * (scene.start + scene.goal), obstacle));
    EXPECT_EQ(scene.workspace.unit, scale > 10.0 ? "mm" : "m") << scale;
    const Json plan = OneRow("plan scene.json", 0);
    ExpectFree(plan, scene);
    EXPECT_GT(plan["path"].size(), 2U) << "the line leads through";
    ExpectFree(OneRow("optimize scene.json", 0), scene);
  }
}

TEST_F(CliNew, LimitsThatAreCommentedOutAreLimitsWithoutTheSlashes) {
  New("../cone.off", "../box.off");
  std::string text = Content(Output("scene.json"));
  for (const std::string line : {"// , \"limits\"", "// , \"trajectory\""}) {
    const std::size_t at = text.find(line);
    ASSERT_NE(at, std::string::npos) << text;
    text.erase(at, 3);
  }
  WriteText("limits.json", text);
  const phongpd::Scene scene = ParseSceneFile(text, Output("scene.json"));
  ASSERT_TRUE(scene.limits.has_value());
  EXPECT_GT(scene.limits->velocity.minCoeff(), 0.0);
  EXPECT_EQ(scene.trajectory.margin, DefaultMargin());
}

TEST_F(CliNew, NamesMeshesFromTheFolderOfTheScene) {
  std::filesystem::create_directories(Output("deep/er"));
  ASSERT_EQ(Run("new ../cone.off ../box.off -o deep/er/s.json").code, 0);
  EXPECT_EQ(Run("plan deep/er/s.json").code, 0);
  // Standard output is taken to be where the command is.
  const Outcome piped = Run("new ../cone.off ../box.off");
  ASSERT_EQ(piped.code, 0);
  WriteText("run/piped.json", piped.out);
  EXPECT_EQ(Run("plan piped.json").code, 0);
  // A whole path stays.
  ASSERT_EQ(Run("new '" + File("cone.off") + "' ../box.off -o w.json").code, 0);
  EXPECT_NE(Content(Output("w.json")).find('"' + File("cone.off") + '"'),
            std::string::npos);
  EXPECT_EQ(Run("plan w.json").code, 0);
}

TEST_F(CliNew, KeepsWhatIsThere) {
  WriteText("run/scene.json", "{}");
  EXPECT_EQ(Run("new ../cone.off ../box.off -o scene.json").code, 2);
  EXPECT_EQ(Content(Output("scene.json")), "{}");
}

TEST_F(CliNew, TellsWhatItGuessesAsJson) {
  const Outcome outcome =
      Run("new ../cone.off ../box.off --json --output s.json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json told = Json::parse(outcome.out);
  const phongpd::Scene scene = ReadScene(Output("s.json"));
  EXPECT_EQ(told["scene"], "s.json");
  EXPECT_EQ(told["unit"], scene.workspace.unit);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(told["start"][axis], scene.start[axis]);
    EXPECT_EQ(told["goal"][axis], scene.goal[axis]);
    EXPECT_EQ(told["bounds"]["min"][axis], scene.workspace.bounds.min[axis]);
    EXPECT_EQ(told["bounds"]["max"][axis], scene.workspace.bounds.max[axis]);
  }
}

TEST_F(CliNew, RepairsAsAskedAndSaysSoInTheScene) {
  TriangleMesh twice = MakeBox({-1, -1, -1}, {1, 1, 1});
  twice.triangles.push_back(twice.triangles.front());
  WriteMesh(twice, File("twice.off"));
  ASSERT_EQ(Run("new ../cone.off ../twice.off -o s.json").code, 2);
  ASSERT_EQ(Run("new ../cone.off ../twice.off --repair safe -o s.json").code,
            0);
  EXPECT_EQ(Run("plan s.json").code, 0);
}

TEST(NewScene, TellsTheUnitByTheFormatOrElseBySize) {
  const TriangleMesh small = MakeBox({0, 0, 0}, {1, 1, 1});
  const TriangleMesh large = Scaled(small, 20.0);
  const auto unit = [](const TriangleMesh& a, const std::string& name_a,
                       const TriangleMesh& b, const std::string& name_b) {
    return GuessScene(a, name_a, b, name_b).unit;
  };
  EXPECT_EQ(unit(small, "a.stl", small, "b.off"), "m");
  EXPECT_EQ(unit(small, "a.stl", large, "b.off"), "mm");
  EXPECT_EQ(unit(large, "a.urdf#hand", large, "b.off"), "m");
  EXPECT_EQ(unit(large, "a.stl", large, "b.GLB"), "m");
  EXPECT_EQ(unit(small, "a.3mf", small, "b.off"), "mm");
  EXPECT_THROW(GuessScene({}, "a.stl", {}, "b.stl"), InputError);
}

TEST(NewScene, QuotesWhateverNamesFilesHave) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  const SceneGuess guess = GuessScene(box, "a", box, "b");
  const std::string name = "a \"b\"\n\\c/*.off";
  const auto json = nlohmann::ordered_json::parse(
      NewSceneText(guess, name, "b.off"), nullptr, true, true);
  EXPECT_EQ(json["robot"]["mesh"], name);
}

}  // namespace
}  // namespace phongpd
