// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

// What the readers of all mesh formats share: bytes in memory, taken from the
// front, and refusals that name file and place.
namespace phongpd::internal {

// Takes the next word, between blanks (space, tab, CR, LF, VT, FF); empty at
// the end.
std::string_view TakeWord(std::string_view* text);

// Takes a line and its end; the line has no LF, and no CR before it.
std::string_view TakeLine(std::string_view* text);

// The integer that the whole of `word` spells, with or without a sign; false
// if it is none of 64 bits.
bool ParseInteger(std::string_view word, long long* value);

// `word` in quotes for a message: shortened, on one line.
std::string Quoted(std::string_view word);

// A signalling NaN becomes a quiet one: read as it is, it would be an invalid
// operation wherever it is converted or compared, even by std::isnan.  Looks at
// the bits (IEEE) for that reason.
template <typename Real>
void MakeQuiet(Real* x) {
  static_assert(std::numeric_limits<Real>::is_iec559);
  using Bits =
      std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  static_assert(sizeof(Bits) == sizeof(Real));
  constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
  Bits bits, infinity;
  std::memcpy(&bits, x, sizeof bits);
  std::memcpy(&infinity, &kInfinite, sizeof infinity);
  const bool is_nan = static_cast<Bits>(bits << 1) > infinity << 1;
  if (is_nan) *x = std::numeric_limits<Real>::quiet_NaN();
}

class MeshScanner {
 public:
  // `format` and `file` appear in messages; all arguments outlive the scanner.
  MeshScanner(std::string_view bytes, const char* format,
              const std::string& file)
      : bytes_(bytes), format_(format), file_(file) {}

  std::string_view& rest() { return bytes_; }
  bool AtEnd() const { return bytes_.empty(); }

  [[noreturn]] void Refuse(const std::string& what) const;
  // Other content than the format's, or less of it.
  [[noreturn]] void RefuseContent() const;

  // Refuses `count` things called `name` of at least `least` bytes each when
  // what is left cannot hold them.  To be asked before anything is allocated
  // or repeated `count` times.
  void RequireRoom(unsigned long long count, std::size_t least,
                   const std::string& name) const;

  // The double next to the number `word` spells.  Refuses anything else, also
  // numbers beyond all doubles; "inf" and "nan" are let pass (RequireValid in
  // mesh_io.cc counts them).
  double Real(std::string_view word, const std::string& place) const;

  // Takes a value in the given byte order; refuses when too few are left.  Of
  // reals a NaN is a quiet one, whatever its bits are in the file.
  template <typename T>
  T Binary(bool is_big_endian) {
    if (bytes_.size() < sizeof(T)) RefuseContent();
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    // The machines this runs on are little-endian.
    if (is_big_endian) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    if constexpr (std::is_floating_point_v<T>) MakeQuiet(&value);
    return value;
  }

 private:
  std::string_view bytes_;
  const char* format_;
  const std::string& file_;
};

}  // namespace phongpd::internal
