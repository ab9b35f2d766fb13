// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// How much time is spent on a better answer.  With every preset the answer is
// exact: a path is free, a proof is a proof.  They trade time against the
// length or energy of the path; the figures are in results/trade.
//
// Queries have no presets: nothing that one could set there trades one for the
// other (results/trade says what was tried).
enum class Preset {
  kFast,
  kBalanced,  // the options' own defaults
  kTight,
};
const char* ToString(Preset preset);
const std::vector<std::string>& PresetNames();
// Throws InputError starting with `what`.
Preset ParsePreset(const std::string& text, const std::string& what);

}  // namespace phongpd
