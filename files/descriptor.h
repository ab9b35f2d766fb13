// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>

// Files by descriptors, so that what was checked is what is used.
namespace phongpd::internal {

// Owns an open file or folder.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { Close(); }
  Descriptor(Descriptor&& other) noexcept
      : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  bool IsOpen() const { return number_ >= 0; }
  int number() const { return number_; }
  void Close();

 private:
  int number_ = -1;
};

// Throws std::system_error for errno.
[[noreturn]] void ThrowErrno(const std::string& what);

// Opens a folder, to make and name files in it.  Throws std::system_error.
Descriptor OpenFolder(const std::string& path);

// Writes all of `bytes` where the file stands.  Throws std::system_error.
void WriteAll(const Descriptor& file, std::string_view bytes);

// Reads from the beginning to the end.  Throws std::system_error.
std::string ReadAll(const Descriptor& file);

// Is it the caller's own, and can nobody else write to it?
bool IsPrivate(const Descriptor& file);

}  // namespace phongpd::internal
