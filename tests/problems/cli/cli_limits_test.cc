// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of the system, signals at random moments, a shared cache.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_process.h"
#include "tests/support/campaign.h"
#include "tests/support/sanitizer.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

class CliLimitsCampaign : public CliProcess {
 protected:
  void SetUp() override {
    CliProcess::SetUp();
    Scene(TwoObstacles());
  }

  const std::string kBuild =
      "contact-space --robot ../cone.off --obstacle ../box.off --output c.off "
      "--report c.json ";
  const std::string kOptimize =
      "optimize ../scene.json --start straight --start-noise 0.1 --runs 3 "
      "--seed 5 --output o.jsonl --html o.html --svg o.svg ";

  // Old outputs, which the program must replace together or not at all.
  void PutOld(const std::set<std::string>& names) const {
    for (const auto& entry : fs::directory_iterator(folder_ / "run")) {
      fs::remove_all(entry.path());
    }
    for (const std::string& name : names) WriteText("run/" + name, "old");
  }
  // How many of them are old; others than `extra` are a failure.
  long Old(const std::set<std::string>& names,
           const std::string& extra = "") const {
    for (const std::string& name : Names()) {
      EXPECT_TRUE(names.count(name) != 0 || name == extra) << name;
    }
    return std::count_if(names.begin(), names.end(), [&](const auto& name) {
      return Content(Output(name)) == "old";
    });
  }
};

TEST_F(CliLimitsCampaign, SignalsAtRandomMoments) {
  const std::set<std::string> outputs = {"o.html", "o.jsonl", "o.svg"};
  const std::string partial = "o.jsonl.partial";
  PutOld(outputs);
  const auto duration = Duration(kOptimize);
  testing::CampaignRow report;
  report.item = "faults";
  report.subject = "SIGINT, SIGTERM, SIGHUP at random moments";
  report.cases = testing::CampaignCases(10, 100);
  constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
  for (long i = 0; i < report.cases; ++i) {
    PutOld(outputs);
    const int signal = kSignals[i % 3];
    const int code = Interrupt(kOptimize, RandomTime(duration), signal);
    const long old = Old(outputs, code == 0 ? "" : partial);
    // Before main, and while the shell becomes the program, signals are not
    // the program's.
    const bool is_right = (code == 0 && old == 0) ||
                          (code == 128 + signal && (old == 0 || old == 3));
    report.failures += is_right ? 0 : 1;
    EXPECT_TRUE(is_right) << code << ", " << old << " old\n"
                          << Content(folder_ / "err");
  }
  testing::ReportCampaign(report);
}

TEST_F(CliLimitsCampaign, WhatSigkillLeavesGoesWithTheNextRun) {
  const std::set<std::string> outputs = {"c.json", "c.off"};
  const auto duration = Duration(kBuild + "--no-cache");
  long left = 0;
  const long tries = testing::CampaignCases(10, 100);
  // More until one was killed while there were temporaries, a short while.
  for (long i = 0; i < tries || (left == 0 && i < 30 * tries); ++i) {
    PutOld(outputs);
    Interrupt(kBuild + "--no-cache", RandomTime(duration), SIGKILL);
    left += Names() == outputs ? 0 : 1;
    ASSERT_EQ(Run(kBuild).code, 0);
    EXPECT_EQ(Names(), outputs);
  }
  EXPECT_GT(left, 0) << "never killed while there were temporaries";
}

TEST_F(CliLimitsCampaign, FilesMayNotGrow) {
  const std::set<std::string> outputs = {"o.html", "o.jsonl", "o.svg"};
  for (const int blocks : {0, 1, 4}) {
    PutOld(outputs);
    const Outcome outcome =
        Run(kOptimize, "ulimit -f " + std::to_string(blocks) + " &&");
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(Old(outputs, "o.jsonl.partial"), 3) << blocks;
    fs::remove(Output("o.jsonl.partial"));
  }
}

TEST_F(CliLimitsCampaign, FoldersMayNotBeWrittenTo) {
  const std::set<std::string> outputs = {"c.json", "c.off"};
  PutOld(outputs);
  ASSERT_EQ(chmod(Output("").c_str(), 0555), 0);
  ASSERT_EQ(chmod(folder_.c_str(), 0755), 0);
  std::string as_nobody;
  if (geteuid() == 0) {
    as_nobody = "setpriv --reuid 65534 --clear-groups env";
    if (std::system(
            (as_nobody + " '" PHONGPD_PROGRAM "' --version >/dev/null 2>&1")
                .c_str()) != 0) {
      GTEST_SKIP() << "root may write everywhere";
    }
  }
  const Outcome outcome = Run(kBuild, as_nobody);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("cannot be written"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(Old(outputs), 2);
}

// Address space for less and less of the work.
TEST_F(CliLimitsCampaign, MemoryRunsOut) {
  if (testing::kIsSanitized) GTEST_SKIP() << "sanitizers need address space";
  WriteMesh(MakeIcoBall(1.0, 3), File("ball.off"));
  WriteMesh(MakeL(3, 1, 1), File("l.off"));
  const std::string command =
      "contact-space --robot ../ball.off --obstacle ../l.off --output c.off "
      "--report c.json --no-cache";
  const std::set<std::string> outputs = {"c.json", "c.off"};
  testing::CampaignRow report;
  report.item = "faults";
  report.subject = "ulimit -v, contact space of a ball and an L";
  long refused = 0;
  const long steps = testing::CampaignCases(10, 100);
  for (long i = 0; i < steps; ++i) {
    const long kib = 45000 + 50000 * i / steps;
    PutOld(outputs);
    const Outcome outcome =
        RunWatched(command, "ulimit -v " + std::to_string(kib) + " &&");
    if (!outcome.has_begun) continue;
    ++report.cases;
    const bool is_done = outcome.code == 0;
    // GMP says so itself, and aborts.
    const bool is_refused =
        (outcome.code == 3 || outcome.code == 128 + SIGABRT) &&
        outcome.err.find("internal error") == std::string::npos &&
        (outcome.err.find("memory") != std::string::npos ||
         outcome.err.find("the system refuses") != std::string::npos);
    refused += is_refused ? 1 : 0;
    const bool is_right =
        (is_done || is_refused) && Old(outputs) == (is_done ? 0 : 2);
    report.failures += is_right ? 0 : 1;
    EXPECT_TRUE(is_right) << kib << ": " << outcome.code << ' ' << outcome.err;
  }
  EXPECT_GT(refused, 0);
  testing::ReportCampaign(report);
}

// Eight processes, while the file they share is damaged again and again.
TEST_F(CliLimitsCampaign, EightProcessesShareADamagedCache) {
  ASSERT_EQ(Run(kBuild + "--no-cache").code, 0);
  const std::string mesh = Content(Output("c.off"));
  ASSERT_EQ(Run(kBuild).code, 0);
  const fs::path file = fs::directory_iterator(folder_ / "cache")->path();
  const std::string good = Content(file);
  testing::CampaignRow report;
  report.item = "faults";
  report.subject = "8 processes on one cache, damaged";
  const long rounds = testing::CampaignCases(2, 20);
  for (long round = 0; round < rounds; ++round) {
    std::string bad = good;
    const auto at =
        std::uniform_int_distribution<std::size_t>(0, bad.size() - 1)(random_);
    if (round % 2 == 0) {
      bad[at] = static_cast<char>(bad[at] ^ 4);
    } else {
      bad.resize(at);
    }
    std::ofstream(file, std::ios::binary) << bad;
    std::vector<pid_t> processes;
    for (int i = 0; i < 8; ++i) {
      processes.push_back(
          Start("contact-space --robot ../cone.off --obstacle "
                "../box.off --output p" +
                std::to_string(i) + ".off"));
    }
    for (int i = 0; i < 8; ++i) {
      ++report.cases;
      const bool is_right =
          Wait(processes[static_cast<std::size_t>(i)]) == 0 &&
          Content(Output("p" + std::to_string(i) + ".off")) == mesh;
      report.failures += is_right ? 0 : 1;
      EXPECT_TRUE(is_right) << round << ' ' << i;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "cache"), {}), 1);
  }
  testing::ReportCampaign(report);
}

}  // namespace
}  // namespace phongpd
