// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace phongpd {

// `text` as one line that any terminal, log or JSON takes: ends of lines are
// blanks, other control characters and bytes that are no UTF-8 question marks,
// none of both at its ends.  Of more than 1,600 bytes the middle is left out.
std::string OneLine(const std::string& text);

// Input that cannot be used.  what() is one line for a person: the file or
// operand, what was expected, what was found with a count, and how to mend
// it; OneLine of what it is made of, since names and words of files are among
// it.  Command-line programs print it and exit with code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what)
      : std::runtime_error(OneLine(what)) {}
};

}  // namespace phongpd
