// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace phongpd::internal {

// MurmurHash3_x64_128 of Austin Appleby (public domain), seed 0: 128 bits that
// behave like random ones on data nobody chose to break it.  Among n different
// contents some two agree with probability about n² / 2^129: 1e-27 for a
// million.  No defence against forged contents.
using ContentHash = std::array<std::uint64_t, 2>;
ContentHash HashContent(std::string_view bytes);

// 32 hexadecimal digits.
std::string ToHex(const ContentHash& hash);

}  // namespace phongpd::internal
