// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene file may not be, and what its writer is told.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/solid/solid.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

Json Good() {
  return Json::parse(R"({
    "name": "good",
    "robot": {"shape": {"type": "ball", "radius": 0.5, "triangles": 20}},
    "obstacles": [
      {"id": "cube", "shape": {"type": "box", "size": [1, 1, 1]},
       "position": [0, 0, 0], "scale": 2,
       "rotation": {"axis": [0, 0, 1], "degrees": 30}},
      {"id": "step", "shape": {"type": "cells", "x": [0, 1, 2], "y": [0, 1],
                               "z": [0, 1, 2], "layers": [["##"], ["#."]]},
       "rotation": [1, 0, 0, 0, 0, -1, 0, 1, 0]}],
    "bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]},
    "start": [-3, 0, 0],
    "goal": [3, 0, 0],
    "penetration": {"metric": "phong", "field": "normal",
                    "smoothing_length": 0.1, "jacobian": "direction"},
    "trajectory": {"waypoints": 40, "samples_per_segment": 2, "margin": 0.01,
                   "max_segment_ratio": 1.6,
                   "ipopt": {"tol": 1e-6, "mu_strategy": "adaptive"}},
    "planning": {"planner": "contact-surface", "time_limit": 5.0,
                 "clearance": 0.01},
    "feasible": true,
    "witness": [[-3, 0, 0], [0, 0, 4], [3, 0, 0]]
  })");
}

std::string ErrorOf(const Json& scene) {
  try {
    ParseScene(scene, "s.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// The message after setting (or, with null, removing) what is at a pointer.
std::string ErrorWith(const std::string& pointer, const Json& value) {
  Json scene = Good();
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
      "s.json: expected only the keys $schema, name, unit, robot, obstacles, "
      "bounds, start, goal, preset, limits, penetration, trajectory, planning, "
      "feasible, witness, ";
  const std::vector<Case> cases = {
      {"/robto", 1, keys + "found \"robto\"; did you mean robot?"},
      {"/velocity", 3, keys + "found \"velocity\""},
      {"/trajectory/waypoint", 3,
       "s.json: /trajectory: expected only the keys waypoints, "
       "samples_per_segment, margin, max_segment_ratio, model, ipopt, "
       "found \"waypoint\"; did you mean waypoints?"},
      {"/goal", nullptr,
       "s.json: /goal: expected an array of 3 numbers, found nothing"},
      {"/robot", nullptr, "s.json: /robot: expected an object, found nothing"},
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
       "plate_round_hole, prism, vessel, star, knot, scan, found \"sphere\""},
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
       "\"euclidean\", found \"manhattan\""},
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
       "found '0.01 m': the user's unit has no name; a scene's \"unit\": "
       "\"m\" gives it one"},
      {"/trajectory/margin", "-1unit",
       "s.json: /trajectory/margin: expected a length >= 0 as 0.01 or 0.01D "
       "(a share of the world's diagonal D) or 0.5unit (the user's unit), "
       "found '-1unit'"},
      {"/trajectory/margin", true,
       "s.json: /trajectory/margin: expected a number >= 0 or a text that is "
       "not empty, found true"},
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
  EXPECT_EQ(ErrorOf(Good()), "no error");
  for (const Case& c : cases) {
    EXPECT_EQ(ErrorWith(c.pointer, c.value), c.message) << c.pointer;
  }
  EXPECT_EQ(ErrorOf(Json(3)),
            "s.json: expected an object with \"robot\", \"obstacles\", "
            "\"start\", \"goal\", found 3");
}

// What is too long is known once the solids are.
TEST(SceneErrors, NameLengthsBeyondTheWorld) {
  for (const std::string place :
       {"/penetration/smoothing_length", "/trajectory/margin",
        "/planning/clearance"}) {
    const std::string error = ErrorWith(place, "1e6unit");
    EXPECT_EQ(error.find("s.json: " + place + ": expected at most "), 0U)
        << error;
    EXPECT_NE(error.find("unit (the world's diagonal D), found 1e+06unit"),
              std::string::npos)
        << error;
  }
}

TEST(SceneErrors, NameWhatIsNoMesh) {
  const std::filesystem::path folder(testing::TempDir());
  Json scene = Good();
  scene["robot"] = {{"mesh", "none.off"}};
  std::string message = "no error";
  try {
    ParseScene(scene, "s.json", folder.string());
  } catch (const InputError& error) {
    message = error.what();
  }
  const std::string path = (folder / "none.off").string();
  EXPECT_EQ(
      message.rfind(
          "s.json: /robot/mesh: expected a mesh file, found " + path + ": ", 0),
      0U)
      << message;

  std::ofstream(folder / "scene_errors_sheet.off")
      << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  scene["robot"] = {{"mesh", "scene_errors_sheet.off"}};
  try {
    ParseScene(scene, "s.json", folder.string());
    message = "no error";
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(
      message.rfind("s.json: /robot/mesh: \"scene_errors_sheet.off\": ", 0), 0U)
      << message;
}

std::string TextError(const std::string& text) {
  try {
    ParseJson(text, "s.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
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

// Every place of a document.
void CollectPlaces(const Json& value, const Pointer& at,
                   std::vector<Pointer>* places) {
  places->push_back(at);
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) {
      CollectPlaces(item, at / key, places);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      CollectPlaces(value[i], at / i, places);
    }
  }
}

// An InputError of one line, or a scene that keeps the reader's promises.
// Returns whether it was a scene.
bool ReadsOrRefuses(const std::string& text) {
  try {
    const Scene scene = ParseScene(ParseJson(text, "s.json"), "s.json");
    EXPECT_TRUE(scene.start.allFinite() && scene.goal.allFinite()) << text;
    EXPECT_FALSE(scene.workspace.obstacles.empty()) << text;
    EXPECT_NO_THROW(MakeSolid(scene.workspace.robot, "robot")) << text;
    EXPECT_GE(scene.trajectory.waypoints, 1) << text;
    ReachableObstacles(scene.workspace);
    return true;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("s.json: ", 0), 0U) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_LT(what.size(), 500U) << what;
    return false;
  }
}

TEST(SceneErrors, RandomDocumentsAreReadOrRefused) {
  const std::vector<Json> odd = {nullptr,
                                 true,
                                 0,
                                 -1,
                                 1e308,
                                 -1e-308,
                                 1e18,
                                 2.5,
                                 "",
                                 "a\nb",
                                 "~/",
                                 Json::array(),
                                 Json::object(),
                                 {1, 2, 3},
                                 {{"type", "box"}},
                                 "phong",
                                 18446744073709551615U};
  std::mt19937_64 random(1);
  const auto below = [&random](std::size_t n) {
    return static_cast<std::size_t>(random() % n);
  };
  int read = 0;
  constexpr int kDocuments = 4000;
  for (int i = 0; i < kDocuments; ++i) {
    Json scene = Good();
    for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
      std::vector<Pointer> places;
      CollectPlaces(scene, Pointer(), &places);
      const Pointer at = places[below(places.size())];
      Json& parent = at.empty() ? scene : scene[at.parent_pointer()];
      switch (at.empty() ? 0 : below(4)) {
        case 0:
          scene[at] = odd[below(odd.size())];
          break;
        case 1:  // another part of the document
          scene[at] = Json(scene[places[below(places.size())]]);
          break;
        case 2:
          if (parent.is_object()) parent.erase(at.back());
          break;
        default:
          if (parent.is_object()) parent[at.back() + "x"] = 1;
      }
    }
    read += ReadsOrRefuses(
        scene.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  EXPECT_GT(read, kDocuments / 20);
  EXPECT_LT(read, kDocuments / 2);
}

TEST(SceneErrors, RandomBytesAreReadOrRefused) {
  const std::string good = Good().dump();
  std::mt19937_64 random(2);
  int read = 0;
  constexpr int kDocuments = 4000;
  for (int i = 0; i < kDocuments; ++i) {
    std::string text = good;
    for (int changes = 0; changes < 1 + i % 3; ++changes) {
      const std::size_t at = random() % text.size();
      const char byte = i % 2 == 0
                            ? static_cast<char>(random() % 256)
                            : "{}[],:\"0123456789.-e \n/*#"[random() % 25];
      if (random() % 3 == 0) {
        text.erase(at, 1 + random() % 5);
      } else {
        text[at] = byte;
      }
    }
    read += ReadsOrRefuses(text);
  }
  EXPECT_GT(read, 20);
  EXPECT_LT(read, kDocuments / 2);
}

}  // namespace
}  // namespace phongpd
