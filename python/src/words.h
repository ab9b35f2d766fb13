// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"

namespace phongpd::python {

// Texts as Python takes them: what is said of a file may hold words of it, with
// bytes that are no UTF-8.
inline std::vector<std::string> Lines(std::vector<std::string> texts) {
  for (std::string& text : texts) text = OneLine(text);
  return texts;
}

}  // namespace phongpd::python
