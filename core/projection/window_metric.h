// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/contact/convolution_model.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/smoothed_metric.h"
#include "core/projection/window_use.h"

namespace phongpd {

// EuclideanMetric or SmoothedMetric without the whole contact space, for many
// queries along a path: an optimiser's.  Outside of C_obj the convolution alone
// answers; inside, what of C_cont the answer depends on is modelled, box by box
// from q_o on (explored_surface.h), and kept for all further queries.  So the
// cost is that of what lies within the depth, and of a smoothed direction
// within ρ = 2ℓD, of the positions asked for that penetrate; where that is
// everything, several times that of the whole.
//
// Answers are those of the metric on the whole contact space but for rounding
// (1e-12 D), and `triangle` is −1.  Of several contacts as near another one may
// be given, and smoothed directions known to less than 1e-6 may be unknown.  A
// q_o whose distance rounds to 0 is on C_cont.
//
// Thread-safe, one at a time; a query may take long and allocate, and throws
// BuildRefusal where it passes the model's limits, BuildCancelled, and
// std::logic_error where cells at the walls of boxes are too thin to be judged.
class WindowMetric final : public PenetrationMetric {
 public:
  // Euclid's.  Keeps the model.
  explicit WindowMetric(const ConvolutionModel& model);
  // Smoothed: ℓ as a share of D, in [1e-9, 1], and D, user's unit, finite and
  // > 0.  Throws InputError otherwise.
  WindowMetric(const ConvolutionModel& model, double smoothing_length,
               double diagonal, SmoothedAt at = SmoothedAt::kPosition);
  ~WindowMetric() override;
  WindowMetric(WindowMetric&&) noexcept;
  WindowMetric& operator=(WindowMetric&&) noexcept;

  using PenetrationMetric::Query;
  PenetrationResult Query(const Eigen::Vector3d& q_o,
                          const Branch& previous) const override;

  // Over all queries so far.
  WindowUse Use() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
