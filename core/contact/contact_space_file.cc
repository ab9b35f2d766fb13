// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_file.h"

#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <utility>

#include "core/contact/byte_stream.h"
#include "core/contact/contact_space_bytes.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"

namespace phongpd {
namespace {

// To be raised when the bytes of ContactSpace::Parts change, which
// tests/data/box.pcs, a file of version 1, finds.
constexpr std::uint32_t kVersion = 1;

constexpr std::string_view kMagic = "phongpd contact space\n";
constexpr std::string_view kExtension = ".pcs";

// Reads otherwise where the order of bytes or a size is another.
constexpr std::uint64_t kMachine =
    0x0102030405060000u + (sizeof(std::size_t) << 8) + sizeof(int);

constexpr std::size_t kHeaderBytes =
    kMagic.size() + sizeof(kMachine) + sizeof(kVersion) + internal::kSealBytes;

const char kAgain[] = "; write it anew by phongpd contact-space";

std::string Header(std::string_view content) {
  internal::ByteWriter writer;
  writer(kMachine, kVersion);
  return std::string(kMagic) + writer.Take() + internal::Seal(content);
}

// The content behind a header that promises it; says what is wrong.
std::string_view ContentOf(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    throw InputError(name +
                     ": expected a contact space written by phongpd "
                     "contact-space to a .pcs file, found another beginning");
  }
  if (bytes.size() < kHeaderBytes) {
    throw InputError(name + ": cut off, expected at least " +
                     std::to_string(kHeaderBytes) + " bytes, found " +
                     std::to_string(bytes.size()) + kAgain);
  }
  std::uint64_t machine = 0;
  std::uint32_t version = 0;
  std::uint64_t size = 0;
  internal::ByteReader reader(bytes.substr(kMagic.size()));
  reader(machine, version, size);
  if (machine != kMachine) {
    throw InputError(name +
                     ": expected the byte order and number sizes of this "
                     "machine, found others" +
                     kAgain + " on this one");
  }
  if (version != kVersion) {
    throw InputError(name + ": expected version " + std::to_string(kVersion) +
                     " of the format, found " + std::to_string(version) +
                     kAgain + " of this version");
  }
  const std::string_view content = bytes.substr(kHeaderBytes);
  if (size != content.size()) {
    throw InputError(
        name + ": expected " + std::to_string(size) +
        " bytes after the header, found " + std::to_string(content.size()) +
        (content.size() < size ? ", it was cut off" : ", something follows") +
        kAgain);
  }
  if (bytes.substr(0, kHeaderBytes) != Header(content)) {
    throw InputError(name +
                     ": damaged, expected contents of the checksum in the "
                     "header, found others" +
                     kAgain);
  }
  return content;
}

}  // namespace

bool NamesContactSpaceFile(const std::string& path) {
  if (path.size() < kExtension.size()) return false;
  std::string end = path.substr(path.size() - kExtension.size());
  for (char& c : end) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return end == kExtension;
}

std::string ContactSpaceContent(const ContactSpace& space) {
  internal::ByteWriter length;
  length(space.HasOwnLength() ? space.length() : 0.0);
  const std::string content = length.Take() + internal::ToBytes(space.parts());
  if (kHeaderBytes + content.size() > kMaxMeshBytes) {
    throw InputError("contact space: expected at most " +
                     std::to_string(kMaxMeshBytes) +
                     " bytes as a file, found " +
                     std::to_string(kHeaderBytes + content.size()));
  }
  return Header(content) + content;
}

ContactSpace ParseContactSpace(const std::string& bytes,
                               const std::string& name) {
  const std::string_view content = ContentOf(bytes, name);
  double length = 0.0;
  internal::ByteReader reader(content.substr(0, sizeof length));
  reader(length);
  ContactSpace::Parts parts;
  if (!reader.Done() || !(length >= 0.0 && std::isfinite(length)) ||
      !internal::FromBytes(content.substr(sizeof length), &parts)) {
    throw InputError(name +
                     ": expected a contact space behind a valid checksum, "
                     "found none" +
                     kAgain);
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
