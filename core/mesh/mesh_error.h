// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace phongpd {

// Input that cannot be used.  what() is one line for a person: the file or
// operand, what was expected, what was found with a count, and how to mend
// it.  Command-line programs print it and exit with code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace phongpd
