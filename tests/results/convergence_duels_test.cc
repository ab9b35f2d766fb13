// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: rows made by hand, binomials and intervals worked out on paper.
#include "results/bench/convergence_duels.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace phongpd::bench {
namespace {

using Json = nlohmann::ordered_json;

Json Row(const char* method, long seed, bool is_solved, int iterations,
         const char* scene = "a") {
  return {{"scene", scene}, {"protocol", "p"},     {"method", method},
          {"seed", seed},   {"solved", is_solved}, {"iterations", iterations}};
}

// Seeds 1 to 6: both solve and own takes half; 7 own alone, 8 rival alone, 9
// neither, 10 has no rival.
std::vector<Json> Rows() {
  std::vector<Json> rows;
  for (long seed = 1; seed <= 6; ++seed) {
    rows.push_back(Row("own", seed, true, 10));
    rows.push_back(Row("rival", seed, true, 20));
  }
  rows.push_back(Row("own", 7, true, 900));
  rows.push_back(Row("rival", 7, false, 1));
  rows.push_back(Row("own", 8, false, 1));
  rows.push_back(Row("rival", 8, true, 900));
  rows.push_back(Row("own", 9, false, 1));
  rows.push_back(Row("rival", 9, false, 2));
  rows.push_back(Row("own", 10, true, 1));
  rows.push_back(Row("rival", 1, true, 5, "b"));
  rows.push_back(Row("own", 1, true, 5, "b"));
  return rows;
}

TEST(Arena, CountsPairsOfTheScenesAsked) {
  const Arena arena(Rows());
  const Duel duel = arena.Fight("p", "own", "rival", {"a"});
  EXPECT_EQ(duel.problems, 9);
  EXPECT_EQ(duel.only_own, 1);
  EXPECT_EQ(duel.only_rival, 1);
  EXPECT_EQ(duel.fewer, 7);  // what is not solved took more than any
  EXPECT_EQ(duel.more, 1);
  EXPECT_EQ(duel.ratios, std::vector<double>(6, 0.5));
  EXPECT_DOUBLE_EQ(duel.p_solved, 1.0);
  EXPECT_NEAR(duel.p_iterations, 2.0 * 9.0 / 256.0, 1e-12);
  const Duel both = arena.Fight("p", "own", "rival", {"a", "b"});
  EXPECT_EQ(both.problems, 10);
  EXPECT_EQ(both.fewer + both.more, 8);  // equal iterations are none's
  EXPECT_EQ(arena.Fight("q", "own", "rival", {"a"}).problems, 0);
  EXPECT_EQ(arena.Fight("p", "own", "other", {"a"}).problems, 0);
}

TEST(Duel, ShowsEffectsWithTheirIntervals) {
  Duel duel;
  EXPECT_EQ(duel.IterationsEffect(), "–");
  duel.problems = 100;
  duel.only_own = 20;
  // 20 ± 1.96·√(20 − 4)
  EXPECT_EQ(duel.SolvedEffect(), "20 (12.2 … 27.8)");
  // n = 25: ranks 12.5 ∓ 4.9, the eighth from either end.
  for (int i = 1; i <= 25; ++i) duel.ratios.push_back(i);
  EXPECT_EQ(duel.IterationsEffect(), "13 (8 … 18)");
}

TEST(Correct, LabelsOnlyWhatAllTestsTogetherAllow) {
  Duel clear, weak;
  clear.only_own = 20;
  clear.p_solved = 1e-5;
  clear.more = 9;
  clear.p_iterations = 0.004;
  weak.only_rival = 9;
  weak.p_solved = 0.03;  // twice that after the two above
  Correct({&clear, &weak});
  EXPECT_NEAR(clear.p_solved, 4e-5, 1e-12);
  EXPECT_NEAR(clear.p_iterations, 0.012, 1e-12);
  EXPECT_NEAR(weak.p_solved, 0.06, 1e-12);
  EXPECT_EQ(clear.SolvedVerdict(), "win");
  EXPECT_EQ(clear.IterationsVerdict(), "**loss**");
  EXPECT_EQ(weak.SolvedVerdict(), "tie");
}

}  // namespace
}  // namespace phongpd::bench
