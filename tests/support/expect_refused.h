// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/mesh/mesh_error.h"

namespace phongpd::testing {

// What the InputError says that `action` throws; `otherwise` if it throws none.
template <typename Action>
std::string ErrorOf(const Action& action, const std::string& otherwise = "") {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return otherwise;
}

// `action` has to throw an InputError of one line that says `part`.
template <typename Action>
void ExpectRefused(const Action& action, const std::string& part) {
  const std::string text = ErrorOf(action, "no error");
  EXPECT_NE(text.find(part), std::string::npos) << text << " / " << part;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

}  // namespace phongpd::testing
