// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/windows/window_plan.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// A window of which both halves meet more of its facets than this is not split.
constexpr double kUseless = 0.95;

class Planner {
 public:
  Planner(const Convolution& convolution, const OccupiedRegion& occupied,
          std::size_t most_facets, std::vector<PlannedWindow>* out)
      : convolution_(convolution),
        occupied_(occupied),
        most_facets_(most_facets),
        out_(out) {}

  void Split(PlannedWindow whole) {
    if (whole.facets.empty() || occupied_.Contains(whole.window.Box())) return;
    const auto halves = whole.window.Halves();
    if (whole.facets.size() <= most_facets_ || !halves) {
      out_->push_back(std::move(whole));
      return;
    }
    PlannedWindow low{(*halves)[0], {}}, high{(*halves)[1], {}};
    low.facets = FacetsIn(convolution_, whole.facets, low.window.Box());
    high.facets = FacetsIn(convolution_, whole.facets, high.window.Box());
    const auto all = static_cast<double>(whole.facets.size());
    const auto less =
        static_cast<double>(std::min(low.facets.size(), high.facets.size()));
    if (less > kUseless * all) {
      out_->push_back(std::move(whole));
      return;
    }
    whole.facets = {};
    Split(std::move(low));
    Split(std::move(high));
  }

 private:
  const Convolution& convolution_;
  const OccupiedRegion& occupied_;
  std::size_t most_facets_;
  std::vector<PlannedWindow>* out_;
};

}  // namespace

std::vector<int> FacetsIn(const Convolution& convolution,
                          const std::vector<int>& facets,
                          const BoundingBox& box) {
  std::vector<int> out;
  for (const int f : facets) {
    Vector3d corners[3];
    for (int k = 0; k < 3; ++k) {
      corners[k] =
          ToDouble(convolution.points[convolution.facets[f].corners[k]]);
    }
    if (!IsClearlyApart(corners, box)) out.push_back(f);
  }
  return out;
}

std::vector<PlannedWindow> PlanWindows(const Convolution& convolution,
                                       const OccupiedRegion& occupied,
                                       std::size_t most_facets) {
  PlannedWindow all;
  for (std::size_t f = 0; f < convolution.facets.size(); ++f) {
    all.facets.push_back(static_cast<int>(f));
    for (const int corner : convolution.facets[f].corners) {
      const GridPoint& p = convolution.points[corner];
      for (int k = 0; k < 3; ++k) {
        const bool first = f == 0 && corner == convolution.facets[0].corners[0];
        const std::int64_t low = 2 * p[k] - 1, high = 2 * p[k] + 1;
        all.window.min[k] = first ? low : std::min(all.window.min[k], low);
        all.window.max[k] = first ? high : std::max(all.window.max[k], high);
      }
    }
  }
  std::vector<PlannedWindow> windows;
  Planner(convolution, occupied, most_facets, &windows).Split(std::move(all));
  return windows;
}

WindowConvolution PartOf(const Convolution& convolution,
                         const PlannedWindow& window) {
  WindowConvolution out;
  std::unordered_map<int, int> numbers;
  for (const int f : window.facets) {
    ConvolutionFacet facet = convolution.facets[f];
    for (int& corner : facet.corners) {
      const auto [it, is_new] = numbers.emplace(
          corner, static_cast<int>(out.convolution.points.size()));
      if (is_new) out.convolution.points.push_back(convolution.points[corner]);
      corner = it->second;
    }
    out.convolution.facets.push_back(facet);
  }
  return out;
}

}  // namespace phongpd::internal
