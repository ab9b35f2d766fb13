// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever names and words of files are made of, a refusal is one short line of
// UTF-8 without control characters.
#include "core/mesh/mesh_error.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <string>

namespace phongpd {
namespace {

// As JSON in ASCII it shows each of its characters, and strictly: what is no
// UTF-8 is an exception.
void ExpectPlain(const std::string& line) {
  std::string ascii;
  ASSERT_NO_THROW(ascii = nlohmann::json(line).dump(-1, ' ', true));
  EXPECT_FALSE(std::regex_search(
      ascii, std::regex(R"(\\(u00[01]|u007f|u00[89]|[bfnrt]))")))
      << ascii;
  EXPECT_LE(line.size(), 1605U);
}

TEST(InputError, KeepsWhatCanBeRead) {
  const std::string text = "größe Ψ 文 😀.off: expected 3, found \"a\"";
  EXPECT_STREQ(InputError(text).what(), text.c_str());
  EXPECT_STREQ(InputError(std::string(1600, 'x')).what(),
               std::string(1600, 'x').c_str());
}

TEST(InputError, IsOneLineWithoutControlCharacters) {
  EXPECT_STREQ(InputError("\na\r\n\n b\n").what(), "a  b");
  EXPECT_STREQ(InputError("\x1b[31mred\x7f\t").what(), "?[31mred??");
  EXPECT_STREQ(InputError(std::string("a\0b", 3)).what(), "a?b");
  EXPECT_STREQ(InputError("a\xc2\x9b"
                          "31m")
                   .what(),
               "a?31m");  // C1's CSI
}

TEST(InputError, ReplacesWhatIsNoUtf8) {
  EXPECT_STREQ(InputError("bad\xff.off").what(), "bad?.off");
  EXPECT_STREQ(InputError("cut\xe6\x96").what(), "cut??");
  EXPECT_STREQ(InputError("\xc0\xaf").what(), "??");            // '/' too long
  EXPECT_STREQ(InputError("\xed\xa0\x80").what(), "???");       // half a pair
  EXPECT_STREQ(InputError("\xf4\x90\x80\x80").what(), "????");  // > U+10FFFF
}

TEST(InputError, KeepsBothEndsOfALongText) {
  std::string names;
  for (int i = 0; i < 3000; ++i) names += "文";
  const std::string line =
      InputError("robot.urdf: " + names + "; name one of them").what();
  ExpectPlain(line);
  EXPECT_EQ(line.rfind("robot.urdf: ", 0), 0U);
  EXPECT_NE(line.find(" ... "), std::string::npos);
  EXPECT_NE(line.find("; name one of them"), std::string::npos);
}

TEST(InputError, IsPlainForRandomBytes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> byte(0, 255), kind(0, 5), size(0, 40);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int k = size(random); k > 0; --k) {
      const char* const kPieces[] = {"文", "😀", "\n", "a"};
      const int piece = kind(random);
      if (piece < 4) {
        text += kPieces[piece];
      } else {
        text += static_cast<char>(byte(random));
        if (text.back() == '\\') text.back() = '/';  // ExpectPlain's own sign
      }
    }
    ExpectPlain(InputError(text).what());
  }
}

}  // namespace
}  // namespace phongpd
