// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the sentence of the header, in cases and on random pairs.
#include "planners/exact/route_order.h"

#include <gtest/gtest.h>

#include <random>

namespace phongpd {
namespace {

using Route = RouteOrder::Route;

TEST(RouteOrder, WeighsClearanceAsATenthOfTheLength) {
  const RouteOrder order(1e-9);
  const Route base = {10.0, 1.0};
  EXPECT_TRUE(order.IsBetter({9.9, 0.8}, base));
  EXPECT_FALSE(order.IsBetter({10.1, 1.2}, base));
  // Much less clearance: a tenth shorter, or not better.
  EXPECT_FALSE(order.IsBetter({9.1, 0.6}, base));
  EXPECT_TRUE(order.IsBetter({8.9, 0.6}, base));
  // Much more: a tenth longer is better still.
  EXPECT_TRUE(order.IsBetter({11.0, 1.5}, base));
  EXPECT_FALSE(order.IsBetter({11.2, 1.5}, base));
}

TEST(RouteOrder, PrefersWhatRoundingDidNotOpen) {
  const RouteOrder order(0.01);
  EXPECT_TRUE(order.IsBetter({100.0, 0.011}, {1.0, 0.01}));
  EXPECT_FALSE(order.IsBetter({1.0, 0.01}, {100.0, 0.011}));
}

TEST(RouteOrder, PrefersWhatKeepsTheClearanceAskedFor) {
  const RouteOrder order(1e-9, 0.5);
  EXPECT_TRUE(order.IsBetter({100.0, 0.5}, {1.0, 0.49}));
  EXPECT_TRUE(order.IsBetter({100.0, 0.2}, {1.0, 0.1}));
  // Where both keep it to rounding, the shorter one.
  EXPECT_TRUE(order.IsBetter({1.0, 0.5 * (1.0 - 1e-9)}, {1.01, 0.6}));
  EXPECT_FALSE(order.IsBetter({1.0, 0.499}, {100.0, 0.5}));
}

// Found in either order, the same of two routes is kept.
TEST(RouteOrder, DoesNotDependOnWhichWasFoundFirst) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> length(1.0, 1.3), room(0.0, 1.0);
  const RouteOrder order(0.1);
  int either = 0;
  for (int i = 0; i < 100000; ++i) {
    const Route a = {length(random), room(random)};
    const Route b = {length(random), room(random)};
    EXPECT_FALSE(order.IsBetter(a, a));
    EXPECT_FALSE(order.IsBetter(a, b) && order.IsBetter(b, a));
    either += order.IsBetter(a, b) || order.IsBetter(b, a) ? 1 : 0;
  }
  EXPECT_EQ(either, 100000);
}

}  // namespace
}  // namespace phongpd
