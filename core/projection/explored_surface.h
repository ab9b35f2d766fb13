// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/convolution_model.h"
#include "core/contact/explored_boxes.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/contact_surface.h"
#include "core/projection/smoothed_normal.h"
#include "core/projection/window_use.h"

namespace phongpd::internal {

// C_cont as far as questions lead to it.  Boxes of configuration space
// (explored_boxes.h) are arranged when an answer depends on them, those nearest
// to the question first, and are kept: all that is nearer than a point of
// C_cont that is known has been looked at, so that point is the nearest one;
// and G_ρ is a sum over boxes, of which those within ρ count.
//
// C_cont is cut at the boxes' walls, so answers are those of the whole but for
// rounding, and of several nearest points another may be given.  Not
// thread-safe.  Throws BuildRefusal where one question passes the model's
// limits, BuildCancelled, and std::logic_error where cells at the walls are too
// thin to be judged.
class ExploredSurface {
 public:
  // Keeps the model.  ρ of Sum, user's unit; 0: nobody will ask for it.
  ExploredSurface(const ConvolutionModel& model, double radius);

  // The point of C_cont nearest to a q that is not free; `triangle` is −1.
  NearestContact FindNearest(const Eigen::Vector3d& q);
  // G_ρ (smoothed_normal.h) at a finite x.
  SmoothedNormal Sum(const Eigen::Vector3d& x);

  // Of the frame that distances are in: TriangleBvh::scale of all of C_cont,
  // or so.
  double scale() const { return scale_; }
  // Its boxes, faces, extensions and seconds.
  const WindowUse& use() const { return use_; }

 private:
  // C_cont in a box.
  struct Part {
    TriangleMesh mesh;
    std::vector<Eigen::Vector3d> normals;  // of triangles
    std::shared_ptr<const TriangleBvh> bvh;
    std::optional<SmoothedNormals> sums;
  };

  void Explore(int box);
  // Boxes within `reach` grid steps of x, that were not arranged, nearest
  // first.
  std::vector<std::pair<double, int>> Unknown(const Eigen::Vector3d& x,
                                              double reach);
  void Improve(const Part& part, const Eigen::Vector3d& q,
               NearestContact* nearest) const;

  ExploredBoxes boxes_;
  double radius_, scale_;
  std::vector<Part> parts_;
  WindowUse use_;
};

}  // namespace phongpd::internal
