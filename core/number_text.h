// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh_error.h"

// Numbers and points as text, the same in every file and message.
namespace phongpd {

// A stream to a string that throws std::bad_alloc; the standard one drops what
// finds no memory and goes on.
class TextStream : public std::ostringstream {
 public:
  TextStream() { exceptions(std::ios::badbit); }
};

// The shortest decimal text that reads back to exactly `value`.
std::string FormatDouble(double value);

// `value` with the given number of significant digits, for people.
std::string Rounded(double value, int digits = 3);

// Three numbers separated by commas.
std::string FormatPoint(const Eigen::Vector3d& point);

// The finite number that `text` spells in full, correctly rounded.  Throws
// InputError "<what>: expected a finite number, found '<text>'".
double ParseDouble(std::string_view text, const std::string& what);

// "a, b, c", or with another text between them.
std::string Joined(const std::vector<std::string>& cells,
                   const char* between = ", ");

}  // namespace phongpd
