// SPDX-License-Identifier: GPL-3.0-or-later
// The surface before rounding: vertices and triangles in exact arithmetic.
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Object.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <random>

#include "core/minkowski/arrangement/face_geometry.h"
#include "core/minkowski/arrangement/facet_intersections.h"
#include "core/minkowski/arrangement/plane_arrangement.h"
#include "core/minkowski/cells/cells.h"
#include "core/minkowski/cells/patch_triangulation.h"
#include "core/minkowski/cells/radial_edges.h"
#include "core/minkowski/cells/surface_assembly.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/grid_frame.h"
#include "core/minkowski/operands/solid_collision.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/random_pairs.h"

namespace phongpd {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

Kernel::FT ToExact(const internal::Wide& value) {
  return Kernel::FT(Kernel::FT::Exact_type(value.str()));
}

// The stages of BuildContactSpace up to the arrangement.
struct Stages {
  explicit Stages(const SolidPair& pair) {
    const internal::GridFrame frame =
        internal::PlaceOnGrid(pair.robot, pair.obstacle);
    p = internal::MakeGridSolid(frame.obstacle, pair.obstacle.triangles, false,
                                "obstacle");
    q = internal::MakeGridSolid(frame.robot, pair.robot.triangles, true,
                                "robot");
    convolution = internal::ReducedConvolution(p, q);
    groups = internal::GroupByPlane(convolution);
    const internal::FacetIndex index(convolution);
    const internal::FacetIntersections intersections =
        internal::IntersectFacets(convolution, groups, index, limits, &points);
    arrangement = internal::ArrangePlanes(convolution, groups, intersections,
                                          limits, &points);
  }

  internal::BuildLimits limits{ContactSpaceOptions()};
  internal::GridSolid p, q;
  internal::Convolution convolution;
  internal::PlaneGroups groups;
  internal::ExactPoints points;
  internal::Arrangement arrangement;
};

// And those up to rounding.
std::vector<Kernel::Triangle_3> BuildExactly(const SolidPair& pair) {
  Stages s(pair);
  const internal::RadialEdges radial =
      internal::SortAroundEdges(s.convolution, s.arrangement, s.points);
  const internal::SolidCollision judge(s.p, s.q);
  const internal::FreeCells cells = internal::FindFreeCells(
      s.convolution, s.arrangement, radial, s.points, judge, s.limits);
  const internal::PatchSurface patches = internal::AssembleSurface(
      s.arrangement, s.groups, radial, cells, {}, &s.points);
  const internal::ExactSurface surface =
      internal::TriangulatePatches(patches, s.convolution, s.points);

  std::vector<Kernel::Point_3> vertices;
  for (const int id : surface.vertex_points) {
    const internal::Homogeneous h = Evaluate(s.points[id].definition);
    const Kernel::FT w = ToExact(h.w);
    vertices.emplace_back(ToExact(h.x[0]) / w, ToExact(h.x[1]) / w,
                          ToExact(h.x[2]) / w);
    vertices.back().exact();
  }
  std::vector<Kernel::Triangle_3> triangles;
  for (const auto& [i, j, k] : surface.triangles) {
    triangles.emplace_back(vertices[i], vertices[j], vertices[k]);
  }
  return triangles;
}

bool AreOnOneEdge(const Kernel::Triangle_3& triangle, const Kernel::Point_3& p,
                  const Kernel::Point_3& q) {
  for (int k = 0; k < 3; ++k) {
    const Kernel::Segment_3 edge(triangle[k], triangle[k + 1]);
    if (edge.has_on(p) && edge.has_on(q)) return true;
  }
  return false;
}

// Whether two triangles share more than parts of their edges.
bool MeetProperly(const Kernel::Triangle_3& s, const Kernel::Triangle_3& t) {
  const CGAL::Object part = CGAL::intersection(s, t);
  if (part.is_empty()) return false;
  if (const auto* p = CGAL::object_cast<Kernel::Point_3>(&part)) {
    return !AreOnOneEdge(s, *p, *p) || !AreOnOneEdge(t, *p, *p);
  }
  if (const auto* e = CGAL::object_cast<Kernel::Segment_3>(&part)) {
    return !AreOnOneEdge(s, e->source(), e->target()) ||
           !AreOnOneEdge(t, e->source(), e->target());
  }
  return true;
}

int CountDegenerate(const std::vector<Kernel::Triangle_3>& triangles) {
  int count = 0;
  for (const auto& t : triangles) count += t.is_degenerate();
  return count;
}

int CountSelfIntersections(const std::vector<Kernel::Triangle_3>& triangles) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    boxes.emplace_back(triangles[i].bbox(), i);
  }
  int count = 0;
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        count += MeetProperly(triangles[a.info()], triangles[b.info()]);
      });
  return count;
}

class ExactSurface : public ::testing::TestWithParam<PairKind> {};

TEST_P(ExactSurface, HasNoSelfIntersectionBeforeRounding) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto triangles = BuildExactly(MakeRandomPair(GetParam(), seed));
    EXPECT_GT(triangles.size(), 0U);
    EXPECT_EQ(CountDegenerate(triangles), 0);
    EXPECT_EQ(CountSelfIntersections(triangles), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, ExactSurface,
                         ::testing::ValuesIn(AllPairKinds()));

// Each face found where the ray meets its own plane: beside an edge two faces
// found two places, and the ray passed between them or hit both.
TEST(FaceGeometry, NoRaySlipsBetweenTwoFaces) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  SolidPair convex;  // a ray from inside hits its sum once
  convex.robot =
      Rotated(MakeBox({-1, -2, -3}, {1, 2, 3}), RandomRotation(&random));
  convex.obstacle = MakeIcoBall(2.0, 2);
  SolidPair lattice;
  lattice.robot = lattice.obstacle = MakeBox({-1, -1, -1}, {1, 1, 1});
  for (const SolidPair& pair : {convex, lattice}) {
    const Stages s(pair);
    internal::FaceGeometry geometry(s.convolution, s.arrangement, s.points);
    int wrong = 0;
    for (const bool tree : {false, true}) {
      if (tree) geometry.BuildTree();
      for (const internal::HalfEdge& e : s.arrangement.half_edges) {
        const Eigen::Vector3d& a = s.points.Approximate(e.from);
        const Eigen::Vector3d& b = s.points.Approximate(e.to);
        for (const double t : {0.0, 0.5, unit(random)}) {
          const Eigen::Vector3d ray = (a + t * (b - a)).normalized();
          const Eigen::Vector3d from = -1e3 * unit(random) * ray;
          wrong += geometry.AllHits(from, ray, -1).size() != 1U;
        }
      }
    }
    EXPECT_EQ(wrong, 0);
  }
}

}  // namespace
}  // namespace phongpd
