// SPDX-License-Identifier: GPL-3.0-or-later
// Clearances and margins: what is asked, kept and possible.  Truth: the room of
// boxes, by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using CliClearance = CliScenes;

constexpr double kRoom = 0.5;  // of start and goal, to the bounds

struct Asking {
  std::string command, flag, name, status;
};
const Asking kAsking[] = {{"plan", "--clearance", "clearance", "status"},
                          {"optimize", "--margin", "margin", "status_class"}};

void ExpectTold(const nlohmann::ordered_json& row, double asked) {
  const nlohmann::ordered_json& lengths = row["lengths"];
  EXPECT_NEAR(lengths["asked_clearance"]["unit"].get<double>(), asked, 1e-12);
  EXPECT_NEAR(lengths["start_room"]["unit"].get<double>(), kRoom, 1e-9);
  EXPECT_NEAR(lengths["goal_room"]["unit"].get<double>(), kRoom, 1e-9);
  const double kept = row["clearance"].get<double>();
  EXPECT_NEAR(row["clearance_shortfall"].get<double>(),
              std::max(0.0, asked - kept), 1e-9);
}

TEST_F(CliClearance, SaysWhatIsAskedKeptAndPossible) {
  const std::string scene = Scene(TwoObstacles());
  for (const Asking& a : kAsking) {
    const std::string command =
        a.command + ' ' + scene + ' ' + a.flag + " 0.6unit";
    const Json row = OneRow(command, 0);
    ExpectTold(row, 0.6);
    EXPECT_GT(row["clearance_shortfall"].get<double>(), 0.05);
    EXPECT_EQ(row["collision_free"], true);
    const std::string reason = row["reason"];
    EXPECT_NE(reason.find("of the " + a.name +
                          " of 0.6unit; the start has "
                          "0.5unit, the goal 0.5unit"),
              std::string::npos)
        << reason;
    // People are told, the impossible before anything is built.
    const Outcome outcome = Run(command);
    EXPECT_NE(outcome.out.find(reason), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("no path keeps the " + a.name +
                               " of 0.6unit: the start has 0.5unit, the goal "
                               "0.5unit"),
              std::string::npos)
        << outcome.err;
  }
  // Nobody asked: nothing is missing in words.
  EXPECT_EQ(OneRow("plan " + scene, 0)["reason"], "");
  EXPECT_TRUE(OneRow("plan " + scene, 0)["clearance_shortfall"].is_null());
}

TEST_F(CliClearance, IsAnErrorWhereItIsRequired) {
  const std::string two = Scene(TwoObstacles());
  Json near = TwoObstacles();
  near["goal"] = {-1.5, 0.3, 0.2};  // a clear line
  const std::string clear = Scene(near, "near.json");
  for (const Asking& a : kAsking) {
    const std::string rest = "unit --require";
    const Json missed =
        OneRow(a.command + ' ' + two + ' ' + a.flag + " 0.6" + rest, 1);
    EXPECT_EQ(missed[a.status], "clearance_missed");
    EXPECT_EQ(missed["solved"], false);
    EXPECT_EQ(missed["collision_free"], true);
    EXPECT_FALSE(missed["path"].empty());
    const Json kept =
        OneRow(a.command + ' ' + clear + ' ' + a.flag + " 0.4" + rest, 0);
    EXPECT_NE(kept[a.status], "clearance_missed");
    EXPECT_EQ(kept["solved"], true);
    ExpectTold(kept, 0.4);
    EXPECT_EQ(kept["clearance_shortfall"], 0.0);
  }
  ExpectRefused("plan " + two + " --require --output o.jsonl",
                {"--require", "--clearance"});
}

// Rows of compare are rows of optimize, of several ways of running.
TEST_F(CliClearance, IsSaidInEveryRowOfCompare) {
  Json scene = TwoObstacles();
  scene["trajectory"]["margin"] = "0.6unit";
  std::vector<std::string> keys =
      Keys(OneRow("optimize " + Scene(scene) + " --polish never", 0));
  keys.erase(std::find(keys.begin(), keys.end(), "path"));
  keys.push_back("protocol");
  std::sort(keys.begin(), keys.end());
  const Outcome outcome =
      Run("compare " + Scene(scene) +
          " --runs 2 --protocols straight-adaptive pipeline --metrics "
          "euclidean phong@0.2 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = Split(outcome.out, '\n');
  ASSERT_EQ(lines.size(), 8U);
  int free = 0;
  for (const std::string& line : lines) {
    const Json row = Json::parse(line);
    std::vector<std::string> found = Keys(row);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, keys);
    if (row["collision_free"].get<bool>()) {
      ++free;
      ExpectTold(row, 0.6);
      EXPECT_NE(row["reason"].get<std::string>().find("of the margin of 0.6"),
                std::string::npos);
    } else {
      EXPECT_TRUE(row["clearance_shortfall"].is_null());
    }
  }
  EXPECT_GE(free, 4);
}

TEST_F(CliClearance, IsSaidByCompareBeforeItRuns) {
  Json scene = TwoObstacles();
  scene["trajectory"]["margin"] = "0.6unit";
  const Outcome outcome =
      Run("compare " + Scene(scene) +
          " --runs 1 --protocols pipeline --metrics euclidean");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("seed 1: no path keeps the margin of 0.6unit"),
            std::string::npos)
      << outcome.err;
}

// 0.5 is meant as half a millimetre as a rule, and was half of D.
TEST_F(CliClearance, ALargeShareHasToSayThatItIsOne) {
  const std::string two = Scene(TwoObstacles());
  for (const Asking& a : kAsking) {
    for (const std::string bare : {"0.5", "0.11", "20"}) {
      ExpectRefused(a.command + ' ' + two + ' ' + a.flag + ' ' + bare +
                        " --output o.jsonl",
                    {a.flag, "expected a unit", "found " + bare,
                     "did you mean " + bare + "unit? or " + bare + "D"});
    }
    OneRow(a.command + ' ' + two + ' ' + a.flag + " 0.1", 0);
    OneRow(a.command + ' ' + two + ' ' + a.flag + " 0.11D", 0);
    Json scene = TwoObstacles();
    scene[a.command == "plan" ? "planning" : "trajectory"][a.name] = 0.5;
    ExpectRefused(
        a.command + ' ' + Scene(scene, "bare.json") + " --output o.jsonl",
        {"bare.json: /", a.name, "did you mean 0.5unit?"});
  }
}

// The unit's name changes how lengths are written, and nothing else.
TEST_F(CliClearance, IsInTheScenesUnitIfThatHasAName) {
  const std::string plain = Scene(TwoObstacles());
  Json scene = TwoObstacles();
  scene["unit"] = "mm";
  const std::string named = Scene(scene, "mm.json");
  for (const Asking& a : kAsking) {
    const std::string flag = ' ' + a.flag + ' ';
    const auto row = [&](const std::string& rest) {
      return OneRow(a.command + ' ' + rest, 0);
    };
    const Json truth = row(plain + flag + "0.4unit");
    EXPECT_TRUE(truth["lengths"]["unit"].is_null());
    Json with = scene;
    with[a.command == "plan" ? "planning" : "trajectory"][a.name] = 0.4;
    for (const std::string& rest :
         {named + flag + "0.4", named + flag + "0.4mm",
          named + flag + "0.4unit", Scene(with, "own.json")}) {
      const Json same = row(rest);
      EXPECT_EQ(same["lengths"]["unit"], "mm");
      ExpectTold(same, 0.4);
      EXPECT_EQ(same["path"], truth["path"]) << rest;
    }
    EXPECT_EQ(row(named + flag + "0.01D")["path"],
              row(plain + flag + "0.01")["path"]);
    const std::string reason = row(named + flag + "0.6mm")["reason"];
    EXPECT_NE(reason.find("of the " + a.name +
                          " of 0.6mm; the start has 0.5mm, the goal 0.5mm"),
              std::string::npos)
        << reason;
    const auto refused = [&](const std::string& rest,
                             const std::vector<std::string>& words) {
      ExpectRefused(a.command + ' ' + rest + " --output o.jsonl", words);
    };
    for (const std::string other : {"cm", "m", "in"}) {
      refused(named + flag + "20" + other,
              {a.flag, "20mm", "found '20" + other + "'",
               "the scene's unit is mm, and nothing is converted"});
    }
    refused(plain + flag + "20mm",
            {a.flag, "found '20mm'", "the user's unit has no name"});
    refused(named + flag + "20", {a.flag, "at most 2.7", "found 20mm"});
  }
}

}  // namespace
}  // namespace phongpd
