// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/json_text.h"

#include <nlohmann/json.hpp>

namespace phongpd {

std::string JsonText(const nlohmann::ordered_json& value, int indent) {
  return value.dump(indent, ' ', false,
                    nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace phongpd
