// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <string>

// Files as an attacker or a bad disk would make them of valid ones.
namespace phongpd::testing {

inline std::size_t Below(std::size_t count, std::mt19937_64* random) {
  return static_cast<std::size_t>((*random)() % count);
}

template <typename T>
void Put(T value, std::size_t at, std::string* bytes) {
  std::memcpy(&(*bytes)[at], &value,
              std::min(sizeof value, bytes->size() - at));
}

// Values at which counts, indices and coordinates end.
inline void PutLimit(std::size_t at, std::mt19937_64* random,
                     std::string* bytes) {
  constexpr std::int64_t kWide[] = {0,
                                    1,
                                    -1,
                                    2,
                                    255,
                                    std::int64_t{1} << 31,
                                    std::int64_t{1} << 40,
                                    std::int64_t{1} << 62,
                                    std::numeric_limits<std::int64_t>::max(),
                                    std::numeric_limits<std::int64_t>::min()};
  constexpr int kNarrow[] = {0,
                             1,
                             -1,
                             2,
                             3,
                             7,
                             1 << 20,
                             std::numeric_limits<int>::max(),
                             std::numeric_limits<int>::min()};
  constexpr double kReal[] = {0.0,
                              -1.0,
                              0.5,
                              1e-300,
                              1e300,
                              std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()};
  switch (Below(3, random)) {
    case 0:
      return Put(kWide[Below(std::size(kWide), random)], at, bytes);
    case 1:
      return Put(kNarrow[Below(std::size(kNarrow), random)], at, bytes);
    default:
      return Put(kReal[Below(std::size(kReal), random)], at, bytes);
  }
}

// A few changes: bits, fields, neighbours of numbers, parts doubled, moved onto
// others, or gone.
inline std::string Mutated(std::string bytes, std::mt19937_64* random) {
  for (std::size_t n = 1 + Below(3, random); n > 0 && bytes.size() > 16; --n) {
    const std::size_t at = Below(bytes.size(), random);
    const std::size_t from = Below(bytes.size(), random);
    const std::size_t size = std::min(
        {Below(64, random) + 1, bytes.size() - from, bytes.size() - at});
    switch (Below(9, random)) {
      case 0:
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << Below(8, random)));
        break;
      case 2:
      case 3:
        PutLimit(at, random, &bytes);
        break;
      case 4:
      case 5:
        bytes[at] = static_cast<char>(bytes[at] + (Below(2, random) ? 1 : -1));
        break;
      case 6:
        std::memmove(&bytes[at], &bytes[from], size);
        break;
      case 7:
        bytes.insert(at, bytes.substr(from, size));
        break;
      default:
        Below(4, random) == 0 ? bytes.resize(at) : void(bytes.erase(at, size));
    }
  }
  return bytes;
}

}  // namespace phongpd::testing
