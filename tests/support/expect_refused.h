// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/mesh/mesh_error.h"

namespace phongpd::testing {

// `action` has to throw an InputError of one line that says `part`.
template <typename Action>
void ExpectRefused(const Action& action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no error that says: " << part;
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

}  // namespace phongpd::testing
