// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/shapes.h"
#include "tests/support/page_numbers.h"
#include "viewer/display_mesh.h"
#include "viewer/gltf.h"
#include "viewer/page_numbers.h"
#include "viewer/scene_view.h"
#include "viewer/view_json.h"
#include "viewer/view_page.h"
#include "viewer/wasm/page_modules.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::At;
using testing::Decoded;
using Json = nlohmann::ordered_json;

// A box far from the origin, a robot, two paths, of which one collides.
View SomeView() {
  View view;
  view.title = "a </script> & b";
  view.meshes = {
      {"box", ViewRole::kObstacle, MakeBox({1000, -1, -1}, {1002, 1, 1})},
      {"contact", ViewRole::kContactSpace,
       MakeBox({999, -2, -2}, {1003, 2, 2})}};
  view.robot = MakeBox({-1, -1, -1}, {1, 1, 1});
  view.start = Vector3d(998, 0, 0);
  view.goal = Vector3d(1004, 0, 0);
  view.paths = {
      {"phong, seed 1", {{998, 0, 0}, {998, 3, 0}, {1004, 3, 0}}, true},
      {"euclid", {{998, 0, 0}, {1004, 0, 0}}, false},
      {"none", {}, false}};
  return view;
}

// RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandard) {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"", ""},
      {"f", "Zg=="},
      {"fo", "Zm8="},
      {"foo", "Zm9v"},
      {"foob", "Zm9vYg=="},
      {"fooba", "Zm9vYmE="},
      {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : pairs) {
    EXPECT_EQ(internal::Base64(bytes), text);
    EXPECT_EQ(Decoded(text), bytes);
  }
}

TEST(ViewJson, HoldsMeshesToSinglePrecisionFarFromTheOrigin) {
  const View view = SomeView();
  const Json json = ViewJson(view);
  ASSERT_EQ(json["meshes"].size(), 2U);
  const double scale = json["scale"];
  for (std::size_t m = 0; m < 2; ++m) {
    const Json& entry = json["meshes"][m];
    const TriangleMesh& mesh = view.meshes[m].mesh;
    EXPECT_EQ(entry["name"], view.meshes[m].name);
    EXPECT_EQ(entry["triangles"], mesh.triangles.size());
    EXPECT_EQ(entry["shown"], mesh.triangles.size());
    const std::string positions = Decoded(entry["positions"]);
    const std::string indices = Decoded(entry["indices"]);
    ASSERT_EQ(positions.size(), 12 * mesh.vertices.size());
    ASSERT_EQ(indices.size(), 12 * mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double shown = At<float>(positions, 12 * v + 4 * k) * scale +
                             json["center"][k].get<double>();
        EXPECT_NEAR(shown, mesh.vertices[v][static_cast<int>(k)], 1e-7 * scale);
      }
    }
    for (std::size_t i = 0; i < indices.size(); i += 4) {
      EXPECT_EQ(At<std::uint32_t>(indices, i),
                static_cast<std::uint32_t>(mesh.triangles[i / 12][i / 4 % 3]));
    }
  }
  EXPECT_EQ(json["meshes"][0]["role"], "obstacle");
  EXPECT_EQ(json["meshes"][1]["role"], "contact");
  // Without the compiler for it a note says that there is no probe.
  EXPECT_EQ(json["notes"].size(), json["probe"].is_null() ? 1U : 0U);
}

TEST(ViewJson, HandsItsProbeContactSpacesToTheLastBit) {
  View view = SomeView();
  view.length = 2.5;
  const Json json = ViewJson(view);
  const Json& probe = json["probe"];
  if (probe.is_null()) GTEST_SKIP() << "built without the live probe";
  EXPECT_EQ(probe["length"], 2.5);
  EXPECT_EQ(Decoded(probe["module"]).substr(0, 4), std::string("\0asm", 4));
  ASSERT_EQ(probe["spaces"].size(), 1U);
  const TriangleMesh& mesh = view.meshes[1].mesh;
  const std::string positions = Decoded(probe["spaces"][0]["positions"]);
  const std::string indices = Decoded(probe["spaces"][0]["indices"]);
  ASSERT_EQ(positions.size(), 24 * mesh.vertices.size());
  ASSERT_EQ(indices.size(), 12 * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(At<double>(positions, 24 * v + 8 * k),
                mesh.vertices[v][static_cast<int>(k)]);
    }
  }
  view.length = 0.0;
  EXPECT_EQ(ViewJson(view)["probe"]["length"], ComputeBounds(mesh).Diagonal());
}

TEST(ViewJson, HasNoProbeWithoutContactSpaceOrForTooLargeOnes) {
  View view = SomeView();
  // The walls of bounds alone look inwards.
  for (const auto& [mesh, words] :
       {std::make_pair(MakeIcoBall(1.0, 7), "probe is left out"),
        std::make_pair(Reversed(MakeIcoBall(1.0, 2)), "no live probe")}) {
    view.meshes[1].mesh = mesh;
    const Json json = ViewJson(view);
    EXPECT_TRUE(json["probe"].is_null());
    EXPECT_NE(json["notes"].dump().find(words), std::string::npos);
  }
  view.meshes.pop_back();
  const Json none = ViewJson(view);
  EXPECT_TRUE(none["probe"].is_null());
  EXPECT_TRUE(none["notes"].empty());
}

TEST(ViewJson, NamesPathsAndSaysWhichAreFree) {
  const Json json = ViewJson(SomeView());
  ASSERT_EQ(json["paths"].size(), 3U);
  EXPECT_EQ(json["paths"][0]["name"], "phong, seed 1");
  EXPECT_EQ(json["paths"][0]["free"], true);
  EXPECT_EQ(json["paths"][0]["points"].size(), 3U);
  EXPECT_EQ(json["paths"][1]["free"], false);
  EXPECT_EQ(json["paths"][1]["points"][1], Json({1004.0, 0.0, 0.0}));
  EXPECT_TRUE(json["paths"][2]["points"].empty());
  EXPECT_TRUE(json["motion"].is_null());
}

// A build without a compiler for WebAssembly has no module.
TEST(ViewJson, PlansByItselfForOneRobotAmongFewTriangles) {
  View view = SomeView();
  view.motion = {};
  view.serve_command = "phongpd view x --serve";
  view.start = Eigen::Vector3d(1, 2, 3);
  view.goal = Eigen::Vector3d(4, 5, 6);
  const auto solver = [&view] { return ViewJson(view)["solver"]; };
  if (internal::SolverModule().empty()) {
    EXPECT_TRUE(solver().is_null());
    GTEST_SKIP() << "built without WebAssembly";
  }
  const Json json = solver();
  ASSERT_FALSE(json.is_null());
  // 8 bytes a coordinate, in base64.
  const std::size_t bytes = 24 * view.robot.vertices.size();
  EXPECT_EQ(json["robot"]["positions"].get<std::string>().size(),
            4 * ((bytes + 2) / 3));
  EXPECT_FALSE(json["obstacles"].empty());
  View other = view;
  view.is_served = true;
  EXPECT_TRUE(solver().is_null()) << "the server has a better one";
  view = other;
  view.movers.push_back({"belt", view.robot, {}});
  EXPECT_TRUE(solver().is_null()) << "obstacles that move";
  view = other;
  view.robot = MakeUvBall(1.0, 80, 80);
  ASSERT_GT(view.robot.triangles.size(), kMaxSolverTriangles);
  EXPECT_TRUE(solver().is_null()) << "too many triangles";
  view = other;
  for (ViewMesh& mesh : view.meshes) mesh.role = ViewRole::kMesh;
  EXPECT_TRUE(solver().is_null()) << "no obstacle";
}

TEST(SceneView, TellsTheClearanceThatItsSceneAsksFor) {
  Scene scene = SceneSource("u_axis").Load();
  scene.planning.clearance.reset();
  EXPECT_EQ(SceneView(scene).wanted_clearance, 0.0);
  scene.planning.clearance = Length::FromUnit(0.125);
  EXPECT_EQ(SceneView(scene).wanted_clearance, 0.125);
  scene.planning.clearance = Length::FromShare(0.25);
  const View view = SceneView(scene);
  EXPECT_DOUBLE_EQ(view.wanted_clearance, 0.25 * view.length);
}

TEST(ViewJson, AsksByTheKindOfItsRobots) {
  View view = SomeView();
  view.motion = {};
  EXPECT_TRUE(ViewJson(view)["task"].is_null()) << "nothing serves it";
  view.serve_command = "phongpd view x --serve";
  view.start = Eigen::Vector3d(1, 2, 3);
  view.goal = Eigen::Vector3d(4, 5, 6);
  EXPECT_EQ(ViewJson(view)["task"]["kind"], "translates");
  EXPECT_EQ(ViewJson(view)["task"]["clearance"], 0.0);
  view.wanted_clearance = 0.25;
  EXPECT_EQ(ViewJson(view)["task"]["clearance"], 0.25);
  view.turns = true;
  EXPECT_EQ(ViewJson(view)["task"]["kind"], "turns");
  view.turns = false;
  view.start.reset();
  view.goal.reset();
  EXPECT_TRUE(ViewJson(view)["task"].is_null()) << "there are no ends";
  view.robot = {};
  view.ends = {{"left", {1, 2, 3}, {4, 5, 6}}};
  const Json json = ViewJson(view);
  EXPECT_EQ(json["task"]["kind"], "robots");
  EXPECT_EQ(json["task"]["served"], false);
  EXPECT_EQ(json["ends"].dump(),
            "[{\"robot\":\"left\",\"start\":[1.0,2.0,3.0],"
            "\"goal\":[4.0,5.0,6.0]}]");
}

TEST(ViewJson, OfAnEmptyViewIsEmptyAndFinite) {
  const Json json = ViewJson(View());
  EXPECT_TRUE(json["meshes"].empty());
  EXPECT_TRUE(json["robot"].is_null());
  EXPECT_GT(json["scale"].get<double>(), 0.0);
  EXPECT_EQ(json["center"], Json({0.0, 0.0, 0.0}));
}

// A name must not end the element that the data stand in.
TEST(ViewPage, HoldsItsDataWhateverNamesHold) {
  const std::string page = ViewPage(SomeView());
  const std::string open = "id=\"view-data\">";
  const std::size_t begin = page.find(open) + open.size();
  const std::string data =
      page.substr(begin, page.find("</script>", begin) - begin);
  EXPECT_EQ(Json::parse(data)["title"], "a </script> & b");
  EXPECT_NE(page.find("<title>a &lt;/script&gt; &amp; b</title>"),
            std::string::npos);
  // It is whole, and asks for nothing from elsewhere.
  for (const char* const mark : {"@viewer.", "@three.js@", "@stage.js@",
                                 "@dress.js@", "@VIEW_", " src=", "@import"}) {
    EXPECT_EQ(page.substr(0, begin).find(mark), std::string::npos) << mark;
  }
  EXPECT_EQ(page.find("@start.js@"), std::string::npos);
  EXPECT_NE(page.find("Copyright © 2010-2019 three.js authors"),
            std::string::npos);
}

TEST(DisplayMesh, IsTheMeshItselfUpToTheLimit) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 3});
  const DisplayMesh same = MeshForDisplay(box, 12);
  EXPECT_EQ(same.mesh.triangles, box.triangles);
  EXPECT_EQ(same.cell, 0.0);
}

TEST(DisplayMesh, KeepsTheLimitAndTheShape) {
  const TriangleMesh ball = MakeUvBall(1.0, 400, 300);
  ASSERT_GT(ball.triangles.size(), 200000U);
  const DisplayMesh coarse = MeshForDisplay(ball, 5000);
  EXPECT_LE(coarse.mesh.triangles.size(), 5000U);
  EXPECT_GT(coarse.mesh.triangles.size(), 1500U);
  EXPECT_GT(coarse.cell, 0.0);
  for (const Vector3d& v : coarse.mesh.vertices) {
    EXPECT_NEAR(v.norm(), 1.0, std::sqrt(3.0) * coarse.cell);
  }
  EXPECT_NEAR(SurfaceArea(coarse.mesh), 4 * kPi, 0.1 * 4 * kPi);
}

TEST(DisplayMesh, IsSaidInANote) {
  View view;
  view.meshes = {{"ball", ViewRole::kMesh, MakeUvBall(1.0, 400, 300)}};
  const Json json = ViewJson(view);
  EXPECT_LE(json["meshes"][0]["shown"].get<std::size_t>(),
            kMaxDisplayTriangles);
  EXPECT_EQ(json["meshes"][0]["triangles"],
            view.meshes[0].mesh.triangles.size());
  ASSERT_EQ(json["notes"].size(), 1U);
  EXPECT_NE(json["notes"][0].get<std::string>().find("for display only"),
            std::string::npos);
}

struct Glb {
  Json json;
  std::string binary;
};

// By the specification: header, chunks, their lengths and paddings.
Glb Parsed(const std::string& glb) {
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(At<std::uint32_t>(glb, 4), 2U);
  EXPECT_EQ(At<std::uint32_t>(glb, 8), glb.size());
  const std::size_t length = At<std::uint32_t>(glb, 12);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(length % 4, 0U);
  Glb parsed;
  parsed.json = Json::parse(glb.substr(20, length));
  if (20 + length == glb.size()) return parsed;
  EXPECT_EQ(At<std::uint32_t>(glb, 20 + length), glb.size() - 28 - length);
  EXPECT_EQ(glb.substr(24 + length, 4), std::string("BIN\0", 4));
  parsed.binary = glb.substr(28 + length);
  EXPECT_EQ(parsed.json["buffers"][0]["byteLength"], parsed.binary.size());
  return parsed;
}

// The numbers of an accessor, within its buffer and its bounds.
std::vector<double> Numbers(const Glb& glb, std::size_t accessor) {
  const Json& a = glb.json["accessors"][accessor];
  const Json& view =
      glb.json["bufferViews"][a["bufferView"].get<std::size_t>()];
  const std::size_t size = a["type"] == "VEC4"   ? 4
                           : a["type"] == "VEC3" ? 3
                                                 : 1;
  const std::size_t count = a["count"], offset = view["byteOffset"];
  EXPECT_EQ(view["byteLength"], 4 * size * count);
  EXPECT_EQ(offset % 4, 0U);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < size * count; ++i) {
    const double number =
        a["componentType"] == 5126
            ? static_cast<double>(At<float>(glb.binary, offset + 4 * i))
            : At<std::uint32_t>(glb.binary, offset + 4 * i);
    EXPECT_GE(number, a["min"][i % size].get<double>());
    EXPECT_LE(number, a["max"][i % size].get<double>());
    numbers.push_back(number);
  }
  return numbers;
}

TEST(ViewGlb, PutsEveryVertexWhereItIs) {
  const View view = SomeView();
  const Glb glb = Parsed(ViewGlb(view));
  const Json& center = glb.json["nodes"][1]["translation"];
  const TriangleMesh& box = view.meshes[0].mesh;
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  const std::vector<double> p =
      Numbers(glb, primitive["attributes"]["POSITION"]);
  ASSERT_EQ(p.size(), 3 * box.vertices.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(p[i] + center[i % 3].get<double>(),
                box.vertices[i / 3][static_cast<int>(i % 3)], 1e-5);
  }
  const std::vector<double> indices = Numbers(glb, primitive["indices"]);
  ASSERT_EQ(indices.size(), 3 * box.triangles.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    EXPECT_EQ(indices[i], box.triangles[i / 3][i % 3]);
  }
  for (const Json& node : glb.json["nodes"]) {
    for (const Json& child : node.value("children", Json::array())) {
      EXPECT_LT(child.get<std::size_t>(), glb.json["nodes"].size());
    }
  }
}

TEST(ViewGlb, MovesTheRobotAlongEveryPath) {
  const View view = SomeView();
  const Glb glb = Parsed(ViewGlb(view));
  // The third path has no points.
  ASSERT_EQ(glb.json["animations"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& animation = glb.json["animations"][i];
    const std::vector<Vector3d>& points = view.paths[i].points;
    EXPECT_EQ(animation["name"], view.paths[i].name);
    const Json& target = animation["channels"][0]["target"];
    const Json& node = glb.json["nodes"][target["node"].get<std::size_t>()];
    EXPECT_EQ(node["name"], "robot");
    EXPECT_EQ(target["path"], "translation");
    const Json& sampler = animation["samplers"][0];
    const std::vector<double> times = Numbers(glb, sampler["input"]);
    const std::vector<double> at = Numbers(glb, sampler["output"]);
    ASSERT_EQ(times.size(), points.size());
    ASSERT_EQ(at.size(), 3 * points.size());
    EXPECT_EQ(times.front(), 0.0);
    EXPECT_NEAR(times.back(), kGltfSeconds, 1e-5);
    for (std::size_t k = 0; k < at.size(); ++k) {
      EXPECT_NEAR(
          at[k] + glb.json["nodes"][1]["translation"][k % 3].get<double>(),
          points[k / 3][static_cast<int>(k % 3)], 1e-5);
    }
  }
  // 3 of 9 units: a third of the time.
  const std::vector<double> times =
      Numbers(glb, glb.json["animations"][0]["samplers"][0]["input"]);
  EXPECT_NEAR(times[1], kGltfSeconds / 3, 1e-5);
}

TEST(ViewGlb, GivesPosesTurnsAndStandingStillIncreasingTimes) {
  View view;
  view.robot = MakeBox({-1, -1, -1}, {1, 1, 1});
  view.paths = {{"still", {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, true}};
  view.answers.resize(3);
  view.answers[1].orientation = {0.0, 1.0, 0.0, 0.0};
  const Glb glb = Parsed(ViewGlb(view));
  ASSERT_EQ(glb.json["animations"].size(), 2U);
  for (const Json& animation : glb.json["animations"]) {
    const std::vector<double> times =
        Numbers(glb, animation["samplers"][0]["input"]);
    ASSERT_EQ(times.size(), 3U);
    EXPECT_LT(times[0], times[1]);
    EXPECT_LT(times[1], times[2]);
  }
  const Json& poses = glb.json["animations"][1];
  EXPECT_EQ(poses["channels"][1]["target"]["path"], "rotation");
  // x, y, z, w.
  const std::vector<double> turns =
      Numbers(glb, poses["samplers"][1]["output"]);
  EXPECT_EQ(std::vector<double>(turns.begin() + 4, turns.begin() + 8),
            std::vector<double>({1, 0, 0, 0}));
}

TEST(ViewGlb, OfNothingIsValidAndOfTheHugeIsRefused) {
  const Glb empty = Parsed(ViewGlb(View()));
  EXPECT_FALSE(empty.json.contains("meshes"));
  EXPECT_FALSE(empty.json.contains("buffers"));
  View view;
  view.start = Vector3d(1e40, 0, 0);
  EXPECT_THROW(ViewGlb(view), InputError);
}

}  // namespace
}  // namespace phongpd
