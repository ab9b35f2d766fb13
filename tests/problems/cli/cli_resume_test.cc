// SPDX-License-Identifier: GPL-3.0-or-later
// Commands that are interrupted go on where they were when called again.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_process.h"
#include "tests/support/campaign.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

class CliResumeCampaign : public CliProcess {
 protected:
  // The whole rows of a file, without the first line of a partial one.
  Strings Rows(const std::string& name) const {
    const std::string text = Content(Output(name));
    Strings rows = Split(text.substr(0, text.rfind('\n') + 1), '\n');
    if (!rows.empty() && name.find(".partial") != std::string::npos) {
      rows.erase(rows.begin());
    }
    return rows;
  }
  static Strings Comparable(const Strings& rows) {
    Strings result;
    for (const std::string& row : rows) {
      result.push_back(WithoutSeconds(Json::parse(row)).dump());
    }
    return result;
  }
  static bool BeginsWith(const Strings& rows, const Strings& start) {
    return rows.size() >= start.size() &&
           std::equal(start.begin(), start.end(), rows.begin());
  }

  // Runs `command` in one go, expects `count` rows in `rows`, and then kills it
  // at random moments, some times while there are rows, until it is done.
  // Expects the same files again: those of `alike` byte for byte, the rows but
  // for seconds, and every row that was ever there byte for byte.
  void ExpectResumes(const std::string& command, const std::string& rows,
                     std::size_t count, const Strings& alike) {
    const auto duration = Duration(command);
    const Strings whole = Rows(rows);
    ASSERT_EQ(whole.size(), count) << Content(folder_ / "err");
    const std::set<std::string> names = Names();
    const std::size_t lines = Split(Content(folder_ / "out"), '\n').size();
    Strings contents;
    for (const std::string& name : alike) {
      contents.push_back(Content(Output(name)));
      EXPECT_FALSE(contents.back().empty()) << name;
    }
    fs::remove_all(folder_ / "run");
    fs::create_directory(folder_ / "run");

    const Kills kills = Kill(command, rows, duration);
    const Strings& seen = kills.seen;
    EXPECT_FALSE(seen.empty()) << "never killed while there were rows";
    if (!kills.is_done) {
      EXPECT_FALSE(fs::exists(Output(rows)));
      const Outcome outcome = Run(command);
      EXPECT_EQ(outcome.code, 0) << outcome.err;
      EXPECT_NE(
          outcome.err.find("going on after " + std::to_string(seen.size()) +
                           " of " + std::to_string(count)),
          std::string::npos)
          << outcome.err;
    }
    const Strings all = Rows(rows);
    EXPECT_TRUE(BeginsWith(all, seen)) << "rows were done again";
    EXPECT_EQ(Comparable(all), Comparable(whole));
    for (std::size_t i = 0; i < alike.size(); ++i) {
      EXPECT_EQ(Content(Output(alike[i])), contents[i]) << alike[i];
    }
    EXPECT_EQ(Names(), names);
    EXPECT_EQ(Split(Content(folder_ / "out"), '\n').size(), lines);
    testing::CampaignRow report;
    report.item = "faults";
    report.subject = "SIGKILL and resume: " + command.substr(0, 8);
    report.seed = 7;
    report.cases = kills.cases;
    report.failures = HasFailure() ? 1 : 0;
    testing::ReportCampaign(report);
  }

 private:
  struct Kills {
    bool is_done = false;  // the last time it was not killed in time
    long cases = 0;        // with a partial file
    Strings seen;          // its rows at last
  };

  // Kills `command`, which takes about `duration`, some times while there are
  // rows.
  Kills Kill(const std::string& command, const std::string& rows,
             std::chrono::microseconds duration) {
    const long most = testing::CampaignCases(3, 30);
    const std::string partial = rows + ".partial";
    Kills kills;
    long with_rows = 0;
    for (int i = 0; i < 20 * most && with_rows < most; ++i) {
      // Later and later: the machine may be busier than when this was timed.
      const int code =
          Interrupt(command, RandomTime(duration * (10 + i) / 20), SIGKILL);
      kills.is_done = code == 0;
      if (kills.is_done) break;
      EXPECT_EQ(code, 128 + SIGKILL) << Content(folder_ / "err");
      if (fs::exists(Output(rows))) {  // at its very end: from the beginning
        fs::remove_all(folder_ / "run");
        fs::create_directory(folder_ / "run");
        kills.seen.clear();
        with_rows = 0;
        continue;
      }
      if (!fs::exists(Output(partial))) continue;
      Strings now = Rows(partial);
      EXPECT_TRUE(BeginsWith(now, kills.seen)) << "rows were lost or changed";
      with_rows += now.empty() ? 0 : 1;
      ++kills.cases;
      kills.seen = std::move(now);
    }
    return kills;
  }
};

TEST_F(CliResumeCampaign, OptimizeGoesOnAfterSigkill) {
  ExpectResumes("optimize " + Scene(TwoObstacles()) +
                    " --runs 6 --seed 5 --start straight --start-noise 0.1 "
                    "--html o.html --svg o.svg --output o.jsonl",
                "o.jsonl", 6, {"o.html", "o.svg"});
}

TEST_F(CliResumeCampaign, PlanGoesOnAfterSigkill) {
  ExpectResumes("plan " + Scene(TwoObstacles()) +
                    " --planner rrt-connect --runs 300 --time 5 --html o.html "
                    "--output o.jsonl",
                "o.jsonl", 300, {"o.html"});
}

TEST_F(CliResumeCampaign, CompareGoesOnAfterSigkill) {
  ExpectResumes("compare u_trap:triangles=80 " + Scene(TwoObstacles()) +
                    " --runs 2 --seed 3 --metrics euclidean phong@0.2 "
                    "--protocols straight-adaptive --output d",
                "d/rows.jsonl", 8, {});
}

// Every way to leave rows of two commands in one file.
TEST_F(CliResumeCampaign, AnotherCommandIsRefusedWithWhatDiffers) {
  WriteMesh(MakeBox({-0.1, -0.5, -0.5}, {0.1, 0.5, 0.5}), File("wall.off"));
  Json scene = TwoObstacles();
  scene["obstacles"][0] = {{"id", "wall"}, {"mesh", "wall.off"}};
  const std::string command = "optimize " + Scene(scene) +
                              " --start straight --polish never --output "
                              "o.jsonl --runs 500";
  const pid_t process = Start(command + " --seed 1");
  Await("o.jsonl.partial", 3000);
  // While it runs, any second process is refused.
  Outcome second = Run(command + " --seed 1");
  EXPECT_EQ(second.code, 2);
  EXPECT_NE(second.err.find("another process"), std::string::npos)
      << second.err;
  kill(process, SIGTERM);
  EXPECT_EQ(Wait(process), 128 + SIGTERM);
  EXPECT_EQ(Names(), std::set<std::string>{"o.jsonl.partial"});
  const std::string kept = Content(Output("o.jsonl.partial"));

  const auto expect_refused = [&](const std::string& other,
                                  const std::string& word) {
    const Outcome outcome = Run(other);
    EXPECT_EQ(outcome.code, 2) << other;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    for (const std::string& part : {word, std::string("another command")}) {
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(Content(Output("o.jsonl.partial")), kept);
    EXPECT_EQ(Names(), std::set<std::string>{"o.jsonl.partial"});
  };
  expect_refused(command + " --seed 2", "--seed: 1 there, 2 here");
  expect_refused(command + " --seed 1 --metric euclidean",
                 "--metric: not given there, euclidean here");
  expect_refused(command + " --seed 1 --no-line",
                 "--line: not given there, false here");
  expect_refused("optimize u_axis --output o.jsonl", "scene");
  expect_refused("plan ../scene.json --output o.jsonl", "command");
  WriteMesh(MakeBox({-0.1, -0.5, -0.5}, {0.1, 0.5, 0.6}), File("wall.off"));
  expect_refused(command + " --seed 1", "contents of scenes");
  WriteMesh(MakeBox({-0.1, -0.5, -0.5}, {0.1, 0.5, 0.5}), File("wall.off"));
  scene["trajectory"]["margin"] = 0.02;
  Scene(scene);
  expect_refused(command + " --seed 1", "contents of scenes");
}

// The page of a run whose row was there already: it shows all the same what
// lies behind the run.
TEST_F(CliResumeCampaign, APageThatFailedComesWithWhatLiesBehind) {
  const std::string command = "plan " + Scene(TwoObstacles()) +
                              " --planner retraction-rrt --seed 5 --output "
                              "o.jsonl --html o.html";
  ASSERT_EQ(Run(command).code, 0);
  const auto graphs = [this] {
    const std::string page = Content(Output("o.html"));
    const std::string open = "id=\"view-data\">";
    const std::size_t begin = page.find(open) + open.size();
    return Json::parse(
        page.substr(begin, page.find("</script>", begin) - begin))["graphs"];
  };
  const Json whole = graphs();
  ASSERT_EQ(whole.size(), 1U);
  fs::remove_all(folder_ / "run");
  fs::create_directory(folder_ / "run");
  // Room for the rows, none for the page.
  const Outcome failed = Run(command, "ulimit -f 200 &&");
  EXPECT_EQ(failed.code, 2) << failed.err;
  EXPECT_EQ(Names(), std::set<std::string>({"o.jsonl.partial"}));
  const Outcome outcome = Run(command);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("going on after 1 of 1"), std::string::npos);
  EXPECT_EQ(graphs(), whole);
  EXPECT_EQ(Rows("o.jsonl").size(), 1U);
  EXPECT_EQ(Rows("o.jsonl")[0].find('\t'), std::string::npos);
}

TEST_F(CliResumeCampaign, ATornRowIsDoneAgain) {
  const std::string command =
      "plan " + Scene(TwoObstacles()) +
      " --planner rrt-connect --output o.jsonl --seed 5 --runs ";
  ASSERT_EQ(Run(command + "3").code, 0);
  const Strings whole = Rows("o.jsonl");
  const pid_t process = Start(command + "100000");
  Await("o.jsonl.partial", 6000);
  kill(process, SIGKILL);
  Wait(process);
  // As before, the finished output stays until a new one is finished.
  EXPECT_EQ(Rows("o.jsonl"), whole);
  std::string text = Content(Output("o.jsonl.partial"));
  text.replace(text.find("100000"), 6, "3");
  std::size_t end = 0;
  for (int line = 0; line < 3; ++line) end = text.find('\n', end) + 1;
  ASSERT_GT(end, 0U);
  WriteText("run/o.jsonl.partial", text.substr(0, end + 40));
  const Strings kept = Rows("o.jsonl.partial");
  ASSERT_EQ(kept.size(), 2U);
  const Outcome outcome = Run(command + "3");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Strings rows = Rows("o.jsonl");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_TRUE(BeginsWith(rows, kept));
  EXPECT_EQ(Json::parse(rows[2])["seed"], 7);
  EXPECT_FALSE(fs::exists(Output("o.jsonl.partial")));
}

}  // namespace
}  // namespace phongpd
