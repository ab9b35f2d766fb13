// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "files/descriptor.h"
#include "files/interruption.h"

namespace phongpd {

// The rows of a long command, kept as they come, so that the same command goes
// on where it was interrupted: FILE.partial beside the output FILE, first a
// line that says what the rows depend on, then each row as one line of JSON
// (a tab and its aside behind it), handed to the system as soon as it is there
// (what ends the process takes no row away; a power cut may take the last
// ones).  A last line that is torn does not count and is written over.
//
// One process at a time (flock).  Only a regular file of the user's own that
// nobody else can write to is taken up; links are not followed.
//
// Throws InputError naming FILE.partial: it is in use, unsafe, written by
// another command, or cannot be written; what it holds stays as it is.
class RowFile {
 public:
  // `target` is FILE, links resolved; empty keeps the rows in memory only.
  // `command` is an object with everything the rows depend on.
  RowFile(const std::string& target, const nlohmann::ordered_json& command);
  // Removes FILE.partial if it has no row.
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  const std::string& path() const { return path_; }
  // Those of an interrupted run first, byte for byte; without line ends.
  const std::vector<std::string>& rows() const { return rows_; }
  // JSON that was kept with each row and is no part of it; empty: none.
  const std::vector<std::string>& asides() const { return asides_; }
  void Append(const std::string& row, const std::string& aside = "");

  // All rows as lines.
  std::string Content() const;
  // They are safe elsewhere: removes FILE.partial.
  void Finish();

 private:
  void Open();
  void RemoveIfNew();
  void TakeUp(const std::string& content, const nlohmann::ordered_json& command,
              const std::string& header);

  std::string path_;
  std::string leaf_;
  internal::Descriptor folder_;
  internal::Descriptor file_;
  bool is_new_ = false;
  internal::RemovedOnSignal on_signal_;  // while there is no row
  std::size_t size_ = 0;                 // of the file up to the last row
  std::vector<std::string> rows_, asides_;
};

}  // namespace phongpd
