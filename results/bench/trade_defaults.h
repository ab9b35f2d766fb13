// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace phongpd::bench {

// What defaults_benchmark found, a line each challenger; `results`: the folder
// of published rows.
std::string DefaultSentences(const std::string& results);

}  // namespace phongpd::bench
