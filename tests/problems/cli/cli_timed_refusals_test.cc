// SPDX-License-Identifier: GPL-3.0-or-later
// What `phongpd optimize --limits` and `phongpd retime` refuse, before anything
// is built.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

class CliTimedRefusals : public CliScenes {
 protected:
  void WritePath() const {
    WriteText("path.csv", "x,y,z\n-1.5,0,0\n0,1.2,0\n1.5,0,0\n");
  }
};

TEST_F(CliTimedRefusals, RefusesBadLimitsInOneLine) {
  Scene(TwoObstacles());
  WritePath();
  const std::string rest = " --output t.json --limits=";
  for (const std::string command :
       {"optimize ../scene.json", "retime ../path.csv --scene ../scene.json"}) {
    const auto refused = [&](const std::string& limits,
                             const std::vector<std::string>& words) {
      ExpectRefused(command + rest + limits, words);
    };
    refused("0,2,10", {"--limits: velocity of x", "above 0", "found 0"});
    refused("1e-200,1,1", {"limits: velocity of x", "1e-50 at least"});
    refused("1,-2,10", {"--limits: acceleration of x", "found -2"});
    refused("1,2,nan", {"--limits: jerk of x", "nan"});
    refused("1/2/3,2,9,norm", {"--limits", "one number each with norm"});
    refused("1,2,9,most", {"--limits", "V,A,J,norm", "1,2,9,most"});
    refused("1,2,inf", {"--limits: jerk of x", "inf"});
    refused("1,2/2/0,10", {"acceleration of z", "found 0"});
    refused("1/1,2,10", {"velocity", "x/y/z", "'1/1'"});
    refused("1//1,2,10", {"velocity of y"});
    refused("1,2", {"V,A,J", "'1,2'"});
    refused("1,2,10,5", {"V,A,J"});
    refused("fast", {"V,A,J", "'fast'"});
    refused("1e300,1e300,1e300", {"of x, found none"});
    const std::string good = command + " --limits 1,2,10";
    for (const std::string rate : {"0", "-5", "nan", "1e9", "often"}) {
      ExpectRefused(good + " --output t.csv --rate=" + rate, {"--rate", rate});
    }
    ExpectRefused(good + " --output t.json --rate 50", {"--rate", "t.json"});
    ExpectRefused(good + " --rate 50", {"--rate", "FILE.csv"});
    ExpectRefused(good + " --output t.csv --json", {"--json", "t.csv"});
    for (const std::string name : {"t.yaml", "t.gcode", "t.nc"}) {
      ExpectRefused(good + " --json --output " + name, {"--json", name});
      ExpectRefused(good + " --output " + name, {"--output " + name, "unit"});
    }
    ExpectRefused(good + " --output t.svg", {"--output", ".json", "t.svg"});
    ExpectRefused(good + " --output t.json --time 0", {"time", "0"});
    for (const std::string via :
         {"1,2", "1,2,3,0.1,0,0", "1,2,nan", "x,2,3", ""}) {
      ExpectRefused(good + " --output t.json --via='" + via + "'", {"--via"});
    }
    ExpectRefused(good + " --output t.json --via=-1.5,0,0,0",
                  {"--via: LENGTH", "> 0", "found 0"});
    ExpectRefused(good + " --output t.json --via=-1.5,0,0,0.5",
                  {"--via: LENGTH", "0.5D"});
    ExpectRefused(good + " --output t.json --via=-1.5,0,0,2D",
                  {"--via: LENGTH", "at most 1"});
    ExpectRefused(good + " --output t.json --via=-1.5,0,0,0.01,-1",
                  {"--via: DWELL", "-1"});
    for (const std::string duration : {"-1", "nan", "inf", "soon"}) {
      ExpectRefused(good + " --output t.json --duration=" + duration,
                    {"duration", duration});
    }
    ExpectRefused(good + " --output t.json --duration 9 --via=-1.5,0,0,0.01,1",
                  {"duration", "no dwell"});
    ExpectBadLengthsRefused(good + " --output t.json", "--margin");
  }
}

TEST_F(CliTimedRefusals, RefusesWhatMakesNoSense) {
  const std::string good = "optimize " + Scene(TwoObstacles());
  const std::string timed = good + " --output t.json --limits 1,2,10";
  for (const std::string flag :
       {"--metric euclidean", "--start straight", "--rows 2", "--runs 3",
        "--svg t.svg", "--polish never", "--per-obstacle"}) {
    ExpectRefused(timed + ' ' + flag, {Split(flag, ' ')[0], "--limits none"});
  }
  for (const std::string flag : {"--rate 50", "--via 0,1,0", "--duration 9"}) {
    ExpectRefused(good + " --output o.jsonl " + flag,
                  {Split(flag, ' ')[0], "--limits"});
  }
  WritePath();
  ExpectRefused("retime ../path.csv --scene ../scene.json --output t.json",
                {"--limits", "found none"});
  WriteText("one.csv", "x,y,z\n1,2,3\n");
  WriteText("still.csv", "x,y,z\n1,1,1\n1,1,1\n");
  const std::string rest = " --scene ../scene.json --limits 1,2,10";
  ExpectRefused("retime ../one.csv" + rest, {"one.csv", "two rows"});
  ExpectRefused("retime ../still.csv" + rest, {"two different places"});
  ExpectRefused("retime ../none.csv" + rest, {"none.csv"});
  Json json = TwoObstacles();
  json["goal"] = json["start"];
  ExpectRefused("optimize " + Scene(json) + " --limits 1,2,10",
                {"two different places", "(-1.5,0,0)"});
}

TEST_F(CliTimedRefusals, RefusesBadLimitsOfScenes) {
  const auto refused = [&](const Json& limits,
                           const std::vector<std::string>& words) {
    Json json = TwoObstacles();
    json["limits"] = limits;
    ExpectRefused("optimize " + Scene(json) + " --output t.json", words);
  };
  const Json good = {{"velocity", 1}, {"acceleration", 2}, {"jerk", 10}};
  for (const char* key : {"velocity", "acceleration", "jerk"}) {
    const std::string place = std::string("/limits/") + key;
    Json bad = good;
    bad.erase(key);
    refused(bad, {"scene.json", place, "nothing"});
    for (const Json& value : std::vector<Json>{0, -1, "fast", {1, 1}}) {
      bad[key] = value;
      refused(bad, {place, "a number > 0"});
    }
    bad[key] = {1, 0, 1};
    refused(bad, {place + "/1", "a number > 0", "found 0"});
  }
  Json slip = good;
  slip["jerks"] = 3;
  refused(slip, {"/limits", "jerks", "jerk"});
}

// Over 3 along x, from rest to rest: 3 / v, 2 (3 / a)^½ and (96 / j)^⅓ seconds
// at least.
TEST_F(CliTimedRefusals, MoreRowsThanThereMayBeBeforeTheMotionIsKnown) {
  const std::string scene = Scene(TwoObstacles());
  const std::string shut = Scene(ShutOff(), "shut.json");
  WritePath();
  for (const std::string& command : {"optimize " + scene, "optimize " + shut,
                                     "retime ../path.csv --scene " + scene}) {
    for (const auto& [limits, seconds] : {std::pair("0.2,2,10", "15.3 s"),
                                          {"1,0.01,10", "34.6 s"},
                                          {"1,2,0.001", "45.8 s"},
                                          {"0.2/9/9,2,10", "15.3 s"}}) {
      ExpectRefused(command + " --output t.csv --rate 1e6 --limits " + limits,
                    {"--rate: expected at most 1e+07 rows", seconds,
                     "at least, found 1e+06 Hz"});
    }
    ExpectRefused(command + " --output t.csv --limits 1e-5,2,10",
                  {"--rate: expected at most 1e+07 rows", "found 100 Hz"});
  }
  // Only what is sure: that no motion is there is an answer, and one that takes
  // longer than its ends tell is refused once it is known.
  EXPECT_EQ(Run("optimize " + shut +
                " --output ../t.csv --rate 1e6 --limits 0.311,2,10")
                .code,
            1);
  ExpectRefused(
      "optimize " + scene + " --output t.csv --rate 1e6 --limits 0.311,2,10",
      {"--rate: expected at most 1e+07 rows", "s at least"});
  // JSON has pieces and no rows.
  EXPECT_EQ(
      Run("optimize " + scene + " --output ../t.json --limits 1e-5,2,10").code,
      0);
}

}  // namespace
}  // namespace phongpd
