// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/support/sanitizer.h"

// Counts every allocation of the process.  It replaces operator new, so one
// source of a program includes it, a test of what a query costs.  The thread
// sanitizer has an operator new of its own: nothing is counted under it, and
// what such a test finds then is races.
namespace {
std::atomic<long> allocations{0};
}  // namespace

#if !PHONGPD_THREAD_SANITIZER
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
// Inlined, gcc would see memory of operator new go to free().
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif
