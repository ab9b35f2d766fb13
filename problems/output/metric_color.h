// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// One colour a metric, in figures, still pictures and pages: told apart by
// colour-blind readers (Okabe and Ito), each dark enough on white.  viewer/
// colors.js and results/bench/step_figure.py have the same; a test compares
// them.
inline constexpr char kPhongColor[] = "#0060B0";
inline constexpr char kEuclideanColor[] = "#D55E00";
inline constexpr char kSlidingColor[] = "#009E73";

// Of lines or paths, by the names that they have in the legend: of "PhongPD, ℓ
// = 0.1", "Euclidean PD" and "sliding contact" the metric's, of the next of the
// same metric a paler one each; of all else others in turn.
std::vector<std::string> LineColors(const std::vector<std::string>& names);

}  // namespace phongpd
