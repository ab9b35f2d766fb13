// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace phongpd::internal {

// probe.cc and solver.cc as WebAssembly; empty if there was no compiler for it
// when this was built.  Compiled in by embed_modules.cmake.
std::string_view ProbeModule();
std::string_view SolverModule();

}  // namespace phongpd::internal
