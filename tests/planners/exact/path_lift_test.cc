// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: exact motion checks on solids whose edges and corners are known.
#include "planners/exact/path_lift.h"

#include <gtest/gtest.h>

#include <vector>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/unit_normal.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/surface_graph.h"
#include "planners/exact/surface_sight.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Seen from everywhere on a lattice around a solid with convex and concave
// edges and corners: every corner and the middle of every edge that is seen
// becomes a site which may be lifted, on a triangle that faces the viewer.
TEST(SurfaceSight, LiftsWhatIsSeenOfEdgesAndCorners) {
  const TriangleMesh mesh = MakeL(4.0, 2.0, 2.0);
  const TriangleBvh segments(mesh);
  const FreeSpace space({TakeAsContactSpace(mesh)});
  std::vector<Vector3d> places = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      places.push_back(0.5 *
                       (mesh.vertices[t[k]] + mesh.vertices[t[(k + 1) % 3]]));
    }
  }
  int sites = 0, unseen = 0;
  for (int code = 0; code < 11 * 11 * 11; ++code) {
    const Vector3d q(0.5 * (code % 11) - 0.5, 0.5 * (code / 11 % 11) - 0.5,
                     0.5 * (code / 121) - 1.5);
    if (!space.IsFree(q)) continue;
    for (const Vector3d& p : places) {
      const TriangleBvh::Hit first = segments.FirstHit(q, p);
      if (!first.Found() || first.fraction < 1.0 - 1e-12) continue;
      const auto site =
          SiteSeenFrom(q, p, first.triangle, mesh, segments, 1e-13);
      unseen += !site;
      if (!site) continue;
      ++sites;
      const Triangle& t = mesh.triangles[site->triangle];
      const Vector3d normal = UnitNormal(mesh, t);
      EXPECT_GT(normal.dot(site->direction), 1e-6);
      // From there to the middle of its triangle, and back to q.
      SurfaceSite middle, viewer;
      middle.triangle = site->triangle;
      middle.direction = normal;
      middle.point =
          (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) /
          3.0;
      viewer.point = q;
      std::vector<Vector3d> path;
      LiftCounts counts;
      EXPECT_TRUE(LiftRoute({viewer, *site, middle}, segments, 0.1, 1e-13,
                            &path, &counts)
                      .empty())
          << q.transpose() << " sees " << p.transpose();
    }
  }
  EXPECT_GT(sites, 5000);
  EXPECT_EQ(unseen, 0);
}

// A viewer who stands on the surface, up to rounding, may be where it looks.
TEST(SurfaceSight, HasNoDirectionWhereTheViewerIsThePlaceItself) {
  // A facet across the lattice of doubles: its centroid rounds to either side.
  const TriangleMesh mesh =
      Rotated(MakeBox({-1, -1, -1}, {1, 1, 1}), GenericRotation());
  const TriangleBvh segments(mesh);
  int seen = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vector3d p =
        (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const auto site =
        SiteSeenFrom(p, p, static_cast<int>(i), mesh, segments, 1e-13);
    if (!site) continue;
    ++seen;
    EXPECT_EQ(site->point, p);
    EXPECT_EQ(site->direction, Vector3d::Zero());
  }
  EXPECT_GT(seen, 0);
}

// The lifts on either side of a segment that stays blocked vanish too; it
// alone is to blame.
TEST(PathLift, BlamesTheSegmentThatNothingFrees) {
  const TriangleBvh segments(MakeBox({-1, -1, -1}, {1, 1, 1}));
  const auto site = [](const Vector3d& p, const Vector3d& direction) {
    SurfaceSite s;
    s.point = p;
    s.direction = direction;
    return s;
  };
  const Vector3d x(1, 0, 0), y(0, 1, 0);
  const std::vector<SurfaceSite> sites = {
      site({3, 0, 0}, Vector3d::Zero()),
      site({1, 0, 0}, x),
      site({1, 0.5, 0}, x),  // and then through the edge at x = y = 1:
      site({0.5, 1, 0}, y),
      site({0, 1, 0}, y),
      site({0, 3, 0}, Vector3d::Zero())};
  std::vector<Vector3d> path;
  LiftCounts counts;
  EXPECT_EQ(LiftRoute(sites, segments, 0.5, 1e-14, &path, &counts),
            std::vector<int>{2});
}

}  // namespace
}  // namespace phongpd
