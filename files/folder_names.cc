// SPDX-License-Identifier: GPL-3.0-or-later
#include "files/folder_names.h"

#include <dirent.h>

#include <memory>

namespace phongpd::internal {

std::vector<std::string> NamesIn(const std::string& folder) {
  std::vector<std::string> names;
  const auto close = [](DIR* stream) { closedir(stream); };
  const std::unique_ptr<DIR, decltype(close)> stream(opendir(folder.c_str()),
                                                     close);
  if (stream == nullptr) return names;
  while (const dirent* const entry = readdir(stream.get())) {
    const std::string name = static_cast<const char*>(entry->d_name);
    if (name != "." && name != "..") names.push_back(name);
  }
  return names;
}

}  // namespace phongpd::internal
