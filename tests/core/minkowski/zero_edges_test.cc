// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of length zero, put in by hand: the truth is the mesh without them.
#include "core/minkowski/arrangement/zero_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/solid/mesh_check.h"
#include "problems/shapes/shapes.h"
#include "tests/support/random_pairs.h"

namespace phongpd {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

// The triangles as sorted triples of coordinates, sorted.
std::vector<Corners> Described(const TriangleMesh& mesh) {
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& v = mesh.vertices[t[k]];
      corners[k] = {v.x(), v.y(), v.z()};
    }
    std::sort(corners.begin(), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Splits edge k of triangle t by a new vertex in the place of its first end.
void SplitAtEnd(std::size_t t, std::size_t k, TriangleMesh* mesh) {
  const int u = mesh->triangles[t][k], w = mesh->triangles[t][(k + 1) % 3];
  const int middle = static_cast<int>(mesh->vertices.size());
  mesh->vertices.push_back(Eigen::Vector3d(mesh->vertices[u]));
  for (std::size_t s = 0, count = mesh->triangles.size(); s < count; ++s) {
    Triangle& near_w = mesh->triangles[s];
    if (std::count(near_w.begin(), near_w.end(), u) +
            std::count(near_w.begin(), near_w.end(), w) <
        2) {
      continue;
    }
    Triangle thin = near_w;
    std::replace(near_w.begin(), near_w.end(), u, middle);
    std::replace(thin.begin(), thin.end(), w, middle);
    mesh->triangles.push_back(thin);
  }
}

void ExpectUntouched(const TriangleMesh& mesh) {
  TriangleMesh result = mesh;
  EXPECT_EQ(internal::CollapseZeroEdges(&result).size(), mesh.triangles.size());
  EXPECT_EQ(result.triangles, mesh.triangles);
  EXPECT_EQ(result.vertices, mesh.vertices);
}

TEST(CollapseZeroEdges, LeavesTheMeshThatWasSplit) {
  const TriangleMesh ball = MakeIcoBall(1.0, 2);
  TriangleMesh mesh = ball;
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {  // some where others were before
    SplitAtEnd(random() % ball.triangles.size(), random() % 3, &mesh);
  }
  ASSERT_EQ(ExamineMesh(mesh).boundary_edges, 0U);
  ASSERT_EQ(mesh.triangles.size(), ball.triangles.size() + 120);
  const TriangleMesh split = mesh;
  const std::vector<int> kept = internal::CollapseZeroEdges(&mesh);
  EXPECT_EQ(Described(mesh), Described(ball));
  EXPECT_EQ(mesh.vertices.size(), ball.vertices.size());
  const MeshReport report = ExamineMesh(mesh);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges +
                report.misoriented_edges,
            0U);
  ASSERT_EQ(kept.size(), mesh.triangles.size());
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  for (std::size_t t = 0; t < kept.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.vertices[mesh.triangles[t][k]],
                split.vertices[split.triangles[kept[t]][k]]);
    }
  }
}

TEST(CollapseZeroEdges, PinchesNothing) {
  ExpectUntouched(MakeIcoBall(1.0, 1));
  // A tetrahedron has nothing to spare.
  ExpectUntouched({{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
  // An hourglass whose waist is a triangle with two equal corners.
  TriangleMesh hourglass;
  for (const double r : {2.0, 1.0, 2.0}) {
    const double z = 3.0 * static_cast<double>(hourglass.vertices.size());
    hourglass.vertices.insert(hourglass.vertices.end(),
                              {{r, 0, z}, {-r, r, z}, {-r, -r, z}});
  }
  hourglass.vertices[4] = Eigen::Vector3d(hourglass.vertices[3]);
  hourglass.triangles = {{0, 2, 1}, {6, 7, 8}};
  for (int ring = 0; ring < 6; ring += 3) {
    for (int k = 0; k < 3; ++k) {
      const int a = ring + k, b = ring + (k + 1) % 3;
      hourglass.triangles.push_back({a, b, b + 3});
      hourglass.triangles.push_back({a, b + 3, a + 3});
    }
  }
  ASSERT_EQ(ExamineMesh(hourglass).boundary_edges, 0U);
  ExpectUntouched(hourglass);
}

// Rounding left 118 and 54 triangles without area.
TEST(CollapseZeroEdges, CleansContactSpacesOfNearlyCoplanarSolids) {
  for (const auto& [kind, seed] :
       {std::pair(PairKind::kJittered, 23), std::pair(PairKind::kTilted, 2)}) {
    const SolidPair pair = MakeRandomPair(kind, seed);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    EXPECT_TRUE(space.report().manifold);
    EXPECT_LE(space.report().degenerate_triangles, 4U) << Name(kind);
    EXPECT_EQ(space.plane().size(), space.mesh().triangles.size());
    EXPECT_EQ(space.kind().size(), space.mesh().triangles.size());
  }
}

}  // namespace
}  // namespace phongpd
