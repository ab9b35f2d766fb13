// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/minkowski/build_limits.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/solid_collision.h"
#include "core/minkowski/operands/solid_gap.h"
#include "core/minkowski/windows/window_cells.h"

namespace phongpd::internal {

// A point Σ wᵢ vᵢ of a solid: of a vertex, an edge or a facet by `count`.
struct FeaturePoint {
  int count = 0;  // 0: none
  std::array<int, 3> vertices = {-1, -1, -1};
  std::array<double, 3> weights = {0.0, 0.0, 0.0};  // ≥ 0, sum to 1
};

// Where A + x and B stand to each other, grid steps.
struct GridDepth {
  bool collides = false;  // they share a point
  // Of x to the nearest point of C_cont; 0 exactly when x lies on it.  Where it
  // is not certified, the least that is known to suffice.
  double distance = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of C_cont there
  FeaturePoint of_obstacle, of_robot;  // that touch there; none: a mere bound
  bool is_certified = false;
  double radius = 0.0;  // nothing of C_cont is nearer that was not looked at
  bool is_full = false;
  int windows = 0;
  std::vector<double> reaches;  // half-widths of those, around x
  std::size_t faces = 0;
};

struct SearchLimits {
  double max_radius = 0.0;  // grid steps
  double max_seconds = 0.0;
};

// Depth and clearance of one pair of operands.  Of C_cont only windows around x
// are built: the first one as large as a few facets of the convolution need,
// every further one with several times as many, and never beyond what is known
// to be far enough.  Once a point is found, the window that reaches as far
// tells whether a nearer one exists.
class DepthSearch {
 public:
  // Keeps a reference.  What is built is held to `options`' memory, counted
  // from here on.
  DepthSearch(const GridPair& pair, const ContactSpaceOptions& options);

  // x finite, rounded to 2^-12 steps where that matters.
  GridDepth Find(const Eigen::Vector3d& x, const SearchLimits& limits) const;

 private:
  GridDepth Apart(const Eigen::Vector3d& x) const;
  void SearchWindows(const Eigen::Vector3d& x, const SearchLimits& limits,
                     GridDepth* depth) const;
  void TellFeatures(const WindowConvolution& part, int facet,
                    GridDepth* depth) const;

  const GridPair& pair_;
  SolidCollision judge_;
  FeatureSums sums_;
  SolidGap gap_;
  BuildLimits build_limits_;
};

}  // namespace phongpd::internal
