// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/length.h"

#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

double Checked(double value, const char* kind) {
  if (value >= 0.0 && std::isfinite(value)) return value;
  throw InputError(std::string("length: expected a finite ") + kind +
                   " >= 0, found " + FormatDouble(value));
}

[[noreturn]] void Refuse(const std::string& what, const std::string& expected,
                         const std::string& found) {
  throw InputError(what + ": expected " + expected + ", found " + found);
}

// What may stand in a message, on one line.
std::string Excerpt(const std::string& text) {
  constexpr std::size_t kLongest = 40;
  std::string quoted = "'" + text.substr(0, kLongest);
  for (char& c : quoted) {
    if (c < ' ' || c == '\x7f') c = '?';
  }
  return quoted + (text.size() > kLongest ? "...'" : "'");
}

// Takes `suffix` and the blanks before it off, if it is there.
bool Strip(const std::string& suffix, std::string* text) {
  if (text->size() < suffix.size() ||
      text->compare(text->size() - suffix.size(), suffix.size(), suffix) != 0) {
    return false;
  }
  text->resize(text->size() - suffix.size());
  while (!text->empty() && text->back() == ' ') text->pop_back();
  return true;
}

}  // namespace

const char* const kLengthSyntax =
    "a length >= 0 as 0.01 or 0.01D (a share of the world's diagonal D) or "
    "0.5unit (the user's unit)";

Length Length::FromShare(double share) {
  return Length(Checked(share, "share of D"), true);
}

Length Length::FromUnit(double length) {
  return Length(Checked(length, "length"), false);
}

ResolvedLength Length::Resolve(double diagonal) const {
  if (!(diagonal > 0.0 && std::isfinite(diagonal))) {
    throw InputError("length " + Text() +
                     ": expected a world of finite diagonal D > 0, found " +
                     FormatDouble(diagonal));
  }
  return is_share_ ? ResolvedLength{value_ * diagonal, value_}
                   : ResolvedLength{value_, value_ / diagonal};
}

std::string Length::Text() const {
  return FormatDouble(value_) + (is_share_ ? "" : "unit");
}

Length ParseLength(const std::string& text, const std::string& what) {
  std::string number = text;
  const bool is_unit = Strip("unit", &number);
  if (!is_unit) Strip("D", &number);
  double value = -1.0;
  try {
    value = ParseDouble(number, what);
  } catch (const InputError&) {
    // Below: what a length is, not what a number is.
  }
  // −0 is a zero with a sign that nobody means.
  if (!(value >= 0.0)) Refuse(what, kLengthSyntax, Excerpt(text));
  value = std::abs(value);
  return is_unit ? Length::FromUnit(value) : Length::FromShare(value);
}

void RequireLength(const Length& length, LengthRange range, double diagonal,
                   const std::string& what) {
  if (range == LengthRange::kAboveZero && length.value() == 0.0) {
    Refuse(what, "a length > 0", length.Text());
  }
  if (length.is_share() && length.value() > 1.0) {
    Refuse(what, "at most 1 (the world's diagonal D)", length.Text());
  }
  if (!length.is_share() && diagonal > 0.0 && length.value() > diagonal) {
    Refuse(
        what,
        "at most " + FormatDouble(diagonal) + "unit (the world's diagonal D)",
        length.Text());
  }
}

}  // namespace phongpd
