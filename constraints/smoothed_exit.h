// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/convolution_model.h"

namespace phongpd::internal {

// Where a ray from inside C_obj meets C_cont first, and the smoothed normal of
// C_cont there.
struct Exit {
  bool is_found = false;
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  // q_c
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   // n_ρ(q_c), unit
};

// Such rays from one q, by a window of C_cont that grows until it holds the
// ball of radius ρ around the contact.  User's unit; not thread-safe.
class SmoothedExit {
 public:
  // q inside C_obj; `depth` > 0, about how far C_cont is.
  SmoothedExit(const ConvolutionModel& model, const Eigen::Vector3d& q,
               double depth);
  ~SmoothedExit();
  SmoothedExit(const SmoothedExit&) = delete;
  SmoothedExit& operator=(const SmoothedExit&) = delete;

  // Along a unit direction, with ρ = `share` · |q_c − q|.  Not found: the ray
  // grazes what rounding hides, or what is around q_c cancels.  Throws
  // BuildRefusal as ConvolutionModel's limits, std::logic_error as
  // ExploredBoxes::Surface.
  Exit Along(const Eigen::Vector3d& direction, double share);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::internal
