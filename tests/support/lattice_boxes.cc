// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/lattice_boxes.h"

#include <Eigen/Core>
#include <algorithm>

#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr int kQuarters = 4;  // of the lattice in a unit

}  // namespace

std::vector<LatticeBox> LatticeBoxes(const Voxels& voxels) {
  std::vector<LatticeBox> boxes;
  const int n = voxels.n;
  for (int i = 0; i < n * n * n; ++i) {
    const int cell[3] = {i / (n * n), i / n % n, i % n};
    if (voxels.filled[cell[0] + n * (cell[1] + n * cell[2])] == 0) continue;
    LatticeBox& box = boxes.emplace_back();
    for (int k = 0; k < 3; ++k) {
      box.min[k] = kQuarters * (static_cast<int>(voxels.corner[k]) + cell[k]);
      box.max[k] = box.min[k] + kQuarters;
    }
  }
  return boxes;
}

TriangleMesh BoxesMesh(const std::vector<LatticeBox>& boxes) {
  const auto point = [](const std::array<int, 3>& quarters) -> Vector3d {
    return Vector3d(quarters[0], quarters[1], quarters[2]) / kQuarters;
  };
  TriangleMesh mesh;
  for (const LatticeBox& box : boxes) {
    mesh = Joined(mesh, MakeBox(point(box.min), point(box.max)));
  }
  return mesh;
}

double LatticeSumVolume(const std::vector<LatticeBox>& robot,
                        const std::vector<LatticeBox>& obstacle) {
  std::vector<LatticeBox> sums;
  LatticeBox all = {{0, 0, 0}, {0, 0, 0}};
  for (const LatticeBox& a : robot) {
    for (const LatticeBox& b : obstacle) {
      LatticeBox& sum = sums.emplace_back();
      for (int k = 0; k < 3; ++k) {
        sum.min[k] = b.min[k] - a.max[k];
        sum.max[k] = b.max[k] - a.min[k];
        all.min[k] =
            sums.size() == 1 ? sum.min[k] : std::min(all.min[k], sum.min[k]);
        all.max[k] =
            sums.size() == 1 ? sum.max[k] : std::max(all.max[k], sum.max[k]);
      }
    }
  }
  const int nx = all.max[0] - all.min[0], ny = all.max[1] - all.min[1];
  const int nz = all.max[2] - all.min[2];
  std::vector<char> cells(static_cast<std::size_t>(nx) * ny * nz);
  for (const LatticeBox& sum : sums) {
    for (int z = sum.min[2]; z < sum.max[2]; ++z) {
      for (int y = sum.min[1]; y < sum.max[1]; ++y) {
        const int row = nx * (y - all.min[1] + ny * (z - all.min[2]));
        std::fill(cells.begin() + row + sum.min[0] - all.min[0],
                  cells.begin() + row + sum.max[0] - all.min[0], 1);
      }
    }
  }
  return static_cast<double>(std::count(cells.begin(), cells.end(), 1)) /
         (kQuarters * kQuarters * kQuarters);
}

}  // namespace phongpd
