// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/view.h"

namespace phongpd {

// What lies behind a path, for a file that is read again by the same version:
// BehindOf(BehindJson(b)) is b, to the last bit.  BehindOf throws
// nlohmann::json::exception for other JSON.
nlohmann::ordered_json BehindJson(const ViewBehind& behind);
ViewBehind BehindOf(const nlohmann::ordered_json& json);

}  // namespace phongpd
