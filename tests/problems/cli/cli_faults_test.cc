// SPDX-License-Identifier: GPL-3.0-or-later
// Every call that can fail does: a clear error, old outputs whole, nothing left
// behind.  The calls are made to fail by tests/support/fail_calls.cc.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_process.h"
#include "tests/support/campaign.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

struct FaultyCommand {
  std::string arguments;
  std::vector<std::string> outputs;  // in run/
  bool keeps_rows = false;           // in a .partial file
};

class CliFaultCampaign : public CliProcess {
 protected:
  void SetUp() override {
    CliProcess::SetUp();
    Scene(TwoObstacles());
    WriteText("points.csv", "x,y,z\n0.3,0,0.1\n3,0,-0.1\n");
    ASSERT_EQ(Run("contact-space --robot ../cone.off --obstacle ../box.off "
                  "--output ../contact.off")
                  .code,
              0);
    // Of what the tests do, nothing is to come from the cache.
    fs::remove_all(folder_ / "cache");
  }

  static std::vector<FaultyCommand> Commands() {
    return {
        {"contact-space --robot ../cone.off --obstacle ../box.off --output "
         "c.ply --report c.json",
         {"c.ply", "c.json"}},
        {"query --contact-space ../contact.off --points ../points.csv "
         "--output q.csv",
         {"q.csv"}},
        {"motion --contact-space ../contact.off --from -3 0 0.1 --to 3 0 0 "
         "--frames 20 --output m.csv --svg m.svg",
         {"m.csv", "m.svg"}},
        {"optimize ../scene.json --start straight --start-noise 0.1 --polish "
         "never --runs 2 --seed 5 --output o.jsonl --html o.html --svg o.svg",
         {"o.jsonl", "o.html", "o.svg"},
         true},
        {"plan ../scene.json --runs 2 --output p.jsonl --html p.html --svg "
         "p.svg",
         {"p.jsonl", "p.html", "p.svg"},
         true},
        {"compare ../scene.json --runs 1 --metrics euclidean phong@0.2 "
         "--protocols straight-adaptive --output .",
         {"rows.jsonl", "rows.csv", "summary.csv",
          "profile-straight-adaptive-iterations.svg"},
         true},
        {"scenes write u_trap --output s.json --meshes .",
         {"s.json", "robot.off", "obstacle.off"}},
    };
  }

  // How often the command makes calls of each kind.
  std::map<std::string, long> Counts(const FaultyCommand& command) const {
    const std::string file = File("counts");
    EXPECT_EQ(Run(command.arguments, std::string("LD_PRELOAD='") +
                                         PHONGPD_FAIL_CALLS +
                                         "' PHONGPD_COUNT_CALLS='" + file + "'")
                  .code,
              0);
    std::map<std::string, long> counts;
    std::ifstream stream(file);
    std::string kind;
    for (long count = 0; stream >> kind >> count;) counts[kind] = count;
    EXPECT_EQ(counts.size(), 9U);
    fs::remove(file);
    return counts;
  }

  // Empty, or what is wrong after the call was made to fail.
  std::string Wrong(const FaultyCommand& command,
                    const std::string& fault) const {
    for (const auto& entry : fs::directory_iterator(folder_ / "run")) {
      fs::remove_all(entry.path());
    }
    fs::remove_all(folder_ / "cache");
    for (const std::string& name : command.outputs) {
      WriteText("run/" + name, "old");
    }
    const Outcome outcome = RunWatched(
        command.arguments, std::string("LD_PRELOAD='") + PHONGPD_FAIL_CALLS +
                               "' PHONGPD_FAIL_CALL=" + fault);
    const bool is_done = outcome.code == 0;
    if (!outcome.has_begun) return "";
    if (!is_done && outcome.code != 2 && outcome.code != 3) {
      return "ends with " + std::to_string(outcome.code) + " " + outcome.err;
    }
    if (!is_done && !IsClear(outcome.err)) return "says: " + outcome.err;
    for (const std::string& name : command.outputs) {
      if ((Content(Output(name)) == "old") == is_done) {
        return (is_done ? "did not write " : "replaced ") + name;
      }
    }
    for (const std::string& name : Names()) {
      const bool is_partial = command.keeps_rows && !is_done &&
                              name.find(".jsonl.partial") != std::string::npos;
      if (!is_partial && !IsOutput(command, name)) return "leaves " + name;
    }
    if (fs::exists(folder_ / "cache")) {
      for (const auto& file : fs::directory_iterator(folder_ / "cache")) {
        if (file.path().extension() != ".contact-space") {
          return "leaves " + file.path().string();
        }
      }
    }
    return "";
  }

  // One line of error, after warnings.
  static bool IsClear(const std::string& text) {
    const std::vector<std::string> lines = Split(text, '\n');
    const auto is_warning = [](const std::string& line) {
      return line.rfind("phongpd: warning: ", 0) == 0;
    };
    return std::count_if(lines.begin(), lines.end(), is_warning) + 1 ==
               static_cast<long>(lines.size()) &&
           lines.back().rfind("phongpd: ", 0) == 0 &&
           text.find("internal error") == std::string::npos;
  }

  static bool IsOutput(const FaultyCommand& command, const std::string& name) {
    // A comparison has more profiles than those named above.
    return name.rfind("profile-", 0) == 0 ||
           std::find(command.outputs.begin(), command.outputs.end(), name) !=
               command.outputs.end();
  }
};

TEST_F(CliFaultCampaign, EveryCallCanFail) {
  // Of each kind and command; all where there are no more.
  const long tries = testing::CampaignCases(1, 25);
  std::mt19937 random(11);
  testing::CampaignRow report;
  report.item = "faults";
  report.subject = "calls made to fail in 7 commands";
  report.seed = 11;
  for (const FaultyCommand& command : Commands()) {
    for (const auto& [kind, count] : Counts(command)) {
      std::set<long> calls;
      for (long i = 1; i <= count && count <= tries; ++i) calls.insert(i);
      while (static_cast<long>(calls.size()) < std::min(tries, count)) {
        calls.insert(std::uniform_int_distribution<long>(1, count)(random));
      }
      for (const long call : calls) {
        const std::string fault = kind + ":" + std::to_string(call);
        const std::string wrong = Wrong(command, fault);
        ++report.cases;
        report.failures += wrong.empty() ? 0 : 1;
        EXPECT_EQ(wrong, "")
            << fault << " of " << count << " in " << command.arguments;
      }
    }
  }
  testing::ReportCampaign(report);
}

// From some write on, none succeeds.
TEST_F(CliFaultCampaign, TheDiskIsFull) {
  testing::CampaignRow report;
  report.item = "faults";
  report.subject = "full disk from some write on";
  for (const FaultyCommand& command : Commands()) {
    const long count = Counts(command)["write"];
    const long step = std::max(1L, count / testing::CampaignCases(1, 20));
    for (long call = 1; call <= count; call += step) {
      const std::string wrong =
          Wrong(command, "write:" + std::to_string(call) + "+");
      ++report.cases;
      report.failures += wrong.empty() ? 0 : 1;
      EXPECT_EQ(wrong, "") << "write " << call << " of " << count << " in "
                           << command.arguments;
    }
  }
  testing::ReportCampaign(report);
}

}  // namespace
}  // namespace phongpd
