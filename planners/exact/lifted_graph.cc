// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/lifted_graph.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "constraints/free_space.h"
#include "core/mesh/numbers.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/path_lift.h"
#include "planners/exact/surface_sight.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using internal::kInfinity;

// Of a way that keeps such a share of the wanted clearance: a path that is
// free of narrow places is worth a detour.
double Price(double length, double share) { return (2.0 - share) * length; }

SurfaceSite Fixed(const Vector3d& point) {
  SurfaceSite site;
  site.point = point;
  return site;
}

}  // namespace

LiftedGraph::LiftedGraph(const PlanningSurface& surface, double spacing,
                         int gap_links)
    : surface_(surface),
      graph_(surface.contact.mesh(), surface.neighbors, surface.segments,
             surface.cells, spacing, gap_links) {
  LiftNodes();
  const Edges edges = JoinNodes();
  counts_.ways = static_cast<int>(edges.size());
  routes_ = RouteTable(counts_.nodes, edges);
  std::vector<BoundingBox> boxes;
  boxes.reserve(points_.size());
  for (const Vector3d& p : points_) boxes.push_back({p, p});
  tree_ = BoxTree(boxes, 8);
}

void LiftedGraph::LiftNodes() {
  const FreeCells& cells = surface_.cells;
  for (const SurfaceSite& site : graph_.sites()) {
    const int cell = site.triangle >= 0
                         ? cells.CellOfPiece(cells.piece()[site.triangle])
                         : FreeCells::kOutside;
    const double clearance = surface_.WantedClearance(cell);
    Vector3d point = site.point;
    if (!site.direction.isZero()) {
      point += RoomAbove(site, surface_.segments, clearance, cells.rounding()) *
               site.direction;
    }
    points_.push_back(point);
    room_.push_back(surface_.segments.Distance(point, point, clearance));
    share_.push_back(room_.back() / clearance);
  }
  counts_.nodes = static_cast<int>(points_.size());
}

void LiftedGraph::Join(int i, int j, Edges* edges) {
  if (i > j) std::swap(i, j);
  double length = (points_[i] - points_[j]).norm();
  int via = -1;
  // True whenever they meet, too.
  if (surface_.segments.ComesWithin(points_[i], points_[j],
                                    0.5 * std::min(room_[i], room_[j]))) {
    std::vector<Vector3d> path;
    LiftCounts lift;
    const std::vector<int> blamed =
        LiftRoute({Fixed(points_[i]), graph_.sites()[i], graph_.sites()[j],
                   Fixed(points_[j])},
                  surface_.segments, std::max(room_[i], room_[j]),
                  surface_.cells.rounding(), &path, &lift);
    if (!blamed.empty()) {
      ++counts_.left_out;
      return;
    }
    ++counts_.lowered;
    length = PathLength(path);
    via = static_cast<int>(via_.size());
    via_.push_back(path[1]);
    via_.push_back(path[2]);
  }
  const double room = via >= 0 ? 0.0 : std::min(share_[i], share_[j]);
  edges->push_back({i, j, Price(length, room)});
  via_of_.push_back(via);
}

LiftedGraph::Edges LiftedGraph::JoinNodes() {
  Edges edges;
  const std::vector<SurfaceSite>& sites = graph_.sites();
  const int triangles = static_cast<int>(surface_.neighbors.size());
  std::vector<int> on_edges, of_links;
  std::vector<std::pair<double, int>> near;
  for (int t = 0; t < triangles; ++t) {
    on_edges.clear();
    of_links.clear();
    graph_.ForEachOn(t, [&](int i) {
      (i < graph_.edge_points() ? on_edges : of_links).push_back(i);
    });
    std::sort(on_edges.begin(), on_edges.end());
    for (std::size_t x = 0; x < on_edges.size(); ++x) {
      for (std::size_t y = x + 1; y < on_edges.size(); ++y) {
        const SurfaceSite& a = sites[on_edges[x]];
        const SurfaceSite& b = sites[on_edges[y]];
        const bool one_edge = a.triangle == b.triangle && a.other == b.other;
        // Along an edge in one of its triangles, from each point to the next.
        if (one_edge && (y > x + 1 || a.triangle != t)) continue;
        Join(on_edges[x], on_edges[y], &edges);
      }
    }
    for (const int i : of_links) {
      near.clear();
      for (const int j : on_edges) {
        near.emplace_back((sites[i].point - sites[j].point).squaredNorm(), j);
      }
      const std::size_t ways = std::min<std::size_t>(kLinkWays, near.size());
      std::partial_sort(near.begin(),
                        near.begin() + static_cast<std::ptrdiff_t>(ways),
                        near.end());
      for (std::size_t k = 0; k < ways; ++k) Join(i, near[k].second, &edges);
    }
  }
  for (int i = 0; i < counts_.nodes; ++i) {
    if (graph_.partner(i) > i) Join(i, graph_.partner(i), &edges);
  }
  for (std::size_t k = 1; k < graph_.outside().size(); ++k) {
    Join(graph_.outside()[0], graph_.outside()[k], &edges);
  }
  return edges;
}

void LiftedGraph::See(const Vector3d& q, const Vector3d& around,
                      double clearance, int tried, int wanted,
                      std::vector<Stop>* stops) const {
  using Candidate = std::pair<double, int>;
  const std::size_t most = static_cast<std::size_t>(tried);
  std::vector<Candidate> nearest;  // a heap, the farthest on top
  nearest.reserve(most + 1);
  tree_.NearestFirst(
      kInfinity,
      [&](int node) { return tree_.nodes()[node].SquaredDistance(around); },
      [&](int position) {
        const int i = tree_.order()[position];
        nearest.emplace_back((points_[i] - around).squaredNorm(), i);
        std::push_heap(nearest.begin(), nearest.end());
        if (nearest.size() > most) {
          std::pop_heap(nearest.begin(), nearest.end());
          nearest.pop_back();
        }
        return nearest.size() < most ? kInfinity : nearest.front().first;
      });
  std::sort_heap(nearest.begin(), nearest.end());
  const double room = surface_.segments.Distance(q, q, clearance);
  int seen = 0;
  for (const auto& [squared, i] : nearest) {
    if (seen == wanted) break;
    if (surface_.segments.ComesWithin(q, points_[i],
                                      0.5 * std::min(room, room_[i]))) {
      continue;
    }
    stops->push_back({i, Price((points_[i] - q).norm(), share_[i]), {}});
    ++seen;
  }
}

std::vector<LiftedGraph::Stop> LiftedGraph::Descend(const Vector3d& q,
                                                    double clearance,
                                                    int wanted) const {
  const PenetrationResult closest =
      surface_.contact.Answer(q, Location::kOutside);
  const std::optional<SurfaceSite> foot = SiteSeenFrom(
      q, closest.contact, closest.triangle, surface_.contact.mesh(),
      surface_.segments, surface_.cells.rounding());
  std::vector<Stop> stops;
  if (!foot) return stops;
  std::vector<std::pair<double, int>> near;
  graph_.ForEachOn(foot->triangle, [&](int i) {
    near.emplace_back((graph_.sites()[i].point - foot->point).squaredNorm(), i);
  });
  std::sort(near.begin(), near.end());
  for (const auto& [squared, i] : near) {
    if (static_cast<int>(stops.size()) == wanted) break;
    std::vector<Vector3d> path;
    LiftCounts lift;
    if (!LiftRoute({Fixed(q), *foot, graph_.sites()[i], Fixed(points_[i])},
                   surface_.segments, clearance, surface_.cells.rounding(),
                   &path, &lift)
             .empty()) {
      continue;
    }
    stops.push_back({i, Price(PathLength(path), 0.0), {path[1], path[2]}});
  }
  return stops;
}

std::vector<Vector3d> LiftedGraph::Search(const Vector3d& start,
                                          const std::vector<Stop>& starts,
                                          const Vector3d& goal,
                                          const std::vector<Stop>& goals,
                                          RouteTable::Scratch* scratch) const {
  const auto priced = [](const std::vector<Stop>& stops) {
    std::vector<RouteTable::Stop> prices;
    for (const Stop& stop : stops) prices.push_back({stop.node, stop.price});
    return prices;
  };
  const RouteTable::Route route =
      routes_.Search(priced(starts), priced(goals), scratch);
  std::vector<Vector3d> path;
  if (route.nodes.empty()) return path;
  const auto add = [&path](const Vector3d& p) {
    if (path.empty() || path.back() != p) path.push_back(p);
  };
  add(start);
  for (const Vector3d& p : starts[route.start].via) add(p);
  add(points_[route.nodes[0]]);
  for (std::size_t k = 0; k < route.edges.size(); ++k) {
    const int via = via_of_[route.edges[k]];
    const bool forward = route.nodes[k] < route.nodes[k + 1];
    if (via >= 0) {
      add(via_[forward ? via : via + 1]);
      add(via_[forward ? via + 1 : via]);
    }
    add(points_[route.nodes[k + 1]]);
  }
  const std::vector<Vector3d>& via = goals[route.goal].via;
  std::for_each(via.rbegin(), via.rend(), add);
  add(goal);
  return path;
}

}  // namespace phongpd
