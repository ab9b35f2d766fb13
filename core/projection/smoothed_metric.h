// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/contact/contact_space.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/phong_field.h"

namespace phongpd {

// Where the direction is taken.
enum class SmoothedAt {
  kPosition,  // at q_o: continuous in it while the direction is known
  kContact,   // at q_c, and jumps where q_c does
};

// ρ = 2ℓD, user's unit.  Throws InputError unless ℓ, a share of D, is in
// [1e-9, 1].
double SmoothedRadius(double smoothing_length, double diagonal);

// Euclid's depth with a smoothed direction.
//
// Inside C_obj: value, contact and `gradient` are those of EuclideanMetric, bit
// for bit.  `direction` is the gradient of smoothed occupancy
// (smoothed_normal.h) at q_o or at q_c, outward.  It does not point from q_o to
// q_c, and its product with `gradient` may be anything up to 1, even negative.
// If there is no such direction, it is Euclid's own, and the status is
// kEuclideanFallback: if nothing of C_cont is within ρ, as for q_o deeper than
// ρ, or if what is there cancels out, as in the middle of a plate.  Towards the
// depth ρ the smoothed direction becomes Euclid's.
// Outside and on C_cont: the answer of EuclideanMetric, bit for bit.
//
// It has no field, branch or memory: `previous` is ignored.  It is for
// optimisers, which follow a direction; for the depth alone EuclideanMetric is
// faster.
class SmoothedMetric final : public PenetrationMetric {
 public:
  // ℓ as a share of D (ContactSpace::length), in [1e-9, 1]: what lies within
  // 2ℓ counts.  Throws InputError otherwise.
  explicit SmoothedMetric(const ContactSpace& space,
                          double smoothing_length = kDefaultSmoothingLength,
                          SmoothedAt at = SmoothedAt::kPosition);
  ~SmoothedMetric() override;
  SmoothedMetric(SmoothedMetric&&) noexcept;
  SmoothedMetric& operator=(SmoothedMetric&&) noexcept;

  using PenetrationMetric::Query;
  PenetrationResult Query(const Eigen::Vector3d& q_o,
                          const Branch& previous) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
