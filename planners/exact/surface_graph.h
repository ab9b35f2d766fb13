// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/exact/free_cells.h"

namespace phongpd {

// A place a path may pass: a point of the surface, to be lifted off it along
// `direction`, or a point away from everything.
struct SurfaceSite {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction =
      Eigen::Vector3d::Zero();  // unit; zero: not lifted
  int triangle = -1;            // it lies on; −1: none
  int other = -1;               // the other one where it lies on an edge
};

// What a ray from the site along its direction meets first within `reach`,
// without the triangles the site lies on and those within `rounding`; fraction
// 1 if nothing.
TriangleBvh::Hit FirstAbove(const SurfaceSite& site,
                            const TriangleBvh& segments, double reach,
                            double rounding);

// How the configurations start and goal see the surface.
struct Attachment {
  SurfaceSite site;  // free to see from the configuration
  bool to_goal = false;
  bool outside = false;  // the site is one of the outside (below)
};

// The roadmap that a closed surface is for every free cell around it: points
// of its edges, joined when they lie on one triangle; and links, segments
// through free space between two triangles.  Nothing is lifted or tested here.
class SurfaceGraph {
 public:
  // Edges get a point per `spacing` > 0 of their length (between 1 and 6), at
  // most `gap_links` triangles, and points of edges if triangles are fewer, a
  // link across the free gap in front of them.
  // All must outlive this.
  SurfaceGraph(const TriangleMesh& mesh,
               const std::vector<std::array<int, 3>>& neighbors,
               const TriangleBvh& segments, const FreeCells& cells,
               double spacing, int gap_links);

  const std::vector<SurfaceSite>& sites() const { return sites_; }

  // The first sites are so many points of edges, those of an edge in a row.
  int edge_points() const { return edge_points_; }
  // The other end of a site's link; −1: it has none.
  int partner(int site) const { return partner_[site]; }
  // Sites away from everything, which all see each other.
  const std::vector<int>& outside() const { return outside_; }
  // Calls visit(site) for the sites on a triangle.
  template <typename Visit>
  void ForEachOn(int triangle, const Visit& visit) const {
    for (int k = first_[triangle]; k < first_[triangle + 1]; ++k) {
      visit(on_triangle_[k]);
    }
  }

  // Unit normal of a triangle; zero if it has no area.
  const Eigen::Vector3d& normal(int triangle) const {
    return normals_[triangle];
  }

  static constexpr double kDetour = 3.0;
  using Edge = std::pair<int, int>;  // of sites, the smaller first
  // Numbers of sites; attachment i is number sites().size() + i.
  using Route = std::vector<int>;

  // The shortest route (A*, by distances on the surface and along links) from
  // an attachment of the start to one of the goal without the edges in
  // `deleted`; empty if there is none.  Ways to triangles that are `avoided`
  // (empty: none) count kDetour times: that finds routes of another kind.
  Route Search(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
               const std::vector<Attachment>& attachments,
               const std::set<Edge>& deleted,
               const std::vector<char>& avoided) const;

 private:
  void AddEdgePoints(const std::vector<std::array<int, 3>>& neighbors,
                     double spacing);
  void AddRays(const FreeCells& cells);
  void AddGapLinks(const TriangleBvh& segments, double rounding, int count);
  void AddLink(const SurfaceSite& a, const SurfaceSite& b);
  bool HasMutualPartners() const;
  void IndexTriangles();

  const TriangleMesh& mesh_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<SurfaceSite> sites_;
  int edge_points_ = 0;
  std::vector<int> partner_;  // of a site
  std::vector<int> outside_;
  std::vector<int> first_;  // of a triangle, into on_triangle_
  std::vector<int> on_triangle_;
};

}  // namespace phongpd
