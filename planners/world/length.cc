// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/length.h"

#include <algorithm>
#include <cmath>
#include <map>

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

std::string LengthSyntax(const std::string& unit) {
  if (unit.empty()) {
    return "a length >= 0 as 0.01 or 0.01D (a share of the world's diagonal D) "
           "or 0.5unit (the user's unit)";
  }
  return "a length >= 0 as 20 or 20" + unit +
         " (the scene's unit) or 0.01D (a share of the world's diagonal D)";
}

// Why `text` is no length where it is one in a unit that is not the user's.
std::string OtherUnitNote(const std::string& text, const std::string& unit) {
  const std::string named = UnitNamedIn(text);
  if (named.empty() || named == unit) return "";
  if (!unit.empty()) {
    return ": the scene's unit is " + unit + ", and nothing is converted";
  }
  std::string number = text;
  Strip(named, &number);
  return ": the user's unit has no name; write " + number +
         "unit, or name it (in a scene \"unit\": \"" + named +
         "\", of Python's World unit=\"" + named + "\")";
}

}  // namespace

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

std::string Length::Text(const std::string& unit) const {
  const std::string name = unit.empty() ? "unit" : unit;
  const std::string share = unit.empty() ? "" : "D";
  return FormatDouble(value_) + (is_share_ ? share : name);
}

const std::vector<std::string>& UnitNames() {
  static const std::vector<std::string> names = {"nm", "um", "mm", "cm", "dm",
                                                 "m",  "km", "in", "ft"};
  return names;
}

double MetresOf(const std::string& unit) {
  static const std::map<std::string, double> metres = {
      {"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3},   {"cm", 1e-2},  {"dm", 1e-1},
      {"m", 1.0},   {"km", 1e3},  {"in", 0.0254}, {"ft", 0.3048}};
  const auto found = metres.find(unit);
  return found == metres.end() ? 1.0 : found->second;
}

std::string UnitNamedIn(const std::string& text) {
  // All letters at the end: "mm" ends with "m", but does not name it.
  const auto is_letter = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
  };
  const auto begin = std::find_if_not(text.rbegin(), text.rend(), is_letter);
  const std::string word(begin.base(), text.end());
  const std::vector<std::string>& names = UnitNames();
  const bool is_unit =
      std::find(names.begin(), names.end(), word) != names.end();
  return is_unit ? word : "";
}

Length ParseLength(const std::string& text, const std::string& what,
                   const std::string& unit) {
  std::string number = text;
  const bool is_named = !unit.empty() && UnitNamedIn(text) == unit;
  const bool is_unit = Strip(is_named ? unit : "unit", &number);
  const bool is_share = !is_unit && (Strip("D", &number) || unit.empty());
  double value = -1.0;
  try {
    value = ParseDouble(number, what);
  } catch (const InputError&) {
    // Below: what a length is, not what a number is.
  }
  // −0 is a zero with a sign that nobody means.
  if (!(value >= 0.0)) {
    Refuse(what, LengthSyntax(unit), Excerpt(text) + OtherUnitNote(text, unit));
  }
  value = std::abs(value);
  return is_share ? Length::FromShare(value) : Length::FromUnit(value);
}

void RequireLength(const Length& length, LengthRange range, double diagonal,
                   const std::string& what, const std::string& unit) {
  if (range == LengthRange::kAboveZero && length.value() == 0.0) {
    Refuse(what, "a length > 0", length.Text(unit));
  }
  const double most = length.is_share() ? 1.0 : diagonal;
  if (!(most > 0.0) || length.value() <= most) return;
  const Length limit =
      length.is_share() ? Length::FromShare(most) : Length::FromUnit(most);
  Refuse(what, "at most " + limit.Text(unit) + " (the world's diagonal D)",
         length.Text(unit));
}

}  // namespace phongpd
