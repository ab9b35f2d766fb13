// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace phongpd::fuzz {

// Decisions from a fuzzer's bytes; zeros when there are no more.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size)
      : data_(data), size_(size) {}

  bool AtEnd() const { return size_ == 0; }
  int Byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  int Below(int count) { return Byte() % count; }
  // Any bits of a T.
  template <typename T>
  T Raw() {
    unsigned char bytes[sizeof(T)];
    for (unsigned char& b : bytes) b = static_cast<unsigned char>(Byte());
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  // A multiple of 1/8 in [−16, 16).
  double Coordinate() { return (Byte() - 128) / 8.0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace phongpd::fuzz
