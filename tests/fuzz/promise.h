// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/mesh/mesh_error.h"

namespace phongpd::fuzz {

// Stops the program, which fuzzers and tests notice, unless `holds`.
inline void Promise(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

// Every refusal is one line that starts with the file's name and can be read.
inline void PromiseReadable(const InputError& error, const std::string& file) {
  const std::string what = error.what();
  Promise(what.rfind(file, 0) == 0, "a refusal names the file first");
  Promise(what.find('\n') == std::string::npos, "a refusal is one line");
  Promise(what.size() < 2000, "a refusal is short");
}

}  // namespace phongpd::fuzz
