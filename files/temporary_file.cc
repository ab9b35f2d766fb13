// SPDX-License-Identifier: GPL-3.0-or-later
#include "files/temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "files/folder_names.h"

namespace phongpd::internal {
namespace {

constexpr mode_t kPrivate = 0600;
constexpr std::size_t kRandomDigits = 32;
constexpr char kDigits[] = "0123456789abcdef";
constexpr std::string_view kEnding = ".part";

bool IsTemporaryName(const std::string& name, const std::string& prefix) {
  if (name.size() != prefix.size() + kRandomDigits + kEnding.size() ||
      name.compare(0, prefix.size(), prefix) != 0 ||
      name.compare(name.size() - kEnding.size(), kEnding.size(), kEnding) !=
          0) {
    return false;
  }
  const std::string digits = name.substr(prefix.size(), kRandomDigits);
  return digits.find_first_not_of(kDigits) == std::string::npos;
}

// Reading the umask means setting it; nothing becomes more open meanwhile.
mode_t Umask() {
  const mode_t mask = umask(S_IRWXG | S_IRWXO);
  umask(mask);
  return mask;
}

}  // namespace

std::string UnguessableName(const std::string& prefix) {
  std::array<unsigned char, kRandomDigits / 2> bytes = {};
  const ssize_t got = getrandom(bytes.data(), bytes.size(), 0);
  if (got != static_cast<ssize_t>(bytes.size())) ThrowErrno("getrandom");
  std::string name = prefix;
  for (const unsigned char byte : bytes) {
    name += kDigits[byte / 16];
    name += kDigits[byte % 16];
  }
  return name.append(kEnding);
}

bool TryLock(const Descriptor& file, bool shared) {
  return flock(file.number(), (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0 ||
         errno != EWOULDBLOCK;
}

TemporaryFile::TemporaryFile(const Descriptor& folder,
                             const std::string& prefix)
    : folder_(folder.number()) {
  // Again only where RemoveAbandoned of another process came before the lock.
  for (;;) {
    name_ = UnguessableName(prefix);
    on_signal_ = RemovedOnSignal(folder_, name_);
    file_ = Descriptor(
        openat(folder_, name_.c_str(),
               O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kPrivate));
    if (!file_.IsOpen()) ThrowErrno("open");
    on_signal_.Confirm();
    struct stat status;
    if (TryLock(file_) && fstat(file_.number(), &status) == 0 &&
        status.st_nlink == 1) {
      return;
    }
    unlinkat(folder_, name_.c_str(), 0);
  }
}

TemporaryFile::~TemporaryFile() {
  // Not when it has been moved from, or published.
  if (file_.IsOpen() && !name_.empty()) unlinkat(folder_, name_.c_str(), 0);
}

void TemporaryFile::Sync() const {
  // EINVAL: a file system that keeps nothing.
  if (fsync(file_.number()) != 0 && errno != EINVAL) ThrowErrno("fsync");
}

void TemporaryFile::Publish(const std::string& name, mode_t mode) {
  // EPERM: a file system without modes.
  if (mode != kPrivate && fchmod(file_.number(), mode & ~Umask()) != 0 &&
      errno != EPERM) {
    ThrowErrno("chmod");
  }
  if (renameat(folder_, name_.c_str(), folder_, name.c_str()) != 0) {
    ThrowErrno("rename");
  }
  on_signal_.Forget();
  name_.clear();
}

void RemoveAbandoned(const std::string& folder, const std::string& prefix) {
  const Descriptor at(open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!at.IsOpen()) return;
  for (const std::string& name : NamesIn(folder)) {
    if (!IsTemporaryName(name, prefix)) continue;
    const Descriptor file(
        openat(at.number(), name.c_str(),
               O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status;
    if (file.IsOpen() && fstat(file.number(), &status) == 0 &&
        S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
        flock(file.number(), LOCK_EX | LOCK_NB) == 0) {
      unlinkat(at.number(), name.c_str(), 0);
    }
  }
}

}  // namespace phongpd::internal
