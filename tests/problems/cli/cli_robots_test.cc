// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd optimize of scenes of several robots, as users run it.  Truth: FCL at
// 10⁴ times for each pair, and the rows of the files.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// De Casteljau, in the piece that t is in; at rest afterwards.
Vector3d At(const nlohmann::ordered_json& pieces, double t) {
  const auto point = [](const nlohmann::ordered_json& p) {
    return Vector3d(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
  };
  for (const auto& piece : pieces) {
    const double duration = piece.at("duration").get<double>();
    if (t > duration) {
      t -= duration;
      continue;
    }
    std::vector<Vector3d> points;
    for (const auto& p : piece.at("points")) points.push_back(point(p));
    while (points.size() > 1) {
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        points[i] += t / duration * (points[i + 1] - points[i]);
      }
      points.pop_back();
    }
    return points.front();
  }
  return point(pieces.back().at("points").back());
}

class CliRobots : public CliScenes {
 protected:
  // Two that change places beside a post.
  static Json Swap() {
    return Json::parse(R"({"name": "swap", "unit": "m",
      "robots": [
        {"id": "left", "shape": {"type": "box", "size": [0.2, 0.2, 0.2]},
         "start": [-1, 0.3, 0], "goal": [1, 0.3, 0]},
        {"id": "right", "shape": {"type": "box", "size": [0.2, 0.2, 0.2]},
         "start": [1, 0.3, 0], "goal": [-1, 0.3, 0]}],
      "obstacles": [{"id": "post",
                     "shape": {"type": "box", "size": [0.2, 0.2, 2]}}],
      "bounds": {"min": [-2, -2, -0.1], "max": [2, 2, 0.1]},
      "limits": {"velocity": 1, "acceleration": 2, "jerk": 20},
      "preset": "fast"})");
  }
};

TEST_F(CliRobots, ExplainWhatAllShareOnceAndWhatEachHasByItsName) {
  Json swap = Swap();
  swap["robots"][1]["limits"] = {
      {"velocity", 2}, {"acceleration", 2}, {"jerk", 20}};
  const Outcome outcome = Run("optimize " + Scene(swap) + " --explain");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto count = [&](const std::string& beginning) {
    std::size_t found = 0;
    for (const std::string& line : Split(outcome.err, '\n')) {
      found += line.rfind("phongpd: " + beginning, 0) == 0 ? 1 : 0;
    }
    return found;
  };
  EXPECT_EQ(count("preset: fast (by the scene)"), 1U) << outcome.err;
  EXPECT_EQ(count("world: D = "), 1U);
  for (const std::string robot : {"left", "right"}) {
    EXPECT_EQ(count(robot + ": limits: velocity "), 1U) << outcome.err;
    EXPECT_EQ(count(robot + ": preset"), 0U);
  }
}

TEST_F(CliRobots, AreAskedForTheUnitOfLimitsThatMakeThemSlow) {
  Json slow = Swap();
  slow["limits"]["velocity"] = 0.001;
  const Outcome outcome = Run("optimize " + Scene(slow));
  for (const std::string robot : {"left", "right"}) {
    EXPECT_NE(outcome.err.find(robot + ": the motion takes"), std::string::npos)
        << outcome.err;
  }
  EXPECT_NE(outcome.err.find("are the limits in the scene's unit, m?"),
            std::string::npos);
}

TEST_F(CliRobots, ChangePlacesCertifiedPairByPair) {
  const std::string scene = Scene(Swap());
  const Outcome outcome = Run("optimize " + scene + " --output t.json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("swap: 2 robots, "), std::string::npos);
  EXPECT_NE(outcome.out.find("left and right: "), std::string::npos);
  const Json row = Json::parse(Content(Output("t.json")));
  EXPECT_EQ(row.at("solved"), true);
  ASSERT_EQ(row.at("robots").size(), 2u);
  ASSERT_EQ(row.at("pairs").size(), 1u);
  const Json& pair = row.at("pairs")[0];
  EXPECT_EQ(pair.at("robots"), Json({"left", "right"}));
  EXPECT_EQ(pair.at("certified"), true);
  EXPECT_EQ(pair.at("verified"), "confirmed");
  double slowest = 0.0;
  for (const Json& robot : row.at("robots")) {
    EXPECT_EQ(robot.at("certified"), true);
    EXPECT_EQ(robot.at("verified"), "confirmed");
    slowest = std::max(slowest, robot.at("duration").get<double>());
  }
  EXPECT_EQ(row.at("duration"), slowest);
  const Json& left = row.at("robots")[0];
  const Json& right = row.at("robots")[1];
  EXPECT_EQ(left.at("id"), "left");
  EXPECT_EQ(At(left.at("pieces"), 99.0), Vector3d(1, 0.3, 0));
  // Two boxes of 0.2: their distance by hand.
  double least = 1e9;
  for (int i = 0; i <= 10'000; ++i) {
    const double t = slowest * i / 10'000;
    const Vector3d apart =
        ((At(left.at("pieces"), t) - At(right.at("pieces"), t)).cwiseAbs() -
         Vector3d::Constant(0.2))
            .cwiseMax(0.0);
    least = std::min(least, apart.norm());
  }
  EXPECT_GT(least, 0.0);
  EXPECT_LE(pair.at("clearance").get<double>(), least);
  EXPECT_GE(pair.at("clearance").get<double>(), 0.45 * least);
  EXPECT_NEAR(pair.at("least").get<double>(), least, 0.01 * least + 1e-6);
}

TEST_F(CliRobots, WriteAFileEachOnOneClock) {
  const std::string scene = Scene(Swap());
  ASSERT_EQ(Run("optimize " + scene + " --output t.csv --rate 20").code, 0);
  EXPECT_FALSE(std::filesystem::exists(Output("t.csv")));
  for (const std::string id : {"left", "right"}) {
    const std::vector<std::string> rows =
        Split(Content(Output("t." + id + ".csv")), '\n');
    ASSERT_GT(rows.size(), 10u);
    EXPECT_EQ(rows[0], "t,x,y,z,vx,vy,vz,ax,ay,az");
    const double start = id == "left" ? -1.0 : 1.0;
    for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
      EXPECT_NEAR(Number(Split(rows[i], ',')[0]),
                  0.05 * static_cast<double>(i - 1), 1e-12);
    }
    EXPECT_EQ(Number(Split(rows[1], ',')[1]), start);
    EXPECT_EQ(Number(Split(rows.back(), ',')[1]), -start);
  }
  ASSERT_EQ(Run("optimize " + scene + " --output t.yaml").code, 0);
  EXPECT_NE(Content(Output("t.left.yaml"))
                .find("joint_names: [left_x, left_y, left_z]\n"),
            std::string::npos);
  ASSERT_EQ(Run("optimize " + scene + " --output t.multidof.yaml").code, 0);
  EXPECT_NE(
      Content(Output("t.right.multidof.yaml")).find("joint_names: [right]\n"),
      std::string::npos);
}

TEST_F(CliRobots, ShowThemAllOnOnePage) {
  const std::string scene = Scene(Swap());
  const Outcome outcome = Run("optimize " + scene + " --html t.html");
  if (outcome.code == 2) GTEST_SKIP() << outcome.err;  // without three.js
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = Content(Output("t.html"));
  EXPECT_NE(page.find("Closest to each other: left and right"),
            std::string::npos);
}

TEST_F(CliRobots, AreNotSolvedWhereNoneCanPass) {
  Json narrow = Swap();
  narrow["bounds"] = {{"min", {-2, 0.25, -0.1}}, {"max", {2, 0.35, 0.1}}};
  const std::string scene = Scene(narrow);
  const Outcome outcome = Run("optimize " + scene + " --output t.json");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const Json row = Json::parse(Content(Output("t.json")));
  EXPECT_EQ(row.at("solved"), false);
  EXPECT_NE(row.at("reason").get<std::string>().find("no motion was found"),
            std::string::npos);
  EXPECT_EQ(row.at("pairs").size(), 0u);
  EXPECT_EQ(row.at("robots").size(), 2u);
  // A machine gets answers only.
  EXPECT_EQ(Run("optimize " + scene + " --output t.csv").code, 1);
  EXPECT_EQ(Content(Output("t.left.csv")), "t,x,y,z,vx,vy,vz,ax,ay,az\n");
}

TEST_F(CliRobots, AreRefusedInOneLineBeforeLongWork) {
  const std::string scene = Scene(Swap());
  for (const std::string& command : std::vector<std::string>{
           "plan " + scene + " --output o.jsonl", "compare " + scene,

           "retime ../p.csv --scene " + scene + " --output t.json"}) {
    WriteText("p.csv", "x,y,z\n-1,0.3,0\n1,0.3,0\n");
    ExpectRefused(command, {"/robots: expected one robot here",
                            "found a list of 2", "phongpd optimize"});
  }
  const std::string good = "optimize " + scene;
  ExpectRefused(good + " --output t.gcode",
                {"--output", "FILE.csv", "several robots", "t.gcode"});
  ExpectRefused(good + " --limits none", {"\"left\"", "limits", "--limits"});
  ExpectRefused(good + " --via 0,1,0", {"--via", "several robots"});
  ExpectRefused(good + " --metric phong", {"--metric", "several robots"});
  ExpectRefused(good + " --rate 50", {"--rate", "FILE.csv"});
  Json close = Swap();
  close["robots"][1]["start"] = {-0.9, 0.3, 0};
  ExpectRefused(
      "optimize " + Scene(close),
      {"robots: \"left\" at (-1,0.3,0)", "\"right\"", "touch at their starts"});
  Json unlimited = Swap();
  unlimited.erase("limits");
  ExpectRefused("optimize " + Scene(unlimited),
                {"\"left\"", "expected limits", "--limits V,A,J"});
  unlimited.erase("unit");
  ExpectRefused(
      "optimize " + Scene(unlimited) + " --limits 1,2,20 --output t.yaml",
      {"unit"});
}

}  // namespace
}  // namespace phongpd
