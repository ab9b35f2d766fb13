// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/sealed_file.h"

#include <cstddef>

#include "core/contact/byte_stream.h"
#include "core/contact/contact_space_bytes.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"

namespace phongpd::internal {
namespace {

// Reads otherwise where the order of bytes or a size is another.
constexpr std::uint64_t kMachine =
    0x0102030405060000u + (sizeof(std::size_t) << 8) + sizeof(int);

std::string Header(const SealedFormat& format, std::string_view content) {
  ByteWriter writer;
  writer(kMachine, format.version);
  return std::string(format.magic) + writer.Take() + Seal(content);
}

std::size_t HeaderBytes(const SealedFormat& format) {
  return format.magic.size() + sizeof(kMachine) + sizeof(format.version) +
         kSealBytes;
}

}  // namespace

std::string SealedFile(const SealedFormat& format, std::string_view content) {
  const std::size_t bytes = HeaderBytes(format) + content.size();
  if (bytes > kMaxMeshBytes) {
    throw InputError("contact space: expected at most " +
                     std::to_string(kMaxMeshBytes) +
                     " bytes as a file, found " + std::to_string(bytes));
  }
  std::string file = Header(format, content);
  file += content;
  return file;
}

std::string_view ContentOf(const SealedFormat& format, std::string_view bytes,
                           const std::string& name) {
  const std::size_t header = HeaderBytes(format);
  const std::string again = format.again;
  if (bytes.substr(0, format.magic.size()) != format.magic) {
    throw InputError(name + ": expected " + format.expected +
                     ", found another beginning");
  }
  if (bytes.size() < header) {
    throw InputError(name + ": cut off, expected at least " +
                     std::to_string(header) + " bytes, found " +
                     std::to_string(bytes.size()) + again);
  }
  std::uint64_t machine = 0;
  std::uint32_t version = 0;
  std::uint64_t size = 0;
  ByteReader reader(bytes.substr(format.magic.size()));
  reader(machine, version, size);
  if (machine != kMachine) {
    throw InputError(name +
                     ": expected the byte order and number sizes of this "
                     "machine, found others" +
                     again + " on this one");
  }
  if (version != format.version) {
    throw InputError(name + ": expected version " +
                     std::to_string(format.version) + " of the format, found " +
                     std::to_string(version) + again + " of this version");
  }
  const std::string_view content = bytes.substr(header);
  if (size != content.size()) {
    throw InputError(
        name + ": expected " + std::to_string(size) +
        " bytes after the header, found " + std::to_string(content.size()) +
        (content.size() < size ? ", it was cut off" : ", something follows") +
        again);
  }
  if (bytes.substr(0, header) != Header(format, content)) {
    throw InputError(name +
                     ": damaged, expected contents of the checksum in the "
                     "header, found others" +
                     again);
  }
  return content;
}

}  // namespace phongpd::internal
