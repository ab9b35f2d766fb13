// SPDX-License-Identifier: GPL-3.0-or-later
// From edges to faces: which half-edge follows which, what lies in what, and
// how often each face is covered.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "core/mesh/union_find.h"
#include "core/minkowski/arrangement/planar_graph.h"
#include "core/pi.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector2d;

// Directions closer than this are compared exactly (radians).
constexpr double kDirectionGap = 1e-9;
// Where an edge passes is known in double up to this (grid steps), or else it
// is too level to tell.
constexpr double kSteepError = 1.0;
// Grid steps by which boxes of edges are wider: far above kPointError.
constexpr double kEdgeBoxMargin = 1.0;

}  // namespace

Vector2d PlanarGraph::Direction(int half_edge) const {
  const Edge& e = edges_[half_edge / 2];
  const Vector2d& d = segments_[e.segment].direction;
  return e.along == (half_edge % 2 == 0) ? d : Vector2d(-d);
}

std::array<Wide, 2> PlanarGraph::ExactDirection(int half_edge) const {
  const Edge& e = edges_[half_edge / 2];
  const Segment& s = segments_[e.segment];
  const auto d = WideCross(plane_.normal, s.cutter.normal);
  const bool same = (e.along == (half_edge % 2 == 0)) == (s.turn > 0);
  return same ? std::array<Wide, 2>{d[u_], d[v_]}
              : std::array<Wide, 2>{-d[u_], -d[v_]};
}

// Counter-clockwise, starting just after the direction −u.
void PlanarGraph::SortOutgoing(Few* half_edges) const {
  if (half_edges->size() < 2) return;
  boost::container::small_vector<std::pair<double, int>, 8> order;
  for (const int h : *half_edges) {
    const Vector2d d = Direction(h);
    order.emplace_back(std::atan2(d[1], d[0]), h);
  }
  std::sort(order.begin(), order.end());
  bool clear =
      order.front().first + 2 * kPi - order.back().first > kDirectionGap &&
      kPi - order.back().first > kDirectionGap &&
      order.front().first + kPi > kDirectionGap;
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    clear = clear && order[k + 1].first - order[k].first > kDirectionGap;
  }
  if (clear) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      (*half_edges)[k] = order[k].second;
    }
    return;
  }
  const auto rank = [](const std::array<Wide, 2>& d) {
    const int y = d[1].sign();
    return y < 0 ? 0 : y > 0 ? 2 : d[0].sign() > 0 ? 1 : 3;
  };
  std::sort(half_edges->begin(), half_edges->end(), [&](int a, int b) {
    const auto d = ExactDirection(a), e = ExactDirection(b);
    const int rd = rank(d), re = rank(e);
    if (rd != re) return rd < re;
    return Wide(d[0] * e[1] - d[1] * e[0]).sign() > 0;
  });
}

void PlanarGraph::LinkLoops() {
  outgoing_.assign(vertices_.size(), Few());
  const int count = 2 * static_cast<int>(edges_.size());
  for (int h = 0; h < count; ++h) outgoing_[From(h)].push_back(h);
  next_.resize(count);
  for (Few& out : outgoing_) {
    SortOutgoing(&out);
    for (std::size_t k = 0; k < out.size(); ++k) {
      // The half-edge arriving opposite out[k] turns left-most: clockwise.
      next_[out[k] ^ 1] = out[(k + out.size() - 1) % out.size()];
    }
  }
}

std::vector<PlanarGraph::Component> PlanarGraph::FindComponents() const {
  std::map<int, Component> found;
  UnionFind sets(vertices_.size());
  for (const Edge& e : edges_) sets.Join(e.end[0], e.end[1]);
  const auto before = [this](int a, int b) {
    const int c = Compare(a, b, u_);
    return c != 0 ? c < 0 : Compare(a, b, v_) < 0;
  };
  for (int v = 0; v < static_cast<int>(vertices_.size()); ++v) {
    if (outgoing_[v].empty()) continue;
    const auto [it, is_new] = found.emplace(sets.Find(v), Component{v, 0});
    if (!is_new && before(v, it->second.corner)) it->second.corner = v;
  }
  std::vector<Component> components;
  for (auto& [root, c] : found) {
    // All edges leave it to the right; left of the last one is the outside.
    c.outer = outgoing_[c.corner].back();
    components.push_back(c);
  }
  return components;
}

// Of two edges that pass left of `vertex` at its height: does e come between
// f and the vertex?
bool PlanarGraph::IsCloser(int e, int f, int vertex) const {
  const double height = Flat(vertex)[1];
  // Reach at that height, and how far rounding moves it: without bound on an
  // almost level edge.
  const auto reach = [&](int edge) -> std::pair<double, double> {
    const Vector2d a = Flat(edges_[edge].end[0]), b = Flat(edges_[edge].end[1]);
    if (a[1] == b[1]) return {a[0], std::numeric_limits<double>::infinity()};
    const double slope = (b[0] - a[0]) / (b[1] - a[1]);
    return {a[0] + slope * (height - a[1]),
            8 * kPointError * (1 + std::abs(slope))};
  };
  const auto [reach_e, error_e] = reach(e);
  const auto [reach_f, error_f] = reach(f);
  const auto steep = [](double error) { return error < kSteepError; };
  if (steep(error_e) && steep(error_f) &&
      std::abs(reach_e - reach_f) > error_e + error_f) {
    return reach_e > reach_f;
  }
  // Edges of the graph share no more than an end, and both of these reach from
  // the vertex's height or below to above it: the higher of their lower ends
  // lies beside the other edge, or else they share it, and then the lower of
  // their upper ends does.
  const auto right_of = [this](int vertex_of_other, int edge) {
    const Edge& x = edges_[edge];
    const int low = Compare(x.end[0], x.end[1], v_) < 0 ? 0 : 1;
    if (Compare(x.end[low], vertex_of_other, v_) > 0 ||
        Compare(vertex_of_other, x.end[1 - low], v_) > 0) {
      return 0;
    }
    return RightOfEdge(edge, vertex_of_other);
  };
  for (const int end : edges_[e].end) {
    const int side = right_of(end, f);
    if (side != 0) return side > 0;
  }
  for (const int end : edges_[f].end) {
    const int side = right_of(end, e);
    if (side != 0) return side < 0;
  }
  throw std::logic_error("contact space: edges of a plane overlap");
}

// +1 when the vertex lies to the +u side of the (not horizontal) edge.
int PlanarGraph::RightOfEdge(int edge, int vertex) const {
  const Edge& e = edges_[edge];
  if (vertex == e.end[0] || vertex == e.end[1]) return 0;
  const Segment& s = segments_[e.segment];
  // Towards −(plane normal × direction) grows the cutter's value by
  // turn · |…|; in the projection that is right of from → to, or left when
  // the projection is mirrored.
  const int right =
      SideOf(s.cutter, vertices_[vertex]) * s.turn * (mirrored_ ? -1 : 1);
  const int upward = Compare(s.to, s.from, v_);
  return right * upward;
}

// The half-edge with the component just to its left, −1 when there is none.
int PlanarGraph::HalfEdgeLeftOf(const Component& component,
                                const std::vector<int>& component_of,
                                const BoxTree& tree) const {
  const int corner = component.corner;
  const Vector2d at = Flat(corner);
  int closest = -1;
  const auto visit = [&](int e) {
    const auto [a, b] = edges_[e].end;
    if (component_of[a] == component_of[corner]) return;
    // Half-open in height, so that a chain counts once.
    const bool a_below = Compare(a, corner, v_) <= 0;
    const bool b_below = Compare(b, corner, v_) <= 0;
    if (a_below == b_below || RightOfEdge(e, corner) <= 0) return;
    if (closest < 0 || IsCloser(e, closest, corner)) closest = e;
  };
  // How far left of the corner a box begins; nothing behind the left end of
  // the closest edge can come between.
  constexpr double kNever = std::numeric_limits<double>::infinity();
  tree.NearestFirst(
      std::numeric_limits<double>::max(),
      [&](int index) {
        const BoxTree::Node& node = tree.nodes()[index];
        const bool is_beside = node.min[0] <= at[0] && node.min[1] <= at[1] &&
                               node.max[1] >= at[1];
        return is_beside ? at[0] - node.max[0] : kNever;
      },
      [&](int position) {
        visit(tree.order()[position]);
        if (closest < 0) return std::numeric_limits<double>::max();
        const auto [a, b] = edges_[closest].end;
        return at[0] - std::min(Flat(a)[0], Flat(b)[0]) + kEdgeBoxMargin;
      });
  if (closest < 0) return -1;
  // It lies right of the upward half-edge: left of the other.
  const auto [a, b] = edges_[closest].end;
  return Compare(a, b, v_) < 0 ? 2 * closest + 1 : 2 * closest;
}

// Boxes of the projected edges, wider than their ends are uncertain.
BoxTree PlanarGraph::EdgeTree() const {
  std::vector<BoundingBox> boxes;
  boxes.reserve(edges_.size());
  for (const Edge& e : edges_) {
    const Vector2d p = Flat(e.end[0]), q = Flat(e.end[1]);
    const Vector2d low = p.cwiseMin(q).array() - kEdgeBoxMargin;
    const Vector2d high = p.cwiseMax(q).array() + kEdgeBoxMargin;
    boxes.push_back({{low[0], low[1], 0.0}, {high[0], high[1], 0.0}});
  }
  return BoxTree(boxes, 4);
}

void PlanarGraph::FormFaces() {
  const int count = static_cast<int>(next_.size());
  face_of_.assign(count, -1);
  faces_.assign(1, Face());
  const std::vector<Component> components = FindComponents();
  std::vector<char> is_outer(count, 0);
  for (const Component& c : components) {
    for (int h = c.outer; !is_outer[h]; h = next_[h]) is_outer[h] = 1;
  }
  for (int h = 0; h < count; ++h) {
    if (is_outer[h] || face_of_[h] >= 0) continue;
    const int face = static_cast<int>(faces_.size());
    faces_.emplace_back();
    faces_.back().loops.push_back(h);
    for (int k = h; face_of_[k] < 0; k = next_[k]) face_of_[k] = face;
  }
  // Every component's outer loop belongs to the face around it.
  std::vector<int> component_of(vertices_.size(), -1);
  BoxTree tree;
  if (components.size() > 1) {
    tree = EdgeTree();
    UnionFind sets(vertices_.size());
    for (const Edge& e : edges_) sets.Join(e.end[0], e.end[1]);
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      component_of[v] = sets.Find(static_cast<int>(v));
    }
  }
  // From left to right, so that the container of a container is known.
  std::vector<Component> ordered = components;
  std::sort(ordered.begin(), ordered.end(),
            [this](const Component& a, const Component& b) {
              const int c = Compare(a.corner, b.corner, u_);
              return c != 0 ? c < 0 : Compare(a.corner, b.corner, v_) < 0;
            });
  for (const Component& c : ordered) {
    int face = 0;
    if (components.size() > 1) {
      const int h = HalfEdgeLeftOf(c, component_of, tree);
      if (h >= 0) face = face_of_[h];
    }
    if (face < 0) throw std::logic_error("contact space: faces out of order");
    faces_[face].loops.push_back(c.outer);
    for (int k = c.outer; face_of_[k] < 0; k = next_[k]) face_of_[k] = face;
  }
}

void PlanarGraph::SpreadCoverage() {
  std::vector<char> visited(faces_.size(), 0);
  std::vector<int> stack = {0};
  visited[0] = 1;
  while (!stack.empty()) {
    const int face = stack.back();
    stack.pop_back();
    for (const int first : faces_[face].loops) {
      int h = first;
      do {
        const int twin = h ^ 1;
        const int next = face_of_[twin];
        if (!visited[next]) {
          visited[next] = 1;
          stack.push_back(next);
          // Crossing h from its left to its right, in the projection.
          const int sign = ((h % 2 == 0) != mirrored_) ? -1 : 1;
          for (int layer = 0; layer < 2; ++layer) {
            const int count =
                faces_[face].coverage[layer] + sign * edges_[h / 2].net[layer];
            if (count < 0) {
              throw std::logic_error("contact space: negative coverage");
            }
            faces_[next].coverage[layer] = count;
          }
        }
        h = next_[h];
      } while (h != first);
    }
  }
}

bool PlanarGraph::HasLoops() const {
  std::vector<char> seen(next_.size(), 0);
  for (std::size_t h = 0; h < next_.size(); ++h) {
    const int half_edge = static_cast<int>(h);
    if (From(next_[h]) != From(half_edge ^ 1)) return false;
    if (From(half_edge) == From(half_edge ^ 1)) return false;
    if (seen[next_[h]]++ != 0) return false;
  }
  return true;
}

}  // namespace phongpd::internal
