// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/metric_color.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace phongpd {
namespace {

using Strings = std::vector<std::string>;

TEST(LineColors, AreTheMetricsWhateverTheirOrder) {
  EXPECT_EQ(LineColors({"Euclidean PD", "PhongPD, ℓ = 0.1", "sliding contact"}),
            Strings({kEuclideanColor, kPhongColor, kSlidingColor}));
  EXPECT_EQ(LineColors({"PhongPD, ℓ = 0.2 · seed 3 · solved",
                        "Euclidean PD · seed 3 · failed"}),
            Strings({kPhongColor, kEuclideanColor}));
  EXPECT_TRUE(LineColors({}).empty());
}

// Towards (9F, B4, C8) by 0.45: 00 + 0.45 · 9F = 47.55 → 48.
TEST(LineColors, ArePalerForTheNextOfAMetric) {
  const Strings colors = LineColors({"PhongPD, ℓ = 0", "PhongPD, ℓ = 0.1",
                                     "PhongPD, ℓ = 0.2", "PhongPD, ℓ = 0.3"});
  EXPECT_EQ(colors[0], kPhongColor);
  EXPECT_EQ(colors[1], "#4886BB");
  EXPECT_NE(colors[2], colors[1]);
  EXPECT_EQ(colors[3], colors[2]) << "no paler than three quarters";
}

TEST(LineColors, AreNoMetricsForAllElse) {
  const Strings colors = LineColors(
      {"contact-surface", "PhongPD, ℓ = 0.2", "prm", "", "a", "b", "c", "d"});
  const std::set<std::string> metrics = {kPhongColor, kEuclideanColor,
                                         kSlidingColor};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    EXPECT_EQ(metrics.count(colors[i]), i == 1 ? 1U : 0U) << i;
    EXPECT_EQ(colors[i].size(), 7U) << colors[i];
  }
  EXPECT_NE(colors[0], colors[2]);
}

}  // namespace
}  // namespace phongpd
