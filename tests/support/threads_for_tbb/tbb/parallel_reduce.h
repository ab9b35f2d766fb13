// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>

// See parallel_for.h beside this file.
namespace tbb {

template <class Value, class Result, class Body, class Join>
Result parallel_reduce(const blocked_range<Value>& range, const Result& zero,
                       const Body& body, const Join& join) {
  std::array<Result, 4> parts{zero, zero, zero, zero};
  InFourThreads([&](std::size_t k) {
    const blocked_range<Value> part = Quarter(range, k);
    if (!part.empty()) parts[k] = body(part, zero);
  });
  Result sum = zero;
  for (const Result& part : parts) sum = join(sum, part);
  return sum;
}

}  // namespace tbb
