// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: sites looked up one by one, and routes by Bellman and Ford on the
// graph as its accessors tell it.
#include "planners/exact/surface_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "core/bvh/closest_on_triangle.h"
#include "planners/exact/free_neighbors.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct World {
  explicit World(TriangleMesh surface, double spacing, int gap_links)
      : mesh(std::move(surface)),
        neighbors(FreeNeighbors(mesh)),
        segments(mesh),
        cells(mesh, neighbors, segments),
        graph(mesh, neighbors, segments, cells, spacing, gap_links) {}

  TriangleMesh mesh;
  std::vector<std::array<int, 3>> neighbors;
  TriangleBvh segments;
  FreeCells cells;
  SurfaceGraph graph;
};

// Three pieces beside each other: links across gaps, sites outside.
TriangleMesh Pieces() {
  return Joined(Joined(MakeBox({-1, -1, -1}, {1, 1, 1}), MakeL(3, 1, 1)),
                Translated(MakeCone(0.8, 1.6, 8), {4.5, 0.3, 0.2}));
}

TriangleMesh Apart() {
  return Joined(Joined(MakeBox({-1, -1, -1}, {1, 1, 1}),
                       Translated(MakeL(3, 1, 1), {0.1, 0.2, 4.0})),
                Translated(MakeCone(0.8, 1.6, 8), {4.5, 0.3, 0.2}));
}

double DistanceTo(const TriangleMesh& mesh, int t, const Vector3d& p) {
  const Triangle& c = mesh.triangles[static_cast<std::size_t>(t)];
  const auto corner = [&](std::size_t k) {
    return mesh.vertices[static_cast<std::size_t>(c[k])];
  };
  return std::sqrt(
      ClosestOnTriangle(corner(0), corner(1), corner(2), p).squared_distance);
}

TEST(SurfaceGraph, HasPointsOnEveryEdgeByItsLength) {
  const World world(Apart(), 0.7, 0);
  const auto& sites = world.graph.sites();
  int site = 0;
  for (std::size_t t = 0; t < world.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int u = world.neighbors[t][k];
      if (u < static_cast<int>(t)) continue;
      const auto corner = [&](std::size_t i) {
        return world.mesh
            .vertices[static_cast<std::size_t>(world.mesh.triangles[t][i % 3])];
      };
      const double length = (corner(k + 1) - corner(k)).norm();
      const int points =
          std::min(6, std::max(1, static_cast<int>(std::lround(length / 0.7))));
      for (int i = 0; i < points; ++i, ++site) {
        ASSERT_LT(site, world.graph.edge_points());
        const SurfaceSite& at = sites[static_cast<std::size_t>(site)];
        EXPECT_EQ(std::minmax(at.triangle, at.other),
                  std::minmax(static_cast<int>(t), u));
        // Evenly spread between the corners, which get none.
        const double way = (at.point - corner(k)).norm() / length;
        EXPECT_NEAR(way, (i + 1.0) / (points + 1.0), 1e-12);
        EXPECT_LT(DistanceTo(world.mesh, u, at.point), 1e-12);
        // Above both triangles, or along a fold.
        EXPECT_NEAR(at.direction.norm(), 1.0, 1e-12);
        EXPECT_GE(at.direction.dot(world.graph.normal(at.triangle)), -1e-12);
        EXPECT_GE(at.direction.dot(world.graph.normal(at.other)), -1e-12);
      }
    }
  }
  EXPECT_EQ(site, world.graph.edge_points());
  EXPECT_GT(site, static_cast<int>(world.mesh.triangles.size()));
}

TEST(SurfaceGraph, IndexesEverySiteByItsTriangles) {
  const World world(Apart(), 0.5, 40);
  const auto& sites = world.graph.sites();
  for (std::size_t t = 0; t < world.mesh.triangles.size(); ++t) {
    std::multiset<int> listed, expected;
    world.graph.ForEachOn(static_cast<int>(t),
                          [&](int i) { listed.insert(i); });
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (sites[i].triangle == static_cast<int>(t) ||
          sites[i].other == static_cast<int>(t)) {
        expected.insert(static_cast<int>(i));
      }
    }
    EXPECT_EQ(listed, expected);
  }
}

// Nothing lies between the two ends of a link, a little off the surface.
TEST(SurfaceGraph, LinksRunThroughFreeSpace) {
  const World world(Apart(), 0.5, 60);
  const auto& sites = world.graph.sites();
  int links = 0;
  std::set<std::pair<int, int>> pieces;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const int j = world.graph.partner(static_cast<int>(i));
    if (j < 0) continue;
    EXPECT_EQ(world.graph.partner(j), static_cast<int>(i));
    EXPECT_NE(j, static_cast<int>(i));
    const Vector3d& a = sites[i].point;
    const Vector3d& b = sites[static_cast<std::size_t>(j)].point;
    const Vector3d step = 1e-6 * (b - a).normalized();
    EXPECT_FALSE(world.segments.Meets(a + step, b - step));
    ++links;
    const int s = sites[i].triangle,
              t = sites[static_cast<std::size_t>(j)].triangle;
    if (s < 0 || t < 0) continue;
    EXPECT_LT(DistanceTo(world.mesh, s, a), 1e-9);
    const auto piece = [&](int k) {
      return world.cells.piece()[static_cast<std::size_t>(k)];
    };
    if (piece(s) != piece(t)) pieces.insert({piece(s), piece(t)});
  }
  EXPECT_GT(links, 10);
  EXPECT_GE(pieces.size(), 4U);  // each pair, both ways
  for (const int i : world.graph.outside()) {
    EXPECT_TRUE(world.cells.IsAbove(sites[static_cast<std::size_t>(i)].point));
  }
}

// The graph as its header tells it, all edges, with attachments.
class Truth {
 public:
  Truth(const World& world, const std::vector<Attachment>& attachments)
      : world_(world), attachments_(attachments) {}

  std::size_t size() const {
    return world_.graph.sites().size() + attachments_.size();
  }
  const SurfaceSite& Site(std::size_t i) const {
    const std::size_t count = world_.graph.sites().size();
    return i < count ? world_.graph.sites()[i] : attachments_[i - count].site;
  }
  bool AreJoined(std::size_t i, std::size_t j) const {
    const SurfaceSite &a = Site(i), &b = Site(j);
    for (const int t : {a.triangle, a.other}) {
      if (t >= 0 && (b.triangle == t || b.other == t)) return true;
    }
    const std::size_t count = world_.graph.sites().size();
    if (i < count &&
        world_.graph.partner(static_cast<int>(i)) == static_cast<int>(j)) {
      return true;
    }
    return IsOutside(i) && IsOutside(j);
  }
  // The length of the shortest route that keeps to the rules; ∞: none.
  double Shortest(const Vector3d& start, const Vector3d& goal,
                  const std::set<SurfaceGraph::Edge>& deleted,
                  const std::vector<char>& avoided) const {
    const double kInfinity = std::numeric_limits<double>::infinity();
    const std::size_t count = world_.graph.sites().size();
    std::vector<double> length(size(), kInfinity);
    for (std::size_t i = count; i < size(); ++i) {
      const Attachment& a = attachments_[i - count];
      if (!a.to_goal) length[i] = (a.site.point - start).norm();
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < size(); ++i) {
        if (length[i] == kInfinity) continue;
        for (std::size_t j = 0; j < size(); ++j) {
          if (i == j || !AreJoined(i, j) ||
              deleted.count(
                  std::minmax(static_cast<int>(i), static_cast<int>(j))) > 0) {
            continue;
          }
          const double way = length[i] + Cost(i, j, avoided);
          changed = changed || way < length[j];
          length[j] = std::min(length[j], way);
        }
      }
    }
    double best = kInfinity;
    for (std::size_t i = count; i < size(); ++i) {
      const Attachment& a = attachments_[i - count];
      if (!a.to_goal) continue;
      best = std::min(best, length[i] + (a.site.point - goal).norm());
    }
    return best;
  }
  double Cost(std::size_t i, std::size_t j,
              const std::vector<char>& avoided) const {
    const int t = Site(j).triangle;
    const bool avoid = !avoided.empty() && t >= 0 &&
                       j < world_.graph.sites().size() &&
                       avoided[static_cast<std::size_t>(t)] != 0;
    return (avoid ? SurfaceGraph::kDetour : 1.0) *
           (Site(i).point - Site(j).point).norm();
  }

 private:
  bool IsOutside(std::size_t i) const {
    const std::size_t count = world_.graph.sites().size();
    if (i >= count) return attachments_[i - count].outside;
    const std::vector<int>& outside = world_.graph.outside();
    return std::find(outside.begin(), outside.end(), static_cast<int>(i)) !=
           outside.end();
  }

  const World& world_;
  const std::vector<Attachment>& attachments_;
};

// A site in the middle of a triangle, off which the configuration is.
Attachment MiddleOf(const World& world, int t, bool to_goal) {
  Attachment a;
  const Triangle& c = world.mesh.triangles[static_cast<std::size_t>(t)];
  for (const int v : c) {
    a.site.point += world.mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
  }
  a.site.direction = world.graph.normal(t);
  a.site.triangle = t;
  a.to_goal = to_goal;
  return a;
}

TEST(SurfaceGraph, FindsTheShortestRoute) {
  std::mt19937_64 random(9);
  int found = 0, none = 0, longer = 0;
  for (const bool apart : {true, false}) {
    const World world(apart ? Apart() : Pieces(), 1.0, apart ? 12 : 0);
    const int triangles = static_cast<int>(world.mesh.triangles.size());
    for (int round = 0; round < 25; ++round) {
      const auto pick = [&] {
        return static_cast<int>(random() % static_cast<unsigned>(triangles));
      };
      const std::vector<Attachment> attachments = {
          MiddleOf(world, pick(), false), MiddleOf(world, pick(), false),
          MiddleOf(world, pick(), true)};
      const Vector3d start =
          attachments[0].site.point + 0.3 * attachments[0].site.direction;
      const Vector3d goal =
          attachments[2].site.point + 0.3 * attachments[2].site.direction;
      const Truth truth(world, attachments);
      std::set<SurfaceGraph::Edge> deleted;
      std::vector<char> avoided;
      if (round % 3 == 2) {
        for (int t = 0; t < triangles; ++t) {
          avoided.push_back(static_cast<char>(random() % 2));
        }
      }
      // The shortest one, then without an edge of it, and another.
      double before = 0.0;
      for (int turn = 0; turn < 4; ++turn) {
        const SurfaceGraph::Route route =
            world.graph.Search(start, goal, attachments, deleted, avoided);
        const double shortest = truth.Shortest(start, goal, deleted, avoided);
        if (route.empty()) {
          EXPECT_EQ(shortest, std::numeric_limits<double>::infinity());
          ++none;
          break;
        }
        ++found;
        double length =
            (truth.Site(static_cast<std::size_t>(route.front())).point - start)
                .norm() +
            (truth.Site(static_cast<std::size_t>(route.back())).point - goal)
                .norm();
        for (std::size_t k = 1; k < route.size(); ++k) {
          const auto i = static_cast<std::size_t>(route[k - 1]);
          const auto j = static_cast<std::size_t>(route[k]);
          EXPECT_TRUE(truth.AreJoined(i, j));
          EXPECT_EQ(deleted.count(std::minmax(route[k - 1], route[k])), 0U);
          length += truth.Cost(i, j, avoided);
        }
        EXPECT_NEAR(length, shortest, 1e-12 * shortest);
        EXPECT_GE(length, before - 1e-12);
        longer += length > before + 1e-9 && turn > 0;
        before = length;
        if (route.size() < 2) break;
        const std::size_t cut = random() % (route.size() - 1);
        deleted.insert(std::minmax(route[cut], route[cut + 1]));
      }
    }
  }
  EXPECT_GT(found, 80);
  EXPECT_GT(none, 0);
  EXPECT_GT(longer, 20);
}

}  // namespace
}  // namespace phongpd
