// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: of numbered iterations, the multiples of a power of two and the last.
#include "planners/trajectory/path_history.h"

#include <gtest/gtest.h>

namespace phongpd {
namespace {

PathIterate Numbered(int iteration, std::size_t points) {
  PathIterate iterate;
  iterate.stage = "ipopt";
  iterate.record.iteration = iteration;
  iterate.path.assign(points, Eigen::Vector3d::Constant(iteration));
  return iterate;
}

TEST(PathHistory, KeepsEveryIterationOfAShortRun) {
  PathHistory history;
  EXPECT_TRUE(history.Kept().empty());
  for (int i = 0; i < 100; ++i) history.Add(Numbered(i, 42));
  const auto kept = history.Kept();
  ASSERT_EQ(kept.size(), 100U);
  EXPECT_EQ(history.stride(), 1U);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(kept[i].number, i);
}

TEST(PathHistory, ThinsLongRunsEvenlyAndKeepsBothEnds) {
  for (const auto& [count, points] :
       {std::make_pair(241, 42), std::make_pair(1000, 42),
        std::make_pair(5000, 1000), std::make_pair(77, 50000),
        std::make_pair(3, 100000)}) {
    PathHistory history;
    for (int i = 0; i < count; ++i) {
      history.Add(Numbered(i, static_cast<std::size_t>(points)));
    }
    const auto kept = history.Kept();
    EXPECT_EQ(history.count(), static_cast<std::size_t>(count));
    ASSERT_GE(kept.size(), 2U);
    EXPECT_LE(kept.size(), PathHistory::kMostPaths);
    EXPECT_TRUE(kept.size() == 2 ||
                kept.size() * static_cast<std::size_t>(points) <=
                    PathHistory::kMostPoints);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const bool is_last = i + 1 == kept.size();
      EXPECT_EQ(kept[i].number,
                is_last ? history.count() - 1 : i * history.stride());
      EXPECT_EQ(kept[i].iterate.record.iteration,
                static_cast<int>(kept[i].number));
    }
  }
}

// Where a restoration hands over, its last iterate comes again as a regular
// one.
TEST(PathHistory, AnIterateThatComesAgainTakesItsPlace) {
  PathHistory history;
  history.Add(Numbered(0, 2));
  for (int i = 1; i <= 2; ++i) {
    PathIterate iterate = Numbered(i, 2);
    iterate.record.is_restoration = true;
    history.Add(iterate);
  }
  history.Add(Numbered(2, 2));
  const auto kept = history.Kept();
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_TRUE(kept[1].iterate.record.is_restoration);
  EXPECT_FALSE(kept[2].iterate.record.is_restoration);
  // The same number of another round is another iterate.
  PathIterate next = Numbered(2, 2);
  next.round = 1;
  history.Add(next);
  EXPECT_EQ(history.count(), 4U);
}

}  // namespace
}  // namespace phongpd
