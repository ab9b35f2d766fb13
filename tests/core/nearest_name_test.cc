// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/nearest_name.h"

#include <gtest/gtest.h>

namespace phongpd {
namespace {

TEST(NearestName, IsFoundForOneSlipInThreeLetters) {
  const std::vector<std::string> names = {"optimize", "plan", "plate",
                                          "long_plate"};
  EXPECT_EQ(DidYouMean("optimise", names), "; did you mean optimize?");
  EXPECT_EQ(DidYouMean("optmize", names), "; did you mean optimize?");
  EXPECT_EQ(DidYouMean("potimize", names), "; did you mean optimize?");
  EXPECT_EQ(DidYouMean("pla", names), "; did you mean plan?");
  EXPECT_EQ(DidYouMean("plaet", names), "; did you mean plate?");
  EXPECT_EQ(DidYouMean("longplate", names), "; did you mean long_plate?");
}

TEST(NearestName, CountsNeitherCapitalsNorWhatStandsBetweenWords) {
  const std::vector<std::string> names = {"prm", "rrt-connect", "prm-bridge"};
  for (const std::string word :
       {"RRTConnect", "rrt_connect", "RRT Connect", "RrtConect"}) {
    EXPECT_EQ(DidYouMean(word, names), "; did you mean rrt-connect?") << word;
  }
  EXPECT_EQ(DidYouMean("PRM", names), "; did you mean prm?");
}

TEST(NearestName, OfSeveralSlipsIsOneInFourLetters) {
  EXPECT_EQ(DidYouMean("strait", {"plate", "straight"}),
            "; did you mean straight?");
  EXPECT_EQ(DidYouMean("palace", {"plate", "straight"}), "");
}

TEST(NearestName, IsTheOnlyOneThatBeginsWithTheWord) {
  const std::vector<std::string> names = {"--output", "--obstacle", "--margin",
                                          "--max-seconds", "--max-mib"};
  EXPECT_EQ(DidYouMean("--out", names), "; did you mean --output?");
  EXPECT_EQ(DidYouMean("--obst", names), "; did you mean --obstacle?");
  EXPECT_EQ(DidYouMean("--o", names), "");    // of two, and short
  EXPECT_EQ(DidYouMean("--max", names), "");  // of two
  EXPECT_EQ(DidYouMean("euclid", {"phong", "euclidean"}),
            "; did you mean euclidean?");
  // A slip is nearer than a beginning.
  EXPECT_EQ(DidYouMean("pla", {"planning", "plan"}), "; did you mean plan?");
}

TEST(NearestName, IsNoneWhereNothingIsNear) {
  EXPECT_EQ(DidYouMean("query", {"optimize", "plan"}), "");
  EXPECT_EQ(DidYouMean("velocity", {"robot", "repair", "planning"}), "");
  EXPECT_EQ(DidYouMean("--velocity", {"--repair", "--unit"}), "");
  EXPECT_EQ(DidYouMean("x", {"y"}), "");
  EXPECT_EQ(DidYouMean("", {"plan"}), "");
  EXPECT_EQ(DidYouMean("plan", {}), "");
  EXPECT_EQ(DidYouMean(std::string(100000, 'x'), {"plan"}), "");
}

}  // namespace
}  // namespace phongpd
