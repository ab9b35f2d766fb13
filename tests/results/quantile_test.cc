// SPDX-License-Identifier: GPL-3.0-or-later
// Quantiles of all tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

TEST(Quantile, MedianOfAnEvenNumberIsTheMiddleOfTwo) {
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
  EXPECT_EQ(Quantile({3.0}, 0.5), 3.0);
  EXPECT_EQ(Quantile({4.0, 1.0}, 0.5), 2.5);
  EXPECT_EQ(Quantile({9.0, 1.0, 2.0, 4.0}, 0.5), 3.0);
  EXPECT_EQ(Quantile({9.0, 1.0, 2.0}, 0.5), 2.0);
}

// Runs without an answer took longer than any other.
TEST(Quantile, WhatLiesNextToInfinityIsInfinite) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Quantile({kNever, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(Quantile({kNever, 1.0, kNever, 2.0}, 0.5), kNever);
  EXPECT_EQ(Quantile({kNever, 1.0, kNever, kNever}, 0.5), kNever);
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
