// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>

#include <array>
#include <exception>
#include <thread>

// Stands before the header of TBB's own name in the build for the thread
// sanitizer.  TBB's library is not instrumented: the sanitizer would neither
// see that a loop's end waits for its bodies nor, on a quiet machine, two
// bodies at once.  Here every loop runs in four plain threads, so that the
// sanitizer judges the bodies, which are ours, and nothing needs suppressing.
namespace tbb {

// Runs f(0), ..., f(3), each in a thread of its own; rethrows what one threw.
template <class Function>
void InFourThreads(const Function& f) {
  std::array<std::exception_ptr, 4> thrown;
  std::array<std::thread, 4> threads;
  for (std::size_t k = 0; k < threads.size(); ++k) {
    threads[k] = std::thread([&thrown, &f, k] {
      try {
        f(k);
      } catch (...) {
        thrown[k] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
  InFourThreads([&](std::size_t k) {
    for (Index i = first; i < last; ++i) {
      if (static_cast<std::size_t>(i - first) % 4 == k) body(i);
    }
  });
}

// Quarter k of the range, which may be empty.
template <class Value>
blocked_range<Value> Quarter(const blocked_range<Value>& all, std::size_t k) {
  const std::size_t size = all.empty() ? 0 : all.size();
  const auto at = [&](std::size_t part) {
    return static_cast<Value>(all.begin() +
                              static_cast<Value>(size * part / 4));
  };
  return blocked_range<Value>(at(k), at(k + 1));
}

template <class Value, class Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
  InFourThreads([&](std::size_t k) {
    const blocked_range<Value> part = Quarter(range, k);
    if (!part.empty()) body(part);
  });
}

}  // namespace tbb
