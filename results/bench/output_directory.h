// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "problems/output/output_files.h"

namespace phongpd::bench {

// Files of one directory, written together at the end.
class OutputDirectory {
 public:
  explicit OutputDirectory(const std::string& path) : path_(path) {
    std::filesystem::create_directories(path);
  }
  void Write(const std::string& file, const std::string& content) {
    const std::string path = path_ + "/" + file;
    outputs_.Declare(path);
    outputs_.Write(path, content);
  }
  void Commit() { outputs_.Commit(); }

 private:
  std::string path_;
  OutputFiles outputs_;
};

}  // namespace phongpd::bench
