// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/shard.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"
#include "problems/output/json_text.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

// Far above what the settings of a command with thousands of scenes take.
constexpr std::uintmax_t kMaxShardBytes = std::uintmax_t{64} << 20;

}  // namespace

Shard ParseShard(const std::string& text, const std::string& flag) {
  const std::size_t slash = text.find('/');
  Shard shard;
  try {
    if (slash != std::string::npos) {
      std::size_t first = 0, second = 0;
      shard.index = std::stoi(text.substr(0, slash), &first);
      shard.count = std::stoi(text.substr(slash + 1), &second);
      if (first == slash && second == text.size() - slash - 1 &&
          0 <= shard.index && shard.index < shard.count) {
        return shard;
      }
    }
  } catch (const std::logic_error&) {  // no number, or too large
  }
  throw InputError(flag + ": expected i/n with 0 <= i < n, found '" + text +
                   "'");
}

std::string ShardText(const Shard& shard, Json settings, std::size_t rows) {
  settings.erase("--shard");
  const Json record = {{"shard", std::to_string(shard.index) + "/" +
                                     std::to_string(shard.count)},
                       {"rows", rows},
                       {"command", std::move(settings)}};
  return JsonText(record, 2) + '\n';
}

ShardRecord ReadShard(const std::string& folder) {
  const std::string path = folder + "/" + kShardFile;
  const Json record = Json::parse(
      ReadInputFile(path, "part of a phongpd compare --shard", kMaxShardBytes),
      nullptr, false);
  if (!record.is_object() || !record.contains("shard") ||
      !record["shard"].is_string() || !record.contains("rows") ||
      !record["rows"].is_number_unsigned() || !record.contains("command")) {
    throw InputError(path +
                     ": expected the shard, rows and command that phongpd "
                     "compare --shard writes, found something else");
  }
  ShardRecord found;
  try {
    found.shard = ParseShard(record["shard"].get<std::string>());
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
  found.rows = record["rows"].get<std::size_t>();
  found.command = JsonText(record["command"]);
  return found;
}

}  // namespace phongpd::cli
