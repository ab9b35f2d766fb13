// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/slice_check.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_error.h"

namespace phongpd::bench {
namespace {

TEST(Spread, TakesTheMiddlesOfEqualParts) {
  EXPECT_EQ(Spread(3, 40), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(Spread(12, 3), (std::vector<std::size_t>{2, 6, 10}));
  const std::vector<std::size_t> rows = Spread(20600, 40);
  ASSERT_EQ(rows.size(), 40u);
  EXPECT_EQ(rows.front(), 257u);
  EXPECT_EQ(rows.back(), 20342u);
}

TEST(CompareRow, NamesEveryOtherCellButIgnoredOnes) {
  const CsvTable was("scene,status,length,seconds\na,ok,1.5,7\nb,ok,2,7\n",
                     "was");
  const CsvTable is("scene,status,length,seconds\nb,failed,2.5,9\nb,ok,2,9\n",
                    "is");
  Slice slice;
  CompareRow(was, 1, is, 0, {"seconds"}, "b", &slice);
  CompareRow(was, 1, is, 1, {"seconds"}, "b", &slice);
  EXPECT_EQ(slice.remade, 2u);
  EXPECT_EQ(slice.identical, 1u);
  ASSERT_EQ(slice.deviations.size(), 2u);
  EXPECT_EQ(slice.deviations[0].column, "status");
  EXPECT_EQ(slice.deviations[0].published, "ok");
  EXPECT_EQ(slice.deviations[0].found, "failed");
  EXPECT_EQ(slice.deviations[1].column, "length");
  CompareRow(was, 1, is, 1, {}, "b", &slice);
  EXPECT_EQ(slice.deviations.back().column, "seconds");
}

TEST(CompareRow, TellsRoundingFromAnotherNumber) {
  const CsvTable was("a,b\n0.1,-5e-17\n0.1,1\n0.1,1e-9\n", "was");
  const CsvTable is("a,b\n0.10000000000000001,0\n0.1,one\n0.1,2e-9\n", "is");
  Slice slice;
  CompareRow(was, 0, is, 0, {}, "rounded", &slice);
  EXPECT_EQ(slice.rounded, 1u);
  EXPECT_TRUE(slice.deviations.empty());
  CompareRow(was, 1, is, 1, {}, "text", &slice);
  CompareRow(was, 2, is, 2, {}, "number", &slice);
  EXPECT_EQ(slice.rounded, 1u);
  EXPECT_EQ(slice.identical, 0u);
  EXPECT_EQ(slice.deviations.size(), 2u);
}

TEST(CompareRow, RefusesTablesWithoutAColumn) {
  const CsvTable was("scene,status\na,ok\n", "was");
  const CsvTable is("scene\na\n", "is");
  Slice slice;
  EXPECT_THROW(CompareRow(was, 0, is, 0, {}, "a", &slice), InputError);
}

}  // namespace
}  // namespace phongpd::bench
