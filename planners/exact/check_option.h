// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>

#include "core/mesh/mesh_error.h"

namespace phongpd {

// Throws InputError "<whose>: <name>: expected <range>, found <value>" unless
// it holds.
template <typename T>
void CheckOption(bool holds, const std::string& whose, const char* name,
                 const char* range, T value) {
  if (holds) return;
  std::ostringstream message;
  message << whose << ": " << name << ": expected " << range << ", found "
          << value;
  throw InputError(message.str());
}

}  // namespace phongpd
