// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

#include "files/descriptor.h"
#include "files/interruption.h"

namespace phongpd::internal {

// A new file under a name nobody can guess, `prefix` + 32 random hexadecimal
// digits + ".part", which only its owner can read, until Publish.  Made by
// exclusive creation that follows no link; locked (flock) while this lives, by
// which RemoveAbandoned tells it from what a killed process has left.  Removed
// by the destructor and by signals (interruption.h).
//
// Everything here throws std::system_error.
class TemporaryFile {
 public:
  // In the open `folder`, which must outlive this.
  TemporaryFile(const Descriptor& folder, const std::string& prefix);
  ~TemporaryFile();
  TemporaryFile(TemporaryFile&&) noexcept = default;
  TemporaryFile& operator=(TemporaryFile&&) = delete;

  // Appends.
  void Write(std::string_view bytes) { WriteAll(file_, bytes); }
  // Returns when the content has reached the disk.
  void Sync() const;

  // Takes the place of whatever is called `name` in the folder, atomically.
  // `mode` as for open(2) without the umask's share.
  void Publish(const std::string& name, mode_t mode);

 private:
  int folder_;
  std::string name_;  // empty once it is published
  RemovedOnSignal on_signal_;
  Descriptor file_;
};

// `prefix` + 32 random hexadecimal digits + ".part".
std::string UnguessableName(const std::string& prefix);

// Takes flock(2) at once or not at all; false: someone else has it.  True also
// where the file system knows no locks.
bool TryLock(const Descriptor& file, bool shared = false);

// Removes what TemporaryFiles of this prefix have left in the folder: the
// user's own regular files, which no process has locked.
void RemoveAbandoned(const std::string& folder, const std::string& prefix);

}  // namespace phongpd::internal
