// SPDX-License-Identifier: GPL-3.0-or-later
// What a budget picks: the published table, cell by cell, and what requests
// become.  Truth: results/trade/budget_flags.csv, which the report writes, read
// word by word.
#include "planners/world/budget.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

std::vector<std::vector<std::string>> Published() {
  std::ifstream file(PHONGPD_TEST_DATA "/../../results/trade/budget_flags.csv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      rows.back().push_back(cell);
    }
  }
  return rows;
}

// Of published flags the value of "--name"; `otherwise` where they say none.
std::string FlagOf(const std::string& flags, const std::string& name,
                   const std::string& otherwise) {
  std::istringstream words(flags);
  for (std::string flag, value; words >> flag >> value;) {
    if (flag == "--" + name) return value;
  }
  return otherwise;
}

BudgetUse UseOf(const std::string& name) {
  return name == "plan" ? BudgetUse::kPlan : BudgetUse::kOptimize;
}

TEST(Budget, PicksWhatThePublishedTableSays) {
  const auto rows = Published();
  ASSERT_GT(rows.size(), 8U);
  EXPECT_EQ(rows[0][3], "flags");
  ASSERT_EQ(rows.size(), BudgetChoices().size() + 1);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& row = rows[i];
    SCOPED_TRACE(row[0] + ' ' + row[1] + ' ' + row[2]);
    const BudgetChoice& choice =
        ChoiceFor(UseOf(row[0]), std::stoul(row[1]), std::stod(row[2]));
    EXPECT_EQ(ToString(choice.flags), row[3]);
    EXPECT_EQ(std::to_string(choice.answered), row[4]);
    EXPECT_EQ(std::to_string(choice.problems), row[5]);
  }
}

TEST(Budget, TakesTheNearestSizeAndTheMostSecondsThatAreNoMore) {
  const auto at = [](std::size_t triangles, double seconds) {
    return ChoiceFor(BudgetUse::kPlan, triangles, seconds);
  };
  EXPECT_EQ(at(0, 1.0).triangles, 1000U);
  EXPECT_EQ(at(3100, 1.0).triangles, 1000U);
  EXPECT_EQ(at(3200, 1.0).triangles, 10000U);  // √10 · 1000 = 3162
  EXPECT_EQ(at(1000, 0.001).seconds, 0.01);
  EXPECT_EQ(at(1000, 0.0999).seconds, 0.01);
  EXPECT_EQ(at(1000, 0.1).seconds, 0.1);
  EXPECT_EQ(at(1000, 9.0).seconds, 1.0);
  EXPECT_EQ(at(1000, 1e6).seconds, 10.0);
}

TEST(Budget, RefusesWhatNobodyMeasured) {
  EXPECT_THROW(ChoiceFor(BudgetUse::kPlan, 100000000, 1.0), InputError);
  PlanRequest plan;
  const Workspace workspace{MakeSolid(testing::Cube(0.1), "robot"), {}, {}, ""};
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(ApplyBudget(bad, workspace, &plan), InputError) << bad;
  }
}

TEST(Budget, WritesTheFlagsIntoRequests) {
  Workspace workspace;
  workspace.robot = MakeSolid(MakeIcoBall(0.25, 1), "robot");             // 80
  workspace.obstacles = {MakeSolid(MakeKnot(0.5, 0.2, 40, 12), "knot")};  // 960
  EXPECT_EQ(TrianglesOf(workspace), 1040U);
  for (const auto& row : Published()) {
    if (row[1] != "1000") continue;
    SCOPED_TRACE(row[0] + ' ' + row[2]);
    const double seconds = std::stod(row[2]);
    const std::string& flags = row[3];
    if (UseOf(row[0]) == BudgetUse::kPlan) {
      PlanRequest plan;
      plan.planner = PlannerId::kPrm;
      plan.seed = 7;
      ApplyBudget(seconds, workspace, &plan);
      EXPECT_EQ(ToString(plan.planner),
                FlagOf(flags, "planner", "contact-surface"));
      EXPECT_EQ(ToString(plan.model), FlagOf(flags, "model", ""));
      EXPECT_EQ(ToString(plan.preset), FlagOf(flags, "preset", "balanced"));
      EXPECT_EQ(plan.seed, 7U);
      continue;
    }
    OptimizeRequest optimize;
    ApplyBudget(seconds, workspace, &optimize);
    EXPECT_EQ(ToString(optimize.preset), FlagOf(flags, "preset", ""));
    EXPECT_EQ(ToString(optimize.model), FlagOf(flags, "model", ""));
    EXPECT_EQ(ToString(optimize.penetration.metric),
              FlagOf(flags, "metric", "phong"));
    // The preset is written out, not only named.
    EXPECT_EQ(optimize.options.also_line, optimize.preset != Preset::kFast);
  }
}

}  // namespace
}  // namespace phongpd
