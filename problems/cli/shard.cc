// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/shard.h"

#include <sstream>

#include "core/mesh/mesh_error.h"

namespace phongpd::cli {

Shard ParseShard(const std::string& text, const std::string& flag) {
  std::istringstream stream(text);
  Shard shard;
  char slash = 0;
  const bool is_read = stream >> shard.index >> slash >> shard.count &&
                       stream.peek() == std::istringstream::traits_type::eof();
  if (is_read && slash == '/' && 0 <= shard.index &&
      shard.index < shard.count) {
    return shard;
  }
  throw InputError(flag + ": expected i/n with 0 <= i < n, found '" + text +
                   "'");
}

}  // namespace phongpd::cli
