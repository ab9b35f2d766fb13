// SPDX-License-Identifier: GPL-3.0-or-later
// --verify and phongpd reproduce as users run them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "planners/solve/finish_answer.h"
#include "planners/world/world.h"
#include "problems/scenes/scene_source.h"
#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using CliVerify = CliScenes;

TEST_F(CliVerify, ConfirmsPathsProofsAndBlockedEnds) {
  const std::string good = Scene(TwoObstacles());
  for (const std::string command : {"plan ", "optimize "}) {
    const Json row = OneRow(command + good, 0);
    EXPECT_EQ(row["verified"], "confirmed");
    EXPECT_TRUE(row["seconds"]["verification"].is_number());
    EXPECT_TRUE(
        OneRow(command + good + " --no-verify", 0)["verified"].is_null());
    const Json proof = OneRow(command + Scene(ShutOff(), "shut.json"), 1);
    EXPECT_EQ(proof["verified"], "confirmed");
    Json blocked = TwoObstacles();
    blocked["goal"] = {0, 0, 0};
    EXPECT_EQ(OneRow(command + Scene(blocked, "blocked.json"), 1)["verified"],
              "confirmed");
  }
}

TEST_F(CliVerify, JudgesAnswersInTime) {
  const auto answer = [&](const std::string& command, int code) {
    const Outcome outcome = Run(command + " --limits 1,2,10 --json");
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return Json::parse(outcome.out);
  };
  const std::string good = "optimize " + Scene(TwoObstacles());
  EXPECT_EQ(answer(good, 0)["verified"], "confirmed");
  EXPECT_TRUE(answer(good + " --no-verify", 0)["verified"].is_null());
  const std::string shut = "optimize " + Scene(ShutOff(), "shut.json");
  for (const std::string model : {"full", "window"}) {
    const Json proof = answer(shut + " --model " + model, 1);
    EXPECT_EQ(proof["status"], "infeasible_proved");
    EXPECT_EQ(proof["verified"], "confirmed") << model;
  }
  Json blocked = TwoObstacles();
  blocked["goal"] = {0, 0, 0};
  EXPECT_EQ(answer("optimize " + Scene(blocked, "blocked.json"), 1)["verified"],
            "confirmed");
}

// What a wrong contact space or a broken planner would claim.
TEST(AnswerCheck, TakesBackWhatTheSolidsRefute) {
  const Scene scene = SceneSource("u_axis").Load();
  const World world(scene.workspace, scene.name);
  PathAnswer through, proof, blocked, elsewhere, curve, other_curve;
  through.path = {scene.start, scene.goal};  // through the arms of the U
  proof.status = PathStatus::kInfeasibleProved;
  blocked.status = PathStatus::kStartInCollision;
  elsewhere.path = {scene.start};
  curve.motion = Trajectory::Along({scene.start, scene.goal});
  other_curve.motion = Trajectory::Along({scene.goal, scene.start});
  for (PathAnswer* claim : {&through, &elsewhere, &curve, &other_curve}) {
    claim->status = PathStatus::kSolved;
    claim->is_free = claim->is_solved = true;
  }
  for (const PathAnswer& claim :
       {through, proof, blocked, elsewhere, curve, other_curve}) {
    PathAnswer answer = claim;
    internal::Finish(world, scene.start, scene.goal, {}, true, &answer);
    ASSERT_TRUE(answer.evidence.verification);
    EXPECT_EQ(answer.evidence.verification->verdict, Verdict::kRefuted);
    EXPECT_EQ(answer.status, PathStatus::kVerificationFailed);
    EXPECT_FALSE(answer.is_free);
    EXPECT_FALSE(answer.is_solved);
    EXPECT_FALSE(answer.IsInfeasible());
    EXPECT_FALSE(answer.reason.empty());
    PathAnswer unjudged = claim;
    internal::Finish(world, scene.start, scene.goal, {}, false, &unjudged);
    EXPECT_EQ(unjudged.status, claim.status);
    EXPECT_FALSE(unjudged.evidence.verification);
  }
}

TEST_F(CliVerify, MotionIsVerifiedWhereTheSolidsAreKnown) {
  const std::string motion =
      "motion --robot ../cone.off --obstacle ../box.off --from -3 0.1 0.2 "
      "--to 3 0.1 0.2 --frames 50 --output m.csv";
  const Outcome with = Run(motion);
  EXPECT_EQ(with.code, 0) << with.err;
  EXPECT_NE(with.out.find("verified on the original solids: 150 of 150"),
            std::string::npos)
      << with.out;
  EXPECT_EQ(Run(motion + " --no-verify").out.find("verified"),
            std::string::npos);
}

TEST_F(CliVerify, ContactSpacesAreSampled) {
  const std::string build =
      "contact-space --robot ../cone.off --obstacle ../box.off --output c.off "
      "--report r.json";
  const auto sample = [&](const std::string& flags) {
    EXPECT_EQ(Run(build + flags).code, 0);
    return Json::parse(Content(Output("r.json")))["verification"];
  };
  const Json fresh = sample("");
  EXPECT_GE(fresh["points"].get<int>(), 20);
  EXPECT_EQ(fresh["wrong"], 0);
  EXPECT_EQ(fresh["within_rounding"], 0);
  EXPECT_TRUE(sample("").is_null());  // from the cache
  EXPECT_TRUE(sample(" --no-cache --no-verify").is_null());
  EXPECT_TRUE(sample(" --no-cache --robot-hull").is_null());
}

class CliReproduce : public CliScenes {
 protected:
  Json Pack(const std::string& command) const {
    const Outcome outcome = Run("reproduce --output r.json -- " + command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = Content(Output("r.json"));
    // The folder of the test stands for the user's.
    EXPECT_EQ(text.find(folder_.string()), std::string::npos) << text;
    return Json::parse(text);
  }

  void ExpectReplays() const {
    const Outcome outcome = Run("reproduce --replay r.json");
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("as recorded"), std::string::npos);
    std::filesystem::remove(Output("r.json"));
  }
};

TEST_F(CliReproduce, PacksEveryKindOfCommandAndReplaysIt) {
  Json packed =
      Pack("contact-space --robot '" + File("cone.off") +
           "' --obstacle=../box.off --output c.off --report /nowhere/r.json");
  EXPECT_EQ(packed["files"].size(), 2U);
  EXPECT_EQ(packed["run"]["exit_code"], 0);
  EXPECT_EQ(packed["arguments"][2], "inputs/1/cone.off");
  EXPECT_EQ(packed["arguments"][3], "--obstacle=inputs/2/box.off");
  EXPECT_EQ(packed["arguments"].back(), "outputs/r.json");
  EXPECT_TRUE(packed["versions"].contains("CGAL"));
  ExpectReplays();

  Run("contact-space --robot ../cone.off --obstacle ../box.off --output "
      "../c.off");
  WriteText("p.csv", "x,y,z\n-0.5,0,0.1\n");
  packed = Pack("query --contact-space ../c.off --points ../p.csv --output q");
  EXPECT_EQ(packed["files"][1]["content"], "x,y,z\n-0.5,0,0.1\n");
  ExpectReplays();
}

TEST_F(CliReproduce, PacksTheMeshesOfASceneWhereverTheyAre) {
  Json scene = TwoObstacles();
  scene["robot"] = {{"mesh", File("cone.off")}};  // an absolute path
  scene["obstacles"][0] = {{"id", "wall"}, {"mesh", "box.off"}};
  scene["bounds"] = {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}};
  scene["start"] = {-5, 0, 0};
  scene["goal"] = {5, 0, 0};
  const Json packed = Pack("plan " + Scene(scene) + " --output o.jsonl");
  EXPECT_EQ(packed["files"].size(), 3U);
  EXPECT_EQ(packed["run"]["exit_code"], 0) << packed["run"];
  ExpectReplays();
}

TEST_F(CliReproduce, KeepsFailuresAndBytesThatAreNoText) {
  WriteText("broken.stl", std::string("solid \xff\x00\x01", 9));
  Json packed = Pack(
      "contact-space --robot ../broken.stl --obstacle ../none/x.off --output "
      "c.off");
  EXPECT_EQ(packed["files"][0]["encoding"], "base64");
  EXPECT_EQ(packed["arguments"][4], "missing/x.off");
  EXPECT_EQ(packed["run"]["exit_code"], 2);
  ExpectReplays();
  packed = Pack("plan '" + Scene(ShutOff()) + "' --output o.jsonl");
  EXPECT_EQ(packed["run"]["exit_code"], 1);
  ExpectReplays();
}

TEST_F(CliReproduce, ANewOutcomeIsExitCodeOne) {
  Json packed = Pack("scenes list");
  packed["run"]["exit_code"] = 3;
  WriteText("run/r.json", packed.dump());
  const Outcome outcome = Run("reproduce --replay r.json --folder kept");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find("recorded: exit code 3"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_directory(Output("kept")));
}

TEST_F(CliReproduce, RefusesWhatWouldWriteElsewhere) {
  ExpectRefused("reproduce", {"COMMAND ARGUMENTS", "--replay"});
  ExpectRefused("reproduce --output r.json -- reproduce --replay x",
                {"repeated"});
  const Json good = Json::parse(
      R"({"format": "phongpd reproduction 1", "files": [],
          "arguments": ["scenes", "list"]})");
  const auto refused = [&](const Json& json, const std::string& word) {
    WriteText("bad.json", json.dump());
    ExpectRefused("reproduce --replay ../bad.json", {"bad.json", word});
  };
  refused(Json::array(), "format");
  for (const std::string name : {"/nowhere/x", "../x", "a/../../x", ""}) {
    Json bad = good;
    bad["files"] = {{{"name", name}, {"encoding", "text"}, {"content", "x"}}};
    refused(bad, "file name");
    if (name.empty()) continue;
    bad = good;
    bad["arguments"] = {"scenes", "write", "u_axis", "--output", name};
    refused(bad, "argument");
    bad["arguments"] = {"scenes", "write", "u_axis", "--output=" + name};
    refused(bad, "argument");
  }
  ExpectRefused("reproduce --replay ../none.json", {"none.json"});
}

}  // namespace
}  // namespace phongpd
