// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "core/bvh/triangle_corners.h"
#include "core/minkowski/convolution/convolution_cells.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/solid_collision.h"

namespace phongpd::internal {

// What the reduced convolution alone tells of free space, exactly and without
// an arrangement; of it only the cells that questions lead to are made
// (convolution_cells.h), each once.
//
// Directly behind each of its facets the operands overlap, and C_cont is part
// of it.  A segment that starts free first meets it from the front, and what is
// in front of the first facet it meets is free; so it is free iff it meets
// none.  The segment from a free q to the nearest point of the convolution
// meets nothing before: that point is the nearest of C_cont.  So it is with the
// shortest way from any point of a free segment.
//
// Configurations are in the user's frame; they are rounded to 2^-12 of a grid
// step (2^-50 of the operands), for which the answers are exact.  Thread-safe.
class ConvolutionSpace {
 public:
  // Keeps a reference.  What questions lead to is kept up to max_mib(), and
  // beyond that made anew each time.
  explicit ConvolutionSpace(
      const GridPair& pair, std::function<double()> max_mib = [] {
        return std::numeric_limits<double>::infinity();
      });

  // Does A + q meet B nowhere?  False for non-finite q, and for q so far away
  // that it has no place on the grid.
  bool IsFree(const Eigen::Vector3d& q) const;
  // Is every point of the closed segment free?
  bool IsFree(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // From a free a towards b: the fraction of the way at which C_cont is met,
  // rounded; > 1 iff it is not.  0 for b without a place on the grid.
  double FirstContact(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // The point of C_cont nearest to a free q, and its distance, rounded.
  struct Nearest {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double distance = 0.0;
  };
  Nearest FindNearest(const Eigen::Vector3d& q) const;

  // Distance of a free segment from C_cont if that is below `limit` > 0, and
  // `limit` otherwise.  Rounded.
  double Distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  double limit) const;

  // Corners of the facets whose planes keep a free segment from all others
  // within `radius` ≥ 0 (separators.h), `slack` in the user's unit; facets of
  // cells that are all behind such planes are never made.
  std::vector<TriangleCorners> FindSeparating(const Eigen::Vector3d& a,
                                              const Eigen::Vector3d& b,
                                              double radius,
                                              double slack) const;

  // Of the convolution, in the user's frame; rounded.
  BoundingBox Bounds() const;
  // Those made so far; some may be counted several times.
  std::size_t facets() const { return cells_.facets(); }
  // The whole convolution, made for this; the user's frame, rounded.
  TriangleMesh Mesh() const;

 private:
  // In grid steps, rounded as above.
  Eigen::Vector3d ToGrid(const Eigen::Vector3d& q) const;

  const GridPair& pair_;
  SolidCollision judge_;
  ConvolutionCells cells_;
};

}  // namespace phongpd::internal
