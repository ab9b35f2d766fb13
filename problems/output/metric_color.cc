// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/metric_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace phongpd {
namespace {

// Okabe and Ito's, and two of Tol's; none of a metric.
constexpr std::array<const char*, 6> kOtherColors = {
    "#E69F00", "#CC79A7", "#56B4E9", "#882255", "#999933", "#888888"};

constexpr int kPale[] = {0x9F, 0xB4, 0xC8};

// Null: no metric's name.
const char* ColorOfMetric(const std::string& name) {
  for (const auto& [word, color] :
       {std::make_pair("PhongPD", kPhongColor),
        std::make_pair("Euclidean", kEuclideanColor),
        std::make_pair("sliding", kSlidingColor)}) {
    if (name.compare(0, std::strlen(word), word) == 0) return color;
  }
  return nullptr;
}

// "#RRGGBB", mixed with a share of the pale one.
std::string Paler(const std::string& color, double share) {
  std::string text = "#";
  for (std::size_t k = 0; k < 3; ++k) {
    const int full = std::stoi(color.substr(1 + 2 * k, 2), nullptr, 16);
    const int mixed =
        static_cast<int>(std::lround(full + share * (kPale[k] - full)));
    constexpr char kDigits[] = "0123456789ABCDEF";
    text += kDigits[mixed / 16];
    text += kDigits[mixed % 16];
  }
  return text;
}

}  // namespace

std::vector<std::string> LineColors(const std::vector<std::string>& names) {
  std::vector<std::string> colors;
  std::map<std::string, int> before;  // lines of a metric's colour
  std::size_t others = 0;
  for (const std::string& name : names) {
    const char* const metric = ColorOfMetric(name);
    if (metric == nullptr) {
      colors.emplace_back(kOtherColors[others++ % kOtherColors.size()]);
      continue;
    }
    colors.push_back(Paler(metric, std::min(0.75, 0.45 * before[metric]++)));
  }
  return colors;
}

}  // namespace phongpd
