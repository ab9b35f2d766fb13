// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// How much is spent on a better answer.  Every answer is exact whichever is
// taken: a path is free, a proof a proof.  What they trade is time against the
// length or energy of the path; the figures are in results/trade.
//
// There is none for queries: of what they could set nothing trades (results/
// trade says what was tried).
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
