// SPDX-License-Identifier: GPL-3.0-or-later
// The program on files of its own with other contents: pieces and contact
// spaces with a valid checksum, and rows that an interrupted command kept.  It
// answers or refuses them (0, 1, 2), and never dies of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/fuzz/resealed.h"
#include "tests/problems/cli/cli_process.h"
#include "tests/support/campaign.h"
#include "tests/support/mutated_bytes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

using testing::Mutated;

class CliMutatedFiles : public CliProcess {
 protected:
  // Runs the command on a file of mutated content; a refusal names the file.
  void Try(const std::string& command, const std::string& file,
           const std::string& content) {
    WriteText("run/" + file, content);
    const Outcome outcome = Run(command);
    EXPECT_GE(outcome.code, 0) << command;
    EXPECT_LE(outcome.code, 2) << command << ": " << outcome.err;
    EXPECT_EQ(outcome.err.find("internal error"), std::string::npos);
    if (outcome.code == 2) {
      EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
      ++refused_;
    } else {
      ++answered_;
    }
    ++cases_;
  }
  void Report(const char* subject) const {
    testing::CampaignRow row;
    row.item = "mutated files";
    row.subject = std::string(subject) + ": " + std::to_string(refused_) +
                  " refused, " + std::to_string(answered_) + " answered";
    row.cases = cases_;
    testing::ReportCampaign(row);
  }

  std::mt19937_64 mutations_{29};
  long cases_ = 0, refused_ = 0, answered_ = 0;
};

TEST_F(CliMutatedFiles, PiecesAndContactSpaces) {
  WriteMesh(testing::Cube(1), File("robot.off"));
  WriteMesh(MakeVessel(4, 3, 0), File("obstacle.off"));
  const std::string build =
      "contact-space --robot ../robot.off --obstacle ../obstacle.off ";
  ASSERT_EQ(Run(build + "--piece 0/1 --output a.piece").code, 0);
  ASSERT_EQ(Run(build + "--output a.pcs").code, 0);
  const std::string piece = Content(Output("a.piece"));
  const std::string space = Content(Output("a.pcs"));
  WriteText("points.csv", "x,y,z\n0,0,0\n1,0.2,0.1\n");
  const long cases = testing::CampaignCases(25, 400);
  for (long i = 0; i < cases; ++i) {
    Try("join a.piece --json", "a.piece",
        fuzz::Resealed(piece,
                       Mutated(fuzz::ContentOfSealed(piece), &mutations_)));
    Try("query --contact-space a.pcs --points ../points.csv --json", "a.pcs",
        fuzz::Resealed(space,
                       Mutated(fuzz::ContentOfSealed(space), &mutations_)));
  }
  Report("join and query");
}

// Rows of runs that were interrupted.
class CliMutatedRows : public CliMutatedFiles {
 protected:
  // `command` writes run/OUTPUT, and until it has all rows OUTPUT.partial.
  void TryRowsKept(const std::string& command, const std::string& output) {
    const std::string kept = output + ".partial";
    const std::string first = Interrupted(command, output, kept);
    ASSERT_FALSE(first.empty()) << "never killed between two rows";
    const std::string header = first.substr(0, first.find('\n') + 1);
    std::vector<std::string> changed = {
        R"({"what":3,"command":{}})"
        "\n",
        "{\"what\":" + std::string(100000, '[') + "\n",
        header + "{\"seed\":1}\n", header + "{\"seed\":\"x\"}\n",
        header + "{}\n"};
    const long cases = testing::CampaignCases(25, 400);
    for (long i = 0; i < cases; ++i) {
      changed.push_back(Mutated(first, &mutations_));
    }
    for (const std::string& content : changed) {
      Clear(kept);
      WriteText("run/" + kept, content);
      fs::permissions(Output(kept),
                      fs::perms::owner_read | fs::perms::owner_write);
      Try(command, kept, content);
    }
    EXPECT_GT(refused_, 5);
    Report(command.substr(0, command.find(' ')).c_str());
  }

  // An empty run/ but for the folder of `file`.
  void Clear(const std::string& file) const {
    fs::remove_all(folder_ / "run");
    fs::create_directories(fs::path(Output(file)).parent_path());
  }

 private:
  // What was kept when the command was killed with a row at least; empty: it
  // was too fast for that each time.
  std::string Interrupted(const std::string& command, const std::string& output,
                          const std::string& kept) const {
    for (int tries = 0; tries < 20; ++tries) {
      const pid_t process = Start(command);
      for (int i = 0; i < 300000 && !fs::exists(Output(output)) &&
                      LinesOf(Output(kept)) < 2;
           ++i) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
      kill(process, SIGKILL);
      Wait(process);
      if (LinesOf(Output(kept)) >= 2) return Content(Output(kept));
      fs::remove(Output(output));
    }
    return "";
  }

  // Of a file that may not be there, or not any more.
  static long LinesOf(const std::string& file) {
    std::ifstream in(file);
    return std::count(std::istreambuf_iterator<char>(in), {}, '\n');
  }
};

// Of so many runs that it is not done before it is seen to have a row.
TEST_F(CliMutatedRows, OfPlan) {
  TryRowsKept("plan " + Scene(TwoObstacles()) + " --runs 40 --output o.jsonl",
              "o.jsonl");
}

TEST_F(CliMutatedRows, OfOptimize) {
  TryRowsKept("optimize " + Scene(TwoObstacles()) +
                  " --start straight --polish never --runs 3 --output o.jsonl",
              "o.jsonl");
}

TEST_F(CliMutatedRows, OfCompare) {
  TryRowsKept("compare " + Scene(TwoObstacles()) +
                  " --runs 2 --metrics euclidean phong@0.2 --protocols "
                  "straight-adaptive --output d",
              "d/rows.jsonl");
}

// Those of a comparison that is done, which is told anew.
TEST_F(CliMutatedRows, OfCompareThatAreSummarised) {
  ASSERT_EQ(Run("compare " + Scene(TwoObstacles()) +
                " --runs 2 --metrics euclidean phong@0.2 --protocols "
                "straight-adaptive --output ../d")
                .code,
            0);
  const std::string rows = Content(File("d/rows.jsonl"));
  const long cases = testing::CampaignCases(25, 400);
  for (long i = 0; i < cases; ++i) {
    Clear("rows.jsonl");
    Try("compare --rows rows.jsonl --output e", "rows.jsonl",
        Mutated(rows, &mutations_));
  }
  EXPECT_GT(refused_, 5);
  Report("compare --rows");
}

}  // namespace
}  // namespace phongpd
