// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/voxel_pair.h"

#include <Eigen/LU>
#include <algorithm>

#include "problems/shapes/random_solids.h"

namespace phongpd::testing {
namespace {

using Eigen::Matrix3i;
using Eigen::Vector3d;
using Eigen::Vector3i;
using Box = std::array<Vector3i, 2>;
using Kind = VoxelPair::Kind;

constexpr int kTries = 30;

// Cubes, their surface, and they themselves as boxes.
struct Cubes {
  TriangleMesh mesh;
  std::vector<Box> boxes;
};

// Of the given side, in a block of n³.
void AddCubes(int n, int side, double fill, const Vector3i& corner,
              std::mt19937_64* random, Cubes* cubes) {
  Voxels voxels = RandomVoxels(n, fill, EdgeContact::kAvoided, random);
  voxels.corner.setZero();
  TriangleMesh surface = VoxelSurface(voxels);
  for (Vector3d& v : surface.vertices) v = side * v + corner.cast<double>();
  cubes->mesh =
      cubes->mesh.triangles.empty() ? surface : Joined(cubes->mesh, surface);
  for (int i = 0; i < n * n * n; ++i) {
    if (voxels.filled[static_cast<std::size_t>(i)] == 0) continue;
    const Vector3i low =
        corner + side * Vector3i(i % n, i / n % n, i / (n * n));
    cubes->boxes.push_back({low, low + Vector3i::Constant(side)});
  }
}

void AddAll(bool is_merged, std::mt19937_64* random, Cubes* robot,
            Cubes* obstacle) {
  for (int i = is_merged ? Pick(1, 2, random) : 1; i > 0; --i) {
    AddCubes(Pick(1, 2, random), 1, 0.5, PickPoint(-1, 1, random), random,
             robot);
  }
  // In one lattice, or in two.
  const Vector3i corner = PickPoint(-3, 3, random);
  const int side = Pick(2, 4, random);
  const bool is_aligned = Pick(0, 1, random) == 0;
  for (int i = is_merged ? Pick(2, 4, random) : 1; i > 0; --i) {
    const Vector3i shift = PickPoint(-1, 1, random);
    AddCubes(Pick(3, 4, random), side, 0.01 * Pick(55, 90, random),
             corner + (is_aligned ? side : 1) * shift, random, obstacle);
  }
}

void FindParts(const Cubes& robot, const Cubes& obstacle, VoxelPair* pair) {
  LatticeWorld& cells = pair->cells;
  cells.boxes.clear();
  for (const Box& o : obstacle.boxes) {
    for (const Box& r : robot.boxes) {
      cells.boxes.push_back({o[0] - r[1], o[1] - r[0]});
    }
  }
  LabelCells(&cells);
  pair->parts.clear();
  LatticeWorld::Cell cell;
  for (cell[2] = cells.min[2]; cell[2] <= cells.max[2]; ++cell[2]) {
    for (cell[1] = cells.min[1]; cell[1] <= cells.max[1]; ++cell[1]) {
      for (cell[0] = cells.min[0]; cell[0] <= cells.max[0]; ++cell[0]) {
        const int label = cells.Label(cell);
        if (label < 0) continue;
        pair->parts.resize(
            std::max(pair->parts.size(), static_cast<std::size_t>(label) + 1));
        pair->parts[static_cast<std::size_t>(label)].push_back(cell);
      }
    }
  }
}

Matrix3i Sheared(std::mt19937_64* random) {
  for (;;) {
    Matrix3i map;
    for (int k = 0; k < 3; ++k) map.row(k) = PickPoint(-2, 2, random);
    if (map.cast<double>().determinant() > 0.5) return map;
  }
}

// Rather the long axes are made longer: all stays integer.
Matrix3i Thin(std::mt19937_64* random) {
  const int factors[] = {16, 100, 1024};
  Vector3i sides = Vector3i::Ones();
  const int axis = Pick(0, 2, random);
  sides[axis] = factors[Pick(0, 2, random)];
  if (Pick(0, 1, random) == 0) sides[(axis + 1) % 3] = sides[axis];
  return sides.asDiagonal();
}

void ChooseMap(Kind kind, std::mt19937_64* random, VoxelPair* pair) {
  Matrix3i& map = pair->cells.map;
  switch (kind) {
    case Kind::kMerged:
      ChooseMap(static_cast<Kind>(Pick(0, VoxelPair::kKinds - 2, random)),
                random, pair);
      pair->name += " merged";
      return;
    case Kind::kAxis:
      pair->name = "axis";
      return;
    case Kind::kThin:
      pair->name = "thin";
      map = Thin(random);
      pair->divisor = Pick(0, 1, random) == 0 ? 1 : 1 << 20;
      return;
    case Kind::kSheared:
      pair->name = "sheared";
      map = Sheared(random);
      return;
    case Kind::kScaled: {
      pair->name = "scaled";
      const int factors[] = {3, 5, 7, 9, 15, 1000};
      map = factors[Pick(0, 5, random)] * Sheared(random);
      pair->divisor = Pick(0, 1, random) == 0 ? 1 : 1 << 10;
      return;
    }
    case Kind::kDecimal:
      pair->name = "decimal";
      // Not sheared: whether doubles near tenths lie in an oblique plane is
      // another question.
      if (Pick(0, 1, random) == 0) map = Thin(random);
      pair->divisor = Pick(0, 1, random) == 0 ? 10 : 1000;
      return;
  }
}

}  // namespace

Vector3d VoxelPair::Point(const Quarters& point) const {
  // Exact but for the last step.
  const Vector3i q = cells.map * Vector3i(point[0], point[1], point[2]);
  return q.cast<double>() / (4.0 * divisor);
}

VoxelPair::Quarters VoxelPair::RandomPoint(std::mt19937_64* random) const {
  LatticeWorld::Cell cell = cells.RandomCell(random);
  if (Pick(0, 7, random) > 0) {
    const auto& part = parts[(*random)() % parts.size()];
    cell = part[(*random)() % part.size()];
  }
  Quarters point;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = 2 * cell[k] + (cell[k] % 2 == 0 ? 0 : Pick(-1, 1, random));
  }
  return point;
}

int VoxelPair::Label(const Quarters& point) const {
  LatticeWorld::Cell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    // Integers are cells of their own; between them all is one.
    const int below = point[k] >= 0 ? point[k] / 4 : (point[k] - 3) / 4;
    cell[k] = 2 * below + (point[k] == 4 * below ? 0 : 1);
  }
  return cells.Label(cell);
}

VoxelPair MakeVoxelPair(Kind kind, std::mt19937_64* random) {
  VoxelPair pair;
  ChooseMap(kind, random, &pair);
  Cubes robot, obstacle;
  // Three of four with several parts of free space, should they be found.
  for (int tries = Pick(0, 3, random) > 0 ? kTries : 1; tries > 0; --tries) {
    robot = obstacle = {};
    AddAll(kind == Kind::kMerged, random, &robot, &obstacle);
    FindParts(robot, obstacle, &pair);
    if (pair.parts.size() > 1) break;
  }
  for (Cubes* cubes : {&robot, &obstacle}) {
    for (Vector3d& v : cubes->mesh.vertices) {
      v = (pair.cells.map * v.cast<int>()).cast<double>() / pair.divisor;
    }
  }
  pair.robot = MakeSolid(robot.mesh, "robot");
  pair.obstacle = MakeSolid(obstacle.mesh, "obstacle");
  return pair;
}

}  // namespace phongpd::testing
