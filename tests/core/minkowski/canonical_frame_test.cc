// SPDX-License-Identifier: GPL-3.0-or-later
// The frame that solids are turned into, by another route: all facets, each
// beside each other, without any table.
#include "core/minkowski/operands/canonical_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

struct Direction {
  Vector3d first;
  double share;
};

std::vector<Direction> DirectionsOf(const std::vector<TriangleMesh>& meshes) {
  std::vector<Direction> all;
  for (const TriangleMesh& mesh : meshes) {
    for (const Triangle& t : mesh.triangles) {
      const Vector3d& a = mesh.vertices[t[0]];
      const Vector3d n =
          (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
      const double share = 0.5 * n.norm() / SurfaceArea(mesh);
      const auto same =
          std::find_if(all.begin(), all.end(), [&](const Direction& d) {
            return d.first.cross(n).norm() < 1e-10 * n.norm();
          });
      if (same == all.end()) {
        all.push_back({n.normalized(), share});
      } else {
        same->share += share;
      }
    }
  }
  return all;
}

double AlignedShare(const std::vector<Direction>& all,
                    const Eigen::Matrix3d& rotation) {
  double share = 0.0;
  for (const Direction& d : all) {
    const Vector3d n = rotation * d.first;
    if (n.lpNorm<1>() - n.lpNorm<Eigen::Infinity>() < 1e-9) share += d.share;
  }
  return share;
}

TriangleMesh Together(TriangleMesh a, const TriangleMesh& b) {
  const int first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return a;
}

// Every frame is one that the shares of all directions justify, and there is
// none only where no turn of the largest direction into an axis gains enough.
TEST(CanonicalFrame, IsWhatTheSharesOfAllDirectionsSay) {
  std::mt19937_64 random(5);
  const auto turn = [&random] {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random), normal(random), normal(random),
                              normal(random))
        .normalized()
        .toRotationMatrix();
  };
  const std::vector<TriangleMesh> solids = {
      MakeBox({-0.1, -0.2, -0.3}, {0.3, 0.2, 0.1}),
      MakeU(2.0, 0.3, 0.6),
      MakeL(0.5, 0.2, 0.3),
      MakeWrench(0.5, 6, 6, 4, 4),
      MakeBlob(1.0, 2, 0.3, 1),
      MakeStar(0.5, 1.2)};
  int used = 0;
  for (const TriangleMesh& a : solids) {
    for (const TriangleMesh& b : solids) {
      for (const bool together : {true, false}) {
        const Eigen::Matrix3d one = turn();
        const TriangleMesh robot = Rotated(a, one);
        const TriangleMesh obstacle = Rotated(b, together ? one : turn());
        const CanonicalFrame frame = ChooseCanonicalFrame(robot, obstacle);
        const std::vector<Direction> all = DirectionsOf({robot, obstacle});
        const double before = AlignedShare(all, Eigen::Matrix3d::Identity());
        if (frame.used) {
          ++used;
          EXPECT_LT((frame.rotation * frame.rotation.transpose() -
                     Eigen::Matrix3d::Identity())
                        .norm(),
                    1e-14);
          EXPECT_GT(AlignedShare(all, frame.rotation), before + 0.0999);
          continue;
        }
        EXPECT_EQ(frame.rotation, Eigen::Matrix3d::Identity());
        const auto largest = std::max_element(
            all.begin(), all.end(), [](const Direction& x, const Direction& y) {
              return x.share < y.share;
            });
        EXPECT_LT(largest->share, before + 0.1001);
      }
    }
  }
  EXPECT_GT(used, 20);
}

// The many facets of a blob, each with a direction of its own, hide none of the
// few that decide.
TEST(CanonicalFrame, OfAFewDirectionsAmongManyIsThatOfTheFew) {
  const Eigen::Matrix3d turn = GenericRotation();
  const TriangleMesh robot = Rotated(MakeL(0.5, 0.2, 0.3), turn);
  const CanonicalFrame alone =
      ChooseCanonicalFrame(robot, Rotated(MakeU(2.0, 0.3, 0.6), turn));
  ASSERT_TRUE(alone.used);
  for (const int levels : {3, 5}) {
    const TriangleMesh obstacle = Together(Rotated(MakeU(2.0, 0.3, 0.6), turn),
                                           MakeBlob(0.3, levels, 0.3, 1));
    const CanonicalFrame frame = ChooseCanonicalFrame(robot, obstacle);
    ASSERT_TRUE(frame.used) << obstacle.triangles.size();
    EXPECT_LT((frame.rotation - alone.rotation).norm(), 1e-12);
  }
  EXPECT_FALSE(
      ChooseCanonicalFrame(MakeBlob(0.3, 4, 0.3, 2), MakeBlob(1.0, 5, 0.3, 1))
          .used);
}

}  // namespace
}  // namespace phongpd::internal
