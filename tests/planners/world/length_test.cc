// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

template <typename Call>
std::string ErrorOf(const Call& call) {
  return testing::ErrorOf([&] { call(); }, "no error");
}

TEST(Length, ResolvesInBothWays) {
  const ResolvedLength share = Length::FromShare(0.25).Resolve(8.0);
  EXPECT_EQ(share.share, 0.25);
  EXPECT_EQ(share.unit, 2.0);
  const ResolvedLength unit = Length::FromUnit(2.0).Resolve(8.0);
  EXPECT_EQ(unit.share, 0.25);
  EXPECT_EQ(unit.unit, 2.0);
  EXPECT_NE(Length::FromShare(2.0), Length::FromUnit(2.0));
}

// What was given must not pass through a product and a quotient.
TEST(Length, KeepsWhatWasGivenToTheBit) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::pow(10.0, exponent(random));
    const double diagonal = std::pow(10.0, exponent(random));
    EXPECT_EQ(Length::FromShare(value).Resolve(diagonal).share, value);
    EXPECT_EQ(Length::FromUnit(value).Resolve(diagonal).unit, value);
    for (const Length& length :
         {Length::FromShare(value), Length::FromUnit(value)}) {
      EXPECT_EQ(ParseLength(length.Text(), "x"), length);
    }
  }
}

TEST(Length, IsReadAsNumberShareOrUnit) {
  const std::vector<std::pair<std::string, Length>> cases = {
      {"0.01", Length::FromShare(0.01)},   {"0.01D", Length::FromShare(0.01)},
      {"0.01 D", Length::FromShare(0.01)}, {"0.5unit", Length::FromUnit(0.5)},
      {"0.5 unit", Length::FromUnit(0.5)}, {"1e-3unit", Length::FromUnit(1e-3)},
      {"+2unit", Length::FromUnit(2.0)},   {"0", Length()},
      {"-0unit", Length::FromUnit(0.0)},   {"1", Length::FromShare(1.0)}};
  for (const auto& [text, length] : cases) {
    EXPECT_EQ(ParseLength(text, "x"), length) << text;
  }
}

TEST(Length, RefusesOtherTextInOneLine) {
  const std::string expected =
      "--margin: expected a length >= 0 as 0.01 or 0.01D (a share of the "
      "world's diagonal D) or 0.5unit (the user's unit), found ";
  for (const std::string text :
       {"",         "D",    "unit",      "-1",      "-0.5unit",
        "-1D",      "nan",  "inf",       "infunit", "0.5units",
        "0.5 M",    "0.5d", "5%",        "5 %D",    "0.5D unit",
        "unit 0.5", "0,5",  "1e999unit", " 1",      "1 "}) {
    EXPECT_EQ(ErrorOf([&] { ParseLength(text, "--margin"); }),
              expected + "'" + text + "'");
  }
  EXPECT_EQ(ErrorOf([&] { ParseLength("1\n2", "--margin"); }),
            expected + "'1?2'");
  EXPECT_EQ(ErrorOf([&] { ParseLength(std::string(99, 'x'), "--margin"); }),
            expected + "'" + std::string(40, 'x') + "...'");
}

TEST(Length, IsReadInAUnitThatHasAName) {
  for (const std::string& unit : UnitNames()) {
    for (const auto& text : {"20" + unit, "20 " + unit, std::string("20unit"),
                             std::string("20"), std::string("2e1")}) {
      EXPECT_EQ(ParseLength(text, "x", unit), Length::FromUnit(20.0)) << text;
    }
    EXPECT_EQ(ParseLength("20D", "x", unit), Length::FromShare(20.0));
    EXPECT_EQ(ParseLength("0.3 D", "x", unit), Length::FromShare(0.3));
    EXPECT_EQ(UnitNamedIn("20" + unit), unit);
    for (const Length& length :
         {Length::FromShare(0.3), Length::FromUnit(0.3)}) {
      EXPECT_EQ(ParseLength(length.Text(unit), "x", unit), length);
    }
    for (const std::string text :
         {"", "-1", "-1mm", "mm", "20 mm ", "mm20", "20mmm", "20unitmm",
          "20mmD", "nan", "inf"}) {
      EXPECT_THROW(ParseLength(text, "x", unit), InputError) << text;
    }
  }
  for (const std::string text : {"20", "20mmm", "20Mm", "20unit", "mm2", ""}) {
    EXPECT_EQ(UnitNamedIn(text), "") << text;
  }
}

// Nothing is converted: another unit's name is no length.
TEST(Length, IsRefusedInAnotherUnit) {
  for (const std::string& unit : UnitNames()) {
    for (const std::string& other : UnitNames()) {
      if (other == unit) continue;
      EXPECT_EQ(ErrorOf([&] { ParseLength("20" + other, "--margin", unit); }),
                "--margin: expected a length >= 0 as 20 or 20" + unit +
                    " (the scene's unit) or 0.01D (a share of the world's "
                    "diagonal D), found '20" +
                    other + "': the scene's unit is " + unit +
                    ", and nothing is converted");
    }
    EXPECT_EQ(
        ErrorOf([&] { ParseLength("20" + unit, "--margin"); }),
        "--margin: expected a length >= 0 as 0.01 or 0.01D (a share of "
        "the world's diagonal D) or 0.5unit (the user's unit), found '20" +
            unit +
            "': the user's unit has no name; write 20unit, or name it (in a "
            "scene \"unit\": \"" +
            unit + "\", of Python's World unit=\"" + unit + "\")");
  }
}

TEST(Length, RefusesNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double value : {-1.0, nan, inf, -inf}) {
    EXPECT_THROW(Length::FromShare(value), InputError) << value;
    EXPECT_THROW(Length::FromUnit(value), InputError) << value;
  }
  for (const double diagonal : {0.0, -1.0, nan, inf}) {
    EXPECT_THROW(Length::FromUnit(1.0).Resolve(diagonal), InputError);
  }
}

TEST(Length, IsCheckedAgainstItsRange) {
  const auto error = [](const Length& length, LengthRange range,
                        double diagonal) {
    return ErrorOf([&] { RequireLength(length, range, diagonal, "m"); });
  };
  constexpr auto kFromZero = LengthRange::kFromZero;
  constexpr auto kAboveZero = LengthRange::kAboveZero;
  EXPECT_EQ(error(Length(), kFromZero, 4.0), "no error");
  EXPECT_EQ(error(Length(), kAboveZero, 4.0),
            "m: expected a length > 0, found 0");
  EXPECT_EQ(error(Length::FromUnit(0.0), kAboveZero, 4.0),
            "m: expected a length > 0, found 0unit");
  EXPECT_EQ(error(Length::FromShare(1.0), kAboveZero, 4.0), "no error");
  EXPECT_EQ(error(Length::FromShare(2.0), kAboveZero, 0.0),
            "m: expected at most 1 (the world's diagonal D), found 2");
  EXPECT_EQ(error(Length::FromUnit(4.0), kAboveZero, 4.0), "no error");
  EXPECT_EQ(error(Length::FromUnit(5.0), kAboveZero, 4.0),
            "m: expected at most 4unit (the world's diagonal D), found 5unit");
  EXPECT_EQ(error(Length::FromUnit(5.0), kAboveZero, 0.0), "no error");
  const auto in_mm = [](const Length& length) {
    return ErrorOf([&] {
      RequireLength(length, LengthRange::kAboveZero, 4.0, "m", "mm");
    });
  };
  EXPECT_EQ(in_mm(Length::FromUnit(4.0)), "no error");
  EXPECT_EQ(in_mm(Length::FromUnit(5.0)),
            "m: expected at most 4mm (the world's diagonal D), found 5mm");
  EXPECT_EQ(in_mm(Length::FromShare(2.0)),
            "m: expected at most 1D (the world's diagonal D), found 2D");
  EXPECT_EQ(in_mm(Length::FromUnit(0.0)),
            "m: expected a length > 0, found 0mm");
}

// By other units: a kilometre is 10³ m, a foot 12 inches, an inch 25.4 mm.
TEST(Length, UnitsAreSoManyMetres) {
  for (const std::string& name : UnitNames()) {
    EXPECT_EQ(MetresOf(name) == 1.0, name == "m") << name;
  }
  EXPECT_DOUBLE_EQ(MetresOf("km"), 1e3);
  EXPECT_DOUBLE_EQ(MetresOf("dm") * 10.0, 1.0);
  EXPECT_DOUBLE_EQ(MetresOf("cm") * 100.0, 1.0);
  EXPECT_DOUBLE_EQ(MetresOf("mm") * 1e3, 1.0);
  EXPECT_DOUBLE_EQ(MetresOf("um") * 1e6, 1.0);
  EXPECT_DOUBLE_EQ(MetresOf("nm") * 1e9, 1.0);
  EXPECT_DOUBLE_EQ(MetresOf("in"), 25.4 * MetresOf("mm"));
  EXPECT_DOUBLE_EQ(MetresOf("ft"), 12.0 * MetresOf("in"));
  EXPECT_EQ(MetresOf("parsec"), 1.0);
}

}  // namespace
}  // namespace phongpd
