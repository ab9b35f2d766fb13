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

// What is to be known of the operands, and what it cost.
struct ConvolutionReport {
  double seconds = 0.0;  // wall time until questions could be asked
  // As of a contact space (contact_space_report.h).
  double grid_step = 0.0;
  Approximation approximation;
  std::vector<std::string> warnings;
};

// Free space without a contact space: whether motions are free, and distances
// from outside, from the reduced convolution of two operands.  Depths and cells
// it cannot tell.  Facets of the convolution are made when a question needs
// them: the first question in a region takes about a millisecond, further ones
// take microseconds.  The model itself is ready in a few hundredths of the time
// that a contact space takes.
//
// Why it is exact.  C_cont is part of the convolution, and directly behind each
// facet of the convolution the operands overlap.  A motion that starts free
// leaves free space at the first facet that it meets, from the front; so it is
// free iff it meets no facet.  The straight way from a free q to the nearest
// point of the convolution meets no other facet, so it is free: that point is
// the nearest one of C_cont.  The same holds for all points of a free segment.
//
// Configurations are rounded to 2⁻¹² of a grid step, which is 2⁻⁵⁰ of the
// operands.  *Whether* is exact for the rounded ones; *where* and *how far* are
// rounded.  User's unit throughout.
//
// An immutable handle: copies are cheap, share everything and may be used by
// any number of threads.
class ConvolutionModel {
 public:
  // Operands are prepared as BuildContactSpace prepares them, by the same
  // options.  Throws InputError as that does, also for outer_shell_only, since
  // cavities are not known here; and BuildRefusal if a limit is passed before
  // the model is ready.  Later questions are never refused: beyond max_mib (0:
  // nine tenths of the free memory) the facets they need are not kept.
  ConvolutionModel(const Solid& robot, const Solid& obstacle,
                   const ContactSpaceOptions& options = {});
  ConvolutionModel(const TriangleMesh& robot, const TriangleMesh& obstacle,
                   const ContactSpaceOptions& options = {});

  // Do A + q and B share no point?  False for q that is not finite, or farther
  // than about 1e300 grid steps.
  bool IsFree(const Eigen::Vector3d& q) const;
  // Is every point of the closed segment free?
  bool IsFree(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // The share of the way from a to b before the first contact, rounded: 0 if a
  // is not free or b is not finite, more than 1 iff IsFree(a, b).
  double FirstContact(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  struct Nearest {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  // of C_cont
    double distance = 0.0;                            // from it, ≥ 0
  };
  // The nearest contact of a free q.  If q is not free: q itself and 0, for how
  // deep it is the convolution cannot tell (DepthQuery can).  If q is not
  // finite: the origin and 0.
  Nearest FindNearest(const Eigen::Vector3d& q) const;

  // Distance of the closed segment from C_cont if that is below `limit` > 0,
  // and `limit` otherwise; 0 where it is not free.
  double Clearance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   double limit) const;

  // Facets of the convolution whose planes separate the segment between two
  // finite points from all other facets within `radius` ≥ 0, with `slack` ≥ 0
  // (separators.h).  Those of C_cont are among them; others may lie hidden
  // inside C_obj.  Facets behind the planes are not made for this.
  std::vector<Separator> FindSeparators(const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b, double radius,
                                        double slack) const;

  // Of C_cont.
  const BoundingBox& bounds() const;
  const ConvolutionReport& report() const;

  // Facets made so far; some may be counted several times.
  std::size_t facets() const;
  // All facets, rounded: C_cont and what it hides.  For pictures; each call
  // takes the time and memory of the whole convolution.
  TriangleMesh Mesh() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace phongpd
