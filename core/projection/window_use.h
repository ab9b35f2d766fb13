// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace phongpd {

// What a metric from windows (window_metric.h) has modelled of C_cont so far.
struct WindowUse {
  std::size_t boxes = 0;       // of configuration space, arranged
  std::size_t faces = 0;       // in their arrangements
  std::size_t inside = 0;      // queries that penetrated
  std::size_t extensions = 0;  // of those, such that needed more than there was
  double seconds = 0.0;        // wall time of what they needed
};

}  // namespace phongpd
