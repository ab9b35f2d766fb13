// SPDX-License-Identifier: GPL-3.0-or-later
#include "files/descriptor.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace phongpd::internal {
namespace {

// What Linux moves in one call at most is a little above.
constexpr std::size_t kLargestPiece = std::size_t{1} << 30;

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    Close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

void Descriptor::Close() {
  if (number_ >= 0) close(number_);
  number_ = -1;
}

void ThrowErrno(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

Descriptor OpenFolder(const std::string& path) {
  Descriptor folder(open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder.IsOpen()) ThrowErrno(path);
  return folder;
}

void WriteAll(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file.number(), bytes.data(),
                                  std::min(bytes.size(), kLargestPiece));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) ThrowErrno("write");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string ReadAll(const Descriptor& file) {
  struct stat status;
  if (fstat(file.number(), &status) != 0) ThrowErrno("fstat");
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t got = pread(file.number(), bytes.data() + size,
                              std::min(bytes.size() - size, kLargestPiece),
                              static_cast<off_t>(size));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) ThrowErrno("read");
    if (got == 0) break;  // it has shrunk
    size += static_cast<std::size_t>(got);
  }
  bytes.resize(size);
  return bytes;
}

bool IsPrivate(const Descriptor& file) {
  struct stat status;
  return fstat(file.number(), &status) == 0 && status.st_uid == geteuid() &&
         (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace phongpd::internal
