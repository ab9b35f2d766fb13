// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/projection/field_projector.h"
#include "core/projection/prism_tree.h"

namespace phongpd {

// Searches over all triangles of a field, by the tree of its prisms.
class PrismSearch {
 public:
  explicit PrismSearch(const FieldProjector& projector) : tree_(projector) {}

  // The projection of least depth of x, which must be inside; invalid if
  // there is none.  Depths that agree to 1e-13 are a tie, and the contact
  // that comes first by x, y, z wins: no dependence on triangle order.
  Projection FindLeastDepth(const FieldProjector& projector,
                            const Eigen::Vector3d& x) const noexcept;

  // Calls visit(const Projection&) for every projection of depth ≤ bound, in
  // no particular order.  One on an edge or vertex is visited once for each
  // triangle that finds it.
  template <typename Visit>
  void ForEach(const FieldProjector& projector, const Eigen::Vector3d& x,
               double bound, const Visit& visit) const {
    tree_.ForEach(
        x, bound, [&](int triangle, const PrismTree::Offsets& offsets) {
          std::array<Projection, 3> found;
          const int count = projector.Project(triangle, x, bound, offsets.least,
                                              offsets.most, &found);
          for (int i = 0; i < count; ++i) visit(found[i]);
        });
  }

 private:
  // Of depths, far above rounding; field frame.
  static constexpr double kSlack = 1e-12;

  PrismTree tree_;
};

}  // namespace phongpd
