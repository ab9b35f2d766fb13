// SPDX-License-Identifier: GPL-3.0-or-later
#include "files/temporary_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include "tests/support/temporary_folder.h"

namespace phongpd::internal {
namespace {

namespace testing = phongpd::testing;

namespace fs = std::filesystem;

class TemporaryFileTest : public testing::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    open_ = OpenFolder(folder_.string());
  }

  static mode_t Mode(const fs::path& path) {
    struct stat status = {};
    EXPECT_EQ(lstat(path.c_str(), &status), 0) << path;
    return status.st_mode & 07777;
  }
  // What a child leaves that holds a temporary file when it ends by `end`.
  template <typename End>
  int EndWithTemporary(const End& end) const {
    const pid_t child = fork();
    if (child == 0) {
      RemoveFilesOnSignals();
      const RemovedOnSignal directory(AT_FDCWD, (folder_ / "made").string());
      mkdir((folder_ / "made").c_str(), 0700);
      const TemporaryFile a(open_, "a-");
      const Descriptor made = OpenFolder((folder_ / "made").string());
      const TemporaryFile b(made, "b-");
      end();
      _exit(0);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return status;
  }

  Descriptor open_;
};

TEST_F(TemporaryFileTest, IsPrivateUntilItIsPublished) {
  TemporaryFile file(open_, "x-");
  ASSERT_EQ(Names().size(), 1U);
  const std::string name = *Names().begin();
  EXPECT_EQ(name.size(), 2U + 32U + 5U);
  EXPECT_EQ(Mode(folder_ / name), 0600U);
  file.Write("con");
  file.Write("tent");
  file.Sync();
  const mode_t before = umask(027);
  file.Publish("x", 0666);
  umask(before);
  EXPECT_EQ(Names(), std::set<std::string>{"x"});
  EXPECT_EQ(Mode(folder_ / "x"), 0640U);
  EXPECT_EQ(Content("x"), "content");
}

TEST_F(TemporaryFileTest, NamesDoNotRepeat) {
  std::set<std::string> names;
  for (int i = 0; i < 1000; ++i) names.insert(UnguessableName(""));
  EXPECT_EQ(names.size(), 1000U);
}

TEST_F(TemporaryFileTest, ReplacesALinkAndNotWhatItNames) {
  Put("precious", "kept");
  fs::create_symlink("precious", folder_ / "x");
  TemporaryFile file(open_, "x-");
  file.Write("new");
  file.Publish("x", 0600);
  EXPECT_EQ(Content("precious"), "kept");
  EXPECT_EQ(Content("x"), "new");
  EXPECT_FALSE(fs::is_symlink(folder_ / "x"));
}

TEST_F(TemporaryFileTest, OnlyAbandonedOnesAreRemoved) {
  const std::string digits(32, 'a');
  const std::set<std::string> others = {"x-" + digits,
                                        "x-" + digits + "b.part",
                                        "y-" + digits + ".part",
                                        "x-" + std::string(31, 'a') + "g.part",
                                        "x-.part",
                                        "x.part"};
  for (const std::string& name : others) Put(name, "");
  fs::create_directory(folder_ / ("x-" + std::string(32, 'd') + ".part"));
  fs::create_symlink("x.part",
                     folder_ / ("x-" + std::string(32, 'e') + ".part"));
  const std::set<std::string> kept = Names();
  Put("x-" + digits + ".part", "abandoned");
  std::optional<TemporaryFile> alive;
  alive.emplace(open_, "x-");
  EXPECT_EQ(Names().size(), kept.size() + 2);
  RemoveAbandoned(folder_.string(), "x-");
  EXPECT_EQ(Names().size(), kept.size() + 1);
  alive.reset();
  EXPECT_EQ(Names(), kept);
}

TEST_F(TemporaryFileTest, SignalsRemoveItAndStillEndTheProcess) {
  for (const int signal :
       {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXCPU, SIGABRT}) {
    const int status = EndWithTemporary([&] { raise(signal); });
    EXPECT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_TRUE(Names().empty()) << signal;
  }
}

TEST_F(TemporaryFileTest, IgnoredSignalsStayIgnored) {
  std::signal(SIGHUP, SIG_IGN);
  const int status = EndWithTemporary([] { raise(SIGHUP); });
  std::signal(SIGHUP, SIG_DFL);
  EXPECT_TRUE(WIFEXITED(status));
}

TEST_F(TemporaryFileTest, WhatSigkillLeavesIsAbandoned) {
  EndWithTemporary([] { raise(SIGKILL); });
  EXPECT_EQ(Names().size(), 2U);
  RemoveAbandoned(folder_.string(), "a-");
  RemoveAbandoned((folder_ / "made").string(), "b-");
  EXPECT_EQ(Names(), std::set<std::string>{"made"});
  EXPECT_TRUE(fs::is_empty(folder_ / "made"));
}

TEST_F(TemporaryFileTest, SignalsWaitForAChangeInProgress) {
  const int status = EndWithTemporary([&] {
    TemporaryFile file(open_, "c-");
    const SignalsWait wait;
    raise(SIGTERM);
    file.Publish("whole", 0600);
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(Names(), std::set<std::string>{"whole"});
}

TEST_F(TemporaryFileTest, TheFirstCtrlCAsksAndTheNextEnds) {
  const int again = EndWithTemporary([] {
    const InterruptAsks ctrl_c;
    raise(SIGINT);
    raise(SIGINT);
  });
  EXPECT_TRUE(WIFSIGNALED(again));
  EXPECT_EQ(WTERMSIG(again), SIGINT);
  const int other = EndWithTemporary([] {
    const InterruptAsks ctrl_c;
    raise(SIGTERM);
  });
  EXPECT_EQ(WTERMSIG(other), SIGTERM);
  const int later = EndWithTemporary([] {
    { const InterruptAsks ctrl_c; }
    raise(SIGINT);
  });
  EXPECT_EQ(WTERMSIG(later), SIGINT);
  EXPECT_TRUE(Names().empty());
  const int asked = EndWithTemporary([] {
    const InterruptAsks ctrl_c;
    if (ctrl_c.HasAsked()) abort();
    raise(SIGINT);
    if (!ctrl_c.HasAsked()) abort();
  });
  EXPECT_TRUE(WIFEXITED(asked));
}

TEST_F(TemporaryFileTest, FailuresNameTheirReason) {
  TemporaryFile file(open_, "x-");
  fs::create_directory(folder_ / "x");
  try {
    file.Publish("x", 0600);
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), EISDIR);
  }
  EXPECT_THROW(OpenFolder((folder_ / "none").string()), std::system_error);
  EXPECT_THROW(TemporaryFile(open_, std::string(250, 'x')), std::system_error);
}

}  // namespace
}  // namespace phongpd::internal
