// SPDX-License-Identifier: GPL-3.0-or-later
// The same command gives the same bytes, whatever the number of threads.
// scripts/determinism.sh asks the same of more outputs, runs and compilers.
#include <gtest/gtest.h>
#include <sched.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/problems/cli/cli_fixture.h"
#include "tests/support/campaign.h"

namespace phongpd {
namespace {

// While it lives, this process and those it starts have `count` of its
// processors, at most: TBB takes as many threads.
class Processors {
 public:
  explicit Processors(int count) {
    EXPECT_EQ(sched_getaffinity(0, sizeof before_, &before_), 0);
    cpu_set_t some;
    CPU_ZERO(&some);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&some) < count; ++i) {
      if (CPU_ISSET(i, &before_)) CPU_SET(i, &some);
    }
    EXPECT_EQ(sched_setaffinity(0, sizeof some, &some), 0);
  }
  ~Processors() { sched_setaffinity(0, sizeof before_, &before_); }
  Processors(const Processors&) = delete;
  Processors& operator=(const Processors&) = delete;

 private:
  cpu_set_t before_;
};

void DropSeconds(nlohmann::ordered_json* row) {
  for (auto it = row->begin(); it != row->end();) {
    if (row->is_object() && it.key().find("seconds") != std::string::npos) {
      it = row->erase(it);
      continue;
    }
    if (it->is_structured()) DropSeconds(&*it);
    ++it;
  }
}

// Rows of results without the times they took.
std::string WithoutSeconds(const std::string& rows) {
  std::ostringstream out;
  for (const std::string& line : Split(rows, '\n')) {
    if (line.empty()) continue;
    nlohmann::ordered_json row = nlohmann::ordered_json::parse(line);
    DropSeconds(&row);
    out << row.dump() << '\n';
  }
  return out.str();
}

using DeterminismCampaign = Cli;

TEST_F(DeterminismCampaign, RunsAndThreadsGiveTheSameBytes) {
  std::ostringstream points;
  points << "x,y,z\n";
  for (int i = 0; i < 500; ++i) {
    points << -1.7 + 0.31 * (i % 11) << ',' << -1.6 + 0.27 * (i % 13) << ','
           << -1.5 + 0.19 * (i % 17) << '\n';
  }
  WriteText("p.csv", points.str());
  const std::string pair =
      "--robot meshes/robot.off --obstacle "
      "meshes/obstacle.off --no-cache";
  const std::map<std::string, std::string> commands = {
      {"1.off", "contact-space " + pair + " --output 1.off"},
      {"2.csv",
       "query --contact-space 1.off --points ../p.csv --smoothing-length 0.2 "
       "--output 2.csv"},
      {"3.csv",
       "motion --contact-space 1.off --from -0.9 0.2 0.1 --to 0.8 -0.3 0.2 "
       "--frames 200 --output 3.csv"},
      {"4.jsonl", "optimize u_trap --no-cache --output 4.jsonl"},
      {"5.jsonl", "plan clutter --no-cache --output 5.jsonl"},
      {"6.jsonl",
       "plan clutter --planner retraction-forest --time 60 --no-cache "
       "--output 6.jsonl"},
  };
  ASSERT_EQ(Run("scenes write cone_axes --meshes meshes").code, 0);
  testing::CampaignRow row;
  row.item = "determinism";
  row.subject = "6 outputs, 1 and 2 threads: bytes";
  const long runs = testing::CampaignCases(1, 10);
  std::map<std::string, std::string> first;
  for (long run = 0; run < runs; ++run) {
    for (const int threads : {1, 2}) {
      const Processors processors(threads);
      for (const auto& [file, command] : commands) {
        const Outcome outcome = Run(command);
        ASSERT_EQ(outcome.code, 0) << command << '\n' << outcome.err;
        std::string bytes = Content(Output(file));
        if (file.find(".jsonl") != std::string::npos) {
          bytes = WithoutSeconds(bytes);
        }
        ASSERT_FALSE(bytes.empty()) << command;
        const bool is_same = first.emplace(file, bytes).first->second == bytes;
        EXPECT_TRUE(is_same) << command << ", threads: " << threads;
        ++row.cases;
        row.failures += is_same ? 0 : 1;
      }
    }
  }
  testing::ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
