// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/contact/contact_space_bytes.h"

namespace phongpd::fuzz {

// Of a sealed file (sealed_file.h): what stands before size and checksum.
inline std::size_t BeforeSeal(std::string_view file) {
  return file.find('\n') + 1 + sizeof(std::uint64_t) + sizeof(std::uint32_t);
}

inline std::string ContentOfSealed(std::string_view file) {
  return std::string(file.substr(BeforeSeal(file) + internal::kSealBytes));
}

// The file with another content, of a valid checksum.
inline std::string Resealed(std::string_view file, std::string_view content) {
  return std::string(file.substr(0, BeforeSeal(file))) +
         internal::Seal(content) + std::string(content);
}

}  // namespace phongpd::fuzz
