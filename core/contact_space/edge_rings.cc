// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/edge_rings.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Angles closer than this are told apart exactly (radians).
constexpr double kAngleGap = 1e-6;
// Shorter edges (grid steps) get their direction from exact points only.
constexpr double kShortEdge = 64.0;

// One facet at one edge; `apex` is its third corner.
struct Spoke {
  int low, high, apex, facet;
  bool forward;
};

std::vector<Spoke> CollectSpokes(const std::vector<ArrangementFacet>& facets) {
  std::vector<Spoke> spokes(3 * facets.size());
  tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t f) {
    const Triangle& t = facets[f].corners;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      spokes[3 * f + k] = {std::min(a, b), std::max(a, b), t[(k + 2) % 3],
                           static_cast<int>(f), a < b};
    }
  });
  tbb::parallel_sort(spokes.begin(), spokes.end(),
                     [](const Spoke& x, const Spoke& y) {
                       return std::tie(x.low, x.high, x.facet) <
                              std::tie(y.low, y.high, y.facet);
                     });
  return spokes;
}

class RingSorter {
 public:
  RingSorter(const Convolution& convolution,
             const std::vector<ArrangementFacet>& facets,
             const ExactPoints& points)
      : convolution_(convolution), facets_(facets), points_(points) {}

  void Sort(Spoke* begin, Spoke* end) const {
    if (end - begin > 2 && !SortRounded(begin, end)) SortExactly(begin, end);
  }

 private:
  // By angle in double; false when some angles are too close to call.
  bool SortRounded(Spoke* begin, Spoke* end) const {
    const std::size_t count = static_cast<std::size_t>(end - begin);
    std::vector<Vector3d> normals;
    for (const Spoke* s = begin; s != end; ++s) {
      const int source = facets_[s->facet].facet;
      normals.push_back(
          ToDouble(convolution_.facets[source].normal).normalized());
    }
    // The edge lies in all planes: the cross product of the two that differ
    // most from each other is its most reliable direction.
    Vector3d direction = Vector3d::Zero();
    for (const Vector3d& n : normals) {
      const Vector3d c = normals[0].cross(n);
      if (c.squaredNorm() > direction.squaredNorm()) direction = c;
    }
    const double sine = direction.norm();
    if (sine < 1e-4) return false;
    direction /= sine;
    const Vector3d edge =
        points_.Approximate(begin->high) - points_.Approximate(begin->low);
    const double along = edge.dot(direction);
    if (edge.norm() < kShortEdge || std::abs(along) < 0.5 * edge.norm()) {
      return false;
    }
    if (along < 0) direction = -direction;

    // A facet that contains low → high lies to the left of it: n × d.
    const auto inward = [&](std::size_t k) -> Vector3d {
      const Vector3d u = normals[k].cross(direction);
      return begin[k].forward ? u : Vector3d(-u);
    };
    const Vector3d e1 = inward(0).normalized();
    const Vector3d e2 = direction.cross(e1);
    std::vector<std::pair<double, Spoke>> order;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector3d u = inward(k);
      double angle = k == 0 ? 0.0 : std::atan2(u.dot(e2), u.dot(e1));
      if (angle < 0) angle += 2 * M_PI;
      order.emplace_back(angle, begin[k]);
    }
    std::sort(order.begin(), order.end(),
              [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t k = 0; k < count; ++k) {
      const double next = k + 1 < count ? order[k + 1].first : 2 * M_PI;
      if (next - order[k].first < kAngleGap) return false;
    }
    for (std::size_t k = 0; k < count; ++k) begin[k] = order[k].second;
    return true;
  }

  // Half-planes around low → high relative to the first facet: 0 the same
  // half-plane, 1 counter-clockwise, 2 opposite, 3 clockwise.
  void SortExactly(Spoke* begin, Spoke* end) const {
    const ExactPoint& a = points_[begin->low];
    const ExactPoint& b = points_[begin->high];
    const ExactPoint& reference = points_[begin->apex];
    const auto sector = [&](int apex) {
      if (apex == begin->apex) return 0;
      const ExactPoint& p = points_[apex];
      switch (CGAL::orientation(a, b, reference, p)) {
        case CGAL::POSITIVE:
          return 1;
        case CGAL::NEGATIVE:
          return 3;
        default:
          return CGAL::coplanar_orientation(a, b, reference, p) ==
                         CGAL::POSITIVE
                     ? 0
                     : 2;
      }
    };
    std::vector<std::pair<int, Spoke>> order;
    for (const Spoke* s = begin; s != end; ++s) {
      order.emplace_back(sector(s->apex), *s);
    }
    std::stable_sort(
        order.begin(), order.end(), [&](const auto& x, const auto& y) {
          if (x.first != y.first) return x.first < y.first;
          if (x.first == 0 || x.first == 2) return false;
          if (x.second.apex == y.second.apex) return false;
          return CGAL::orientation(a, b, points_[x.second.apex],
                                   points_[y.second.apex]) == CGAL::POSITIVE;
        });
    for (const auto& entry : order) *begin++ = entry.second;
  }

  const Convolution& convolution_;
  const std::vector<ArrangementFacet>& facets_;
  const ExactPoints& points_;
};

}  // namespace

EdgeRings SortAroundEdges(const Convolution& convolution,
                          const std::vector<ArrangementFacet>& facets,
                          const ExactPoints& points) {
  std::vector<Spoke> spokes = CollectSpokes(facets);
  EdgeRings out;
  for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
    while (end < spokes.size() && spokes[end].low == spokes[begin].low &&
           spokes[end].high == spokes[begin].high) {
      ++end;
    }
    out.rings.push_back({spokes[begin].low, spokes[begin].high,
                         static_cast<int>(begin), static_cast<int>(end)});
  }
  const RingSorter sorter(convolution, facets, points);
  tbb::parallel_for(std::size_t{0}, out.rings.size(), [&](std::size_t r) {
    sorter.Sort(spokes.data() + out.rings[r].begin,
                spokes.data() + out.rings[r].end);
  });
  out.facets.reserve(spokes.size());
  for (const Spoke& s : spokes) out.facets.push_back({s.facet, s.forward});
  return out;
}

}  // namespace phongpd::internal
