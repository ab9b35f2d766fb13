// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/child_process.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace phongpd::bench {
namespace {

// Address space of a child, so that none takes the machine down.
constexpr rlim_t kMemory = rlim_t{12} << 30;

[[noreturn]] void Work(const std::function<std::string()>& work, int pipe) {
  const rlimit memory = {kMemory, kMemory};
  setrlimit(RLIMIT_AS, &memory);
  std::string text;
  int code = 0;
  try {
    text = work();
  } catch (const std::exception& error) {
    text = error.what();
    code = 1;
  }
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = write(pipe, text.data() + at, text.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(2);
    at += static_cast<std::size_t>(n);
  }
  _exit(code);  // no destructors of the parent's objects
}

}  // namespace

ChildProcess::ChildProcess(const std::function<std::string()>& work) {
  int ends[2];
  if (pipe(ends) != 0) {
    throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  }
  std::cout.flush();
  pid_ = fork();
  if (pid_ == 0) {
    close(ends[0]);
    Work(work, ends[1]);
  }
  close(ends[1]);
  pipe_ = ends[0];
  if (pid_ < 0) {
    close(pipe_);
    throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  ChildOutcome ignored;
  Reap(&ignored);
}

ChildOutcome ChildProcess::Wait(double limit) {
  ChildOutcome outcome;
  bool stopped = false;
  char buffer[4096];
  while (true) {
    const double left = limit - stopwatch_.Seconds();
    pollfd ready = {pipe_, POLLIN, 0};
    const int timeout = static_cast<int>(std::clamp(1e3 * left, 0.0, 1e6));
    const int events = poll(&ready, 1, timeout);
    if (events < 0 && errno == EINTR) continue;
    if (events == 0 && left > 0) continue;
    if (events <= 0) {
      stopped = true;
      kill(pid_, SIGKILL);
      break;
    }
    const ssize_t n = read(pipe_, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    outcome.output.append(buffer, static_cast<std::size_t>(n));
  }
  Reap(&outcome);
  if (stopped) outcome.status = ChildStatus::kStopped;
  return outcome;
}

void ChildProcess::Reap(ChildOutcome* outcome) {
  int status = 0;
  rusage usage = {};
  while (wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  outcome->seconds = stopwatch_.Seconds();
  outcome->peak_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
  outcome->status = !WIFEXITED(status)         ? ChildStatus::kCrashed
                    : WEXITSTATUS(status) == 0 ? ChildStatus::kDone
                                               : ChildStatus::kFailed;
  close(pipe_);
  pid_ = -1;
}

ChildOutcome RunInChild(const std::function<std::string()>& work,
                        double limit) {
  return ChildProcess(work).Wait(limit);
}

}  // namespace phongpd::bench
