// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

// See parallel_for.h beside this file; sorting is left to one thread.
namespace tbb {

template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
  std::sort(first, last, less);
}

}  // namespace tbb
