// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/projection/phong_field.h"
#include "core/projection/phong_metric.h"

namespace phongpd {

// The region in which to draw samples for a path from start to goal, in a scene
// without bounds: the bounding box of the cells of free space that contain
// start and goal.  If one of these cells is unbounded (or unknown, or start or
// goal is not free), it is the box of the mesh, start and goal, with room on
// every side.  If a path exists, one exists within the box: it may serve as
// bounds.  `space` is one contact space of all obstacles.
BoundingBox SamplingRegion(const ContactSpace& space,
                           const Eigen::Vector3d& start,
                           const Eigen::Vector3d& goal);

// What retraction and sliding need of the contact spaces of a robot that
// translates: exact tests of motions, penetration metrics, normals of facets,
// and the room in front of a facet.  Immutable and thread-safe: share one model
// among all planners and threads of a scene.
//
// It takes one contact space per obstacle, or better one of all obstacles
// (MergedObstacle, with the shell of the bounds): then a retracted point never
// lies in another obstacle.
class ContactModel {
 public:
  // Spaces and bounds as for FreeSpace; `field` is that of the Phong metric.
  // The default ℓ = 0 is right for planning: ℓ > 0 changes neither what is
  // solved nor the number of samples.  Throws InputError for options, and if
  // there is neither a space nor bounds.
  explicit ContactModel(
      const std::vector<ContactSpace>& spaces,
      const BoundingBox& bounds = FreeSpace::NoBounds(),
      const PhongFieldOptions& field = PhongFieldOptions::Unsmoothed());
  ~ContactModel();
  ContactModel(ContactModel&&) noexcept;
  ContactModel& operator=(ContactModel&&) noexcept;

  const FreeSpace& free_space() const;
  std::size_t size() const { return free_space().size(); }
  const ContactSpace& space(int space) const;
  const PhongMetric& phong(int space) const;

  // Where samples are drawn: the bounds, or without bounds the box of all
  // meshes.  (A shell of bounds makes that box too large: see SamplingRegion.)
  const BoundingBox& region() const;
  // The region's diagonal; lengths below refer to it.
  double diagonal() const { return region().Diagonal(); }
  // 1e-9 · diagonal, the least distance of new points from contact.  Without
  // it, slides would converge onto C_cont, and rounding would decide whether
  // their paths are free.
  double floor() const { return 1e-9 * diagonal(); }

  // A point of a contact surface or of the bounds, with the unit normal that
  // points into free space; the normal is zero for a facet without area.
  struct Facet {
    int space = MotionCheck::kNone;  // or MotionCheck::kBounds
    int triangle = -1;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  // Outward unit normal of a triangle.
  const Eigen::Vector3d& Normal(int space, int triangle) const;

  // TriangleNeighbors of the space's mesh.
  const std::vector<std::array<int, 3>>& Neighbors(int space) const;

  // The facet that the motion from a to b hits first.  `check` is the answer of
  // free_space().Check: not free, and not at the start.  Of triangles that are
  // hit at the same point, to rounding, the one that opposes the motion most.
  Facet FacetMet(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                 const MotionCheck& check) const;

  // The facet closest to q, of all spaces and bounds; if q lies in several
  // spaces, that of the space in which it is deepest.  *distance is signed, and
  // its sign is exact: > 0 iff q is free, < 0 inside an obstacle or beyond the
  // bounds.  If q is not finite: −∞, and no facet.
  Facet FindNearest(const Eigen::Vector3d& q, double* distance) const;

  // How far from the facet a point should be, along its normal, so that it
  // stays in the middle of a narrow passage: min(clearance, half the free gap),
  // user's unit, ≥ 0.  Triangles that touch the facet's point are ignored,
  // because a projection often lies on an edge.
  double Standoff(const Facet& facet, double clearance) const;

  // Writes to *q the point of the facet moved off by its standoff.  If that is
  // close to another facet (in the corner of a channel), it is moved off that
  // one, too, at most four times.  *room is its distance from the nearest
  // contact.  Returns false, and leaves *q, if no point with floor() was found.
  bool LiftOff(Facet facet, double clearance, Eigen::Vector3d* q,
               double* room) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
