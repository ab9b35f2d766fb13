// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <mutex>
#include <string_view>

#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_observer.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFirst = 2.0;  // seconds until anything is counted
constexpr double kBetweenOnTerminal = 2.0, kBetweenInLog = 10.0;

double Since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

struct Reporter {
  bool is_terminal = isatty(STDERR_FILENO) != 0;
  bool is_silent = [] {
    const char* const wish = std::getenv("PHONGPD_PROGRESS");
    return wish != nullptr && std::string_view(wish) == "never";
  }();
  Clock::time_point told = Clock::now();  // the last line, or the beginning
  std::string what;                       // is counted
  Clock::time_point began;                // counting it
  std::mutex mutex;                       // of all above

  bool IsTime() const {
    return Since(told) >= (is_terminal ? kBetweenOnTerminal : kBetweenInLog);
  }
  void Tell(const std::string& text) {
    if (is_silent) return;
    std::cerr << OneLine(text) + '\n';
    told = Clock::now();
  }
};

Reporter& TheReporter() {
  static Reporter& reporter = *new Reporter;  // builds may outlive main
  return reporter;
}

// "12 s, about 30 s left"
std::string Times(double seconds, double left) {
  return Rounded(seconds, 2) + " s, about " + Rounded(left, 2) + " s left";
}

void TellOfBuild(const BuildProgress& build) {
  if (build.seconds < kFirst) return;
  Reporter& reporter = TheReporter();
  const std::unique_lock<std::mutex> lock(reporter.mutex, std::try_to_lock);
  if (!lock.owns_lock() || !reporter.IsTime()) return;
  try {
    const double left = build.predicted_seconds - build.seconds;
    const std::string stage =
        std::string("  contact space, ") + build.stage + ": ";
    if (build.predicted_seconds == 0.0) {
      reporter.Tell(stage + Rounded(build.seconds, 2) + " s");
    } else if (left > 0.0) {
      reporter.Tell(stage + Times(build.seconds, left) + " (a guess)");
    } else {
      reporter.Tell(stage + Rounded(build.seconds, 2) + " s, longer than the " +
                    Rounded(build.predicted_seconds, 2) + " s predicted");
    }
  } catch (const std::exception&) {
    // No memory for words: the build itself will say so.
  }
}

}  // namespace

void Progress(const std::string& text) {
  Stage() = text;
  Reporter& reporter = TheReporter();
  const std::lock_guard<std::mutex> lock(reporter.mutex);
  if (reporter.is_terminal || reporter.IsTime()) reporter.Tell(text);
}

void ProgressOf(const std::string& what, std::size_t done, std::size_t all) {
  Reporter& reporter = TheReporter();
  const std::lock_guard<std::mutex> lock(reporter.mutex);
  if (reporter.what != what) {
    reporter.what = what;
    reporter.began = Clock::now();
  }
  const double seconds = Since(reporter.began);
  if (seconds < kFirst || done == 0 || done >= all || !reporter.IsTime()) {
    return;
  }
  const double each = seconds / static_cast<double>(done);
  reporter.Tell("  " + what + ": " + std::to_string(done) + " of " +
                std::to_string(all) + ", " +
                Times(seconds, each * static_cast<double>(all - done)));
}

void TellOfBuilds() {
  TheReporter();
  ObserveBuilds(TellOfBuild);
}

std::string& Stage() {
  static std::string stage;
  return stage;
}

}  // namespace phongpd::cli
