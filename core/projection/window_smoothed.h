// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/convolution_model.h"
#include "core/projection/smoothed_metric.h"
#include "core/projection/window_phong.h"

namespace phongpd {

// SmoothedMetric without the whole contact space, for any ℓ.  The direction
// depends on what is within ρ of q_o (SmoothedAt::kContact: of q_c), so one
// window of C_cont is enough that holds this and the nearest contact.  An
// earlier window that holds them is used again.  D is the diagonal of the
// model's bounds.
//
// What is built costs about as much as with BuildContactSpace: less than the
// whole if ρ is small beside the bodies, and more with each window.
class WindowSmoothed {
 public:
  // Keeps the model.  Throws InputError as SmoothedMetric.
  explicit WindowSmoothed(const ConvolutionModel& model,
                          double smoothing_length = kDefaultSmoothingLength,
                          SmoothedAt at = SmoothedAt::kPosition);
  ~WindowSmoothed();
  WindowSmoothed(WindowSmoothed&&) noexcept;
  WindowSmoothed& operator=(WindowSmoothed&&) noexcept;

  // For the robot moved by q: the answer of SmoothedMetric on the whole contact
  // space, to rounding.  Leaves out, and throws, what WindowPhong::At does.
  WindowResult At(const Eigen::Vector3d& q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
