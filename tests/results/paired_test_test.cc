// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: coins counted by hand, and Holm's own rule.
#include "results/bench/paired_test.h"

#include <gtest/gtest.h>

namespace phongpd::bench {
namespace {

TEST(PairedTest, SignTestCountsFairCoins) {
  EXPECT_EQ(SignTest(0, 0), 1.0);
  EXPECT_NEAR(SignTest(5, 0), 2.0 / 32.0, 1e-15);
  EXPECT_NEAR(SignTest(0, 5), 2.0 / 32.0, 1e-15);
  // 1 + 6 of 64 sequences of six coins, on either side.
  EXPECT_NEAR(SignTest(1, 5), 14.0 / 64.0, 1e-14);
  EXPECT_NEAR(SignTest(3, 3), 1.0, 1e-14);
  EXPECT_LT(SignTest(500, 400), 1e-3);
}

TEST(PairedTest, HolmMultipliesByTheTestsThatAreLeftAndNeverFalls) {
  const std::vector<double> adjusted = Holm({0.04, 0.01, 0.5, 0.011});
  EXPECT_DOUBLE_EQ(adjusted[1], 0.04);
  // 3 · 0.011 is less than what the one before it came to.
  EXPECT_DOUBLE_EQ(adjusted[3], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.08);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.5);
  EXPECT_TRUE(Holm({}).empty());
  EXPECT_DOUBLE_EQ(Holm({0.9, 0.8})[0], 1.0);
}

}  // namespace
}  // namespace phongpd::bench
