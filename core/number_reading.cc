// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {

double ParseDouble(std::string_view text, const std::string& what) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') {
    digits.remove_prefix(1);
  }
  double value = 0.0;
  const char* const end = digits.data() + digits.size();
  const std::from_chars_result read =
      std::from_chars(digits.data(), end, value);
  bool good = read.ptr == end && !digits.empty();
  if (good && read.ec == std::errc::result_out_of_range) {
    // from_chars does not say whether it is too large or too small.
    value = std::strtod(std::string(digits).c_str(), nullptr);
  } else if (read.ec != std::errc()) {
    good = false;
  }
  if (!good || !std::isfinite(value)) {
    constexpr std::size_t kLongest = 40;
    std::string found(text.substr(0, kLongest));
    for (char& c : found) {
      if (c < ' ' || c == '\x7f') c = '?';
    }
    throw InputError(what + ": expected a finite number, found '" + found +
                     (text.size() > kLongest ? "...'" : "'"));
  }
  return value;
}

}  // namespace phongpd
