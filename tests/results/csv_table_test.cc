// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: tables written by ToCsv, and texts written here.
#include "results/bench/csv_table.h"

#include <gtest/gtest.h>

#include "results/bench/report.h"
#include "tests/support/expect_refused.h"

namespace phongpd::bench {
namespace {

TEST(CsvTable, ReadsWhatReportsWrite) {
  const Table table{"",
                    "",
                    {"scene", "µs, median", "n"},
                    {{"tunnel:a=1,b=2", "0.5", "3"},
                     {"says \"no\"", "1e-3", ""},
                     {"two\nlines", "-1", "x"}}};
  const CsvTable read(ToCsv(table), "test");
  EXPECT_EQ(read.header(), table.header);
  EXPECT_EQ(read.rows(), table.rows);
  EXPECT_EQ(read.Text(0, "scene"), "tunnel:a=1,b=2");
  EXPECT_EQ(read.Number(1, "µs, median"), 1e-3);
}

TEST(CsvTable, NeedsNoLastLineEnd) {
  const CsvTable read("a,b\n1,2", "test");
  ASSERT_EQ(read.rows().size(), 1u);
  EXPECT_EQ(read.Number(0, "b"), 2.0);
}

TEST(CsvTable, RefusesBadInputByName) {
  const auto message = [](const auto& run) -> std::string {
    return testing::ErrorOf([&] { run(); }, "none");
  };
  EXPECT_EQ(message([] { CsvTable("", "t"); }),
            "t: expected a header, found none");
  EXPECT_EQ(message([] { CsvTable("a,b\n1\n", "t"); }),
            "t: row 1: expected 2 cells, found 1");
  const CsvTable table("a,b\n1,x\n", "t");
  EXPECT_EQ(message([&] { table.Text(0, "c"); }),
            "t: expected a column 'c', found a, b");
  EXPECT_EQ(message([&] { table.Number(0, "b"); }),
            "t: row 1: b: expected a finite number, found 'x'");
  EXPECT_EQ(message([] { ReadCsvTable("/nowhere.csv"); }),
            "/nowhere.csv: cannot be read");
}

}  // namespace
}  // namespace phongpd::bench
