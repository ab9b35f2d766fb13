// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd compare as users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using CliCompare = CliScenes;

TEST_F(CliCompare, RowsOfPartsAreTheWhole) {
  const std::string what =
      "compare thin_wall:thickness=0.02,triangles=80 " + Scene(TwoObstacles()) +
      " --runs 2 --seed 3 --metrics euclidean phong@0.2 --protocols "
      "straight-adaptive pipeline --output ";
  ASSERT_EQ(Run(what + "whole").code, 0);
  ASSERT_EQ(Run(what + "part0 --shard 0/2").code, 0);
  ASSERT_EQ(Run(what + "part1 --shard 1/2").code, 0);
  EXPECT_FALSE(std::filesystem::exists(Output("part0/summary.csv")));
  EXPECT_FALSE(std::filesystem::exists(Output("part0/shard.json")));
  const Outcome merged =
      Run("compare --rows part1/rows.jsonl part0/rows.jsonl --output merged");
  ASSERT_EQ(merged.code, 0) << merged.err;

  const auto rows = [&](const std::string& folder) {
    std::vector<std::string> lines;
    for (const std::string& line :
         Split(Content(Output(folder + "/rows.jsonl")), '\n')) {
      lines.push_back(WithoutSeconds(Json::parse(line)).dump());
    }
    return lines;
  };
  EXPECT_EQ(rows("whole").size(), 2U * 2U * 4U);
  EXPECT_EQ(rows("whole"), rows("merged"));
  // A quoted label holds one comma; without the columns of seconds.
  const auto cells = [&](const std::string& folder) {
    std::vector<std::string> lines;
    for (const std::string& line :
         Split(Content(Output(folder + "/summary.csv")), '\n')) {
      std::vector<std::string> columns = Split(line, ',');
      const std::size_t shift = line[0] == '"' ? 1 : 0;
      EXPECT_EQ(columns.size(), 16U + shift) << line;
      columns[10 + shift] = columns[11 + shift] = "";
      std::string text;
      for (const std::string& column : columns) text += column + ',';
      lines.push_back(text);
    }
    return lines;
  };
  EXPECT_EQ(cells("whole").size(), 1U + 2U * 4U);
  EXPECT_EQ(cells("whole"), cells("merged"));
  for (const char* name :
       {"rows.csv", "profile-straight-adaptive-iterations.svg",
        "profile-straight-adaptive-jacobians.svg",
        "profile-straight-adaptive-seconds.svg"}) {
    EXPECT_FALSE(Content(Output(std::string("merged/") + name)).empty())
        << name;
  }
}

// Once every pipeline ran with phong@0.2, whatever was asked; and the metrics
// of the study alone are known here.
TEST_F(CliCompare, EveryProtocolFollowsTheMetricAsked) {
  const Outcome found =
      Run("compare " + Scene(TwoObstacles()) +
          " --runs 1 --metrics euclidean phong@0.1 followed mixed@0.1 "
          "faded@0.1 --protocols pipeline straight-adaptive --json");
  ASSERT_EQ(found.code, 0) << found.err;
  std::vector<std::string> methods;
  for (const std::string& line : Split(found.out, '\n')) {
    const Json row = Json::parse(line);
    const std::string method = row.at("method");
    EXPECT_EQ(row.at("metric"), method.substr(0, method.find('@')));
    EXPECT_EQ(row.at("smoothing_length").is_null(),
              method == "euclidean" || method == "followed");
    methods.push_back(row.at("protocol").get<std::string>() + " " + method);
  }
  std::vector<std::string> expected;
  for (const char* protocol : {"pipeline ", "straight-adaptive "}) {
    for (const char* method :
         {"euclidean", "phong@0.1", "followed", "mixed@0.1", "faded@0.1"}) {
      expected.push_back(std::string(protocol) + method);
    }
  }
  EXPECT_EQ(methods, expected);
}

TEST_F(CliCompare, PartsThatAreLostRepeatedOrCutShortAreNamed) {
  const std::string what = "compare " + Scene(TwoObstacles()) +
                           " --runs 3 --metrics euclidean --protocols "
                           "straight-adaptive --output ";
  // More parts than problems: the last one has none.
  for (const std::string part : {"0", "1", "2", "3"}) {
    ASSERT_EQ(Run(what + "../p" + part + " --shard " + part + "/4").code, 0);
  }
  const auto rows = [](const std::string& parts) {
    std::string flags = "compare --rows";
    for (const char part : parts) {
      flags += std::string(" ../p") + part + "/rows.jsonl";
    }
    return flags;
  };
  EXPECT_EQ(Content(folder_ / "p3/rows.jsonl"), "");
  const Outcome all = Run(rows("3120"));
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_NE(all.out.find(" of 3 ("), std::string::npos) << all.out;
  EXPECT_EQ(Run(rows("0123")).out.find("\"part\""), std::string::npos);
  ExpectRefused(rows("02") + " --output out",
                {"euclidean", "all 3 problems", "2 of 3", "part 1/4"});
  ExpectRefused(rows("1"), {"1 of 3", "part 0/4, 2/4"});
  ExpectRefused(rows("0121") + " --output out",
                {"p1/rows.jsonl: row 1", "once", "seed 2", "euclidean"});
  ExpectRefused(rows("3") + " --output out", {"p3/rows.jsonl", "found none"});
  ExpectRefused(rows("01") + " ../none.jsonl --output out", {"none.jsonl"});
  const std::string whole = Content(folder_ / "p2/rows.jsonl");
  WriteText("p2/rows.jsonl", whole + whole);
  ExpectRefused(rows("012") + " --output out",
                {"p2/rows.jsonl: row 2", "p2/rows.jsonl: row 1"});
  WriteText("p2/rows.jsonl", whole.substr(0, whole.size() / 2));
  ExpectRefused(rows("012") + " --output out", {"p2/rows.jsonl: row 1"});
  const std::string mark = "\"part\":[2,4,2,3]";
  const std::size_t at = whole.find(mark);
  ASSERT_NE(at, std::string::npos) << whole;
  for (const std::string bad :
       {"7", "[2,4,1,3]", "[4,4,2,3]", "[2,4,2,2]", "[2,4,2]"}) {
    std::string other = whole;
    WriteText("p2/rows.jsonl",
              other.replace(at, mark.size(), "\"part\":" + bad));
    ExpectRefused(rows("012"), {"seed 3: expected at /part", bad});
  }
  EXPECT_FALSE(std::filesystem::exists(Output("out")));
}

// Once left the directory behind, or called bad rows a fault of its own.
TEST_F(CliCompare, RefusesBadInputAndLeavesNoDirectory) {
  const std::string good = "compare " + Scene(TwoObstacles());
  const std::string rest = " --output a/b --runs 1";
  ExpectRefused("compare" + rest, {"--rows"});
  ExpectRefused(good + rest + " --rows ../r.jsonl", {"--rows"});
  ExpectRefused("compare --rows ../none.jsonl" + rest, {"none.jsonl"});
  ExpectRefused("compare none.json" + rest, {"none.json"});
  for (const std::string shard : {"2/2", "-1/2", "1", "a/b", "0/0", "0/2x"}) {
    ExpectRefused(good + rest + " --shard=" + shard, {"--shard", shard});
  }
  ExpectRefused(good + " --output a --runs 0", {"--runs"});
  ExpectRefused(good + rest + " --seed 0", {"--seed"});
  ExpectRefused(good + rest + " --metrics phong@x", {"--metrics", "'x'"});
  ExpectRefused(good + rest + " --metrics phong@2", {"smoothing_length", "2"});
  ExpectRefused(
      good + rest + " --metrics phong@0.1km",
      {"--metrics: smoothing_length: expected a length >= 0", "found '0.1km'"});
  ExpectRefused(good + rest + " --metrics phong@-1unit",
                {"--metrics: smoothing_length", "found '-1unit'"});
  ExpectRefused(good + rest + " --protocols fast", {"--protocols", "fast"});
  ExpectRefused(good + " ../scene.json" + rest, {"two", "twice"});
  ExpectRefused(good + " --output ../scene.json", {"scene.json"});
  Json scene = TwoObstacles();
  scene["trajectory"]["ipopt"] = {{"tool", 1}};
  ExpectRefused("compare " + Scene(scene, "tool.json") + rest, {"tool"});
  WriteText("r.jsonl", "{\"scene\":1}\n");
  ExpectRefused("compare --rows ../r.jsonl" + rest,
                {"r.jsonl: row 1", "/scene", "1"});
}

}  // namespace
}  // namespace phongpd
