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

using WindowPhongResult = WindowResult;  // old name, removed in 0.3

// PhongPD without the whole contact space: cold queries of PhongMetric, from
// windows of C_cont that grow around q until one certifies its answer.
//
// ℓ = 0.  A window is arranged exactly, in boxes as in free_space_flood.h.  A
// flat patch of C_cont that no wall of the window cuts has the same triangles
// as in the whole, and a vertex has the same normal if all patches around it
// are uncut.  Triangles that are uncut and have such vertices project as in the
// whole field (but for slivers lower than 1e-6 of the whole, where rounding
// decides). A projection is never shorter than the distance to its triangle. So
// one that is shorter than the distance to everything else is the least of all.
// Faces as large as the bodies need large windows.
//
// ℓ > 0.  Normals are diffused over all of C_cont, so no window is enough: the
// first query inside builds the whole, and `level` says so.
//
// What is built costs about as much as with BuildContactSpace and PhongMetric.
// Use it for one or a few queries, or for many near each other; otherwise, and
// to follow a branch, build the contact space.
class WindowPhong {
 public:
  // Keeps the model.  Throws InputError for options.
  explicit WindowPhong(const ConvolutionModel& model,
                       const PhongMetricOptions& options = {});
  ~WindowPhong();
  WindowPhong(WindowPhong&&) noexcept;
  WindowPhong& operator=(WindowPhong&&) noexcept;

  // For the robot moved by q; kInvalid if q is not finite.  Thread-safe, but
  // one query runs at a time.  Throws BuildRefusal if this query passes the
  // model's limits, BuildCancelled, and std::logic_error if cells at the walls
  // of boxes are too thin to be judged.
  WindowResult At(const Eigen::Vector3d& q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
