// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/output_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>

#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Set = std::set<std::string>;
using OutputFilesTest = testing::TemporaryFolder;

std::string Refusal(OutputFiles* outputs, const std::string& path) {
  return testing::ErrorOf([&] { outputs->Declare(path); });
}

TEST_F(OutputFilesTest, AllAppearAtCommitAndNoneBefore) {
  Put("b", "old");
  const mode_t before = umask(022);
  {
    OutputFiles outputs;
    for (const char* name : {"a", "b", "c"}) {
      outputs.Declare(At(name));
      outputs.Write(At(name), std::string("new ") + name);
    }
    EXPECT_EQ(Content("b"), "old");
    EXPECT_EQ(Names().count("a"), 0U);
    outputs.Commit();
  }
  umask(before);
  EXPECT_EQ(Names(), (Set{"a", "b", "c"}));
  for (const char* name : {"a", "b", "c"}) {
    EXPECT_EQ(Content(name), std::string("new ") + name);
    struct stat status = {};
    ASSERT_EQ(stat(At(name).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777U, 0644U);
  }
}

// Once the first output was already replaced when the second could not be.
TEST_F(OutputFilesTest, AFailureInCommitUndoesWhatCameBefore) {
  Put("old", "old content");
  OutputFiles outputs;
  for (const char* name : {"new", "old", "blocked", "after"}) {
    outputs.Declare(At(name));
    outputs.Write(At(name), "replaced");
  }
  fs::create_directory(At("blocked"));
  const std::string what = testing::ErrorOf([&] { outputs.Commit(); });
  EXPECT_NE(what.find(At("blocked")), std::string::npos);
  EXPECT_EQ(Content("old"), "old content");
  EXPECT_FALSE(fs::exists(At("new")));
  EXPECT_FALSE(fs::exists(At("after")));
}

TEST_F(OutputFilesTest, WithoutCommitNothingIsLeft) {
  {
    OutputFiles outputs;
    outputs.MakeDirectory(At("made/deep"));
    outputs.Declare(At("made/deep/a"));
    outputs.Write(At("made/deep/a"), "content");
    outputs.Declare(At("b"));
    EXPECT_EQ(Names().size(), 2U);
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

// Once temporaries had names that could be known, and were opened through
// links that lay in wait there.
TEST_F(OutputFilesTest, ALinkUnderAnyEarlierNameIsNotFollowed) {
  Put("precious", "kept");
  const std::string stem = ".x." + std::to_string(getpid()) + ".part.csv";
  fs::create_symlink("precious", At(stem));
  OutputFiles outputs;
  outputs.Declare(At("x.csv"));
  outputs.Write(At("x.csv"), "content");
  outputs.Commit();
  EXPECT_EQ(Content("precious"), "kept");
  EXPECT_EQ(Content("x.csv"), "content");
}

TEST_F(OutputFilesTest, WhatAKilledProcessLeftGoesWithTheNextOutput) {
  const std::string left = ".phongpd-x-" + std::string(32, '0') + ".part";
  const std::string other = ".phongpd-y-" + std::string(32, '0') + ".part";
  OutputFiles running;  // another process at work on the same file
  running.Declare(At("x"));
  Put(left, "torn");
  Put(other, "torn");
  const std::size_t before = Names().size();
  OutputFiles outputs;
  outputs.Declare(At("x"));
  EXPECT_EQ(Names().size(), before);  // one more, and one less
  EXPECT_EQ(Names().count(left), 0U);
  EXPECT_EQ(Names().count(other), 1U);
  running.Write(At("x"), "first");
  outputs.Write(At("x"), "second");
  running.Commit();
  outputs.Commit();
  EXPECT_EQ(Content("x"), "second");
  EXPECT_EQ(Names(), (Set{"x", other}));
}

TEST_F(OutputFilesTest, FollowsOnesOwnLinks) {
  Put("target", "old");
  fs::create_symlink("target", At("link"));
  fs::create_symlink("nothing", At("dangling"));
  OutputFiles outputs;
  for (const char* name : {"link", "dangling"}) {
    outputs.Declare(At(name));
    outputs.Write(At(name), "new");
  }
  outputs.Commit();
  EXPECT_TRUE(fs::is_symlink(At("link")));
  EXPECT_EQ(Content("target"), "new");
  // A link to nothing is replaced.
  EXPECT_EQ(Content("dangling"), "new");
  EXPECT_EQ(Names(), (Set{"dangling", "link", "target"}));
}

TEST_F(OutputFilesTest, RefusesLinksOfOthersInSharedFolders) {
  if (geteuid() != 0) GTEST_SKIP() << "needs to give files away";
  Put("precious", "kept");
  fs::create_directory(At("shared"));
  ASSERT_EQ(chmod(At("shared").c_str(), 01777), 0);
  fs::create_symlink("../precious", At("shared/x"));
  ASSERT_EQ(lchown(At("shared/x").c_str(), 12345, 12345), 0);
  OutputFiles outputs;
  EXPECT_NE(Refusal(&outputs, At("shared/x")).find("link"), std::string::npos);
  EXPECT_EQ(Content("precious"), "kept");
  ASSERT_EQ(chmod(At("shared").c_str(), 0755), 0);
  EXPECT_EQ(Refusal(&outputs, At("shared/x")), "");
}

TEST_F(OutputFilesTest, KeepsNamesAsLongAsTheSystemAllows) {
  const std::string name(255, 'n');
  OutputFiles outputs;
  outputs.Declare(At(name));
  outputs.Write(At(name), "content");
  outputs.Declare(At("b"));
  outputs.Commit();
  EXPECT_EQ(Content(name), "content");
}

TEST_F(OutputFilesTest, WritesDevicesInPlace) {
  ASSERT_EQ(mkfifo(At("pipe").c_str(), 0600), 0);
  OutputFiles outputs;
  outputs.Declare("/dev/null");
  outputs.Write("/dev/null", "gone");
  EXPECT_EQ(outputs.Target("/dev/null"), "");
  outputs.Declare(At("pipe"));
  EXPECT_EQ(outputs.Target(At("pipe")), "");
  outputs.Declare("/dev/full");
  EXPECT_THROW(outputs.Write("/dev/full", "too much"), InputError);
  outputs.Commit();
  EXPECT_TRUE(fs::is_fifo(At("pipe")));
}

}  // namespace
}  // namespace phongpd
