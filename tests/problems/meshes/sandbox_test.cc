// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/sandbox.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>

#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

std::string WaitForEver() {
  for (;;) pause();
}

TEST(Sandbox, EndsWhatWaitsWithoutUsingTheProcessor) {
  SandboxLimits limits;
  limits.max_wait_seconds = 0.2;
  const std::string what =
      testing::ErrorOf([&] { RunInSandbox("file", WaitForEver, limits); });
  EXPECT_EQ(what,
            "file: expected a file that can be read, found one that takes too "
            "long to read");
}

// An answer on standard output is the parent's alone.
TEST(Sandbox, PrintsNothing) {
  ::testing::internal::CaptureStdout();
  std::printf("once, ");
  RunInSandbox("file", [] {
    std::printf("never");
    std::fflush(stdout);
    return std::string("done");
  });
  std::fflush(stdout);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "once, ");
}

TEST(Sandbox, ReturnsWhatWasMadeSlowly) {
  const auto slow = [] {
    usleep(300'000);
    return std::string(1 << 20, 'x');
  };
  EXPECT_EQ(RunInSandbox("file", slow), std::string(1 << 20, 'x'));
}

// Killed, so that it can tell nobody.
TEST(Sandbox, EndsWithTheProcessThatBeganIt) {
  // What the sandbox leaves behind becomes a child of this process.
  ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    RunInSandbox("file", [&] {
      const char ready = 'r';
      if (write(ends[1], &ready, 1) != 1) _exit(1);
      return WaitForEver();
    });
    _exit(0);
  }
  char ready = ' ';
  ASSERT_EQ(read(ends[0], &ready, 1), 1);
  kill(parent, SIGKILL);
  // Both end, and no more are there; a test that hangs has failed.
  int ended = 0;
  while (wait(nullptr) > 0 || errno == EINTR) ++ended;
  EXPECT_EQ(ended, 2);
  close(ends[0]);
  close(ends[1]);
}

}  // namespace
}  // namespace phongpd
