// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>

#include "core/contact/convolution_model.h"
#include "core/contact/depth.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/phong_metric.h"

namespace phongpd {

// The answer of a metric from windows: of WindowPhong and of WindowSmoothed.
// User's unit.
struct WindowResult {
  // What the metric says on the whole contact space, cold.  Without triangle
  // and branch: here they would number what was built for this query only.
  PenetrationResult answer;
  // How much of C_cont was built for it: kNone outside of C_obj.
  DepthLevel level = DepthLevel::kNone;
  int windows = 0;                 // built for it; 0: an earlier one was enough
  std::size_t arranged_faces = 0;  // in these windows

  // The same in the words of all depths, as PenetrationResult::ToDepth.
  Depth ToDepth() const;
};

using WindowPhongResult = WindowResult;  // what it was called, until 0.3

// PhongPD without the whole contact space: cold queries of PhongMetric from
// windows of C_cont that grow around q until one certifies its answer.
//
// ℓ = 0: a window is arranged exactly (free_space_flood.h has its boxes).  A
// flat patch of C_cont that no wall cuts is cut into triangles as in the whole,
// and a vertex has its own normal where all patches around it are such.
// Triangles of which both holds project as in the whole field; not around
// slivers lower than 1e-6 of the whole, where that is a matter of rounding.  A
// projection is never shorter than the way to its triangle; so one that is
// shorter than the way to the nearest other place is the least of all.  Faces
// as large as bodies need large windows.
//
// ℓ > 0 diffuses normals over all of C_cont: no window is enough, the first
// query that penetrates builds the whole, and `level` says so.
//
// Costs about what PhongMetric and BuildContactSpace would for what is built;
// for one or a few queries, or many near each other.  Otherwise, and to follow
// a branch, build the contact space.
class WindowPhong {
 public:
  // Keeps the model.  Throws InputError for options.
  explicit WindowPhong(const ConvolutionModel& model,
                       const PhongMetricOptions& options = {});
  ~WindowPhong();
  WindowPhong(WindowPhong&&) noexcept;
  WindowPhong& operator=(WindowPhong&&) noexcept;

  // At a robot moved by q; kInvalid where q is not finite.  Thread-safe, one at
  // a time.  Throws BuildRefusal where this query passes the model's limits,
  // BuildCancelled, and std::logic_error where cells at the walls of boxes are
  // too thin to be judged.
  WindowResult At(const Eigen::Vector3d& q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
