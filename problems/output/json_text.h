// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace phongpd {

// JSON that any reader takes: bytes that are no UTF-8, as names of files may
// have, become U+FFFD instead of an exception.  On one line, or over several
// with `indent` blanks a level.
std::string JsonText(const nlohmann::ordered_json& value, int indent = -1);

}  // namespace phongpd
