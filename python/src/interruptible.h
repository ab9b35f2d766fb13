// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <future>

#include "core/minkowski/build_cancellation.h"
#include "python/src/arrays.h"
#include "python/src/computing.h"

namespace phongpd::python {

// work() on another thread, so that Ctrl-C reaches Python meanwhile: it stops
// the build of a contact space in it, waits for all else, and comes up as
// KeyboardInterrupt.  Called with Python's lock; work() runs without it.
template <typename Work>
auto Interruptible(const Work& work) {
  const InProgress mark;
  auto result = std::async(std::launch::async, work);
  const auto is_done = [&result] {
    const nb::gil_scoped_release release;
    return result.wait_for(std::chrono::milliseconds(50)) ==
           std::future_status::ready;
  };
  while (!is_done()) {
    if (PyErr_CheckSignals() == 0) continue;
    nb::python_error error;
    // It may only be about to begin.
    do CancelBuilds();
    while (!is_done());
    throw error;
  }
  return result.get();
}

}  // namespace phongpd::python
