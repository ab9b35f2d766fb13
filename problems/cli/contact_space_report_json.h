// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/contact/contact_space.h"

// What `contact-space` and `minkowski` say of what they built.
namespace phongpd::cli {

// An operand as it was found in `file`, and after its repair.
nlohmann::ordered_json ToJson(const MeshReport& mesh,
                              const RepairReport& repair,
                              const std::string& file);

// All but the operands.
nlohmann::ordered_json ToJson(const ContactSpaceReport& report);

// Three lines for people; `file` is where the mesh went.
std::string Summary(const std::string& file, const ContactSpaceReport& report);

}  // namespace phongpd::cli
