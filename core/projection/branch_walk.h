// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/projection/field_projector.h"

namespace phongpd {

// Follows a branch – one continuous family of projections – while the
// configuration moves straight from the branch's own point
// x_a = p(λ) + s·n(λ) to x_b.  Normal field only.
//
// In one prism x(λ, s) is bilinear, so with J at the current point, the Newton
// step w = J⁻¹(x_b − x) and G = J⁻¹[d₁ d₂], the exact step δ obeys
//
//   δ + δs·G δλ = w.
//
// Where |w_s|·‖G_λ‖ and ‖G_s‖·|w_λ| are below ¼ this is a contraction: the
// move lifts to exactly one δ, J stays regular on the way and Newton converges
// to it.  Longer moves are cut until that holds, so the walk cannot change to
// another sheet.  A step that leaves the triangle is cut at the wall; the same
// point and normal continue in the neighbour, at a vertex in the triangle
// around it that the move enters.
//
// The branch ends where the cut moves shrink to nothing (det J → 0, a fold)
// or where det J changes sign across a wall (a fold on the wall).
class BranchWalk {
 public:
  explicit BranchWalk(const FieldProjector& projector);

  // Moves (*triangle, *hit) along the branch to its projection of x_b.  False
  // when the branch ended on the way, *triangle and *hit are then the last
  // point that was reached.  Field frame.
  bool Follow(const FieldProjector& projector, const Eigen::Vector3d& x_b,
              NormalHit* hit, int* triangle) const noexcept;

  // Triangles around each vertex; for ring searches.
  const std::vector<int>& fan() const { return fan_; }
  const std::vector<int>& fan_start() const { return fan_start_; }

 private:
  bool EnterFan(const FieldProjector& projector, const Eigen::Vector3d& x_b,
                int corner, double sign, NormalHit* hit, int* triangle) const;

  std::vector<int> fan_start_;  // per vertex, into fan_
  std::vector<int> fan_;
};

}  // namespace phongpd
