// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/surface_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>

#include "core/mesh/unit_normal.h"
#include "planners/exact/surface_sight.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr int kMaxPointsPerEdge = 6;

Vector3d MeanDirection(const Vector3d& m, const Vector3d& n) {
  const Vector3d sum = m + n;
  const double norm = sum.norm();
  // Two facets folded onto each other have no mean.
  if (norm > 1e-9) return sum / norm;
  return m.isZero() ? n : m;
}

}  // namespace

TriangleBvh::Hit FirstAbove(const SurfaceSite& site,
                            const TriangleBvh& segments, double reach,
                            double rounding) {
  const Vector3d end = site.point + reach * site.direction;
  // Where a sliver is hit is less certain than rounding.
  for (double radius = rounding; radius < 1e9 * rounding; radius *= 16.0) {
    const TriangleBvh::Hit hit =
        segments.FirstHitBeyond(site.point, end, radius);
    if (!hit.Found() ||
        (hit.triangle != site.triangle && hit.triangle != site.other)) {
      return hit;
    }
  }
  return {};
}

SurfaceGraph::SurfaceGraph(const TriangleMesh& mesh,
                           const std::vector<std::array<int, 3>>& neighbors,
                           const TriangleBvh& segments, const FreeCells& cells,
                           double spacing, int gap_links)
    : mesh_(mesh) {
  assert(spacing > 0.0 && gap_links >= 0);
  assert(neighbors.size() == mesh.triangles.size());
  normals_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    normals_.push_back(UnitNormal(mesh, t));
  }
  AddEdgePoints(neighbors, spacing);
  edge_points_ = static_cast<int>(sites_.size());
  AddRays(cells);
  AddGapLinks(segments, cells.rounding(), gap_links);
  partner_.resize(sites_.size(), -1);
  assert(HasMutualPartners());
  IndexTriangles();
}

bool SurfaceGraph::HasMutualPartners() const {
  for (std::size_t i = 0; i < partner_.size(); ++i) {
    const int j = partner_[i];
    if (j >= 0 && partner_[j] != static_cast<int>(i)) return false;
  }
  return true;
}

void SurfaceGraph::AddEdgePoints(
    const std::vector<std::array<int, 3>>& neighbors, double spacing) {
  for (std::size_t t = 0; t < neighbors.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int u = neighbors[t][k];
      if (u < static_cast<int>(t)) continue;
      const Vector3d& a = mesh_.vertices[mesh_.triangles[t][k]];
      const Vector3d& b = mesh_.vertices[mesh_.triangles[t][(k + 1) % 3]];
      const double wanted = std::round((b - a).norm() / spacing);
      const int points =
          static_cast<int>(std::clamp(wanted, 1.0, double{kMaxPointsPerEdge}));
      for (int i = 1; i <= points; ++i) {
        SurfaceSite site;
        site.point = a + (double(i) / (points + 1)) * (b - a);
        site.direction = MeanDirection(normals_[t], normals_[u]);
        site.triangle = static_cast<int>(t);
        site.other = u;
        sites_.push_back(site);
      }
    }
  }
}

void SurfaceGraph::AddLink(const SurfaceSite& a, const SurfaceSite& b) {
  const int first = static_cast<int>(sites_.size());
  partner_.resize(sites_.size() + 2, -1);
  partner_[first] = first + 1;
  partner_[first + 1] = first;
  sites_.push_back(a);
  sites_.push_back(b);
}

void SurfaceGraph::AddRays(const FreeCells& cells) {
  for (const CellRay& ray : cells.rays()) {
    SurfaceSite from, to;
    from.point = ray.from;
    to.point = ray.to;
    if (ray.end == CellRay::End::kSurface) {
      to.triangle = ray.to_triangle;
      to.direction = normals_[ray.to_triangle];
    } else if (ray.end == CellRay::End::kOutside && cells.IsAbove(ray.to)) {
      outside_.push_back(static_cast<int>(sites_.size()) + 1);
    } else {
      continue;
    }
    from.triangle = ray.from_triangle;
    from.direction = normals_[ray.from_triangle];
    AddLink(from, to);
  }
}

void SurfaceGraph::AddGapLinks(const TriangleBvh& segments, double rounding,
                               int count) {
  const double reach = ComputeBounds(mesh_).Diagonal();
  const auto link = [&](const SurfaceSite& from) {
    if (from.direction.isZero()) return;
    const TriangleBvh::Hit hit = FirstAbove(from, segments, reach, rounding);
    if (!hit.Found()) return;
    const std::optional<SurfaceSite> to = SiteSeenFrom(
        from.point, from.point + hit.fraction * reach * from.direction,
        hit.triangle, mesh_, segments, rounding);
    if (to) AddLink(from, *to);
  };
  // From the centroids of as many triangles, then from points of edges.
  const std::size_t edge_points = static_cast<std::size_t>(edge_points_);
  const std::size_t triangles = mesh_.triangles.size();
  const std::size_t most = static_cast<std::size_t>(std::max(0, count));
  const std::size_t links = std::min(triangles, most);
  for (std::size_t i = 0; i < links; ++i) {
    const std::size_t t = i * triangles / links;
    const Triangle& corners = mesh_.triangles[t];
    SurfaceSite from;
    from.triangle = static_cast<int>(t);
    from.direction = normals_[t];
    from.point = (mesh_.vertices[corners[0]] + mesh_.vertices[corners[1]] +
                  mesh_.vertices[corners[2]]) /
                 3.0;
    link(from);
  }
  const std::size_t more = std::min(edge_points, most - links);
  for (std::size_t i = 0; i < more; ++i) {
    link(SurfaceSite(sites_[i * edge_points / more]));
  }
}

void SurfaceGraph::IndexTriangles() {
  first_.assign(mesh_.triangles.size() + 1, 0);
  const auto for_each = [&](const auto& visit) {
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (sites_[i].triangle >= 0) visit(sites_[i].triangle, i);
      if (sites_[i].other >= 0) visit(sites_[i].other, i);
    }
  };
  for_each([&](int t, std::size_t) { ++first_[t + 1]; });
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  on_triangle_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each([&](int t, std::size_t i) {
    on_triangle_[next[t]++] = static_cast<int>(i);
  });
}

SurfaceGraph::Route SurfaceGraph::Search(
    const Vector3d& start, const Vector3d& goal,
    const std::vector<Attachment>& attachments, const std::set<Edge>& deleted,
    const std::vector<char>& avoided) const {
  const int count = static_cast<int>(sites_.size());
  const int extra = static_cast<int>(attachments.size());
  const int end = count + extra;  // the goal itself
  std::unordered_map<int, std::vector<int>> attached;
  std::vector<char> has_attachment(mesh_.triangles.size(), 0);
  std::vector<int> outside = outside_;
  for (int i = 0; i < extra; ++i) {
    const Attachment& attachment = attachments[i];
    if (attachment.outside) outside.push_back(count + i);
    if (attachment.site.triangle >= 0) {
      attached[attachment.site.triangle].push_back(count + i);
      has_attachment[attachment.site.triangle] = 1;
    }
  }
  const auto point = [&](int i) -> const Vector3d& {
    if (i == end) return goal;
    return i < count ? sites_[i].point : attachments[i - count].site.point;
  };
  struct Entry {
    double bound;
    int site;
    bool operator<(const Entry& other) const {
      return bound != other.bound ? bound > other.bound : site > other.site;
    }
  };
  std::vector<double> length(end + 1, std::numeric_limits<double>::infinity());
  std::vector<int> before(end + 1, -1);
  std::vector<char> closed(end + 1, 0);
  std::priority_queue<Entry> open;
  const auto offer = [&](int from, int to, double way) {
    if (!(way < length[to])) return;
    if (!deleted.empty() && deleted.count(std::minmax(from, to)) > 0) return;
    length[to] = way;
    before[to] = from;
    open.push({way + (point(to) - goal).norm(), to});
  };
  for (int i = 0; i < extra; ++i) {
    if (attachments[i].to_goal) continue;
    offer(-1, count + i, (attachments[i].site.point - start).norm());
  }
  while (!open.empty()) {
    const int i = open.top().site;
    open.pop();
    if (closed[i]) continue;
    closed[i] = 1;
    if (i == end) break;
    const Vector3d& here = point(i);
    const auto go = [&](int j) {
      if (closed[j]) return;
      const bool avoid = !avoided.empty() && j < count &&
                         sites_[j].triangle >= 0 &&
                         avoided[sites_[j].triangle] != 0;
      offer(i, j,
            length[i] + (avoid ? kDetour : 1.0) * (point(j) - here).norm());
    };
    const SurfaceSite& site =
        i < count ? sites_[i] : attachments[i - count].site;
    for (const int t : {site.triangle, site.other}) {
      if (t < 0) continue;
      ForEachOn(t, go);
      if (!has_attachment[t]) continue;
      const auto found = attached.find(t);
      for (const int j : found->second) go(j);
    }
    if (i < count && partner_[i] >= 0) go(partner_[i]);
    if (i >= count && attachments[i - count].to_goal) go(end);
    if (site.triangle < 0) {
      for (const int j : outside) go(j);
    }
  }
  Route route;
  if (!closed[end]) return route;
  for (int i = before[end]; i >= 0; i = before[i]) route.push_back(i);
  std::reverse(route.begin(), route.end());
  return route;
}

}  // namespace phongpd
