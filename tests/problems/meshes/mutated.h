// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace phongpd::testing {

// Some bytes changed, left out, doubled, or replaced by what numbers and tags
// begin with.
inline std::string Mutated(std::string bytes, std::mt19937_64* random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(*random);
  };
  static const std::vector<std::string> words = {
      "-1", "4294967295", "1e308", "nan",  "<",    "/>",
      "\"", "{}",         "[]",    "null", "</a>", std::string(4, '\0'),
      "&",  "../"};
  for (std::size_t left = 1 + below(4); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.erase(at, 1 + below(8));
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, 1 + below(40)));
        break;
      case 3:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      default:
        bytes.replace(at, 1 + below(4), words[below(words.size())]);
    }
  }
  return bytes;
}

}  // namespace phongpd::testing
