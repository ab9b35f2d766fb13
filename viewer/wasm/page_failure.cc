// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/wasm/page_failure.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>

// What the library throws all comes from std::exception.  There is no
// unwinding here: the page hears the reason and drops the module.
extern "C" void* __cxa_allocate_exception(std::size_t size) {
  return std::malloc(size);
}
extern "C" [[noreturn]] void __cxa_throw(void* thrown, void*, void*) {
  FailPage(static_cast<std::exception*>(thrown)->what());
  __builtin_trap();
}

// Debian's compiler run-time for WebAssembly was built to look at these.
extern "C" std::uintptr_t __stack_chk_guard;
std::uintptr_t __stack_chk_guard = 0x5bd1e995;
extern "C" [[noreturn]] void __stack_chk_fail() { __builtin_trap(); }

// `bytes` of memory for the page to write to.
PAGE_EXPORT(allocate) void* Allocate(int bytes) { return std::malloc(bytes); }
