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

namespace {

// A* from the attachments of the start to the goal, itself the last number.
class SurfaceRouteSearch {
 public:
  // Of SurfaceGraph::Search; all outlive this.
  SurfaceRouteSearch(const SurfaceGraph& graph, std::size_t triangles,
                     const Vector3d& start, const Vector3d& goal,
                     const std::vector<Attachment>& attachments,
                     const std::set<SurfaceGraph::Edge>& deleted,
                     const std::vector<char>& avoided)
      : graph_(graph),
        sites_(graph.sites()),
        start_(start),
        goal_(goal),
        attachments_(attachments),
        deleted_(deleted),
        avoided_(avoided),
        count_(static_cast<int>(sites_.size())),
        extra_(static_cast<int>(attachments.size())),
        end_(count_ + extra_),
        has_attachment_(triangles, 0),
        outside_(graph.outside()),
        length_(end_ + 1, std::numeric_limits<double>::infinity()),
        before_(end_ + 1, -1),
        closed_(end_ + 1, 0) {}

  SurfaceGraph::Route Run() {
    IndexAttachments();
    for (int i = 0; i < extra_; ++i) {
      if (attachments_[i].to_goal) continue;
      Offer(-1, count_ + i, (attachments_[i].site.point - start_).norm());
    }
    while (!open_.empty()) {
      const int i = open_.top().site;
      open_.pop();
      if (closed_[i]) continue;
      closed_[i] = 1;
      if (i == end_) break;
      Expand(i);
    }
    return RouteToGoal();
  }

 private:
  struct Entry {
    double bound;
    int site;
    bool operator<(const Entry& other) const {
      return bound != other.bound ? bound > other.bound : site > other.site;
    }
  };

  void IndexAttachments() {
    for (int i = 0; i < extra_; ++i) {
      const Attachment& attachment = attachments_[i];
      if (attachment.outside) outside_.push_back(count_ + i);
      if (attachment.site.triangle >= 0) {
        attached_[attachment.site.triangle].push_back(count_ + i);
        has_attachment_[attachment.site.triangle] = 1;
      }
    }
  }

  // Of all but the goal.
  const SurfaceSite& SiteOf(int i) const {
    return i < count_ ? sites_[i] : attachments_[i - count_].site;
  }
  const Vector3d& PointOf(int i) const {
    return i == end_ ? goal_ : SiteOf(i).point;
  }
  bool IsAvoided(int i) const {
    return !avoided_.empty() && i < count_ && sites_[i].triangle >= 0 &&
           avoided_[sites_[i].triangle] != 0;
  }

  // A way of that length; kept if it is the shortest so far.
  void Offer(int from, int to, double way) {
    if (!(way < length_[to])) return;
    if (!deleted_.empty() && deleted_.count(std::minmax(from, to)) > 0) return;
    length_[to] = way;
    before_[to] = from;
    open_.push({way + (PointOf(to) - goal_).norm(), to});
  }

  // All ways on: over the triangles of the site, its link, to the goal, and
  // away from everything.
  void Expand(int i) {
    const Vector3d& here = PointOf(i);
    const auto go = [&](int j) {
      if (closed_[j]) return;
      Offer(i, j,
            length_[i] + (IsAvoided(j) ? SurfaceGraph::kDetour : 1.0) *
                             (PointOf(j) - here).norm());
    };
    const SurfaceSite& site = SiteOf(i);
    for (const int t : {site.triangle, site.other}) {
      if (t < 0) continue;
      graph_.ForEachOn(t, go);
      if (!has_attachment_[t]) continue;
      const auto found = attached_.find(t);
      for (const int j : found->second) go(j);
    }
    if (i < count_ && graph_.partner(i) >= 0) go(graph_.partner(i));
    if (i >= count_ && attachments_[i - count_].to_goal) go(end_);
    if (site.triangle < 0) {
      for (const int j : outside_) go(j);
    }
  }

  SurfaceGraph::Route RouteToGoal() const {
    SurfaceGraph::Route route;
    if (!closed_[end_]) return route;
    for (int i = before_[end_]; i >= 0; i = before_[i]) route.push_back(i);
    std::reverse(route.begin(), route.end());
    return route;
  }

  const SurfaceGraph& graph_;
  const std::vector<SurfaceSite>& sites_;
  const Vector3d& start_;
  const Vector3d& goal_;
  const std::vector<Attachment>& attachments_;
  const std::set<SurfaceGraph::Edge>& deleted_;
  const std::vector<char>& avoided_;
  const int count_;  // of sites; attachments are numbered after them
  const int extra_;
  const int end_;  // the goal itself

  std::unordered_map<int, std::vector<int>> attached_;  // on a triangle
  std::vector<char> has_attachment_;                    // a triangle
  std::vector<int> outside_;
  // Of the shortest way to each so far, and the number before it there.
  std::vector<double> length_;
  std::vector<int> before_;
  std::vector<char> closed_;
  std::priority_queue<Entry> open_;
};

}  // namespace

SurfaceGraph::Route SurfaceGraph::Search(
    const Vector3d& start, const Vector3d& goal,
    const std::vector<Attachment>& attachments, const std::set<Edge>& deleted,
    const std::vector<char>& avoided) const {
  return SurfaceRouteSearch(*this, mesh_.triangles.size(), start, goal,
                            attachments, deleted, avoided)
      .Run();
}

}  // namespace phongpd
