// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: every pair of features tried, signs of exact integers.
#include "core/minkowski/convolution/convolution.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "core/minkowski/convolution/gauss_tree.h"
#include "core/minkowski/operands/grid_frame.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using testing::RandomRotation;

// Facets of the reduced convolution by kind, by its definition; `ties` counts
// pairs that exact signs leave undecided.
struct Counts {
  std::map<ContactKind, int> facets;
  int ties = 0;
};

int TouchingVertices(const GridSolid& facets, const GridSolid& others,
                     int* ties) {
  int count = 0;
  for (const GridNormal& n : facets.normals) {
    for (std::size_t v = 0; v < others.vertices.size(); ++v) {
      bool below = !others.neighbors[v].empty();
      for (const int w : others.neighbors[v]) {
        const int sign = Sign(Dot(n, others.vertices[w] - others.vertices[v]));
        *ties += sign == 0;
        below = below && sign < 0;
      }
      count += below;
    }
  }
  return count;
}

bool IsConvex(const GridSolid& s, const GridEdge& e) {
  return Sign(Dot(s.normals[e.left],
                  s.vertices[e.right_apex] - s.vertices[e.a])) < 0;
}

int TouchingEdges(const GridSolid& p, const GridSolid& q, int* ties) {
  int count = 0;
  for (const GridEdge& e : p.edges) {
    if (!IsConvex(p, e)) continue;
    const GridPoint along = p.vertices[e.b] - p.vertices[e.a];
    for (const GridEdge& g : q.edges) {
      if (!IsConvex(q, g)) continue;
      const GridNormal n = Cross(along, q.vertices[g.b] - q.vertices[g.a]);
      const std::array<int, 4> signs = {
          Sign(Dot(n, p.vertices[e.left_apex] - p.vertices[e.a])),
          Sign(Dot(n, p.vertices[e.right_apex] - p.vertices[e.a])),
          Sign(Dot(n, q.vertices[g.left_apex] - q.vertices[g.a])),
          Sign(Dot(n, q.vertices[g.right_apex] - q.vertices[g.a]))};
      int sum = 0;
      for (const int sign : signs) {
        *ties += sign == 0;
        sum += sign;
      }
      count += sum == 4 || sum == -4;
    }
  }
  return count;
}

Counts CountByDefinition(const GridSolid& p, const GridSolid& q) {
  Counts counts;
  counts.facets[ContactKind::kObstacleFacet] =
      TouchingVertices(p, q, &counts.ties);
  counts.facets[ContactKind::kRobotFacet] =
      TouchingVertices(q, p, &counts.ties);
  counts.facets[ContactKind::kEdges] = 2 * TouchingEdges(p, q, &counts.ties);
  return counts;
}

TriangleMesh Turned(TriangleMesh mesh, std::mt19937_64* random) {
  const Eigen::Matrix3d rotation = RandomRotation(random);
  for (Vector3d& v : mesh.vertices) v = rotation * v;
  return mesh;
}

TEST(Convolution, HoldsExactlyThePairsThatTouch) {
  std::mt19937_64 random(7);
  const std::vector<TriangleMesh> solids = {
      MakeIcoBall(1.0, 2),
      MakeTorus(1.0, 0.3, 24, 12),
      testing::RandomVoxelSolid(3, 0.5, &random),
      MakeWrench(),
      MakeCone(0.5, 1.0, 40),
      MakeStar(0.3, 1.0)};
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = 0; j < solids.size(); ++j) {
      const TriangleMesh robot = Turned(solids[i], &random);
      const TriangleMesh obstacle = Turned(solids[j], &random);
      const GridFrame frame = PlaceOnGrid(robot, obstacle);
      const GridSolid p =
          MakeGridSolid(frame.obstacle, obstacle.triangles, false, "obstacle");
      const GridSolid q =
          MakeGridSolid(frame.robot, robot.triangles, true, "robot");
      const Counts expected = CountByDefinition(p, q);
      ASSERT_EQ(expected.ties, 0) << i << ' ' << j;
      std::map<ContactKind, int> found;
      for (const ConvolutionFacet& f : ReducedConvolution(p, q).facets) {
        ++found[f.kind];
      }
      for (const auto& [kind, count] : expected.facets) {
        EXPECT_EQ(found[kind], count) << i << ' ' << j;
      }
    }
  }
}

Vector3d RandomUnit(std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(*random), normal(*random), normal(*random))
      .normalized();
}

TEST(GaussTree, FindsEveryCapThatOverlaps) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> radius(0.0, 0.4);
  std::vector<GaussCap> caps;
  for (int i = 0; i < 2000; ++i) {
    caps.push_back({RandomUnit(&random), radius(random)});
  }
  caps.push_back({});  // the whole sphere
  const GaussTree tree(caps);
  for (int k = 0; k < 200; ++k) {
    const GaussCap cap = {RandomUnit(&random), radius(random)};
    std::vector<char> found(caps.size());
    tree.ForEachNear(cap, [&](int i) { found[i] = 1; });
    for (std::size_t i = 0; i < caps.size(); ++i) {
      const double gap = (caps[i].center - cap.center).norm();
      EXPECT_EQ(found[i] != 0, gap <= caps[i].radius + cap.radius);
    }
  }
}

TEST(GaussCap, HoldsEverySumOfItsNormals) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> weight(0.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    std::vector<Vector3d> normals;
    const double spread = k % 2 == 0 ? 0.3 : 2.0;
    const Vector3d middle = RandomUnit(&random);
    for (int i = 0; i < 2 + k % 5; ++i) {
      normals.push_back((middle + spread * RandomUnit(&random)).normalized());
    }
    const GaussCap cap = CapAround(normals.data(), normals.size());
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& n : normals) sum += weight(random) * n;
    EXPECT_LE((sum.normalized() - cap.center).norm(), cap.radius);
  }
}

}  // namespace
}  // namespace phongpd::internal
