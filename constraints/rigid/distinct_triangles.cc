// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/distinct_triangles.h"

#include <algorithm>
#include <utility>

namespace phongpd::internal {
namespace {

bool ComesBefore(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(),
                                      b.data() + 3);
}

}  // namespace

std::vector<std::size_t> DistinctTriangles(
    const std::vector<TriangleCorners>& corners) {
  using Numbered = std::pair<TriangleCorners, std::size_t>;
  std::vector<Numbered> sorted;
  sorted.reserve(corners.size());
  for (const TriangleCorners& triangle : corners) {
    sorted.emplace_back(triangle, sorted.size());
    TriangleCorners& own = sorted.back().first;
    std::sort(own.begin(), own.end(), ComesBefore);
  }
  const auto corners_come_before = [](const Numbered& a, const Numbered& b) {
    return std::lexicographical_compare(a.first.begin(), a.first.end(),
                                        b.first.begin(), b.first.end(),
                                        ComesBefore);
  };
  // Of those that are the same the first stays first.
  std::stable_sort(sorted.begin(), sorted.end(), corners_come_before);
  std::vector<std::size_t> distinct;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].first != sorted[i - 1].first) {
      distinct.push_back(sorted[i].second);
    }
  }
  std::sort(distinct.begin(), distinct.end());
  return distinct;
}

}  // namespace phongpd::internal
