// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/radial_edges.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/minkowski/build_limits.h"
#include "core/pi.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Angles closer than this are told apart exactly (radians).
constexpr double kRingGap = 1e-6;
// An edge this long (grid steps) shows which way it runs although its ends
// are rounded.
constexpr double kLongEdge = 1.0;

class SpokeSorter {
 public:
  SpokeSorter(const Convolution& convolution, const Arrangement& arrangement,
              const ExactPoints& points)
      : convolution_(convolution), arrangement_(arrangement), points_(points) {}

  void Sort(const RadialEdge& edge, Spoke* begin, Spoke* end) const {
    if (end - begin > 2 && !SortRounded(edge, begin, end)) {
      SortExactly(edge, begin, end);
    }
  }

 private:
  const GridNormal& Normal(const Spoke& s) const {
    return convolution_.facets[arrangement_.faces[s.face].facet].normal;
  }

  // +1 when low → high runs along `direction`, which is parallel to the edge.
  int Orientation(const RadialEdge& edge, const Vector3d& direction) const {
    const Vector3d along =
        points_.Approximate(edge.high) - points_.Approximate(edge.low);
    if (along.lpNorm<Eigen::Infinity>() > kLongEdge) {
      return Sign(along.dot(direction));
    }
    const int axis = LargestAxis(direction);
    return CompareCoordinate(points_[edge.high], points_[edge.low], axis) *
           Sign(direction[axis]);
  }

  // By angle in double; false when some angles are too close to call.
  bool SortRounded(const RadialEdge& edge, Spoke* begin, Spoke* end) const {
    const std::size_t count = static_cast<std::size_t>(end - begin);
    std::vector<Vector3d> normals;
    for (const Spoke* s = begin; s != end; ++s) {
      normals.push_back(ToDouble(Normal(*s)).normalized());
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
    direction *= Orientation(edge, direction) / sine;

    // A face whose half-edge runs low → high lies to the left of it: n × d.
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
      if (angle < 0) angle += 2 * kPi;
      order.emplace_back(angle, begin[k]);
    }
    std::sort(order.begin(), order.end(),
              [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t k = 0; k < count; ++k) {
      const double next = k + 1 < count ? order[k + 1].first : 2 * kPi;
      if (next - order[k].first < kRingGap) return false;
    }
    for (std::size_t k = 0; k < count; ++k) begin[k] = order[k].second;
    return true;
  }

  // With u_k = ±n_k × d the inward directions, sin and cos of the angle from
  // u_r to u_k have the signs of ±d·(n_r × n_k) and ±n_r·n_k, and
  // d ∥ n_i × n_j gives d·(n_r × n_k) ∝ (n_i·n_r)(n_j·n_k) −
  // (n_i·n_k)(n_j·n_r).
  void SortExactly(const RadialEdge& edge, Spoke* begin, Spoke* end) const {
    const GridNormal& ni = Normal(*begin);
    const GridNormal* nj = nullptr;
    int turn = 0;  // of n_i × n_j against low → high
    for (const Spoke* s = begin + 1; s != end && turn == 0; ++s) {
      const auto cross = WideCross(ni, Normal(*s));
      const Vector3d direction(cross[0].convert_to<double>(),
                               cross[1].convert_to<double>(),
                               cross[2].convert_to<double>());
      if (direction.isZero(0.0)) continue;
      nj = &Normal(*s);
      turn = Orientation(edge, direction);
    }
    if (turn == 0) return;  // one plane only: two spokes in any order
    const auto sine = [&](const Spoke& r, const Spoke& k) {
      const Wide value = WideDot(ni, Normal(r)) * WideDot(*nj, Normal(k)) -
                         WideDot(ni, Normal(k)) * WideDot(*nj, Normal(r));
      return value.sign() * turn * (r.forward == k.forward ? 1 : -1);
    };
    const auto cosine = [&](const Spoke& r, const Spoke& k) {
      return WideDot(Normal(r), Normal(k)).sign() *
             (r.forward == k.forward ? 1 : -1);
    };
    // Half-planes relative to the first: 0 the same, 1 counter-clockwise,
    // 2 opposite, 3 clockwise.
    const Spoke first = *begin;
    const auto sector = [&](const Spoke& s) {
      const int side = sine(first, s);
      if (side != 0) return side > 0 ? 1 : 3;
      return cosine(first, s) > 0 ? 0 : 2;
    };
    std::vector<std::pair<int, Spoke>> order;
    for (const Spoke* s = begin; s != end; ++s) {
      order.emplace_back(sector(*s), *s);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](const auto& x, const auto& y) {
                       if (x.first != y.first) return x.first < y.first;
                       return x.first % 2 == 1 && sine(x.second, y.second) > 0;
                     });
    for (const auto& entry : order) *begin++ = entry.second;
  }

  const Convolution& convolution_;
  const Arrangement& arrangement_;
  const ExactPoints& points_;
};

}  // namespace

RadialEdges SortAroundEdges(const Convolution& convolution,
                            const Arrangement& arrangement,
                            const ExactPoints& points,
                            const BuildLimits* limits) {
  const auto check = [limits] {
    if (limits != nullptr) limits->Check("cells");
  };
  struct Entry {
    int low, high;
    Spoke spoke;
  };
  const std::vector<HalfEdge>& edges = arrangement.half_edges;
  std::vector<Entry> entries(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t h) {
    const HalfEdge& e = edges[h];
    entries[h] = {std::min(e.from, e.to),
                  std::max(e.from, e.to),
                  {static_cast<int>(h), e.face, e.from < e.to}};
  });
  tbb::parallel_sort(entries.begin(), entries.end(),
                     [](const Entry& x, const Entry& y) {
                       return std::tie(x.low, x.high, x.spoke.half_edge) <
                              std::tie(y.low, y.high, y.spoke.half_edge);
                     });
  RadialEdges out;
  out.spokes.reserve(entries.size());
  for (const Entry& e : entries) {
    check();
    const int at = static_cast<int>(out.spokes.size());
    if (out.edges.empty() || out.edges.back().low != e.low ||
        out.edges.back().high != e.high) {
      out.edges.push_back({e.low, e.high, at, at});
    }
    out.spokes.push_back(e.spoke);
    ++out.edges.back().end;
  }
  const SpokeSorter sorter(convolution, arrangement, points);
  tbb::parallel_for(std::size_t{0}, out.edges.size(), [&](std::size_t r) {
    check();
    const RadialEdge& edge = out.edges[r];
    sorter.Sort(edge, out.spokes.data() + edge.begin,
                out.spokes.data() + edge.end);
  });
  return out;
}

UnionFind JoinSides(const RadialEdges& radial, std::size_t faces) {
  UnionFind sides(2 * faces);
  for (const RadialEdge& edge : radial.edges) {
    for (int k = edge.begin; k < edge.end; ++k) {
      const int next = k + 1 < edge.end ? k + 1 : edge.begin;
      sides.Join(radial.spokes[k].SideToNext(),
                 radial.spokes[next].SideToPrevious());
    }
  }
  return sides;
}

}  // namespace phongpd::internal
