// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace phongpd::testing {

// A folder root/ for the files of a stranger, and beside it secret/, of which
// the kernel tells whenever anybody opens or reads a file in it.  In root/
// there are ways that lead there: d (a link to the folder), link.bin and
// link.off; and things that are no files: fifo.bin, fifo.off, zero.bin (a link
// to a device), folder.bin.
class WatchedFolder : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    namespace fs = std::filesystem;
    fs::create_directories(folder_ / "root/sub");
    fs::create_directory(folder_ / "root/folder.bin");
    fs::create_directory(folder_ / "secret");
    fs::create_symlink("../secret", folder_ / "root/d");
    for (const std::string extension : {".bin", ".off"}) {
      fs::create_symlink("../secret/data" + extension,
                         folder_ / ("root/link" + extension));
      ASSERT_EQ(mkfifo(At("root/fifo" + extension).c_str(), 0600), 0);
    }
    fs::create_symlink("/dev/zero", folder_ / "root/zero.bin");
    watch_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    ASSERT_GE(watch_, 0);
  }
  void TearDown() override {
    if (watch_ >= 0) close(watch_);
    TemporaryFolder::TearDown();
  }

  // From now on, when secret/ holds what it is to hold.
  void Watch() {
    ASSERT_GE(
        inotify_add_watch(watch_, At("secret").c_str(), IN_OPEN | IN_ACCESS),
        0);
  }

  // Has anybody been in secret/ since it was last asked?
  bool WasEntered() const {
    char buffer[4096];
    bool was = false;
    while (read(watch_, buffer, sizeof buffer) > 0) was = true;
    return was;
  }

 private:
  int watch_ = -1;
};

}  // namespace phongpd::testing
