// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/row_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Rows = std::vector<std::string>;

class RowFileTest : public testing::TemporaryFolder {
 protected:
  std::unique_ptr<RowFile> Open(const Json& command) const {
    return std::make_unique<RowFile>(At("o.jsonl"), command);
  }
  // Why the file is refused; empty: it is not.
  std::string Refusal(const Json& command) const {
    return testing::ErrorOf([&] { Open(command); });
  }
  void ExpectRefused(const Json& command, const std::string& word) const {
    const std::string refusal = Refusal(command);
    EXPECT_NE(refusal.find(word), std::string::npos) << refusal;
    EXPECT_EQ(refusal.rfind(At("o.jsonl.partial"), 0), 0U) << refusal;
  }
  // The file as an interrupted command leaves it.
  std::string Interrupted(const Rows& rows) const {
    const auto file = Open(kCommand);
    for (const std::string& row : rows) file->Append(row);
    return Content("o.jsonl.partial");
  }

  const Json kCommand = {{"seed", 5}, {"versions", {{"a", "1"}, {"b", "2"}}}};
  // Not as this program would write them: bytes are kept.
  const Rows kRows = {R"({"seed": 5,  "x": 1.50})", R"({"seed":6,"y":"ü"})"};
};

TEST_F(RowFileTest, KeepsAsidesApartFromTheRows) {
  const std::string aside = R"({"tab":"\\t","x":[0.1]})";
  {
    const auto file = Open(kCommand);
    file->Append(kRows[0], aside);
    file->Append(kRows[1]);
  }
  {
    const auto file = Open(kCommand);
    EXPECT_EQ(file->rows(), kRows);
    EXPECT_EQ(file->asides(), Rows({aside, ""}));
    EXPECT_EQ(file->Content(), kRows[0] + '\n' + kRows[1] + '\n');
    file->Append(kRows[0], aside);
  }
  // An aside that is torn takes its row with it.
  const std::string text = Content("o.jsonl.partial");
  Put("o.jsonl.partial", text.substr(0, text.size() - 3) + '\n');
  const auto file = Open(kCommand);
  EXPECT_EQ(file->rows(), kRows);
  file->Finish();
}

TEST_F(RowFileTest, KeepsRowsByteForByteAndGoesOn) {
  Interrupted(kRows);
  const auto file = Open(kCommand);
  EXPECT_EQ(file->rows(), kRows);
  file->Append(R"({"seed":7})");
  EXPECT_EQ(file->Content(), kRows[0] + '\n' + kRows[1] + "\n{\"seed\":7}\n");
  file->Finish();
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(RowFileTest, RowsAreThereAtOnce) {
  const auto file = Open(kCommand);
  for (const std::string& row : kRows) {
    file->Append(row);
    const std::string content = Content("o.jsonl.partial");
    EXPECT_EQ(content.substr(content.size() - row.size() - 1), row + '\n');
  }
}

TEST_F(RowFileTest, NothingIsLeftWithoutRows) {
  Open(kCommand);
  EXPECT_TRUE(fs::is_empty(folder_));
}

// Cut after any byte: whole rows are kept, a torn one is not.
TEST_F(RowFileTest, ATornLineDoesNotCount) {
  const std::string whole = Interrupted(kRows);
  const std::size_t header = whole.find('\n') + 1;
  const std::size_t first = header + kRows[0].size() + 1;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    Put("o.jsonl.partial", whole.substr(0, size));
    const std::size_t rows = size == whole.size() ? 2 : size >= first ? 1 : 0;
    auto file = Open(kCommand);
    ASSERT_EQ(file->rows().size(), rows) << size;
    for (std::size_t i = rows; i < 2; ++i) file->Append(kRows[i]);
    file.reset();
    ASSERT_EQ(Content("o.jsonl.partial"), whole) << size;
    fs::remove(At("o.jsonl.partial"));
  }
  // As a power cut leaves it: blocks that were never written.
  Put("o.jsonl.partial", whole.substr(0, first) + std::string(50, '\0') + '\n');
  EXPECT_EQ(Open(kCommand)->rows(), Rows{kRows[0]});
}

TEST_F(RowFileTest, RowsOfAnotherCommandAreRefusedAndKept) {
  const std::string whole = Interrupted(kRows);
  Json other = kCommand;
  other["seed"] = 7;
  ExpectRefused(other, "seed: 5 there, 7 here");
  ExpectRefused(other, "2 rows");
  other = kCommand;
  other["versions"]["b"] = "3";
  ExpectRefused(other, "b: 2 there, 3 here");
  other = kCommand;
  other.erase("seed");
  ExpectRefused(other, "another command");
  EXPECT_EQ(Content("o.jsonl.partial"), whole);
  EXPECT_EQ(Open(kCommand)->rows(), kRows);
}

TEST_F(RowFileTest, WhatIsNoFileOfRowsIsRefusedAndKept) {
  for (const std::string text : {"my notes", "my notes\n", "{}\n{}\n", "[1]\n",
                                 "{\"what\":\"x\",\"command\":{}}\n"}) {
    Put("o.jsonl.partial", text);
    ExpectRefused(kCommand, "something else");
    EXPECT_EQ(Content("o.jsonl.partial"), text);
  }
}

TEST_F(RowFileTest, TwoAtOnceAreRefused) {
  const auto file = Open(kCommand);
  ExpectRefused(kCommand, "another process");
  file->Append(kRows[0]);
  ExpectRefused(kCommand, "another process");
  EXPECT_EQ(file->rows().size(), 1U);
}

TEST_F(RowFileTest, LinksAndFilesOfOthersAreNotTakenUp) {
  const std::string whole = Interrupted(kRows);
  const std::string path = At("o.jsonl.partial");
  ASSERT_EQ(chmod(path.c_str(), 0666), 0);
  ExpectRefused(kCommand, "only its owner");
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  if (geteuid() == 0) {
    ASSERT_EQ(chown(path.c_str(), 12345, 12345), 0);
    ExpectRefused(kCommand, "only its owner");
    ASSERT_EQ(chown(path.c_str(), 0, 0), 0);
  }
  fs::rename(path, At("elsewhere"));
  fs::create_symlink("elsewhere", path);
  ExpectRefused(kCommand, "symbolic link");
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  ExpectRefused(kCommand, "expected a file of rows");
  EXPECT_EQ(Content("elsewhere"), whole);
}

TEST_F(RowFileTest, WithoutATargetRowsStayInMemory) {
  RowFile file("", kCommand);
  file.Append("{}");
  EXPECT_EQ(file.Content(), "{}\n");
  file.Finish();
}

}  // namespace
}  // namespace phongpd
