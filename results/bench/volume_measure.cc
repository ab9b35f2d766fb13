// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/volume_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/contact/convolution_model.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/solid_collision.h"
#include "core/minkowski/windows/grid_window.h"
#include "core/minkowski/windows/window_cells.h"
#include "core/solid/solid.h"
#include "problems/shapes/random_solids.h"
#include "results/bench/free_space_measure.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr std::array kVolumes = {1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0};
constexpr int kBoxes = 5;
constexpr int kMotions = 100;
constexpr char kFreeSpace[] = "free space";
constexpr std::array<const char*, 2> kLevels = {kFreeSpace, "window"};

// `all` made smaller, around a point of it as far as it stays within.
BoundingBox BoxAround(const BoundingBox& all, double volume,
                      const Vector3d& center) {
  const Vector3d size = std::cbrt(volume) * (all.max - all.min);
  const Vector3d min =
      (center - 0.5 * size).cwiseMax(all.min).cwiseMin(all.max - size);
  return {min, min + size};
}

double FreeSpaceSeconds(const TriangleMesh& robot, const TriangleMesh& obstacle,
                        const BoundingBox& box, std::mt19937_64* random) {
  const double start = CpuSeconds();
  const ConvolutionModel model(robot, obstacle);
  for (int i = 0; i < kMotions; ++i) {
    const Vector3d from = RandomPoint(box, random);
    static_cast<void>(model.IsFree(from, RandomPoint(box, random)));
  }
  return CpuSeconds() - start;
}

double WindowSeconds(const TriangleMesh& robot, const TriangleMesh& obstacle,
                     double volume, const Vector3d& center) {
  const double start = CpuSeconds();
  const Solid a = MakeSolid(robot, "robot"),
              b = MakeSolid(obstacle, "obstacle");
  const internal::GridPair pair =
      internal::MakeGridPair(a.mesh(), "robot", b.mesh(), "obstacle");
  const internal::FeatureSums sums(pair.obstacle, pair.reflected_robot);
  const internal::SolidCollision judge(pair.obstacle, pair.reflected_robot);
  const internal::BuildLimits limits({});
  const BoundingBox box =
      BoxAround(sums.bounds(), volume, pair.frame.ToGrid(center));
  internal::GridWindow window;
  for (int k = 0; k < 3; ++k) {
    window.min[k] = 2 * static_cast<std::int64_t>(std::floor(box.min[k])) - 1;
    window.max[k] = 2 * static_cast<std::int64_t>(std::ceil(box.max[k])) + 1;
  }
  internal::WindowCells cells(sums.Within(window.Box()), window, judge, limits);
  static_cast<void>(cells.SurfaceArea());
  return CpuSeconds() - start;
}

}  // namespace

std::vector<VolumeRow> MeasureVolumes(const std::string& pair,
                                      const TriangleMesh& robot,
                                      const TriangleMesh& obstacle,
                                      const ContactSpace& space,
                                      double full_seconds, std::uint64_t seed) {
  std::vector<VolumeRow> rows;
  for (const std::string level : kLevels) {
    for (const double volume : kVolumes) {
      std::mt19937_64 random(seed);
      std::vector<double> shares;
      for (int i = 0; i < kBoxes; ++i) {
        const Vector3d center =
            RandomSurfacePoint(space.mesh(), &random).position;
        const BoundingBox box = BoxAround(space.bounds(), volume, center);
        const double seconds =
            level == kFreeSpace
                ? FreeSpaceSeconds(robot, obstacle, box, &random)
                : WindowSeconds(robot, obstacle, volume, center);
        shares.push_back(seconds / full_seconds);
      }
      rows.push_back({pair, level, volume, Quantile(shares, 0.5),
                      *std::max_element(shares.begin(), shares.end())});
    }
  }
  return rows;
}

NamedTable VolumeTable(const std::vector<VolumeRow>& rows) {
  return {
      "volume.csv",
      MakeTable({"pair", "level", "volume, share", "cost, share", "largest"},
                rows, [](const VolumeRow& r, const auto& add) {
                  add(r.pair, r.level, r.volume, r.cost, r.largest);
                })};
}

}  // namespace phongpd::bench
