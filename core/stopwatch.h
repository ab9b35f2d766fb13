// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace phongpd {

// Wall time since it was made.
class Stopwatch {
 public:
  double Seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace phongpd
