// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd plan --model as users run it.  Truth: FCL on the original solids.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planners/world/planner_id.h"
#include "tests/problems/cli/cli_scenes.h"
#include "tests/support/sanitizer.h"

namespace phongpd {
namespace {

using CliModel = CliScenes;

// Below what is predicted for any contact space.
constexpr char kTooLittle[] = " --max-mib 3";

TEST_F(CliModel, WindowPlansWithoutTheContactSpace) {
  Json json = TwoObstacles();
  for (const bool has_bounds : {true, false}) {
    if (!has_bounds) json.erase("bounds");
    Scene(json);
    const phongpd::Scene scene = ReadScene(File("scene.json"));
    for (const PlannerId id : AllPlanners()) {
      if (!ChecksMotionsOnly(id)) continue;
      const std::string planner = ToString(id);
      const Json row = OneRow(
          "plan ../scene.json --time 3 --model window --planner " + planner, 0);
      EXPECT_EQ(row["planner"], planner);
      EXPECT_EQ(row["model"], "window");
      EXPECT_EQ(row["contact_triangles"], 0);
      EXPECT_EQ(row["verified"], "confirmed") << planner;
      EXPECT_GT(row["clearance"].get<double>(), 0.0);
      ExpectFree(row, scene);
    }
  }
}

TEST_F(CliModel, TakesAPlannerThatServesTheModel) {
  const std::string good = "plan " + Scene(TwoObstacles());
  const Json row = OneRow(good + " --model window", 0);
  EXPECT_EQ(row["planner"], "contact-surface");
  EXPECT_EQ(row["model"], "window");
  EXPECT_EQ(row["contact_triangles"], 0);
  EXPECT_EQ(row["verified"], "confirmed");
  EXPECT_GT(row["explored_boxes"], 0);
  EXPECT_GT(row["explored_faces"], 0);
  const Outcome outcome = Run(good + " --model window --output o.jsonl");
  for (const char* part : {"model window", "contact-surface", " boxes"}) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
  Json scene = TwoObstacles();
  scene["planning"] = {{"model", "window"}};
  EXPECT_EQ(OneRow("plan " + Scene(scene), 0)["model"], "window");
  EXPECT_EQ(OneRow("plan " + Scene(scene) + " --model full", 0)["planner"],
            "contact-surface");
}

TEST_F(CliModel, AutoIsFullWhereTheContactSpaceFits) {
  const std::string good = "plan " + Scene(TwoObstacles());
  const Json row = OneRow(good, 0);
  EXPECT_EQ(row["model"], "full");
  EXPECT_EQ(row["planner"], "contact-surface");
  EXPECT_EQ(WithoutSeconds(row),
            WithoutSeconds(OneRow(good + " --model full", 0)));
  EXPECT_EQ(WithoutSeconds(row),
            WithoutSeconds(OneRow(good + " --max-seconds 600", 0)));
}

TEST_F(CliModel, AutoTakesTheWindowWhereTheContactSpaceIsRefused) {
  const std::string good = "plan " + Scene(TwoObstacles()) + kTooLittle;
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  const std::string command = good + " --time 3";
  const Json row = OneRow(command, 0);
  EXPECT_EQ(row["model"], "window");
  EXPECT_EQ(row["planner"], "contact-surface");
  ExpectFree(row, scene);
  const Outcome outcome = Run(command + " --output o.jsonl");
  for (const char* part : {"model window", "max_mib"}) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
  // With what is freed kept back it is passed before anything is predicted.
  EXPECT_TRUE(testing::kIsSanitized ||
              outcome.err.find("predicted") != std::string::npos)
      << outcome.err;
}

// Limits of a build that is not needed refuse nothing.
TEST_F(CliModel, AutoTakesTheWindowWhereThatIsEnough) {
  const std::string good = "plan " + Scene(TwoObstacles()) + " --time 3";
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  for (const std::string planner : {"rrt-connect", "prm"}) {
    for (const std::string limit : {"", kTooLittle}) {
      const std::string command = good + " --planner " + planner + limit;
      const Json row = OneRow(command, 0);
      EXPECT_EQ(row["model"], "window");
      EXPECT_EQ(row["planner"], planner);
      EXPECT_EQ(row["contact_triangles"], 0);
      ExpectFree(row, scene);
      const Outcome outcome = Run(command + " --output o.jsonl");
      EXPECT_NE(outcome.err.find("which is enough for " + planner),
                std::string::npos)
          << outcome.err;
    }
    EXPECT_EQ(OneRow(good + " --model full --planner " + planner, 0)["model"],
              "full");
  }
}

TEST_F(CliModel, RefusesWhatThePlannerCannotDoWith) {
  const std::string good =
      "plan " + Scene(TwoObstacles()) + " --output o.jsonl";
  for (const PlannerId id : AllPlanners()) {
    if (!Retracts(id)) continue;
    const std::string planner = ToString(id);
    ExpectRefused(good + " --model window --planner " + planner,
                  {"window", "rrt-connect", planner, "full"});
    ExpectRefused(good + kTooLittle + " --planner " + planner,
                  {"max_mib", "predicted", "rrt-connect"});
  }
  ExpectRefused(good + kTooLittle + " --model full", {"max_mib", "predicted"});
  ExpectRefused(good +
                    " --model window --planner rrt-connect "
                    "--clearance 0.1",
                {"--clearance", "rrt-connect"});
  ExpectRefused(good + " --model some", {"--model", "some", "window"});
  Json scene = TwoObstacles();
  scene["planning"] = {{"model", "some"}};
  ExpectRefused("plan " + Scene(scene) + " --output o.jsonl",
                {"scene.json", "/planning/model", "window", "some"});
}

TEST_F(CliModel, BuildsNothingForAnEndThatIsNotFree) {
  Json scene = TwoObstacles();
  scene["goal"] = {0.1, 0, 0};
  const Json row = OneRow("plan " + Scene(scene) + " --model window", 1);
  EXPECT_EQ(row["model"], "none");
  EXPECT_EQ(row["status"], "goal_in_collision");
  EXPECT_EQ(row["seconds"]["contact_space"], 0.0);
}

TEST_F(CliModel, DrawsAndLogsTheWindow) {
  const Outcome outcome = Run("plan " + Scene(TwoObstacles()) +
                              " --model window --planner prm --time 0.3 "
                              "--output o.jsonl --html p.html --ompl-log "
                              "o.log");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GT(Content(Output("p.html")).size(), 1000U);
  EXPECT_NE(Content(Output("o.log")).find("1 planners"), std::string::npos);
  // Nothing in reach: the bounds alone.
  Json scene = TwoObstacles();
  scene["bounds"] = {{"min", {3, 3, 3}}, {"max", {4, 4, 4}}};
  scene["start"] = {3.2, 3.2, 3.2};
  scene["goal"] = {3.8, 3.8, 3.8};
  const Json row = OneRow("plan " + Scene(scene) + " --model window", 0);
  EXPECT_EQ(row["collision_free"], true);
  EXPECT_EQ(row["path"].size(), 2U);
}

}  // namespace
}  // namespace phongpd
