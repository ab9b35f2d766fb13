// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_file.h"

#include <cctype>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string_view>
#include <utility>

#include "core/contact/byte_stream.h"
#include "core/contact/contact_space_bytes.h"
#include "core/contact/sealed_file.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"

namespace phongpd {
namespace {

constexpr std::string_view kSpaceExtension = ".pcs";

const char kWriteSpaceAnew[] = "; write it anew by phongpd contact-space";

// The version is to be raised when the bytes of ContactSpace::Parts change,
// which tests/data/box.pcs, a file of version 1, finds.
constexpr internal::SealedFormat kSpaceFormat = {
    "phongpd contact space\n", 1,
    "a contact space written by phongpd contact-space to a .pcs file",
    kWriteSpaceAnew};

}  // namespace

bool NamesContactSpaceFile(const std::string& path) {
  if (path.size() < kSpaceExtension.size()) return false;
  std::string end = path.substr(path.size() - kSpaceExtension.size());
  for (char& c : end) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return end == kSpaceExtension;
}

std::string ContactSpaceContent(const ContactSpace& space) {
  internal::ByteWriter length;
  length(space.HasOwnLength() ? space.length() : 0.0);
  return internal::SealedFile(kSpaceFormat,
                              length.Take() + internal::ToBytes(space.parts()));
}

ContactSpace ParseContactSpace(const std::string& bytes,
                               const std::string& name) {
  const std::string_view content =
      internal::ContentOf(kSpaceFormat, bytes, name);
  double length = 0.0;
  internal::ByteReader reader(content.substr(0, sizeof length));
  reader(length);
  ContactSpace::Parts parts;
  if (!reader.Done() || !(length >= 0.0 && std::isfinite(length)) ||
      !internal::FromBytes(content.substr(sizeof length), &parts)) {
    throw InputError(name +
                     ": expected a contact space behind a valid checksum, "
                     "found none" +
                     kWriteSpaceAnew);
  }
  ContactSpace space(std::move(parts), name);
  return length > 0.0 ? space.WithLength(length) : space;
}

void WriteContactSpace(const ContactSpace& space, const std::string& path) {
  const std::string content = ContactSpaceContent(space);
  std::ofstream out(path, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out.flush()) {
    throw InputError(path +
                     ": cannot be written; expected a writable path with room "
                     "for " +
                     std::to_string(content.size()) + " bytes");
  }
}

ContactSpace ReadContactSpace(const std::string& path) {
  return ParseContactSpace(
      ReadInputFile(path, "a contact space file", kMaxMeshBytes), path);
}

}  // namespace phongpd
