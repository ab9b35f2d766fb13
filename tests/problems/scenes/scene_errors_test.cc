// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene file may not be, and what its writer is told.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"
#include "tests/problems/scenes/good_scene.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

std::string ErrorOf(const Json& scene) {
  return testing::ErrorOf([&] { ParseScene(scene, "s.json"); }, "no error");
}

// The message after setting (or, with null, removing) what is at a pointer.
std::string ErrorOfGoodSceneWith(const std::string& pointer,
                                 const Json& value) {
  Json scene = testing::GoodScene();
  if (value.is_null()) {
    const Pointer at(pointer);
    scene[at.parent_pointer()].erase(at.back());
  } else {
    scene[Pointer(pointer)] = value;
  }
  return ErrorOf(scene);
}

TEST(SceneErrors, NameFilePlaceExpectedAndFound) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    std::string pointer;
    Json value;
    std::string message;
  };
  const std::string keys =
      "s.json: expected only the keys $schema, name, unit, robot, robots, "
      "obstacles, bounds, start, goal, start_rotation, goal_rotation, preset, "
      "limits, via, moving, duration, "
      "departure, arrival, "
      "penetration, trajectory, planning, feasible, witness, ";
  const std::vector<Case> cases = {
      {"/robto", 1, keys + "found \"robto\"; did you mean robot?"},
      {"/velocity", 3, keys + "found \"velocity\""},
      {"/trajectory/waypoint", 3,
       "s.json: /trajectory: expected only the keys waypoints, "
       "samples_per_segment, margin, max_segment_ratio, model, ipopt, "
       "found \"waypoint\"; did you mean waypoints?"},
      {"/goal", nullptr,
       "s.json: /goal: expected an array of 3 numbers, found nothing"},
      {"/robot", nullptr,
       "s.json: expected either \"robot\" or \"robots\", found neither"},
      {"/start", "left",
       "s.json: /start: expected an array of 3 numbers, found \"left\""},
      {"/start",
       {1, 2},
       "s.json: /start: expected an array of 3 numbers, found [1,2]"},
      {"/start/1", "y", "s.json: /start/1: expected a number, found \"y\""},
      {"/start/1", inf, "s.json: /start/1: expected a number, found inf"},
      {"/goal/2", nan, "s.json: /goal/2: expected a number, found nan"},
      {"/bounds/max/1", -5,
       "s.json: /bounds/max/1: expected more than min, -5, found -5"},
      {"/bounds/min", nullptr,
       "s.json: /bounds/min: expected an array of 3 numbers, found nothing"},
      {"/obstacles", Json::array(),
       "s.json: /obstacles: expected an array of at least 1 items, found []"},
      {"/obstacles/1/id", "cube",
       "s.json: /obstacles/1/id: expected an id of its own, found \"cube\" a "
       "second time"},
      {"/obstacles/1/id", "",
       "s.json: /obstacles/1/id: expected a text that is not empty, found "
       "\"\""},
      {"/obstacles/0/mesh", "a.off",
       "s.json: /obstacles/0: expected either \"shape\" or \"mesh\", found "
       "\"shape\" and \"mesh\""},
      {"/obstacles/0/shape", nullptr,
       "s.json: /obstacles/0: expected either \"shape\" or \"mesh\", found "
       "neither"},
      {"/obstacles/0/scale", 0,
       "s.json: /obstacles/0/scale: expected a number > 0, found 0"},
      {"/obstacles/0/rotation", 90,
       "s.json: /obstacles/0/rotation: expected an array of 9 numbers or an "
       "object with \"axis\", \"degrees\", found 90"},
      {"/obstacles/0/rotation",
       {0, 0, 90},
       "s.json: /obstacles/0/rotation: expected an array of 9 numbers or an "
       "object with \"axis\", \"degrees\", found [0,0,90]"},
      {"/obstacles/0/rotation/axis",
       {0, 0, 0},
       "s.json: /obstacles/0/rotation/axis: expected a direction, found "
       "[0,0,0]"},
      {"/obstacles/1/rotation",
       {1, 0, 0, 0, 1, 0, 0, 0, -1},
       "s.json: /obstacles/1/rotation: expected the rows of a rotation "
       "matrix, found [1,0,0,0,1,0,0,0,-1]"},
      {"/robot/shape/type", "sphere",
       "s.json: /robot/shape/type: expected one of ball, uv_ball, box, "
       "box_shell, cells, cone, axes, wrench, torus, l, u, plate_hole, "
       "plate_round_hole, prism, vessel, star, knot, tube, triangles, scan, "
       "found "
       "\"sphere\""},
      {"/robot/shape/radius", nullptr,
       "s.json: /robot/shape: a ball needs \"radius\", found "
       "{\"type\":\"ball\",\"triangles\":20}"},
      {"/robot/shape/side", 1,
       "s.json: /robot/shape: a ball has no parameter \"side\""},
      {"/robot/shape/radius", -1,
       "s.json: /robot/shape: MakeIcoBall: radius must be a length in "
       "[1e-70, 1e+70], found -1"},
      {"/robot/shape",
       {{"type", "uv_ball"},
        {"radius", 1},
        {"meridians", 10000},
        {"parallels", 10000}},
       "s.json: /robot/shape: MakeUvBall: 2·meridians·(parallels - 1) "
       "triangles must be a count in [0, 10000000], found 199980000"},
      {"/robot/shape",
       {{"type", "tube"}, {"path", {1, 2}}, {"radius", 1}, {"sides", 6}},
       "s.json: /robot/shape/path: expected an array of points, three numbers "
       "each, found [1,2]"},
      {"/obstacles/1/shape/layers",
       {{"#"}, {"#"}},
       "s.json: /obstacles/1/shape: MakeCells: expected rows of one '#' "
       "(solid) or '.' between two cuts of x"},
      {"/obstacles/1/shape/layers",
       {{"#."}, {".#"}},
       "s.json: /obstacles/1/shape: no closed surface; expected every edge "
       "between two triangles of one orientation, found non-manifold (1 edge "
       "of three or more triangles), the first near (1, -1, 0.5); repair safe "
       "or wrap may mend it (flag --repair, key \"repair\" of a scene), "
       "phongpd check marks the places; or close, clean or reorient the "
       "surface and export it again"},
      {"/penetration/metric", "manhattan",
       "s.json: /penetration/metric: expected one of \"phong\", "
       "\"euclidean\", \"smoothed\", \"smoothed-foot\", found "
       "\"manhattan\""},
      {"/penetration/smoothing_length", 1.5,
       "s.json: /penetration/smoothing_length: expected at most 1 (the world's "
       "diagonal D), found 1.5"},
      {"/penetration/smoothing_length", -0.5,
       "s.json: /penetration/smoothing_length: expected a number >= 0, found "
       "-0.5"},
      {"/penetration/smoothing_length", "1.5D",
       "s.json: /penetration/smoothing_length: expected at most 1 (the world's "
       "diagonal D), found 1.5"},
      {"/trajectory/margin", 0,
       "s.json: /trajectory/margin: expected a length > 0, found 0"},
      {"/trajectory/margin", "0.01 m",
       "s.json: /trajectory/margin: expected a length >= 0 as 0.01 or 0.01D "
       "(a share of the world's diagonal D) or 0.5unit (the user's unit), "
       "found '0.01 m': the user's unit has no name; write 0.01unit, or name "
       "it (in a scene \"unit\": \"m\", of Python's World unit=\"m\")"},
      {"/trajectory/margin", "-1unit",
       "s.json: /trajectory/margin: expected a length >= 0 as 0.01 or 0.01D "
       "(a share of the world's diagonal D) or 0.5unit (the user's unit), "
       "found '-1unit'"},
      {"/trajectory/margin", true,
       "s.json: /trajectory/margin: expected a number >= 0 or a text that is "
       "not empty, found true"},
      {"/via/0/point", nullptr,
       "s.json: /via/0/point: expected an array of 3 numbers, found nothing"},
      {"/via/0/tolerance", 0,
       "s.json: /via/0/tolerance: expected a length > 0, found 0"},
      {"/via/0/dwell", -1,
       "s.json: /via/0/dwell: expected a number >= 0 and <= 1e+09, found -1"},
      {"/via/0/rest", 1,
       "s.json: /via/0: expected only the keys point, tolerance, dwell, found "
       "\"rest\""},
      {"/duration", -1,
       "s.json: /duration: expected a number >= 0 and <= 1e+09, found -1"},
      {"/planning/clearance", "0unit",
       "s.json: /planning/clearance: expected a length > 0, found 0unit"},
      {"/trajectory/waypoints", 2.5,
       "s.json: /trajectory/waypoints: expected a whole number >= 1 and <= "
       "1e+05, found 2.5"},
      {"/trajectory/ipopt/tol", true,
       "s.json: /trajectory/ipopt/tol: expected a text or a number, found "
       "true"},
      {"/planning/time_limit", 0,
       "s.json: /planning/time_limit: expected a number > 0 and <= "
       "1e+09, found 0"},
      {"/feasible", "yes",
       "s.json: /feasible: expected true or false, found \"yes\""},
      {"/witness/0",
       {0, 0, 0},
       "s.json: /witness/0: expected the start, found [0,0,0]"},
      {"/witness/2",
       {0, 0, 0},
       "s.json: /witness/2: expected the goal, found [0,0,0]"},
  };
  EXPECT_EQ(ErrorOf(testing::GoodScene()), "no error");
  for (const Case& c : cases) {
    EXPECT_EQ(ErrorOfGoodSceneWith(c.pointer, c.value), c.message) << c.pointer;
  }
  EXPECT_EQ(ErrorOf(Json(3)),
            "s.json: expected an object with \"obstacles\", found 3");
}

// What is too long is known once the solids are.
TEST(SceneErrors, NameLengthsBeyondTheWorld) {
  for (const std::string place :
       {"/penetration/smoothing_length", "/trajectory/margin",
        "/via/0/tolerance", "/planning/clearance"}) {
    const std::string error = ErrorOfGoodSceneWith(place, "1e6unit");
    EXPECT_EQ(error.find("s.json: " + place + ": expected at most "), 0U)
        << error;
    EXPECT_NE(error.find("unit (the world's diagonal D), found 1e+06unit"),
              std::string::npos)
        << error;
  }
}

TEST(SceneErrors, NameWhatIsNoMesh) {
  const std::filesystem::path folder(::testing::TempDir());
  Json scene = testing::GoodScene();
  scene["robot"] = {{"mesh", "none.off"}};
  std::string message = testing::ErrorOf(
      [&] { ParseScene(scene, "s.json", folder.string()); }, "no error");
  const std::string path = (folder / "none.off").string();
  EXPECT_EQ(message.rfind("s.json: /robot/mesh: " + path + ": ", 0), 0U)
      << message;

  std::ofstream(folder / "scene_errors_sheet.off")
      << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  scene["robot"] = {{"mesh", "scene_errors_sheet.off"}};
  message = testing::ErrorOf(
      [&] { ParseScene(scene, "s.json", folder.string()); }, "no error");
  EXPECT_EQ(
      message.rfind("s.json: /robot/mesh: \"scene_errors_sheet.off\": ", 0), 0U)
      << message;
}

std::string TextError(const std::string& text) {
  return testing::ErrorOf([&] { ParseJson(text, "s.json"); }, "no error");
}

TEST(SceneErrors, NameWhatIsNoJson) {
  EXPECT_EQ(TextError("{\"a\": 1 /* one */ } // end"), "no error");
  EXPECT_EQ(TextError("{\"a\": {\"b\": 1, \"b\": 2}}"),
            "s.json: expected each key once, found \"b\" twice in one object");
  EXPECT_EQ(TextError(std::string(200, '[')),
            "s.json: expected nesting of at most 100 levels, found more");
  EXPECT_EQ(TextError("{\"a\":\n 1e999}").find('\n'), std::string::npos);
  EXPECT_EQ(
      TextError("{\"a\":\n oops}")
          .rfind("s.json: expected JSON, found a parse error at line 2", 0),
      0U)
      << TextError("{\"a\":\n oops}");
  EXPECT_NE(TextError(""), "no error");
}

}  // namespace
}  // namespace phongpd
