// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace phongpd {

// `text` as one line that any terminal, log or JSON takes.  Line ends become
// blanks; other control characters, and bytes that are no UTF-8, become
// question marks; both are dropped at the two ends.  Of more than 1,600 bytes
// the middle is left out.
std::string OneLine(const std::string& text);

// Input that cannot be used.  what() is one line for a person: the file or
// operand, what was expected, what was found, with a count, and how to mend it.
// It goes through OneLine, since it quotes names and words of files.  The
// command line prints it and exits with code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what)
      : std::runtime_error(OneLine(what)) {}
};

}  // namespace phongpd
