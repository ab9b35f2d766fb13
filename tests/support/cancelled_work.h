// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "core/minkowski/build_stop.h"

namespace phongpd::testing {

// What the BuildCancelled says that `work` throws while CancelBuilds is called
// again and again; "" if it ends without.  For work of minutes.
template <typename Work>
std::string WhatCancels(const Work& work) {
  std::atomic<bool> is_done{false};
  std::string what;
  std::thread worker([&] {
    try {
      work();
    } catch (const BuildCancelled& error) {
      what = error.what();
    }
    is_done = true;
  });
  // Until it is there to be stopped.
  while (!is_done) {
    CancelBuilds();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  worker.join();
  return what;
}

}  // namespace phongpd::testing
