// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/convolution_model.h"
#include "core/projection/smoothed_metric.h"
#include "core/projection/window_phong.h"

namespace phongpd {

// SmoothedMetric without the whole contact space, at any ℓ and orientation:
// what is within ρ of q_o (SmoothedAt::kContact: within ρ of q_c) decides, so
// one window of C_cont that holds it and the nearest contact is enough.  A
// window that was built before and holds them is not built again.  D is the
// diagonal of the model's bounds.
//
// Costs about what BuildContactSpace would for what is built: less than that
// where ρ is small beside the bodies, and the more windows the more.
class WindowSmoothed {
 public:
  // Keeps the model.  Throws InputError as SmoothedMetric.
  explicit WindowSmoothed(const ConvolutionModel& model,
                          double smoothing_length = kDefaultSmoothingLength,
                          SmoothedAt at = SmoothedAt::kPosition);
  ~WindowSmoothed();
  WindowSmoothed(WindowSmoothed&&) noexcept;
  WindowSmoothed& operator=(WindowSmoothed&&) noexcept;

  // At a robot moved by q: of SmoothedMetric on the whole contact space, to
  // rounding; throws and leaves out as WindowPhong::At.
  WindowResult At(const Eigen::Vector3d& q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
