// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// Values as bytes, in the machine's own representation.  ByteWriter and
// ByteReader take the same calls, so one function that names the fields of a
// struct (`Fields`, found by argument-dependent lookup) both writes and reads
// it:
//
//   `template <typename Stream>`
//   void Fields(Stream* io, Thing& thing) {
//     auto& [count, names] = thing;  // does not compile when one is missing
//     (*io)(count, names);
//   }
namespace phongpd::internal {

// The bytes a T takes at least; 1 where only its Fields know.
template <typename T>
struct LeastBytes {
  static constexpr std::size_t value =
      std::is_arithmetic_v<T> || std::is_enum_v<T> ? sizeof(T) : 1;
};
template <>
struct LeastBytes<std::string> {
  static constexpr std::size_t value = sizeof(std::size_t);
};
template <>
struct LeastBytes<Eigen::Vector3d> {
  static constexpr std::size_t value = 3 * sizeof(double);
};
template <typename T, std::size_t N>
struct LeastBytes<std::array<T, N>> {
  static constexpr std::size_t value = N * LeastBytes<T>::value;
};
template <typename T, typename U>
struct LeastBytes<std::pair<T, U>> {
  static constexpr std::size_t value =
      LeastBytes<T>::value + LeastBytes<U>::value;
};

class ByteWriter {
 public:
  template <typename... Values>
  void operator()(const Values&... values) {
    (Put(values), ...);
  }
  std::string Take() { return std::move(bytes_); }

 private:
  void PutRaw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  void Put(const std::string& text) {
    Put(text.size());
    PutRaw(text.data(), text.size());
  }
  void Put(const Eigen::Vector3d& v) { PutRaw(v.data(), 3 * sizeof(double)); }
  template <typename T, std::size_t N>
  void Put(const std::array<T, N>& values) {
    for (const T& value : values) Put(value);
  }
  template <typename T, typename U>
  void Put(const std::pair<T, U>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <typename T>
  void Put(const std::vector<T>& values) {
    Put(values.size());
    for (const T& value : values) Put(value);
  }
  template <typename T>
  void Put(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      PutRaw(&value, sizeof value);
    } else {
      // Fields takes what a reader changes; the writer does not.
      Fields(this, const_cast<T&>(value));
    }
  }

  std::string bytes_;
};

// Reading past the end leaves the values as they are and makes Done false.
// Nothing is allocated for more things than the bytes that are left can hold.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename... Values>
  void operator()(Values&... values) {
    (Get(values), ...);
  }
  // Was everything read, and nothing more?
  bool Done() const { return good_ && bytes_.empty(); }

 private:
  void GetRaw(void* data, std::size_t size) {
    good_ = good_ && size <= bytes_.size();
    if (!good_) return;
    std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  // A count of things of at least `least` bytes each.
  std::size_t GetCount(std::size_t least) {
    std::size_t count = 0;
    GetRaw(&count, sizeof count);
    good_ = good_ && count <= bytes_.size() / least;
    return good_ ? count : 0;
  }
  void Get(std::string& text) {
    const std::size_t size = GetCount(1);
    text.assign(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
  }
  void Get(Eigen::Vector3d& v) { GetRaw(v.data(), 3 * sizeof(double)); }
  template <typename T, std::size_t N>
  void Get(std::array<T, N>& values) {
    for (T& value : values) Get(value);
  }
  template <typename T, typename U>
  void Get(std::pair<T, U>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <typename T>
  void Get(std::vector<T>& values) {
    values.clear();
    const std::size_t count = GetCount(LeastBytes<T>::value);
    // Where their size is known, all at once; else as they come.
    if constexpr (LeastBytes<T>::value > 1) values.reserve(count);
    for (std::size_t i = 0; i < count && good_; ++i) Get(values.emplace_back());
  }
  void Get(bool& value) {
    unsigned char byte = value;
    GetRaw(&byte, 1);
    value = byte != 0;
  }
  template <typename T>
  void Get(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      GetRaw(&value, sizeof value);
    } else {
      Fields(this, value);
    }
  }

  std::string_view bytes_;
  bool good_ = true;
};

}  // namespace phongpd::internal
