// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/trajectory_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/studies/performance_profile.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

struct Made {
  const char* method;
  long seed;
  bool solved = true;
  double objective = 1.0;
  int iterations = 10;
  const char* status_class = "solved";
  const char* scene = "plate";
  const char* protocol = "straight-monotone";
};

Json Row(const Made& made) {
  return {{"scene", made.scene},
          {"method", made.method},
          {"seed", made.seed},
          {"status", "Solve_Succeeded"},
          {"status_class", made.status_class},
          {"solved", made.solved},
          {"solver_claims_solved", made.solved},
          {"solver_path_free", made.solved},
          {"collision_free", made.solved},
          {"iterations", made.iterations},
          {"restoration_iterations", 0},
          {"evaluations", {{"jacobian", 2 * made.iterations}}},
          {"objective", made.objective},
          {"inf_pr", 0.0},
          {"inf_du", 0.0},
          {"lengths", {{"clearance", {{"share", 0.01}}}}},
          {"missing_clearance", 0.0},
          {"queries", {{"branch_ends", 0}}},
          {"seconds", {{"callbacks", 0.25}, {"total", 1.0}}},
          {"protocol", made.protocol}};
}

TEST(Summarize, CountsSolvedStalledFreeAndFalseClaims) {
  std::vector<Json> rows = {Row({"a", 1}),
                            Row({"a", 2, true, 1.0, 10, "stalled_feasible"}),
                            Row({"a", 3, false, 1.0, 10, "failed"}),
                            Row({"a", 4, false, 1.0, 10, "failed"}),
                            Row({"a", 5, false, 1.0, 10, "stalled_feasible"})};
  rows[2]["solver_claims_solved"] = true;  // "solved" but collides
  rows[4]["collision_free"] = true;        // free, not solved
  const std::vector<ComparisonCell> cells = Summarize(rows);
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells[0].scene, "plate");
  EXPECT_EQ(cells[0].protocol, "straight-monotone");
  EXPECT_EQ(cells[0].method, "a");
  EXPECT_EQ(cells[0].runs, 5);
  EXPECT_EQ(cells[0].solved, 2);
  EXPECT_EQ(cells[0].stalled, 1);
  EXPECT_EQ(cells[0].free_only, 1);
  EXPECT_EQ(cells[0].claims_only, 1);
  EXPECT_EQ(cells[0].rivals, 2);
}

TEST(Summarize, ComparesObjectivesWithTheBestOfAnyProtocolAndMethod) {
  std::vector<Json> rows = {
      Row({"a", 1, true, 2.0}), Row({"a", 2, true, 1.05}), Row({"b", 1}),
      Row({"b", 2, true, 1.071}),
      Row({"c", 1, true, 0.5, 10, "solved", "plate", "pipeline"}),
      // Another scene and a path that collides are no rivals.
      Row({"a", 1, true, 0.1, 10, "solved", "hole"}),
      Row({"d", 2, false, 0.01, 10, "failed"})};
  rows[0]["lengths"]["clearance"]["share"] = 0.003;
  const std::vector<ComparisonCell> cells = Summarize(rows);
  ASSERT_EQ(cells.size(), 5U);
  const ComparisonCell& a = cells[0];
  EXPECT_DOUBLE_EQ(a.mean_ratio, 0.5 * (2.0 / 0.5 + 1.0));
  EXPECT_EQ(a.within_2_percent, 1);
  EXPECT_EQ(a.within_10_percent, 1);
  EXPECT_EQ(a.least_clearance, 0.003);
  const ComparisonCell& b = cells[1];
  EXPECT_EQ(b.method, "b");
  EXPECT_DOUBLE_EQ(b.mean_ratio, 0.5 * (2.0 + 1.071 / 1.05));
  EXPECT_EQ(b.within_2_percent, 1);  // 1.071 / 1.05 = 1.02
  EXPECT_EQ(b.within_10_percent, 1);
  EXPECT_EQ(cells[2].protocol, "pipeline");
  EXPECT_EQ(cells[2].mean_ratio, 1.0);
  EXPECT_EQ(cells[3].scene, "hole");
  EXPECT_EQ(cells[3].mean_ratio, 1.0);
  EXPECT_EQ(cells[4].rivals, 0);
  EXPECT_EQ(cells[4].mean_ratio, 0.0);
  EXPECT_EQ(cells[4].least_clearance, 0.0);
}

// A shortcut that does not keep the margin is no rival of a path that does.
TEST(Summarize, ComparesObjectivesAtEqualClearance) {
  std::vector<Json> rows = {
      Row({"clear", 1, true, 1.0}), Row({"close", 1, true, 0.9}),
      Row({"closer", 1, true, 0.8}), Row({"sampled", 1, true, 0.99})};
  rows[1]["missing_clearance"] = 0.5;
  rows[2]["missing_clearance"] = 0.6;
  rows[3]["missing_clearance"] = 0.1;  // between samples: does not count
  const std::vector<ComparisonCell> cells = Summarize(rows);
  EXPECT_DOUBLE_EQ(cells[0].mean_ratio, 1.0 / 0.99);
  EXPECT_DOUBLE_EQ(cells[1].mean_ratio, 1.0);
  EXPECT_DOUBLE_EQ(cells[2].mean_ratio, 1.0);
  EXPECT_DOUBLE_EQ(cells[3].mean_ratio, 1.0);
}

TEST(Summarize, TakesMediansAndShares) {
  std::vector<Json> rows;
  const int iterations[] = {40, 10, 30, 20};
  for (int i = 0; i < 4; ++i) {
    rows.push_back(Row({"even", i, true, 1.0, iterations[i]}));
    if (i < 3) rows.push_back(Row({"odd", i, true, 1.0, iterations[i]}));
  }
  rows[0]["restoration_iterations"] = 25;
  rows[0]["seconds"] = {{"callbacks", 2.25}, {"total", 5.0}};
  const std::vector<ComparisonCell> cells = Summarize(rows);
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[0].median_iterations, 25.0);
  EXPECT_EQ(cells[0].restoration_share, 0.25);
  EXPECT_EQ(cells[0].median_seconds, 1.0);
  EXPECT_EQ(cells[0].callback_share, 3.0 / 8.0);
  EXPECT_EQ(cells[1].median_iterations, 30.0);
  EXPECT_TRUE(Summarize({}).empty());
}

// Where start is goal the best objective is 0, which once gave NaN.
TEST(Summarize, HasNumbersWhereTheBestObjectiveIsZero) {
  const std::vector<ComparisonCell> cells =
      Summarize({Row({"a", 1, true, 0.0, 0}), Row({"a", 2, true, 0.0, 0})});
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells[0].mean_ratio, 1.0);
  EXPECT_EQ(cells[0].within_2_percent, 2);
  EXPECT_EQ(cells[0].restoration_share, 0.0);
  EXPECT_EQ(ComparisonCsv(cells).find("nan"), std::string::npos);
}

// A scene's label holds its knobs, with commas between them.
TEST(ComparisonCsv, QuotesNamesWithCommas) {
  const std::vector<Json> rows = {
      Row({"a", 1, true, 1.0, 10, "solved", "plate:x=1,y=2"})};
  EXPECT_NE(ComparisonCsv(Summarize(rows)).find("\n\"plate:x=1,y=2\",straight"),
            std::string::npos);
  EXPECT_NE(CompactCsv(rows).find("\n\"plate:x=1,y=2\",straight"),
            std::string::npos);
}

TEST(ProfileCurves, AreSharesOfTheProblemsThatAMethodWasAsked) {
  const std::vector<Json> rows = {
      // a: best on 1 (tie) and 2; b: twice a on 2; nobody solves 4.
      Row({"a", 1, true, 1.0, 10}),
      Row({"b", 1, true, 1.0, 10}),
      Row({"a", 2, true, 1.0, 20}),
      Row({"b", 2, true, 1.0, 40}),
      Row({"a", 3, false, 1.0, 1}),
      Row({"b", 3, true, 1.0, 70}),
      Row({"a", 4, false}),
      Row({"b", 4, false}),
      Row({"c", 4, false}),
      Row({"d", 2, true, 1.0, 80}),
      Row({"a", 5, true, 1.0, 1, "solved", "plate", "pipeline"})};
  for (const char* measure : {"iterations", "evaluations/jacobian"}) {
    const std::vector<ProfileCurve> curves =
        ProfileCurves(rows, "straight-monotone", measure);
    ASSERT_EQ(curves.size(), 4U);
    EXPECT_EQ(curves[0].method, "a");
    EXPECT_EQ(curves[0].problems, 4);
    EXPECT_EQ(curves[0].ratios, std::vector<double>({1.0, 1.0}));
    EXPECT_EQ(curves[1].ratios, std::vector<double>({1.0, 1.0, 2.0}));
    EXPECT_EQ(curves[0].Share(0.9), 0.0);
    EXPECT_EQ(curves[0].Share(1.0), 0.5);
    EXPECT_EQ(curves[1].Share(1.0), 0.5);
    EXPECT_EQ(curves[1].Share(1.99), 0.5);
    EXPECT_EQ(curves[1].Share(2.0), 0.75);
    EXPECT_EQ(curves[2].problems, 1);
    EXPECT_EQ(curves[2].Share(100.0), 0.0);
    // Of one that it was asked one.
    EXPECT_EQ(curves[3].problems, 1);
    EXPECT_EQ(curves[3].Share(3.99), 0.0);
    EXPECT_EQ(curves[3].Share(4.0), 1.0);
  }
  EXPECT_EQ(
      ProfileCurves(rows, "straight-monotone", "seconds/total")[1].Share(1.0),
      0.75);
  EXPECT_TRUE(ProfileCurves(rows, "none", "iterations").empty());
}

// '@' is markup to gnuplot, and a name may hold its quotes.
TEST(PerformanceProfile, ShowsTheNamesOfMethods) {
  const std::string svg =
      PerformanceProfile({Row({"phong@0.1", 1}), Row({"it's_so", 1})},
                         "straight-monotone", "iterations");
  EXPECT_NE(svg.find("phong@0.1"), std::string::npos);
  EXPECT_NE(svg.find("s_so"), std::string::npos);
  EXPECT_NE(svg.find("straight-monotone, 1 problem;"), std::string::npos);
}

class RowsOfAFile : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }

  std::string Refusal(const std::string& text) {
    std::ofstream(path_) << text;
    return testing::ErrorOf([&] { JoinComparisons({path_}); });
  }

  // Of its own for each test: they run at the same time.
  const std::string path_ =
      ::testing::TempDir() +
      ::testing::UnitTest::GetInstance()->current_test_info()->name() +
      "_rows.jsonl";
};

TEST_F(RowsOfAFile, NamesFileRowAndWhatIsWrong) {
  const std::string good = Row({"a", 1}).dump();
  EXPECT_THROW(JoinComparisons({path_ + ".none"}), InputError);
  EXPECT_EQ(Refusal(""), path_ + ": expected rows, found none");
  EXPECT_EQ(Refusal(good + "\n{\"scene\":"),
            path_ + ": row 2: expected a JSON object, found {\"scene\":");
  EXPECT_EQ(Refusal(good + "\n\n[1]\n"),
            path_ + ": row 2: expected a JSON object, found [1]");
  const Json whole = Row({"a", 1});
  for (const auto& item : whole.items()) {
    Json row = whole;
    row.erase(item.key());
    const std::string text = Refusal(good + '\n' + row.dump());
    EXPECT_EQ(text.find(path_ + ": row 2: expected"), 0U) << item.key() << text;
    EXPECT_NE(text.find("/" + item.key()), std::string::npos) << text;
    row[item.key()] = nullptr;
    EXPECT_NE(Refusal(row.dump()).find("/" + item.key()), std::string::npos)
        << item.key();
  }
  Json row = whole;
  row["solved"] = 1;
  EXPECT_NE(Refusal(row.dump()).find("true or false at /solved, found 1"),
            std::string::npos);
  row = whole;
  row["iterations"] = 1.5;
  EXPECT_NE(Refusal(row.dump()).find("whole number at /iterations, found 1.5"),
            std::string::npos);
}

TEST_F(RowsOfAFile, ReadsWhatWasWritten) {
  const std::vector<Json> rows = {Row({"a", 1}), Row({"b", 7, false})};
  std::ofstream(path_) << rows[0].dump() << "\n\n" << rows[1].dump();
  EXPECT_EQ(JoinComparisons({path_}), rows);
}

TEST(FindProtocol, KnowsEveryNameAndRefusesOthers) {
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    EXPECT_EQ(&FindProtocol(protocol.name), &protocol);
  }
  EXPECT_THROW(FindProtocol("straight"), InputError);
}

}  // namespace
}  // namespace phongpd
