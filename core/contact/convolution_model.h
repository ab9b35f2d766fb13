// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/bounds/approximation.h"
#include "core/bvh/separators.h"
#include "core/minkowski/contact_space_options.h"
#include "core/solid/solid.h"

namespace phongpd {

// What was said of the operands, and at what cost.
struct ConvolutionReport {
  double seconds = 0.0;  // wall time until questions could be asked
  // As of a contact space (contact_space_report.h).
  double grid_step = 0.0;
  Approximation approximation;
  std::vector<std::string> warnings;
};

// All that the reduced convolution of two operands tells of free space without
// C_cont being built: motion checks, and distances from outside.  It tells
// neither depths nor cells.  Of the convolution itself only what questions lead
// to is modelled, so the first question in a region costs about a millisecond
// and further ones microseconds; ready it is after some hundredths of the time
// that a contact space takes.
//
// Why it is exact: C_cont is part of the convolution, and directly behind each
// facet of that the operands overlap.  A motion that starts free meets the
// convolution first where it leaves free space, from the front; so it is free
// iff it meets no facet.  Nothing lies on the straight way from a free q to the
// nearest point of the convolution, which so is free up to it: that point is
// the nearest one of C_cont.  So it is for all points of a free segment.
//
// Configurations are rounded to 2⁻¹² of a grid step, 2⁻⁵⁰ of the operands, and
// *whether* is exact for what they are rounded to.  *Where* and *how far* are
// rounded.  User's unit throughout.
//
// An immutable handle: copies are cheap, share everything and may be used by
// any number of threads.
class ConvolutionModel {
 public:
  // Of the operands that BuildContactSpace would build with, prepared by the
  // same options.  Throws InputError as that does, also for outer_shell_only,
  // as nothing is known of cavities, and BuildRefusal when a limit is passed
  // until it is ready.  Afterwards questions refuse nothing: beyond max_mib (0:
  // nine tenths of what is free) what they lead to is not kept.
  ConvolutionModel(const Solid& robot, const Solid& obstacle,
                   const ContactSpaceOptions& options = {});
  ConvolutionModel(const TriangleMesh& robot, const TriangleMesh& obstacle,
                   const ContactSpaceOptions& options = {});

  // Do A + q and B share no point?  False for q that is not finite, or farther
  // than about 1e300 grid steps.
  bool IsFree(const Eigen::Vector3d& q) const;
  // Is every point of the closed segment free?
  bool IsFree(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // The share of the way from a to b up to the first contact, rounded: 0 where
  // a is not free or b not finite, more than 1 iff IsFree(a, b).
  double FirstContact(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  struct Nearest {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  // of C_cont
    double distance = 0.0;                            // from it, ≥ 0
  };
  // From a free q; q itself and 0 where it is not free: how deep it is the
  // convolution does not tell (DepthQuery does).  The origin and 0 for q that
  // is not finite.
  Nearest FindNearest(const Eigen::Vector3d& q) const;

  // Distance of the closed segment from C_cont if that is below `limit` > 0,
  // and `limit` otherwise; 0 where it is not free.
  double Clearance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   double limit) const;

  // Facets of the convolution whose planes keep the segment between finite
  // points from all others within `radius` ≥ 0, `slack` ≥ 0 (separators.h).
  // What C_cont has there is part of them; others are hidden inside C_obj.
  // Facets that the planes hide are not modelled for it.
  std::vector<Separator> FindSeparators(const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b, double radius,
                                        double slack) const;

  // Of C_cont.
  const BoundingBox& bounds() const;
  const ConvolutionReport& report() const;

  // Facets modelled so far; some may be counted several times.
  std::size_t facets() const;
  // All facets, rounded: C_cont and what it hides.  For pictures: made for
  // this, at the time and memory of the whole convolution.
  TriangleMesh Mesh() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace phongpd
