// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Files of the library's own: a line of text, a byte order and the sizes of
// numbers, a version, the number of bytes that follow and their 128-bit
// checksum, and those.  For machines of one kind.
namespace phongpd::internal {

struct SealedFormat {
  std::string_view magic;     // the first line, with its end
  std::uint32_t version = 1;  // to be raised when the content's meaning changes
  const char* expected;       // "a contact space written by …"
  const char* again;          // "; write it anew by …"
};

// The file: the content behind its header.  Throws InputError if one of that
// many bytes would not be read (kMaxMeshBytes).
std::string SealedFile(const SealedFormat& format, std::string_view content);

// The content of such a file, part of `bytes`.  Throws InputError that begins
// with `name` and says what is wrong: another beginning, machine or version, a
// byte missing, changed or too many.
std::string_view ContentOf(const SealedFormat& format, std::string_view bytes,
                           const std::string& name);

}  // namespace phongpd::internal
