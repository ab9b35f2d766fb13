// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/contact/contact_space.h"
#include "core/projection/penetration_metric.h"

namespace phongpd {

// Euclidean penetration depth: q_c is the point of C_cont closest to q_o
// (paper, Eqs. 1 and 2), found in a box tree; accurate to 1e-14 diagonals of
// the contact space, slivers included.  The baseline PhongPD is compared with.
// Its direction jumps across the medial axis; `previous` is ignored, results
// have no branch, and `gradient` equals `direction` on both sides.  On C_cont
// (signed distance 0, not inside) the direction is the facet's normal.
// At a re-entrant edge with less than 90° of free space it may point into the
// opposite facet: then a step along it does not leave C_obj.
class EuclideanMetric final : public PenetrationMetric {
 public:
  explicit EuclideanMetric(const ContactSpace& space);
  ~EuclideanMetric() override;
  EuclideanMetric(EuclideanMetric&&) noexcept;
  EuclideanMetric& operator=(EuclideanMetric&&) noexcept;

  using PenetrationMetric::Query;
  PenetrationResult Query(const Eigen::Vector3d& q_o,
                          const Branch& previous) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
