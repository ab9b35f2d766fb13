// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// A length, written in both ways.
struct ResolvedLength {
  double unit = 0.0;   // the user's unit, that of coordinates
  double share = 0.0;  // of D
};

// A length ≥ 0 as somebody asks for it: in the user's unit, or as a share of D,
// the one length of a world (World::diagonal).  A plain value: Resolve tells
// how long it is once D is known.
class Length {
 public:
  Length() = default;  // 0
  // Throw InputError unless the number is finite and ≥ 0.
  static Length FromShare(double share);
  static Length FromUnit(double length);

  bool is_share() const { return is_share_; }
  double value() const { return value_; }  // as it was given

  // The number that was given stays the same, to the bit; the other is rounded.
  // Throws InputError unless `diagonal` (D) is finite and > 0.
  ResolvedLength Resolve(double diagonal) const;

  // "0.2" (a share) or "0.5unit"; where the unit has a name "0.2D" or "0.5mm".
  // ParseLength, given the same name, reads back the same length.
  std::string Text(const std::string& unit = "") const;

  friend bool operator==(const Length& a, const Length& b) {
    return a.is_share_ == b.is_share_ && a.value_ == b.value_;
  }
  friend bool operator!=(const Length& a, const Length& b) { return !(a == b); }

 private:
  Length(double value, bool is_share) : value_(value), is_share_(is_share) {}

  double value_ = 0.0;
  bool is_share_ = true;
};

// What a user's unit may be called: "mm", "m", ...  A name says what numbers
// are; nothing is converted.
const std::vector<std::string>& UnitNames();

// Of one of them, in metres; 1 for any other text.
double MetresOf(const std::string& unit);

// The one that `text` ends with, "mm" of "20mm"; empty: none.
std::string UnitNamedIn(const std::string& text);

// Reads a length: "0.01D", a share of D, or "0.5unit", in the user's unit;
// blanks may stand before D and unit.  A bare number is a share of D.  Where
// the user's unit has a name, `unit`, "0.5mm" is read too, and a bare number is
// in it.  Throws InputError "WHAT: expected ..., found 'TEXT'" for anything
// else, negative numbers and other units among them.
Length ParseLength(const std::string& text, const std::string& what,
                   const std::string& unit = "");

// The default margin that paths keep, where there is room: 0.01 D.
inline Length DefaultMargin() { return Length::FromShare(0.01); }

// Which lengths an option takes; none takes more than D.
enum class LengthRange { kFromZero, kAboveZero };

// Throws InputError "WHAT: expected ..., found LENGTH" for lengths out of
// range, told in `unit` if it has that name.  Without D (0) lengths in the
// user's unit pass that may be too long.
void RequireLength(const Length& length, LengthRange range, double diagonal,
                   const std::string& what, const std::string& unit = "");

}  // namespace phongpd
