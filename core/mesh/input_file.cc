// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

constexpr int kPatienceMs = 1000;  // for the first writer of a pipe

class InputDescriptor {
 public:
  explicit InputDescriptor(int number) : number_(number) {}
  ~InputDescriptor() {
    if (number_ >= 0) close(number_);
  }
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

class InputFile {
 public:
  InputFile(const std::string& path, const char* kind, std::uintmax_t max_bytes)
      : path_(path),
        kind_(kind),
        max_bytes_(max_bytes),
        // Without O_NONBLOCK, opening a pipe waits for its writer; with
        // O_NOCTTY, a terminal stays as it is.
        file_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)),
        open_error_(errno) {}

  std::string Read() {
    struct stat status = {};
    if (file_.number() < 0) RefuseUnopened();
    if (fstat(file_.number(), &status) != 0) RefuseError();
    std::string bytes;
    if (S_ISREG(status.st_mode)) {
      const auto size = static_cast<std::uintmax_t>(status.st_size);
      RequireSize(size);
      bytes.reserve(static_cast<std::size_t>(size));
    } else if (S_ISDIR(status.st_mode)) {
      Refuse("a directory; name a file in it");
    } else if (!S_ISFIFO(status.st_mode)) {
      Refuse("a device; name a file");
    } else {
      Wait(kPatienceMs);
    }
    ReadAll(&bytes);
    if (bytes.empty() && S_ISFIFO(status.st_mode)) {
      Refuse("a pipe that nobody writes to; start its writer first");
    }
    return bytes;
  }

 private:
  [[noreturn]] void Refuse(const std::string& found) const {
    throw InputError(path_ + ": expected " + kind_ + ", found " + found);
  }
  [[noreturn]] void RefuseError() const {
    Refuse(std::string("one that cannot be read (") + std::strerror(errno) +
           ")");
  }
  [[noreturn]] void RefuseUnopened() const {
    if (open_error_ == ENOENT || open_error_ == ENOTDIR) {
      Refuse("nothing; check the path");
    }
    if (open_error_ == ENXIO) Refuse("a device or socket; name a file");
    Refuse(std::string("one that cannot be opened (") +
           std::strerror(open_error_) + "); check its permissions");
  }
  void RequireSize(std::uintmax_t size) const {
    if (size <= max_bytes_) return;
    Refuse(std::to_string(size) + " bytes or more, of " +
           std::to_string(max_bytes_) + " allowed; make it smaller");
  }

  void Wait(int milliseconds) const {
    pollfd waiting = {file_.number(), POLLIN, 0};
    poll(&waiting, 1, milliseconds);
  }

  void ReadAll(std::string* bytes) const {
    std::array<char, 1 << 16> buffer;
    for (;;) {
      const ssize_t count = read(file_.number(), buffer.data(), buffer.size());
      if (count == 0) return;
      if (count > 0) {
        RequireSize(bytes->size() + static_cast<std::uintmax_t>(count));
        bytes->append(buffer.data(), static_cast<std::size_t>(count));
      } else if (errno == EAGAIN) {
        Wait(-1);  // a writer holds the pipe and takes its time
      } else if (errno != EINTR) {
        RefuseError();
      }
    }
  }

  const std::string& path_;
  const char* kind_;
  std::uintmax_t max_bytes_;
  InputDescriptor file_;
  int open_error_;
};

}  // namespace

std::string ReadInputFile(const std::string& path, const char* kind,
                          std::uintmax_t max_bytes) {
  return InputFile(path, kind, max_bytes).Read();
}

}  // namespace phongpd
