// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that come through a pipe, and scenes that a stranger wrote.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

class CliStrangers : public CliScenes {
 protected:
  // Runs the command while somebody writes the text to ../pipe, once.
  Outcome RunPiped(const std::string& command, const std::string& text) const {
    const std::string pipe = File("pipe");
    EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const pid_t writer = fork();
    if (writer == 0) {
      std::ofstream(pipe) << text;
      _exit(0);
    }
    const Outcome outcome = Run(command);
    kill(writer, SIGKILL);  // if nobody has read
    waitpid(writer, nullptr, 0);
    std::filesystem::remove(pipe);
    return outcome;
  }
};

TEST_F(CliStrangers, ScenesComeThroughPipesThatAreReadOnce) {
  const std::string text = TwoObstacles().dump();
  for (const std::string command :
       {"plan ../pipe --json", "optimize ../pipe --json",
        "compare ../pipe --runs 1 --metrics euclidean --protocols "
        "straight-adaptive --output c",
        "view ../pipe --html v.html"}) {
    const Outcome outcome = RunPiped(command, text);
    EXPECT_EQ(outcome.code, 0) << command << '\n' << outcome.err;
  }
  // Mesh files are found from where the program runs.
  Json scene = TwoObstacles();
  scene["robot"] = {{"mesh", "../box.off"}, {"scale", 0.1}};
  const Outcome outcome = RunPiped("plan ../pipe --json", scene.dump());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(CliStrangers, ScenesThroughPipesHaveTheLimitOfFiles) {
  const Outcome outcome = RunPiped(
      "plan ../pipe --json", std::string(phongpd::kMaxSceneBytes + 1, ' '));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("of 268435456 allowed"), std::string::npos)
      << outcome.err;
}

// Neither the file nor the process is theirs.
TEST_F(CliStrangers, ScenesSetNoOptionOfIpoptThatDoesMoreThanChangeNumbers) {
  WriteText("precious.txt", "precious");
  for (const auto& [option, value] :
       {std::pair("output_file", "../precious.txt"),
        {"option_file_name", "../precious.txt"},
        {"print_options_documentation", "yes"},
        {"nlp_scaling_method", "equilibration-based"},
        {"linear_solver", "ma97"},
        {"linear_system_scaling", "mc19"},
        {"dependency_detector", "ma28"}}) {
    Json scene = TwoObstacles();
    scene["trajectory"]["ipopt"] = {{option, value}};
    const std::string file = Scene(scene);
    for (const std::string root : {" --root ..", ""}) {
      ExpectRefused("optimize " + file + root + " --output o.jsonl",
                    {"'" + std::string(option) + "'", "expected"});
    }
    EXPECT_EQ(Content(File("precious.txt")), "precious");
  }
}

TEST_F(CliStrangers, ASlipOfTheLimitsUnitIsAskedAbout) {
  Json scene = TwoObstacles();
  scene["unit"] = "mm";
  const std::string command = "optimize " + Scene(scene) + " --preset fast";
  const Outcome slow = Run(command + " --limits 0.001,0.01,0.1");
  EXPECT_EQ(slow.code, 0) << slow.err;
  EXPECT_NE(slow.err.find("phongpd: warning: the motion takes "),
            std::string::npos)
      << slow.err;
  EXPECT_NE(slow.err.find(" s; are the limits in the scene's unit, mm?\n"),
            std::string::npos)
      << slow.err;
  for (const std::string limits : {"1,2,10", "1mm,2mm,10mm"}) {
    const Outcome good = Run(command + " --limits " + limits);
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_EQ(good.err.find("are the limits"), std::string::npos) << good.err;
  }
  EXPECT_EQ(Run(command + " --limits 1cm,2,10").code, 2);
}

TEST_F(CliStrangers, SentencesOfDepthHaveSixDigits) {
  const std::string command = "depth ../box.off ../cone.off --at 0.1,0.2,0.3";
  const Outcome said = Run(command);
  EXPECT_EQ(said.code, 0) << said.err;
  std::size_t longest = 0, digits = 0;
  for (const char c : said.out) {
    digits = ('0' <= c && c <= '9') || c == '.' ? digits + 1 : 0;
    longest = std::max(longest, digits);
  }
  EXPECT_LE(longest, 8U) << said.out;  // "0." and six
  // The metric that is Euclidean has nothing to stand beside it.
  EXPECT_EQ(Run(command + " --metric euclidean --json").code, 0);
  const Json euclidean =
      Json::parse(Run(command + " --metric euclidean --json").out);
  EXPECT_FALSE(euclidean.contains("phong"));
  const Json in_mm = Json::parse(
      Run("depth ../box.off ../cone.off --at 0.1mm,0.2,0.3mm --unit mm --json")
          .out);
  EXPECT_EQ(in_mm["depth"], euclidean["depth"]);
}

}  // namespace
}  // namespace phongpd
