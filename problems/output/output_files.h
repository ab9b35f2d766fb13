// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "files/descriptor.h"
#include "files/interruption.h"
#include "files/temporary_file.h"

namespace phongpd {

// The name by which people mean standard output; a file of that name is ./-.
inline constexpr char kStandardOutput[] = "-";

// The files one command writes: all of them or none.
//
//   OutputFiles outputs;
//   outputs.Declare(path);          // fails now, not after hours of work
//   outputs.Write(path, text);
//   outputs.Commit();
//
// Contents go to private temporaries beside their targets
// (.phongpd-NAME-RANDOM.part, see files/temporary_file.h) and are on the
// disk before Commit renames the first; when a rename fails, those before it
// are undone.  Only a power cut or SIGKILL within Commit, which lasts as long
// as the renames, can leave some new files beside old ones, each of them whole.
// Signals remove the temporaries; what SIGKILL leaves goes with the next
// Declare of the same file.  A symbolic link is followed, unless others could
// have put it there: it is somebody else's, in a folder they may write to.
//
// Targets that are no regular file (a device, a pipe) are written in place,
// and /dev/stdout, or "-", through standard output.
//
// Throws InputError naming the file that cannot be written.
class OutputFiles {
 public:
  OutputFiles() = default;
  ~OutputFiles();  // removes what was not committed
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  // Makes the directory `path` and its parents where they are missing; what
  // it made goes again without Commit.
  void MakeDirectory(const std::string& path);

  // Makes sure that `path` can be written and is declared once only.
  void Declare(const std::string& path);

  // The regular file that the declared `path` names, links resolved; empty for
  // what is written in place.
  std::string Target(const std::string& path) const;

  // Writes the content of the declared `path`; once.
  void Write(const std::string& path, std::string_view content);

  void Commit();

  // One of them is standard output: nothing else should be printed there.
  bool UseStandardOutput() const;

 private:
  struct File {
    std::string path;    // as the user named it
    std::string target;  // symbolic links followed
    std::string leaf;    // its name in the folder
    internal::Descriptor folder;
    std::unique_ptr<internal::TemporaryFile> temporary;  // none: in place
  };
  struct Directory {
    std::string path;
    internal::RemovedOnSignal on_signal;
  };
  class Replacement;
  const File& Find(const std::string& path) const;

  std::vector<File> files_;
  std::vector<Directory> directories_;  // made here, parents first
};

}  // namespace phongpd
