// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/content_hash.h"

#include <cstddef>

namespace phongpd::internal {
namespace {

constexpr std::uint64_t kC1 = 0x87c37b91114253d5u;
constexpr std::uint64_t kC2 = 0x4cf5ad432745937fu;

std::uint64_t Rotate(std::uint64_t x, int bits) {
  return (x << bits) | (x >> (64 - bits));
}

std::uint64_t Mix1(std::uint64_t k) { return Rotate(k * kC1, 31) * kC2; }
std::uint64_t Mix2(std::uint64_t k) { return Rotate(k * kC2, 33) * kC1; }

std::uint64_t Finish(std::uint64_t k) {
  k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdu;
  k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53u;
  return k ^ (k >> 33);
}

// Up to eight bytes, little-endian on every machine.
std::uint64_t Word(std::string_view bytes) {
  std::uint64_t word = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    word = (word << 8) | static_cast<unsigned char>(bytes[i]);
  }
  return word;
}

}  // namespace

ContentHash HashContent(std::string_view bytes) {
  const auto length = static_cast<std::uint64_t>(bytes.size());
  std::uint64_t h1 = 0, h2 = 0;
  while (bytes.size() >= 16) {
    h1 = (Rotate(h1 ^ Mix1(Word(bytes.substr(0, 8))), 27) + h2) * 5 +
         0x52dce729u;
    h2 = (Rotate(h2 ^ Mix2(Word(bytes.substr(8, 8))), 31) + h1) * 5 +
         0x38495ab5u;
    bytes.remove_prefix(16);
  }
  if (bytes.size() > 8) h2 ^= Mix2(Word(bytes.substr(8)));
  h1 ^= Mix1(Word(bytes.substr(0, 8)));
  h1 ^= length;
  h2 ^= length;
  h1 += h2;
  h2 += h1;
  h1 = Finish(h1);
  h2 = Finish(h2);
  h1 += h2;
  h2 += h1;
  return {h1, h2};
}

std::string ToHex(const ContentHash& hash) {
  std::string text;
  for (const std::uint64_t word : hash) {
    for (int shift = 60; shift >= 0; shift -= 4) {
      text += "0123456789abcdef"[(word >> shift) & 15];
    }
  }
  return text;
}

}  // namespace phongpd::internal
