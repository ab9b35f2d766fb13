// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

#include "core/stopwatch.h"

namespace phongpd::bench {

enum class ChildStatus {
  kDone,     // the work returned
  kFailed,   // the work threw
  kStopped,  // killed at the time limit
  kCrashed,  // ended by a signal
};

inline bool IsDone(ChildStatus status) { return status == ChildStatus::kDone; }

struct ChildOutcome {
  ChildStatus status = ChildStatus::kCrashed;
  std::string output;     // what the work returned, or what() it threw
  double seconds = 0.0;   // wall
  double peak_mib = 0.0;  // of the child alone
};

// Work in a forked process: memory is measured for it alone, and neither a
// crash nor an endless loop reaches the caller.  The caller must not have
// started threads (TBB included): a fork copies only its own.
class ChildProcess {
 public:
  explicit ChildProcess(const std::function<std::string()>& work);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  // Kills the child if Wait was never called.
  ~ChildProcess();

  // Waits until the child ends or `limit` seconds after its start.
  ChildOutcome Wait(double limit);

 private:
  void Reap(ChildOutcome* outcome);

  pid_t pid_ = -1;
  int pipe_ = -1;
  Stopwatch stopwatch_;  // since the start
};

ChildOutcome RunInChild(const std::function<std::string()>& work, double limit);

}  // namespace phongpd::bench
