// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/exact_points.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {

std::size_t ExactPoints::CellHash::operator()(const Cell& c) const {
  std::uint64_t h = 0;
  for (const std::int64_t x : c) {
    h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

ExactPoints::ExactPoints(double extent)
    : cell_(extent * 1e-7), tolerance_(cell_ * 1e-2) {}

int ExactPoints::Add(const ExactPoint& p) {
  // Nearly parallel planes give wide intervals whose mid-point may lie in a
  // far cell: force the exact value, or one point gets two ids and the
  // arrangement leaks.
  double width = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto interval = CGAL::to_interval(p[k]);
    width = std::max(width, interval.second - interval.first);
  }
  if (!(width < tolerance_ * 1e-2)) CGAL::exact(p);

  Eigen::Vector3d a;
  Cell low, high;
  for (int k = 0; k < 3; ++k) {
    const auto interval = CGAL::to_interval(p[k]);
    a[k] = 0.5 * (interval.first + interval.second);
    low[k] = static_cast<std::int64_t>(std::floor((a[k] - tolerance_) / cell_));
    high[k] =
        static_cast<std::int64_t>(std::floor((a[k] + tolerance_) / cell_));
  }
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        const auto range = ids_.equal_range({x, y, z});
        for (auto it = range.first; it != range.second; ++it) {
          const int id = it->second;
          if ((approximate_[id] - a).lpNorm<Eigen::Infinity>() > tolerance_) {
            continue;
          }
          if (CGAL::identical(exact_[id], p) || exact_[id] == p) return id;
        }
      }
    }
  }
  const int id = static_cast<int>(exact_.size());
  exact_.push_back(p);
  approximate_.push_back(a);
  Cell home;
  for (int k = 0; k < 3; ++k) {
    home[k] = static_cast<std::int64_t>(std::floor(a[k] / cell_));
  }
  ids_.emplace(home, id);
  return id;
}

Eigen::Vector3d ExactPoints::Rounded(int id) const {
  Eigen::Vector3d r;
  for (int k = 0; k < 3; ++k) {
    const auto interval = CGAL::to_interval(exact_[id][k]);
    const bool tight = interval.second - interval.first < 0x1p-12;
    r[k] = tight ? 0.5 * (interval.first + interval.second)
                 : CGAL::to_double(CGAL::exact(exact_[id][k]));
  }
  return r;
}

}  // namespace phongpd::internal
