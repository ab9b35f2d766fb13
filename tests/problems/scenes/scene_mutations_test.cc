// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files with other contents than anybody means: read or refused in one
// line, whatever they hold.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"
#include "tests/problems/scenes/good_scene.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

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
    EXPECT_GE(scene.duration, 0.0) << text;
    for (const Via& via : scene.via) {
      EXPECT_TRUE(via.point.allFinite()) << text;
      EXPECT_GE(via.dwell, 0.0) << text;
    }
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

TEST(SceneMutations, RandomDocumentsAreReadOrRefused) {
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
    Json scene = testing::GoodScene();
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

TEST(SceneMutations, RandomBytesAreReadOrRefused) {
  const std::string good = testing::GoodScene().dump();
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
