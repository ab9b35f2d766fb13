// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"

namespace phongpd {

// The files one command writes: all of them or none.  Contents go to a
// temporary neighbour of each file first; Commit renames them when everything
// has been written.  Targets that are no regular file (a device, a pipe) are
// written in place, and /dev/stdout through standard output.
//
//   OutputFiles outputs;
//   outputs.Declare(path);          // fails now, not after hours of work
//   outputs.Write(path, text);
//   outputs.Commit();
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

  // Checks that `path` could be written and is declared once only.
  void Declare(const std::string& path);

  // Where the content of the declared `path` goes until Commit; it has the
  // same extension.
  const std::string& TemporaryPath(const std::string& path) const;

  // Writes `content` there.
  void Write(const std::string& path, const std::string& content);

  void Commit();

  // One of them is standard output: nothing else should be printed there.
  bool UseStandardOutput() const;

 private:
  struct File {
    std::string path;       // as the user named it
    std::string target;     // symbolic links followed
    std::string temporary;  // equal to target when written in place
  };
  const File& Find(const std::string& path) const;

  std::vector<File> files_;
  std::vector<std::string> directories_;  // made here, parents first
};

}  // namespace phongpd
