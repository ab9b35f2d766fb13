// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of the convergence study by groups, and quantiles of all tables.
#include "results/bench/convergence_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "results/bench/csv_table.h"

namespace phongpd::bench {
namespace {

// A family's name may begin with another's ("long_plate", "l").
TEST(SceneGroups, EveryPublishedSceneIsInOneOfThem) {
  const CsvTable summary =
      ReadCsvTable(PHONGPD_RESULTS "/convergence/summary.csv");
  std::set<std::string> scenes;
  for (std::size_t i = 0; i < summary.rows().size(); ++i) {
    scenes.insert(summary.Text(i, "scene"));
  }
  std::map<std::string, std::set<std::string>> groups;
  for (const std::string& scene : scenes) {
    int count = 0;
    for (const SceneGroup& group : SceneGroups()) {
      if (!Belongs(scene, group)) continue;
      groups[group.name].insert(scene);
      ++count;
    }
    EXPECT_EQ(count, 1) << scene;
  }
  EXPECT_EQ(groups["traps"], (std::set<std::string>{"l", "u_axis", "u_trap"}));
  EXPECT_EQ(groups["plates"].count("long_plate"), 1u);
}

TEST(SceneGroups, ANameThatBeginsWithAnotherIsNotThatOne) {
  for (const SceneGroup& group : SceneGroups()) {
    for (const std::string& family : group.families) {
      const std::string knobs = group.is_scanned ? ":edge=0.1" : "";
      EXPECT_TRUE(Belongs(family + knobs, group)) << family;
      EXPECT_FALSE(Belongs(family + "_x" + knobs, group)) << family;
      EXPECT_FALSE(Belongs(family.substr(0, family.size() - 1) + knobs, group))
          << family;
    }
  }
}

TEST(Quantile, MedianOfAnEvenNumberIsTheMiddleOfTwo) {
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
  EXPECT_EQ(Quantile({3.0}, 0.5), 3.0);
  EXPECT_EQ(Quantile({4.0, 1.0}, 0.5), 2.5);
  EXPECT_EQ(Quantile({9.0, 1.0, 2.0, 4.0}, 0.5), 3.0);
  EXPECT_EQ(Quantile({9.0, 1.0, 2.0}, 0.5), 2.0);
}

// Another route: sorted, and as far above one half of them as below the other.
TEST(Quantile, TurnedValuesHaveTheTurnedQuantile) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> value(-8, 8);
  for (int n = 1; n <= 40; ++n) {
    std::vector<double> values, turned;
    for (int i = 0; i < n; ++i) {
      values.push_back(value(random));
      turned.push_back(-values.back());
    }
    EXPECT_EQ(Quantile(values, 0.5), -Quantile(turned, 0.5)) << n;
    EXPECT_EQ(Quantile(values, 0.25), -Quantile(turned, 0.75)) << n;
    EXPECT_EQ(Quantile(values, 0.0),
              *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(Quantile(values, 1.0),
              *std::max_element(values.begin(), values.end()));
  }
}

}  // namespace
}  // namespace phongpd::bench
