// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/moved_spaces.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd::testing {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Random = std::mt19937_64;

namespace {

int Uniform(int min, int max, Random* random) {
  return std::uniform_int_distribution<int>(min, max)(*random);
}

// Vertices where three planes or more meet: those on a straight edge depend on
// how it was cut.
std::vector<Vector3d> CornersOf(const ContactSpace& space) {
  std::vector<std::set<int>> planes(space.mesh().vertices.size());
  for (std::size_t t = 0; t < space.mesh().triangles.size(); ++t) {
    for (const int v : space.mesh().triangles[t])
      planes[v].insert(space.plane()[t]);
  }
  std::vector<Vector3d> corners;
  for (std::size_t v = 0; v < planes.size(); ++v) {
    if (planes[v].size() > 2) corners.push_back(space.mesh().vertices[v]);
  }
  return corners;
}

// Largest distance of a point to the nearest of the others, both ways.
double Apart(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double worst = 0.0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Vector3d& p : *from) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& q : *to) {
        nearest = std::min(nearest, (p - q).lpNorm<Eigen::Infinity>());
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

bool IsFinite(const ContactSpace& space) {
  return std::all_of(space.mesh().vertices.begin(), space.mesh().vertices.end(),
                     [](const Vector3d& v) { return v.allFinite(); }) &&
         std::isfinite(space.report().volume);
}

// Largest distance of a vertex to the other surface, both ways.
double SurfacesApart(const TriangleMesh& a, const TriangleMesh& b) {
  double worst = 0.0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const TriangleBvh tree(*to);
    for (const Vector3d& p : from->vertices) {
      worst = std::max(worst, tree.FindClosest(p).distance);
    }
  }
  return worst;
}

}  // namespace

TriangleMesh Mapped(TriangleMesh mesh, const Matrix3d& map,
                    const Vector3d& offset) {
  for (Vector3d& v : mesh.vertices) v = map * v + offset;
  return map.determinant() < 0 ? Reversed(mesh) : mesh;
}

Matrix3d RandomIntegerMap(bool is_unimodular, Random* random) {
  for (;;) {
    Matrix3d map;
    for (int i = 0; i < 9; ++i) map(i / 3, i % 3) = Uniform(-2, 2, random);
    const long det = std::lround(map.determinant());
    if (det != 0 && (!is_unimodular || std::abs(det) == 1)) return map;
  }
}

MovedPair LatticePair(Random* random) {
  return {RandomVoxelSolid(2, 0.5, random), RandomVoxelSolid(3, 0.5, random)};
}

MovedPair MakeMovedPair(std::uint64_t seed) {
  Random random(seed);
  MovedPair pair = LatticePair(&random);
  switch (seed % 6) {
    case 0:
      break;
    case 1: {
      const Matrix3d map = RandomIntegerMap(false, &random);
      pair.robot = Mapped(pair.robot, map);
      pair.obstacle = Mapped(pair.obstacle, map);
      break;
    }
    case 2:  // tenths as people write them
      for (TriangleMesh* mesh : {&pair.robot, &pair.obstacle}) {
        for (Vector3d& v : mesh->vertices) v /= 10.0;
      }
      break;
    case 3:
      return {MakeCone(0.8, 1.6, Uniform(5, 24, &random)), MakeAxes(2, 0.2)};
    case 4:
      return {MakeStar(0.5, 1.2),
              Rotated(MakeTorus(2, 0.6, 9, 6), RandomRotation(&random))};
    default:
      return {MakeL(0.4, 0.15, 0.3), MakeWrench(1.0, 6, 8, 5, 5)};
  }
  return pair;
}

ContactSpace SpaceOf(const MovedPair& pair) {
  return BuildContactSpace(pair.robot, pair.obstacle);
}

MovedSpaceJudge::MovedSpaceJudge(const std::string& subject, double exact_bound,
                                 double rounded_bound) {
  for (CampaignRow* row : {&exact_, &rounded_}) {
    row->item = "invariance";
    row->unit = "L";
  }
  exact_.subject = subject + ", on lattices";
  exact_.bound = exact_bound;
  rounded_.subject = subject + ", rounded";
  rounded_.bound = rounded_bound;
}

MovedSpaceJudge::~MovedSpaceJudge() {
  for (const CampaignRow* row : {&exact_, &rounded_}) {
    if (row->cases > 0) ReportCampaign(*row);
  }
  EXPECT_GT(exact_.cases + rounded_.cases, 0);
}

void MovedSpaceJudge::Compare(
    const ContactSpace& space, const ContactSpace& moved,
    const std::function<Vector3d(const Vector3d&)>& map, double length,
    const std::string& what) {
  const ContactSpaceReport &a = space.report(), &b = moved.report();
  const bool is_exact = a.grid_step == 0.0;
  CampaignRow& row = is_exact ? exact_ : rounded_;
  double apart = 0.0;
  if (is_exact) {
    std::vector<Vector3d> corners = CornersOf(space);
    for (Vector3d& p : corners) p = map(p);
    apart = Apart(corners, CornersOf(moved)) / length;
  } else {
    TriangleMesh expected = space.mesh();
    for (Vector3d& p : expected.vertices) p = map(p);
    apart = SurfacesApart(expected, moved.mesh()) / length;
  }
  const bool is_right = b.manifold && IsFinite(moved) &&
                        b.components == a.components && b.genus == a.genus &&
                        b.cavities == a.cavities && apart <= row.bound;
  EXPECT_TRUE(is_right) << what << ": manifold " << b.manifold
                        << ", components " << a.components << " and "
                        << b.components << ", genus " << a.genus << " and "
                        << b.genus << ", cavities " << a.cavities << " and "
                        << b.cavities << ", apart by " << apart << " L";
  ++row.cases;
  row.failures += !is_right;
  row.worst = std::max(row.worst, apart);
}

}  // namespace phongpd::testing
