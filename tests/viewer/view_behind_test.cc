// SPDX-License-Identifier: GPL-3.0-or-later
// What lies behind an answer: in the page's data, and kept for a page that is
// written later.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "problems/shapes/shapes.h"
#include "tests/support/page_numbers.h"
#include "viewer/behind_json.h"
#include "viewer/display_mesh.h"
#include "viewer/view_json.h"

namespace phongpd {
namespace {

using testing::At;
using testing::Decoded;
using Json = nlohmann::ordered_json;

View ViewWithBehind() {
  View view;
  view.meshes = {{"box", ViewRole::kObstacle, MakeBox({0, -1, -1}, {2, 1, 3})}};
  view.paths = {{"phong, seed 1", {{-2, 0, 0}, {-2, 3, 0}, {4, 3, 0}}, true},
                {"euclid", {{-2, 0, 0}, {4, 0, 0}}, false}};
  return view;
}

TEST(ViewJson, HoldsWhatLiesBehindAnswersWhereThereIsAny) {
  View view = ViewWithBehind();
  EXPECT_TRUE(ViewJson(view)["graphs"].empty());
  ViewBehind& behind = view.paths[1].behind;
  behind.graph = {"roadmap", {{0, 0, 0}, {1, 2, 3}, {4, 0, 0}}, {{0, 2}}};
  behind.planes = {{{1, 2, 3}, {0, 0, 1}, 0.5}};
  behind.window = {{-3, -3, -3}, {5, 4, 3}};
  ViewAnswer answer;
  view.answers = {answer, answer};
  view.answers[1].window_reaches = {0.25, 2.0};
  view.answers[1].window_axes.col(0) = Eigen::Vector3d(0, 1, 0);
  Json json = ViewJson(view);
  const Json& graph = json["graphs"].at(0);
  EXPECT_EQ(graph["path"], 1);
  EXPECT_EQ(graph["name"], "roadmap");
  EXPECT_EQ(graph["points"], 3);
  EXPECT_EQ(At<std::uint32_t>(Decoded(graph["indices"]), 4), 2U);
  const std::string positions = Decoded(graph["positions"]);
  const double scale = json["scale"], center = json["center"][2];
  EXPECT_NEAR(At<float>(positions, 20) * scale + center, 3.0, 1e-6 * scale);
  EXPECT_EQ(json["planes"][0]["planes"].dump(),
            R"([{"point":[1.0,2.0,3.0],"normal":[0.0,0.0,1.0],"size":0.5}])");
  EXPECT_EQ(json["regions"].dump(),
            R"([{"path":1,"min":[-3.0,-3.0,-3.0],"max":[5.0,4.0,3.0]}])");
  EXPECT_TRUE(json["windows"].at(0).is_null());
  EXPECT_EQ(json["windows"][1]["reaches"].dump(), "[0.25,2.0]");
  EXPECT_EQ(json["windows"][1]["axes"][0].dump(), "[0.0,1.0,0.0]");
  EXPECT_TRUE(json["iterates"].empty());
  // Of a huge graph some edges.
  behind.graph.edges.assign(2 * kMaxDisplayEdges + 1, {0, 1});
  json = ViewJson(view);
  EXPECT_EQ(json["graphs"][0]["edges"], 2 * kMaxDisplayEdges + 1);
  EXPECT_LE(Decoded(json["graphs"][0]["indices"]).size(), 8 * kMaxDisplayEdges);
  EXPECT_NE(json["notes"].dump().find("edges of the roadmap are shown"),
            std::string::npos);
}

TEST(ViewJson, HoldsIterationsAndSaysHowManyAreLeftOut) {
  View view = ViewWithBehind();
  ViewIterates& iterates = view.paths[1].behind.iterates;
  iterates.count = 9;
  iterates.kept = {
      {0, "Ipopt", false, false, 1.5, 0.25, {{-2, 0, 0}, {4, 0, 0}}},
      {8, "corridor, round 2", true, true, 1.25, 0, {{-2, 0, 0}, {-2, 3, 0}}}};
  const Json json = ViewJson(view);
  ASSERT_EQ(json["iterates"].size(), 1U);
  const Json& entry = json["iterates"][0];
  EXPECT_EQ(entry["path"], 1);
  EXPECT_EQ(entry["count"], 9);
  EXPECT_EQ(entry["points"], 2);
  EXPECT_EQ(entry["kept"][1].dump(),
            R"({"number":8,"stage":"corridor, round 2","restoration":true,)"
            R"("free":true,"objective":1.25,"violation":0.0})");
  const std::string positions = Decoded(entry["positions"]);
  ASSERT_EQ(positions.size(), 2 * 2 * 12U);
  const double scale = json["scale"], center = json["center"][1];
  EXPECT_NEAR(At<float>(positions, 3 * 12 + 4) * scale + center, 3.0,
              1e-6 * scale);
  EXPECT_NE(json["notes"].dump().find("2 of 9 iterations are kept"),
            std::string::npos);
}

TEST(BehindJson, ComesBackToTheLastBit) {
  ViewBehind behind;
  behind.graph = {"roadmap", {{0.1, 1e-300, 0}, {1.0 / 3.0, 2, 3}}, {{0, 1}}};
  behind.planes = {{{1, 2, 3}, {0, 0.6, 0.8}, 0.1}};
  behind.window = {{-1, 0, 0}, {1.0 / 3.0, 2, 3}};
  behind.iterates.count = 7;
  behind.iterates.kept = {
      {6, "Ipopt", true, true, 0.1, 1e-9, {{0.1, 0.2, 0.3}}}};
  const std::string text = BehindJson(behind).dump();
  const ViewBehind again = BehindOf(Json::parse(text));
  EXPECT_EQ(BehindJson(again).dump(), text);
  EXPECT_EQ(again.graph.points, behind.graph.points);
  EXPECT_EQ(again.graph.edges, behind.graph.edges);
  EXPECT_EQ(again.planes[0].normal, behind.planes[0].normal);
  EXPECT_EQ(again.window.max, behind.window.max);
  EXPECT_TRUE(BehindOf(BehindJson({})).window.IsEmpty());
  EXPECT_EQ(again.iterates.count, 7U);
  EXPECT_EQ(again.iterates.kept[0].points, behind.iterates.kept[0].points);
  EXPECT_TRUE(again.iterates.kept[0].is_restoration);
  EXPECT_EQ(BehindJson(BehindOf(BehindJson({}))), BehindJson({}));
  EXPECT_THROW(BehindOf(Json::parse("{}")), nlohmann::json::exception);
}

}  // namespace
}  // namespace phongpd
