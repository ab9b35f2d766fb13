// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "problems/scenes/scene.h"
#include "tests/problems/cli/cli_fixture.h"

// Runs commands on scenes and judges paths by FCL.
namespace phongpd {

class CliScenes : public Cli {
 protected:
  using Json = nlohmann::ordered_json;

  // A cube, a wall and a post it meets in its shadow.
  static Json TwoObstacles() {
    return Json::parse(R"({"name": "two",
      "robot": {"shape": {"type": "box", "size": [0.2, 0.2, 0.2]}},
      "obstacles": [
        {"id": "wall", "shape": {"type": "box", "size": [0.2, 1, 1]}},
        {"id": "post", "shape": {"type": "box", "size": [0.3, 0.3, 2]},
         "position": [0.6, 0.1, 0]}],
      "bounds": {"min": [-2, -2, -2], "max": [2, 2, 2]},
      "start": [-1.5, 0, 0], "goal": [1.5, 0, 0],
      "trajectory": {"waypoints": 12}})");
  }

  // The same with bounds that end where the wall does.
  static Json ShutOff() {
    Json scene = TwoObstacles();
    scene["bounds"] = {{"min", {-2, -0.3, -0.3}}, {"max", {2, 0.3, 0.3}}};
    return scene;
  }

  // Writes the scene beside run/; the argument that names it there.
  std::string Scene(const Json& json,
                    const std::string& name = "scene.json") const {
    WriteText(name, json.dump());
    return "../" + name;
  }

  // The rows that a command wrote to run/o.jsonl, after which it is empty.
  std::vector<Json> TakeRows() const {
    std::vector<Json> rows;
    for (const std::string& line : Split(Content(Output("o.jsonl")), '\n')) {
      rows.push_back(Json::parse(line));
    }
    std::filesystem::remove(Output("o.jsonl"));
    return rows;
  }

  // One run of `command`, which must end with `code`.
  Json OneRow(const std::string& command, int code) const {
    const Outcome outcome = Run(command + " --output o.jsonl");
    EXPECT_EQ(outcome.code, code) << command << outcome.out << outcome.err;
    std::vector<Json> rows = TakeRows();
    EXPECT_EQ(rows.size(), 1U) << command;
    return rows.empty() ? Json::object() : rows.front();
  }

  static std::vector<std::string> Keys(const Json& json) {
    std::vector<std::string> keys;
    for (const auto& item : json.items()) keys.push_back(item.key());
    return keys;
  }

  static Json WithoutSeconds(Json row) {
    row.erase("seconds");
    if (row.contains("stages")) {
      for (Json& stage : row["stages"]) stage.erase("seconds");
    }
    return row;
  }

  // Two runs from seed 5, and again with the flags `again`: different runs, but
  // the same bytes except for seconds.
  void ExpectRepeats(const std::string& command,
                     const std::string& again) const {
    const std::string runs = command + " --runs 2 --seed 5 --output o.jsonl";
    ASSERT_EQ(Run(runs).code, 0);
    const std::vector<Json> first = TakeRows();
    ASSERT_EQ(Run(runs + again).code, 0);
    const std::vector<Json> second = TakeRows();
    ASSERT_EQ(first.size(), 2U);
    ASSERT_EQ(second.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(first[i]["seed"], 5 + i);
      EXPECT_EQ(WithoutSeconds(first[i]).dump(),
                WithoutSeconds(second[i]).dump());
    }
    EXPECT_NE(first[0]["path"], first[1]["path"]);
  }

  // What every command of seeded runs on a scene refuses.
  void ExpectBadRunsRefused(const std::string& command) const {
    const std::string good = command + ' ' + Scene(TwoObstacles());
    const std::string rest = " --output o.jsonl";
    ExpectRefused(good + " --output nowhere/o.jsonl", {"nowhere"});
    ExpectRefused(command + " none.json" + rest, {"none.json"});
    ExpectRefused(command + " hole:delta=1" + rest, {"delta"});
    ExpectRefused(good + rest + " --metric l1", {"--metric", "l1"});
    ExpectRefused(good + rest + " --runs 0", {"--runs", "0"});
    ExpectRefused(good + rest + " --seed -1", {"--seed", "-1"});
    ExpectRefused(good + rest + " --time nan", {"--time", "nan"});
  }

  // What every flag that is a length refuses, in a world of D = 2.72.
  void ExpectBadLengthsRefused(const std::string& command,
                               const std::string& flag) const {
    for (const std::string value :
         {"-1", "-0.5unit", "1km", "unit", "nan", "infunit", "5%"}) {
      ExpectRefused(command + ' ' + flag + '=' + value,
                    {flag + ": expected a length >= 0 as 0.01 or 0.01D",
                     "found '" + value + "'"});
    }
    ExpectRefused(command + ' ' + flag + " 1.5D",
                  {flag, "at most 1 (the world's diagonal D)", "found 1.5"});
    ExpectRefused(command + ' ' + flag + " 2.8unit",
                  {flag, "at most 2.7", "unit", "found 2.8unit"});
  }

  // FCL on the original meshes at many points of the row's path, its ends and
  // the bounds.
  static void ExpectFree(const Json& row, const phongpd::Scene& scene) {
    std::vector<Eigen::Vector3d> path;
    for (const Json& p : row.at("path")) {
      path.emplace_back(p[0].get<double>(), p[1].get<double>(),
                        p[2].get<double>());
    }
    ASSERT_FALSE(path.empty());
    EXPECT_EQ(path.front(), scene.start);
    EXPECT_EQ(path.back(), scene.goal);
    const Workspace& workspace = scene.workspace;
    for (const Solid& obstacle : workspace.obstacles) {
      const CollisionOracle oracle(workspace.robot, obstacle);
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        for (int k = 0; k <= 20; ++k) {
          const Eigen::Vector3d q =
              path[i] + (path[i + 1] - path[i]) * (k / 20.0);
          EXPECT_FALSE(oracle.Collides(q)) << obstacle.name() << q.transpose();
        }
      }
    }
    for (const Eigen::Vector3d& q : path) {
      EXPECT_TRUE(workspace.bounds.IsEmpty() ||
                  ((q.array() > workspace.bounds.min.array()).all() &&
                   (q.array() < workspace.bounds.max.array()).all()));
    }
  }
};

}  // namespace phongpd
