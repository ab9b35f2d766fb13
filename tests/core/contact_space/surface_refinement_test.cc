// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/surface_refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/mesh/surface_tree.h"
#include "core/mesh/triangle_quality.h"
#include "problems/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct Pair {
  std::string name;
  TriangleMesh robot;
  TriangleMesh obstacle;
};

std::vector<Pair> Pairs() {
  std::mt19937_64 random(7);
  return {
      {"cone, axes", MakeCone(0.8, 1.6, 20), MakeAxes(2, 0.2)},
      {"wrench, L", MakeWrench(0.5, 12, 12, 8, 8), MakeL(3, 1, 1)},
      {"star, torus", MakeStar(0.5, 1.2),
       Rotated(MakeTorus(2, 0.6, 16, 8), testing::RandomRotation(&random))},
  };
}

ContactSpaceOptions Refined(double target_edge, double grading = 0.25) {
  ContactSpaceOptions options;
  options.refine.target_edge = target_edge;
  options.refine.grading = grading;
  return options;
}

std::array<Vector3d, 3> Corners(const TriangleMesh& mesh, std::size_t t) {
  const Triangle& v = mesh.triangles[t];
  return {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]};
}

Vector3d Normal(const std::array<Vector3d, 3>& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

using Long = Eigen::Matrix<long double, 3, 1>;

double SegmentDistance(const Vector3d& a, const Vector3d& b,
                       const Vector3d& x) {
  const Long along = b.cast<long double>() - a.cast<long double>();
  const Long to = x.cast<long double>() - a.cast<long double>();
  const long double length = along.squaredNorm();
  long double t = length > 0 ? to.dot(along) / length : 0;
  t = std::clamp(t, 0.0L, 1.0L);
  return static_cast<double>((to - t * along).norm());
}

// In long double, and the edges always: slivers cost digits.
double Distance(const std::array<Vector3d, 3>& c, const Vector3d& x) {
  const Long a = c[0].cast<long double>(), b = c[1].cast<long double>(),
             d = c[2].cast<long double>(), p = x.cast<long double>();
  const Long n = (b - a).cross(d - a);
  double nearest =
      std::min({SegmentDistance(c[0], c[1], x), SegmentDistance(c[1], c[2], x),
                SegmentDistance(c[2], c[0], x)});
  if (n.dot((b - a).cross(p - a)) >= 0 && n.dot((d - b).cross(p - b)) >= 0 &&
      n.dot((a - d).cross(p - d)) >= 0 && n.squaredNorm() > 0) {
    nearest = std::min(nearest,
                       static_cast<double>(std::abs(n.dot(p - a)) / n.norm()));
  }
  return nearest;
}

std::map<int, std::vector<std::size_t>> ByPlane(const ContactSpace& space) {
  std::map<int, std::vector<std::size_t>> planes;
  for (std::size_t t = 0; t < space.plane.size(); ++t) {
    planes[space.plane[t]].push_back(t);
  }
  return planes;
}

// Every triangle of `fine` lies on triangles of `coarse` with its plane id,
// within `tolerance`, and is turned like them; each plane keeps its area.
void ExpectSameSurface(const ContactSpace& coarse, const ContactSpace& fine,
                       double tolerance) {
  EXPECT_TRUE(fine.report.closed);
  EXPECT_TRUE(fine.report.manifold);
  EXPECT_EQ(fine.report.components, coarse.report.components);
  EXPECT_EQ(fine.report.genus, coarse.report.genus);
  EXPECT_EQ(fine.report.cavities, coarse.report.cavities);
  EXPECT_EQ(fine.report.degenerate_triangles,
            coarse.report.degenerate_triangles);
  EXPECT_NEAR(fine.report.volume, coarse.report.volume,
              1e-13 * coarse.report.volume);
  const double whole = SurfaceArea(coarse.mesh);
  EXPECT_NEAR(SurfaceArea(fine.mesh), whole, 1e-13 * whole);
  const auto before = ByPlane(coarse), after = ByPlane(fine);
  ASSERT_EQ(before.size(), after.size());
  double worst = 0.0;
  for (const auto& [plane, triangles] : after) {
    const std::vector<std::size_t>& patch = before.at(plane);
    Vector3d normal = Vector3d::Zero(), sum = Vector3d::Zero();
    for (const std::size_t s : patch) normal += Normal(Corners(coarse.mesh, s));
    for (const std::size_t t : triangles) {
      const std::array<Vector3d, 3> c = Corners(fine.mesh, t);
      sum += Normal(c);
      EXPECT_GT(Normal(c).dot(normal), 0.0);
      for (const Vector3d& x :
           {c[0], c[1], c[2], Vector3d(0.5 * (c[0] + c[1])),
            Vector3d(0.5 * (c[1] + c[2])), Vector3d(0.5 * (c[2] + c[0])),
            Vector3d((c[0] + c[1] + c[2]) / 3.0)}) {
        double nearest = HUGE_VAL;
        for (const std::size_t s : patch) {
          nearest = std::min(nearest, Distance(Corners(coarse.mesh, s), x));
        }
        worst = std::max(worst, nearest);
      }
    }
    EXPECT_LT((sum - normal).norm(), 1e-13 * whole);
  }
  EXPECT_LT(worst, tolerance);
}

double LargestCoordinate(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Vector3d& v : mesh.vertices) {
    largest = std::max(largest, v.lpNorm<Eigen::Infinity>());
  }
  return largest;
}

TEST(SurfaceRefinement, LeavesTheSurfaceAsItIs) {
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace coarse = BuildContactSpace(pair.robot, pair.obstacle);
    for (const double target : {0.3, 0.06}) {
      const ContactSpace fine =
          BuildContactSpace(pair.robot, pair.obstacle, Refined(target));
      EXPECT_GT(fine.report.triangles, coarse.report.triangles);
      // The promised bound; the other route rounds too.
      ExpectSameSurface(coarse, fine, 2e-15 * LargestCoordinate(coarse.mesh));
      EXPECT_EQ(fine.report.self_intersections,
                coarse.report.self_intersections);
    }
  }
}

TEST(SurfaceRefinement, LeavesRandomSurfacesAsTheyAre) {
  // Patches with holes, patches that touch themselves, cavities.
  std::mt19937_64 random(11);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TriangleMesh a = testing::RandomVoxelSolid(2, 0.5, &random);
    TriangleMesh b = testing::RandomVoxelSolid(3, 0.5, &random);
    // Aligned, generic, and turned alike.
    const Eigen::Matrix3d turn = testing::RandomRotation(&random);
    if (i % 3 > 0) a = Rotated(a, turn);
    if (i % 3 > 1) b = Rotated(b, turn);
    const ContactSpace coarse = BuildContactSpace(a, b);
    const ContactSpace fine = BuildContactSpace(a, b, Refined(0.1, 0.5));
    ExpectSameSurface(coarse, fine, 2e-15 * LargestCoordinate(coarse.mesh));
  }
}

TEST(SurfaceRefinement, StaysOnTheSurfaceFarFromTheOrigin) {
  const Vector3d far(1e6, -3e6, 2e6);
  const TriangleMesh robot = MakeCone(0.8, 1.6, 20);
  const TriangleMesh obstacle = Translated(MakeAxes(2, 0.2), far);
  const ContactSpace coarse = BuildContactSpace(robot, obstacle);
  const ContactSpace fine = BuildContactSpace(robot, obstacle, Refined(0.05));
  EXPECT_TRUE(fine.report.manifold);
  const double ulp = 2e-16 * LargestCoordinate(coarse.mesh);
  EXPECT_NEAR(fine.report.volume, coarse.report.volume,
              ulp * SurfaceArea(coarse.mesh));
  const SurfaceTree tree(coarse.mesh);
  for (const Vector3d& v : fine.mesh.vertices) {
    EXPECT_LT(tree.FindClosest(v).distance, 10 * ulp);
  }
}

// h(x) from the definition: sharp edges by facet normals, brute force.
TEST(SurfaceRefinement, NoEdgeIsLongerThanTheGradedLength) {
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const double target = 0.1, grading = 0.3;
    const ContactSpace coarse = BuildContactSpace(pair.robot, pair.obstacle);
    const ContactSpace fine =
        BuildContactSpace(pair.robot, pair.obstacle, Refined(target, grading));
    const double longest = target * ComputeBounds(coarse.mesh).Diagonal();
    const auto neighbors = TriangleNeighbors(coarse.mesh);
    std::vector<std::array<Vector3d, 2>> sharp;
    for (std::size_t t = 0; t < neighbors.size(); ++t) {
      const std::array<Vector3d, 3> c = Corners(coarse.mesh, t);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto o = static_cast<std::size_t>(neighbors[t][k]);
        const double angle = std::acos(
            std::clamp(Normal(c).normalized().dot(
                           Normal(Corners(coarse.mesh, o)).normalized()),
                       -1.0, 1.0));
        if (angle > 20.001 * M_PI / 180)
          sharp.push_back({c[k], c[(k + 1) % 3]});
      }
    }
    ASSERT_FALSE(sharp.empty());
    double near_sum = 0.0, near_count = 0.0, far_length = 0.0;
    for (std::size_t t = 0; t < fine.mesh.triangles.size(); ++t) {
      const std::array<Vector3d, 3> c = Corners(fine.mesh, t);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d a = c[k], b = c[(k + 1) % 3], x = 0.5 * (a + b);
        double d = HUGE_VAL;
        for (const auto& [p, q] : sharp) {
          d = std::min(d, SegmentDistance(p, q, x));
        }
        const double wanted = std::min(longest, grading * longest + d / 2);
        EXPECT_LE((a - b).norm(), wanted * (1 + 1e-6));
        if (d < 1e-14) near_sum += (a - b).norm(), ++near_count;
        far_length = std::max(far_length, (a - b).norm());
      }
    }
    // Graded indeed: fine at sharp edges, coarse somewhere.
    EXPECT_LT(near_sum / near_count, grading * longest);
    EXPECT_GT(far_length, 1.1 * grading * longest);
  }
}

TEST(SurfaceRefinement, ImprovesTheTriangles) {
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace coarse = BuildContactSpace(pair.robot, pair.obstacle);
    const ContactSpace fine =
        BuildContactSpace(pair.robot, pair.obstacle, Refined(0.05));
    EXPECT_GT(fine.report.median_quality, 0.75);
    EXPECT_GT(fine.report.median_quality, coarse.report.median_quality);
    EXPECT_GE(fine.report.worst_quality, 0.5 * coarse.report.worst_quality);
    EXPECT_EQ(fine.report.worst_quality, MeasureQuality(fine.mesh).worst);
  }
  // Nothing but right angles: no sliver at all.
  for (const double target : {0.5, 0.1, 0.03}) {
    const ContactSpace box =
        BuildContactSpace(MakeBox({0, 0, 0}, {1, 1, 1}),
                          MakeBox({0, 0, 0}, {9, 1, 0.5}), Refined(target));
    EXPECT_GT(box.report.worst_quality, 0.4);
  }
}

TEST(SurfaceRefinement, ScalesBitForBit) {
  const Pair pair = Pairs()[2];
  const ContactSpace one =
      BuildContactSpace(pair.robot, pair.obstacle, Refined(0.1));
  const double factor = std::ldexp(1.0, -200);
  ContactSpace small = BuildContactSpace(pair.robot, pair.obstacle);
  small.mesh = Scaled(small.mesh, factor);
  internal::RefineSurface(Refined(0.1).refine, &small);
  EXPECT_EQ(small.mesh.triangles, one.mesh.triangles);
  EXPECT_EQ(small.plane, one.plane);
  EXPECT_EQ(Scaled(small.mesh, 1 / factor).vertices, one.mesh.vertices);
}

TEST(SurfaceRefinement, LeavesTrianglesWithoutAreaAlone) {
  // A box with a vertex on one edge, joined by a triangle without area.
  ContactSpace space;
  space.mesh = MakeBox({0, 0, 0}, {1, 1, 1});
  const Triangle first = space.mesh.triangles[0];
  const int middle = 8;
  space.mesh.vertices.push_back(
      0.5 * (space.mesh.vertices[first[0]] + space.mesh.vertices[first[1]]));
  space.mesh.triangles[0] = {first[0], middle, first[2]};
  space.mesh.triangles.push_back({middle, first[1], first[2]});
  space.mesh.triangles.push_back({first[0], first[1], middle});
  const std::size_t flat = space.mesh.triangles.size() - 1;
  std::map<std::array<double, 3>, int> ids;
  for (std::size_t t = 0; t <= flat; ++t) {
    const Vector3d n = Normal(Corners(space.mesh, t)).normalized();
    space.plane.push_back(
        t == flat ? 99
                  : ids.emplace(std::array<double, 3>{n[0], n[1], n[2]},
                                static_cast<int>(ids.size()))
                        .first->second);
    space.kind.push_back(ContactKind::kEdges);
  }
  const Triangle kept = space.mesh.triangles[flat];
  internal::RefineSurface(Refined(0.1).refine, &space);
  EXPECT_EQ(space.mesh.triangles[flat], kept);
  EXPECT_NEAR(SignedVolume(space.mesh), 1.0, 1e-13);
  const MeshReport found = ExamineMesh(space.mesh);
  EXPECT_EQ(found.boundary_edges + found.non_manifold_edges, 0U);
  EXPECT_EQ(found.degenerate_triangles, 1U);
  EXPECT_GT(found.triangles, 1000U);
}

TEST(SurfaceRefinement, RefusesWhatCannotBe) {
  const TriangleMesh cube = MakeBox({0, 0, 0}, {1, 1, 1});
  const auto message = [&](const ContactSpaceOptions& options) {
    try {
      BuildContactSpace(cube, cube, options);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(Refined(1e-5)).find("refine.target_edge"),
            std::string::npos);
  EXPECT_NE(message(Refined(-0.1)).find("[0, 1]"), std::string::npos);
  EXPECT_NE(message(Refined(NAN)).find("nan"), std::string::npos);
  EXPECT_NE(message(Refined(0.1, 0.0)).find("grading"), std::string::npos);
  ContactSpaceOptions angle = Refined(0.1);
  angle.refine.sharp_angle_degrees = 181;
  EXPECT_NE(message(angle).find("sharp_angle_degrees"), std::string::npos);
  EXPECT_EQ(message(Refined(1.0, 1.0)), "");
}

}  // namespace
}  // namespace phongpd
