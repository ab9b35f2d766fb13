// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_error.h"

#include <cstddef>

namespace phongpd {
namespace {

constexpr std::size_t kLongest = 1600;
constexpr std::size_t kTail = 400;  // of a longer text: how to mend it

bool IsContinuation(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}

// Bytes of the character that begins there; 0: none that UTF-8 (RFC 3629) has.
std::size_t CharacterLength(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(at), second = byte(at + 1);
  std::size_t length = 0;
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) length = 2;
  if (first >= 0xe0 && first <= 0xef) length = 3;
  if (first >= 0xf0 && first <= 0xf4) length = 4;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0u) != 0x80u) return 0;
  }
  // Longer forms of shorter ones, halves of surrogate pairs, beyond U+10FFFF.
  const bool is_none =
      (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
      (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return is_none ? 0 : length;
}

bool IsControl(const std::string& text, std::size_t at, std::size_t length) {
  const auto byte = static_cast<unsigned char>(text[at]);
  if (length == 1) return byte < 0x20 || byte == 0x7f;
  // U+0080 ... U+009F, which some terminals obey.
  return byte == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0;
}

// Leaves out the middle, and no part of a character.
std::string Shortened(const std::string& text) {
  if (text.size() <= kLongest) return text;
  std::size_t head = kLongest - kTail, tail = text.size() - kTail;
  while (head > 0 && IsContinuation(text[head])) --head;
  while (tail < text.size() && IsContinuation(text[tail])) ++tail;
  return text.substr(0, head) + " ... " + text.substr(tail);
}

}  // namespace

std::string OneLine(const std::string& text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = CharacterLength(text, at);
    if (text[at] == '\n' || text[at] == '\r') {
      if (!line.empty() && line.back() != ' ') line += ' ';
    } else if (length == 0 || IsControl(text, at, length)) {
      line += '?';
    } else {
      line.append(text, at, length);
    }
    at += length == 0 ? 1 : length;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return Shortened(line);
}

}  // namespace phongpd
