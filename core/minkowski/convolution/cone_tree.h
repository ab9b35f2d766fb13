// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/box_tree_pairs.h"
#include "core/minkowski/convolution/gauss_tree.h"

namespace phongpd::internal {

// Features of one solid, each with a box in space and a cap of normals, in a
// tree over the boxes whose nodes bound the caps, too.
class ConeTree {
 public:
  ConeTree(const std::vector<BoundingBox>& boxes,
           const std::vector<GaussCap>& caps);

  const BoxTree& tree() const { return tree_; }
  // Of a node: the caps' box.
  const BoundingBox& Normals(int node) const { return normals_[node]; }
  // By position in tree().order().
  const BoundingBox& Box(int position) const { return boxes_[position]; }
  const GaussCap& Cap(int position) const { return caps_[position]; }

 private:
  BoxTree tree_;
  std::vector<BoundingBox> normals_;
  std::vector<BoundingBox> boxes_;
  std::vector<GaussCap> caps_;
};

// Which normals of P and Q go together: equal ones, or opposite ones as well
// (VertexCaps tells a vertex's normals up to their sign).
enum class NormalMatch { kEqual, kEqualOrOpposite };

// visit(i, j) → bool for every feature i of P and j of Q whose boxes have a sum
// within `window` and whose caps overlap; in no stated order; false stops.
template <typename Visit>
void ForEachPairIn(const ConeTree& p, const ConeTree& q, NormalMatch match,
                   const BoundingBox& window, const Visit& visit) {
  const auto is_in_window = [&window](const auto& a, const auto& b) {
    return ((a.min + b.min).array() <= window.max.array()).all() &&
           ((a.max + b.max).array() >= window.min.array()).all();
  };
  const auto may_match = [match](const BoundingBox& a, const BoundingBox& b) {
    return ((a.min.array() <= b.max.array()).all() &&
            (a.max.array() >= b.min.array()).all()) ||
           (match == NormalMatch::kEqualOrOpposite &&
            (-a.max.array() <= b.max.array()).all() &&
            (-a.min.array() >= b.min.array()).all());
  };
  const auto caps_meet = [match](const GaussCap& a, const GaussCap& b) {
    const double reach = (a.radius + b.radius) * (a.radius + b.radius);
    return (a.center - b.center).squaredNorm() <= reach ||
           (match == NormalMatch::kEqualOrOpposite &&
            (a.center + b.center).squaredNorm() <= reach);
  };
  ForEachPair(
      p.tree(), q.tree(),
      [&](int i, int j) {
        return is_in_window(p.tree().nodes()[i], q.tree().nodes()[j]) &&
               may_match(p.Normals(i), q.Normals(j));
      },
      [&](int k, int l) {
        return !caps_meet(p.Cap(k), q.Cap(l)) ||
               !is_in_window(p.Box(k), q.Box(l)) ||
               visit(p.tree().order()[k], q.tree().order()[l]);
      });
}

}  // namespace phongpd::internal
