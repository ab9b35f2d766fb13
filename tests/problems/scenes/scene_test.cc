// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

Json Box(double size) {
  return {{"type", "box"}, {"size", {size, size, size}}};
}

Json SmallScene() {
  return {{"robot", {{"shape", Box(1)}}},
          {"obstacles", Json::array({{{"shape", Box(2)}}})},
          {"start", {-3, 0, 0}},
          {"goal", {3, 0, 0}}};
}

// What a small scene with `value` at `pointer` is refused with.
std::string ErrorWith(const std::string& pointer, const Json& value,
                      const std::string& unit = "m") {
  Json scene = SmallScene();
  scene["unit"] = unit;
  scene[Json::json_pointer(pointer)] = value;
  return testing::ErrorOf([&] { ParseScene(scene, "s.json"); }, "no error");
}

Json FullScene() {
  Json scene = SmallScene();
  scene["name"] = "full";
  scene["obstacles"][0]["id"] = "cube";
  scene["bounds"] = {{"min", {-5, -5, -5}}, {"max", {5, 5, 5}}};
  scene["penetration"] = {{"metric", "euclidean"},
                          {"field", "tangent-plane"},
                          {"smoothing_length", 0.25},
                          {"jacobian", "exact"}};
  scene["trajectory"] = {
      {"waypoints", 12.0},
      {"samples_per_segment", 3},
      {"margin", 0.02},
      {"max_segment_ratio", 2},
      {"ipopt",
       {{"tol", 1e-6}, {"max_iter", 50}, {"mu_strategy", "adaptive"}}}};
  scene["planning"] = {
      {"planner", "prm"}, {"time_limit", 1}, {"clearance", "0.5D"}};
  scene["via"] = {{{"point", {0, 0, 4}}},
                  {{"point", {1, 0, 4}}, {"tolerance", 0.05}, {"dwell", 2}}};
  scene["duration"] = 7.5;
  scene["departure"] = {{"velocity", {0, 0.5, 0}}, {"acceleration", {1, 0, 0}}};
  scene["arrival"] = {{"velocity", {0.25, 0, 0}}};
  scene["feasible"] = true;
  scene["witness"] = {{-3, 0, 0}, {0, 0, 4}, {3, 0, 0}};
  return scene;
}

TEST(Scene, NeedsOnlySolidsStartAndGoal) {
  const Scene scene = ParseScene(SmallScene(), "s.json", ".", "small");
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.workspace.obstacles.at(0).name(), "obstacle0");
  EXPECT_TRUE(scene.workspace.bounds.IsEmpty());
  EXPECT_EQ(scene.start, Vector3d(-3, 0, 0));
  EXPECT_EQ(scene.goal, Vector3d(3, 0, 0));
  EXPECT_FALSE(scene.feasible.has_value());
  EXPECT_TRUE(scene.witness.empty());
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(ComputeBounds(scene.workspace.robot).max, Vector3d(0.5, 0.5, 0.5));
}

TEST(Scene, KnowsEveryMetric) {
  for (const std::string& name : MetricNames()) {
    Json json = SmallScene();
    json["penetration"]["metric"] = name;
    const Scene scene = ParseScene(json, "s.json");
    EXPECT_EQ(ToString(scene.penetration.metric), name);
  }
}

TEST(Scene, ReadsEverySetting) {
  const Scene scene = ParseScene(FullScene(), "s.json");
  EXPECT_EQ(scene.name, "full");
  EXPECT_EQ(scene.workspace.obstacles.at(0).name(), "cube");
  EXPECT_EQ(scene.workspace.bounds.min, Vector3d(-5, -5, -5));
  EXPECT_EQ(scene.workspace.bounds.max, Vector3d(5, 5, 5));
  EXPECT_EQ(scene.penetration.metric, MetricKind::kEuclidean);
  EXPECT_EQ(scene.penetration.field, FieldKind::kTangentPlane);
  EXPECT_EQ(scene.penetration.smoothing_length, Length::FromShare(0.25));
  EXPECT_EQ(scene.penetration.jacobian, JacobianKind::kExact);
  EXPECT_EQ(scene.trajectory.waypoints, 12);
  EXPECT_EQ(scene.trajectory.samples_per_segment, 3);
  EXPECT_EQ(scene.trajectory.margin, Length::FromShare(0.02));
  EXPECT_EQ(scene.trajectory.max_segment_ratio, 2.0);
  EXPECT_EQ(scene.trajectory.ipopt.at("tol"), IpoptValue(1e-6));
  EXPECT_EQ(scene.trajectory.ipopt.at("max_iter"), IpoptValue(50));
  EXPECT_EQ(scene.trajectory.ipopt.at("mu_strategy"),
            IpoptValue(std::string("adaptive")));
  EXPECT_EQ(scene.planning.planner, PlannerId::kPrm);
  EXPECT_EQ(scene.planning.time_limit, 1.0);
  EXPECT_EQ(scene.planning.clearance, Length::FromShare(0.5));
  ASSERT_EQ(scene.via.size(), 2U);
  EXPECT_EQ(scene.via[0].point, Vector3d(0, 0, 4));
  EXPECT_EQ(scene.via[0].tolerance, Via().tolerance);
  EXPECT_EQ(scene.via[0].dwell, 0.0);
  EXPECT_EQ(scene.via[1].point, Vector3d(1, 0, 4));
  EXPECT_EQ(scene.via[1].tolerance, Length::FromShare(0.05));
  EXPECT_EQ(scene.via[1].dwell, 2.0);
  EXPECT_EQ(scene.duration, 7.5);
  EXPECT_EQ(scene.departure.velocity, Vector3d(0, 0.5, 0));
  EXPECT_EQ(scene.departure.acceleration, Vector3d(1, 0, 0));
  EXPECT_EQ(scene.arrival.velocity, Vector3d(0.25, 0, 0));
  EXPECT_EQ(scene.arrival.acceleration, Vector3d::Zero());
  EXPECT_EQ(scene.feasible, true);
  EXPECT_EQ(scene.witness.at(1), Vector3d(0, 0, 4));
}

TEST(Scene, ReadsLengthsInUnitsOrAsShares) {
  Json json = SmallScene();
  json["penetration"]["smoothing_length"] = "0.3unit";
  json["trajectory"]["margin"] = "0.02 D";
  json["planning"]["clearance"] = "0.125 unit";
  const Scene scene = ParseScene(json, "s.json");
  EXPECT_EQ(scene.penetration.smoothing_length, Length::FromUnit(0.3));
  EXPECT_EQ(scene.trajectory.margin, Length::FromShare(0.02));
  EXPECT_EQ(scene.planning.clearance, Length::FromUnit(0.125));
  EXPECT_FALSE(ParseScene(SmallScene(), "s.json").planning.clearance);
}

TEST(Scene, ReadsLimitsOfAxesOrOfTheNorm) {
  Json json = SmallScene();
  json["limits"] = {{"velocity", {1, 2, 3}}, {"acceleration", 2}, {"jerk", 9}};
  const Scene by_axis = ParseScene(json, "s.json");
  EXPECT_FALSE(by_axis.limits->by_norm);
  EXPECT_EQ(by_axis.limits->velocity, Vector3d(1, 2, 3));
  json["limits"]["by"] = "norm";
  EXPECT_THROW(ParseScene(json, "s.json"), InputError);  // of three numbers
  json["limits"]["velocity"] = 4;
  const Scene by_norm = ParseScene(json, "s.json");
  EXPECT_TRUE(by_norm.limits->by_norm);
  EXPECT_EQ(by_norm.limits->velocity[0], 4.0);
  json["limits"]["by"] = "sum";
  EXPECT_THROW(ParseScene(json, "s.json"), InputError);
}

TEST(Scene, ReadsBareLengthsInItsUnitIfThatHasAName) {
  EXPECT_EQ(ParseScene(SmallScene(), "s.json").workspace.unit, "");
  for (const std::string& unit : UnitNames()) {
    Json json = SmallScene();
    json["unit"] = unit;
    // Defaults are shares whatever the unit is called.
    const Scene plain = ParseScene(json, "s.json");
    EXPECT_EQ(plain.workspace.unit, unit);
    EXPECT_EQ(plain.trajectory.margin, TrajectorySettings().margin);
    EXPECT_EQ(plain.penetration.smoothing_length,
              PenetrationSpec().smoothing_length);
    for (const Json& length : {Json(1.5), Json("1.5"), Json("1.5" + unit),
                               Json("1.5 " + unit), Json("1.5unit")}) {
      json["penetration"]["smoothing_length"] = length;
      json["trajectory"]["margin"] = length;
      json["planning"]["clearance"] = length;
      const Scene scene = ParseScene(json, "s.json");
      EXPECT_EQ(scene.penetration.smoothing_length, Length::FromUnit(1.5));
      EXPECT_EQ(scene.trajectory.margin, Length::FromUnit(1.5)) << length;
      EXPECT_EQ(scene.planning.clearance, Length::FromUnit(1.5)) << length;
      // Nothing is converted.
      EXPECT_EQ(scene.goal, plain.goal);
      EXPECT_EQ(scene.workspace.robot.mesh().vertices,
                plain.workspace.robot.mesh().vertices);
    }
    json["trajectory"]["margin"] = "0.5D";
    EXPECT_EQ(ParseScene(json, "s.json").trajectory.margin,
              Length::FromShare(0.5));
  }
}

TEST(Scene, ReadsNumbersOfLengthsToTheBit) {
  Json json = SmallScene();
  const double share = std::nextafter(0.1, 0.0);
  json["penetration"]["smoothing_length"] = share;
  json["trajectory"]["margin"] = share;
  const Scene scene = ParseScene(json, "s.json");
  EXPECT_EQ(scene.penetration.smoothing_length, Length::FromShare(share));
  EXPECT_EQ(scene.trajectory.margin, Length::FromShare(share));
  json["penetration"]["smoothing_length"] = -0.0;
  const double zero =
      ParseScene(json, "s.json").penetration.smoothing_length.value();
  EXPECT_EQ(zero, 0.0);
  EXPECT_FALSE(std::signbit(zero));
  // As a text of the same number.
  for (const Json& margin : {Json(0.125), Json("0.125")}) {
    json["trajectory"]["margin"] = margin;
    try {
      ParseScene(json, "s.json");
      ADD_FAILURE() << margin;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(),
                   "s.json: /trajectory/margin: expected a unit with a number "
                   "above 0.1, found 0.125: did you mean 0.125unit? or 0.125D, "
                   "a share of the world's diagonal D");
    }
  }
}

TEST(Scene, RefusesUnitsWithoutANameInOneLine) {
  const std::string expected =
      "s.json: /unit: expected one of \"nm\", \"um\", \"mm\", \"cm\", \"dm\", "
      "\"m\", \"km\", \"in\", \"ft\", found ";
  for (const auto& [unit, found] : std::vector<std::pair<Json, std::string>>{
           {"MM", "\"MM\"; did you mean mm?"},
           {"mmm", "\"mmm\"; did you mean mm?"},
           {"D", "\"D\""},
           {"unit", "\"unit\""},
           {"", "\"\""},
           {20, "20"}}) {
    EXPECT_EQ(ErrorWith("/unit", unit), expected + found);
  }
}

TEST(Scene, RefusesLengthsInOtherUnits) {
  for (const std::string place :
       {"/penetration/smoothing_length", "/trajectory/margin",
        "/planning/clearance"}) {
    const auto error = [&](const Json& length) {
      return ErrorWith(place, length, "mm");
    };
    const std::string start = "s.json: " + place + ": expected ";
    EXPECT_EQ(error("20cm"),
              start +
                  "a length >= 0 as 20 or 20mm (the scene's unit) or 0.01D "
                  "(a share of the world's diagonal D), found '20cm': the "
                  "scene's unit is mm, and nothing is converted");
    EXPECT_EQ(error("2D"),
              start + "at most 1D (the world's diagonal D), found 2D");
    for (const Json& length : {Json(1e6), Json("1e6mm"), Json("1e6unit")}) {
      const std::string found = error(length);
      EXPECT_EQ(found.find(start + "at most "), 0U) << found;
      EXPECT_NE(found.find("mm (the world's diagonal D), found 1e+06mm"),
                std::string::npos)
          << found;
    }
  }
}

TEST(Scene, SchemaAndCodeHaveTheSameUnits) {
  EXPECT_EQ(SceneSchema()["properties"]["unit"]["enum"], Json(UnitNames()));
}

// The schema's defaults are what a reader of the file sees; the structs' are
// what happens.
TEST(Scene, SchemaAndStructsHaveTheSameDefaults) {
  Json written = SmallScene();
  for (const char* section : {"penetration", "trajectory", "planning"}) {
    const Json& known = SceneSchema()["properties"][section]["properties"];
    for (const auto& [key, schema] : known.items()) {
      // Ipopt's own defaults, the planner's own clearance, the model's own
      // planner.
      if (key == "ipopt" || key == "clearance" || key == "planner") continue;
      written[section][key] = schema.at("default");
    }
  }
  const Json& keys = SceneSchema()["properties"];
  written["duration"] = keys["duration"]["default"];
  const Json& of_via = SceneSchema()["$defs"]["via"]["properties"];
  written["via"] = {{{"point", {0, 0, 4}},
                     {"tolerance", of_via["tolerance"]["default"]},
                     {"dwell", of_via["dwell"]["default"]}}};
  const Scene a = ParseScene(written, "a"), b = ParseScene(SmallScene(), "b");
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_TRUE(b.departure.IsAtRest() && b.arrival.IsAtRest());
  EXPECT_EQ(a.via.at(0).tolerance, Via().tolerance);
  EXPECT_EQ(a.via.at(0).dwell, Via().dwell);
  EXPECT_EQ(a.penetration.metric, b.penetration.metric);
  EXPECT_EQ(a.penetration.field, b.penetration.field);
  EXPECT_EQ(a.penetration.smoothing_length, b.penetration.smoothing_length);
  EXPECT_EQ(a.penetration.jacobian, b.penetration.jacobian);
  EXPECT_EQ(a.trajectory.waypoints, b.trajectory.waypoints);
  EXPECT_EQ(a.trajectory.samples_per_segment, b.trajectory.samples_per_segment);
  EXPECT_EQ(a.trajectory.margin, b.trajectory.margin);
  EXPECT_EQ(a.trajectory.max_segment_ratio, b.trajectory.max_segment_ratio);
  EXPECT_EQ(a.planning.planner, b.planning.planner);
  EXPECT_EQ(a.planning.model, b.planning.model);
  EXPECT_EQ(a.planning.time_limit, b.planning.time_limit);
  EXPECT_EQ(a.planning.clearance, b.planning.clearance);
}

TEST(Scene, PlacesSolidsByRotationThenScaleThenPosition) {
  Json json = SmallScene();
  Json& obstacle = json["obstacles"][0];
  obstacle["shape"]["size"] = {2, 4, 6};
  obstacle["scale"] = 0.5;
  obstacle["position"] = {10, 20, 30};
  obstacle["rotation"] = {0, -1, 0, 1, 0, 0, 0, 0, 1};  // x to y
  const BoundingBox turned =
      ComputeBounds(ParseScene(json, "s.json").workspace.obstacles[0]);
  EXPECT_EQ(turned.min, Vector3d(9, 19.5, 28.5));
  EXPECT_EQ(turned.max, Vector3d(11, 20.5, 31.5));
  obstacle["rotation"] = {{"axis", {0, 0, 7}}, {"degrees", 90}};
  const BoundingBox same =
      ComputeBounds(ParseScene(json, "s.json").workspace.obstacles[0]);
  EXPECT_LT((same.min - turned.min).norm() + (same.max - turned.max).norm(),
            1e-14);
}

TEST(Scene, ReadsMeshesBesideTheFileAndComments) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "phongpd_scene_test";
  std::filesystem::create_directories(folder / "meshes");
  WriteMesh(MakeBox({-1, -1, -1}, {1, 1, 1}),
            (folder / "meshes" / "cube.off").string());
  Json json = SmallScene();
  json["obstacles"][0] = {{"mesh", "meshes/cube.off"}};
  const std::string path = (folder / "by_mesh.json").string();
  std::ofstream(path) << "// a comment\n" << json.dump() << "/* another */\n";
  const Scene scene = ReadScene(path);
  EXPECT_EQ(scene.name, "by_mesh");
  EXPECT_EQ(ComputeBounds(scene.workspace.obstacles.at(0)).max,
            Vector3d(1, 1, 1));

  std::ofstream(path) << "{\"robot\": 1, }";
  const std::string what = testing::ErrorOf([&] { ReadScene(path); });
  EXPECT_EQ(
      what.rfind(path + ": expected JSON, found a parse error at line 1", 0),
      0U)
      << what;
  EXPECT_THROW(ReadScene((folder / "none.json").string()), InputError);
  EXPECT_THROW(ReadScene(folder.string()), InputError);
  std::filesystem::remove_all(folder);
}

TEST(Scene, KnowsWhichObstaclesCanTouch) {
  Json json = FullScene();
  Json& obstacles = json["obstacles"];
  // C_obj of a cube of side 2 at x reaches from x − 1.5; the bounds end at 5.
  for (const double x : {6.5, 6.75, -6.75}) {
    obstacles.push_back({{"id", "at " + std::to_string(x)},
                         {"shape", Box(2)},
                         {"position", {x, 0, 0}}});
  }
  const Scene scene = ParseScene(json, "s.json");
  EXPECT_EQ(ReachableObstacles(scene.workspace), (std::vector<int>{0, 1}));
  EXPECT_EQ(SkippedObstaclesNote(scene),
            "cannot be touched within the bounds, skipped: at 6.750000, "
            "at -6.750000");
  json.erase("bounds");
  EXPECT_EQ(ReachableObstacles(ParseScene(json, "s.json").workspace).size(),
            4U);
  EXPECT_EQ(SkippedObstaclesNote(ParseScene(json, "s.json")), "");
}

}  // namespace
}  // namespace phongpd
