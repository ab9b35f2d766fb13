// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/planar_graph.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "core/minkowski/build_limits.h"

namespace phongpd::internal {

using Eigen::Vector2d;

PlanarGraph::PlanarGraph(const GridPlane& plane)
    : plane_(plane), dropped_(LargestAxis(plane.normal)) {
  u_ = (dropped_ + 1) % 3;
  v_ = (dropped_ + 2) % 3;
  mirrored_ = plane.normal[dropped_] < 0;
}

int PlanarGraph::AddVertex(const LocatedPoint& point) {
  assert(SideOf(plane_, point) == 0);
  vertices_.push_back(point);
  return static_cast<int>(vertices_.size()) - 1;
}

void PlanarGraph::AddSegment(int from, int to, const GridPlane& cutter,
                             const Coverage& net) {
  assert(from == to || (SideOf(cutter, vertices_[from]) == 0 &&
                        SideOf(cutter, vertices_[to]) == 0));
  Segment s{from, to, cutter,     RoundedPlane(cutter),
            net,  {}, Flat(from), Flat(to)};
  const Vector2d low = s.low.cwiseMin(s.high).array() - 2 * kPointError;
  s.high = s.low.cwiseMax(s.high).array() + 2 * kPointError;
  s.low = low;
  segments_.push_back(std::move(s));
}

GridPlane PlanarGraph::CutterAlong(const GridPoint& a,
                                   const GridPoint& b) const {
  GridPoint across = {0, 0, 0};
  across[dropped_] = 1;
  const GridNormal n = internal::Cross(b - a, across);
  return {n, Dot(n, a)};
}

int PlanarGraph::Side(const Segment& segment, int vertex) const {
  if (vertex == segment.from || vertex == segment.to) return 0;
  const LocatedPoint& p = vertices_[vertex];
  const int side = segment.rounded.Side(p.approximate);
  return side != 0 ? side : ExactSideOf(segment.cutter, p.definition);
}

// For a vertex on the segment's line.
bool PlanarGraph::StrictlyBetween(int vertex, const Segment& s) const {
  if (vertex == s.from || vertex == s.to) return false;
  const int axis = Axis(s);
  return Compare(s.from, vertex, axis) * Compare(vertex, s.to, axis) > 0;
}

int PlanarGraph::AddCrossing(const Segment& s, const Segment& t) {
  PointDefinition d;
  d.kind = PointDefinition::kPlanes;
  d.planes = {plane_, s.cutter, t.cutter};
  // One order for all three planes' graphs, so that they name it alike.
  std::sort(d.planes.begin(), d.planes.end(),
            [](const GridPlane& a, const GridPlane& b) {
              return std::tie(a.normal, a.offset) <
                     std::tie(b.normal, b.offset);
            });
  const LocatedPoint p = Locate(d);
  if (cells_.empty()) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      cells_.emplace(HomeCell(vertices_[i].approximate), static_cast<int>(i));
    }
  }
  int known = -1;
  ForEachNearCell(p.approximate, [&](const GridPoint& cell) {
    const auto range = cells_.equal_range(cell);
    for (auto it = range.first; it != range.second; ++it) {
      if (SamePoint(vertices_[it->second], p)) known = it->second;
    }
  });
  if (known >= 0) return known;
  const int id = AddVertex(p);
  cells_.emplace(HomeCell(p.approximate), id);
  return id;
}

void PlanarGraph::Cross(Segment* s, Segment* t) {
  const int s_from = Side(*t, s->from), s_to = Side(*t, s->to);
  const int t_from = Side(*s, t->from), t_to = Side(*s, t->to);
  const bool collinear = s_from == 0 && s_to == 0;
  if (!collinear && (s_from * s_to > 0 || t_from * t_to > 0)) return;
  if (s_from * s_to < 0 && t_from * t_to < 0) {
    const int crossing = AddCrossing(*s, *t);
    s->inner.push_back(crossing);
    t->inner.push_back(crossing);
    return;
  }
  const auto touch = [this](int side, int vertex, Segment* on) {
    if (side == 0 && StrictlyBetween(vertex, *on)) on->inner.push_back(vertex);
  };
  touch(s_from, s->from, t);
  touch(s_to, s->to, t);
  touch(t_from, t->from, s);
  touch(t_to, t->to, s);
}

void PlanarGraph::CrossAll(const BuildLimits* limits) {
  std::vector<int> order(segments_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [this](int a, int b) {
    return segments_[a].low[0] < segments_[b].low[0];
  });
  const auto split = [this](int vertex, Segment* at) {
    if (Side(*at, vertex) == 0 && StrictlyBetween(vertex, *at)) {
      at->inner.push_back(vertex);
    }
  };
  std::vector<int> active;
  for (const int i : order) {
    if (limits != nullptr) limits->Check("arrangement");
    Segment& s = segments_[i];
    std::size_t kept = 0;
    for (const int j : active) {
      Segment& t = segments_[j];
      if (t.high[0] < s.low[0]) continue;
      active[kept++] = j;
      if (t.high[1] < s.low[1] || s.high[1] < t.low[1]) continue;
      // Point-like segments are vertices other segments may run through.
      if (s.from != s.to && t.from != t.to) {
        Cross(&s, &t);
      } else if (s.from != s.to) {
        split(t.from, &s);
      } else if (t.from != t.to) {
        split(s.from, &t);
      }
    }
    active.resize(kept);
    active.push_back(i);
  }
}

void PlanarGraph::OrientSegments() {
  for (Segment& s : segments_) {
    if (s.from == s.to) continue;
    const auto exact = WideCross(plane_.normal, s.cutter.normal);
    s.direction = {exact[u_].convert_to<double>(),
                   exact[v_].convert_to<double>()};
    s.direction.normalize();
    const int along = Compare(s.to, s.from, Axis(s));
    s.turn = along * Sign(s.direction[Axis(s) == u_ ? 0 : 1]);
    s.direction *= s.turn;
  }
}

void PlanarGraph::SplitSegments() {
  std::map<std::pair<int, int>, int> ids;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    Segment& s = segments_[i];
    if (s.from == s.to) continue;
    const int axis = Axis(s);
    const int sign = Compare(s.to, s.from, axis);
    auto& chain = s.inner;
    std::sort(chain.begin(), chain.end(), [&](int a, int b) {
      return a != b && sign * Compare(a, b, axis) < 0;
    });
    chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
    chain.insert(chain.begin(), s.from);
    chain.push_back(s.to);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      const int a = chain[k], b = chain[k + 1];
      const bool along = a < b;
      const auto [it, is_new] =
          ids.emplace(std::minmax(a, b), static_cast<int>(edges_.size()));
      if (is_new) {
        edges_.push_back(
            {{std::min(a, b), std::max(a, b)}, {}, static_cast<int>(i), along});
      }
      for (int layer = 0; layer < 2; ++layer) {
        edges_[it->second].net[layer] += along ? s.net[layer] : -s.net[layer];
      }
    }
  }
}

void PlanarGraph::Build(const BuildLimits* limits) {
  OrientSegments();
  CrossAll(limits);
  SplitSegments();
  LinkLoops();
  assert(HasLoops());
  FormFaces();
  SpreadCoverage();
}

}  // namespace phongpd::internal
