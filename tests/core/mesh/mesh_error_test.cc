// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever names and words of files are made of, a refusal is one short line of
// UTF-8 without control characters.
#include "core/mesh/mesh_error.h"

#include <gtest/gtest.h>
#include <iconv.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace phongpd {
namespace {

// By the system's own decoder of UTF-8.
void ExpectPlain(const std::string& line) {
  const iconv_t decoder = iconv_open("WCHAR_T", "UTF-8");
  ASSERT_NE(decoder, reinterpret_cast<iconv_t>(-1));
  std::vector<wchar_t> characters(line.size());
  std::string bytes = line;
  char* in = bytes.data();
  char* out = reinterpret_cast<char*>(characters.data());
  std::size_t left = bytes.size(), room = line.size() * sizeof(wchar_t);
  const std::size_t wrong = iconv(decoder, &in, &left, &out, &room);
  iconv_close(decoder);
  ASSERT_EQ(wrong, 0U) << "no UTF-8 from byte " << line.size() - left;
  characters.resize(line.size() - room / sizeof(wchar_t));
  for (const wchar_t c : characters) {
    const auto code = static_cast<std::uint32_t>(c);
    EXPECT_GE(code, 0x20U);
    EXPECT_TRUE(code < 0x7fU || code > 0x9fU) << code;
    EXPECT_TRUE(code < 0xd800U || code > 0xdfffU) << code;
    EXPECT_LE(code, 0x10ffffU);
  }
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
      }
    }
    ExpectPlain(InputError(text).what());
  }
}

}  // namespace
}  // namespace phongpd
