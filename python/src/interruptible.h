// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <type_traits>

#include "core/minkowski/build_stop.h"
#include "python/src/arrays.h"
#include "python/src/computing.h"

namespace phongpd::python {

// work() on another thread, so that Ctrl-C reaches Python meanwhile: it stops
// the build of a contact space in it, waits for all else, and comes up as
// KeyboardInterrupt.  Called with Python's lock; work() runs without it.  Work
// that takes a flag, work(is_asked), may end early once that is true.
template <typename Work>
auto Interruptible(const Work& work) {
  const InProgress mark;
  std::atomic<bool> is_asked{false};
  auto result = std::async(std::launch::async, [&] {
    if constexpr (std::is_invocable_v<Work, const std::atomic<bool>&>) {
      return work(is_asked);
    } else {
      return work();
    }
  });
  const auto is_done = [&result] {
    const nb::gil_scoped_release release;
    return result.wait_for(std::chrono::milliseconds(50)) ==
           std::future_status::ready;
  };
  while (!is_done()) {
    if (PyErr_CheckSignals() == 0) continue;
    nb::python_error error;
    is_asked = true;
    // It may only be about to begin.
    do CancelBuilds();
    while (!is_done());
    throw error;
  }
  return result.get();
}

}  // namespace phongpd::python
