// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
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
Shard ParseShard(const std::string& text, const std::string& flag = "--shard");

// The file beside a part's rows.jsonl that says what part of what it is, and
// how many rows it has; `settings` are CommandSettings.
inline constexpr char kShardFile[] = "shard.json";
std::string ShardText(const Shard& shard, nlohmann::ordered_json settings,
                      std::size_t rows);

// What ShardText wrote into `folder`.  Throws InputError naming the file.
struct ShardRecord {
  Shard shard;
  std::string command;  // settings, without the part's number
  std::size_t rows = 0;
};
ShardRecord ReadShard(const std::string& folder);

}  // namespace phongpd::cli
