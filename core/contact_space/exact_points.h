// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Core>
#include <unordered_map>
#include <vector>

// Includes CGAL: only for the .cc files of this folder.
namespace phongpd::internal {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;
using ExactNumber = ExactKernel::FT;

// All distinct points of the arrangement, in grid units, each with one id.
// Points are found again by a hash of their rounded coordinates and told
// apart exactly.
class ExactPoints {
 public:
  // `extent` bounds the magnitude of all coordinates.
  explicit ExactPoints(double extent);

  // The id of `p`, new or known.
  int Add(const ExactPoint& p);

  const ExactPoint& operator[](int id) const { return exact_[id]; }
  // Coordinates rounded with a small error; good for sorting angles.
  const Eigen::Vector3d& Approximate(int id) const { return approximate_[id]; }
  // Coordinates rounded to double with an error below 2^-12 grid steps.
  Eigen::Vector3d Rounded(int id) const;
  int size() const { return static_cast<int>(exact_.size()); }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& c) const;
  };

  double cell_;       // side of a hash cell, grid units
  double tolerance_;  // how far two roundings of one point may lie apart
  std::vector<ExactPoint> exact_;
  std::vector<Eigen::Vector3d> approximate_;
  std::unordered_multimap<Cell, int, CellHash> ids_;
};

}  // namespace phongpd::internal
