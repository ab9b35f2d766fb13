// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/projection/field_projector.h"

namespace phongpd {

// Searches over all triangles of a field, by a box tree.
//
// Two bounds prune it.  (1) A projection of depth δ lies within δ of its
// triangle, so no box farther than the bound can hold one.  (2) It lies in
// the offset prism {p(λ) + s·n(λ), −δ/|n(λ)| ≤ s ≤ 0}; a node keeps the box
// of the vertex normals below it and the least |n(λ)| (≥ 1/√3 when normals
// are less than 90° apart), which bound all these prisms for any δ given with
// the query.  (2) holds for the normal field only.  Both are widened by 1e-12
// (field frame), far above rounding.
class PrismSearch {
 public:
  explicit PrismSearch(const FieldProjector& projector);

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
    tree_.ForEach([&](int node) { return MayHold(node, x, bound); },
                  [&](int position) {
                    std::array<Projection, 3> found;
                    const int count = projector.Project(tree_.order()[position],
                                                        x, bound, &found);
                    for (int i = 0; i < count; ++i) visit(found[i]);
                    return true;
                  });
  }

 private:
  struct NormalBounds {
    Eigen::Vector3d min;
    Eigen::Vector3d max;
    double least_norm = 0.0;  // 0: bound (2) does not apply
  };

  bool MayHold(int node, const Eigen::Vector3d& x, double depth) const {
    const double reach = depth + kSlack;
    return tree_.nodes()[node].SquaredDistance(x) <= reach * reach &&
           InPrisms(node, x, depth);
  }
  bool InPrisms(int node, const Eigen::Vector3d& x, double depth) const;

  static constexpr double kSlack = 1e-12;

  BoxTree tree_;
  std::vector<NormalBounds> normals_;  // per node
};

}  // namespace phongpd
