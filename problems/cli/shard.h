// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace phongpd::cli {

// i/n: every n-th problem of a command, beginning with the i-th.
struct Shard {
  int index = 0;
  int count = 1;

  bool IsWhole() const { return count == 1; }
  bool Has(int problem) const { return problem % count == index; }
};

// Throws InputError naming the flag.
Shard ParseShard(const std::string& text, const std::string& flag);

}  // namespace phongpd::cli
