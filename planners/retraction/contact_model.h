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

// Where samples for a path from start to goal are worth drawing in a scene
// without bounds: the box around the cells of free space that hold them.  The
// box around the mesh, start and goal, with room on every side, if one of them
// is unbounded (or not told apart by rays, or not free).  Start and goal are
// joined within the box if they are joined at all, so it may be used as bounds.
// One space for all obstacles.
BoundingBox SamplingRegion(const ContactSpace& space,
                           const Eigen::Vector3d& start,
                           const Eigen::Vector3d& goal);

// What retraction and sliding ask of the contact spaces of a robot that
// translates: exact motion checks, both penetration metrics, facet normals,
// and how much room there is in front of a facet.  Const and thread-safe; one
// model is shared by all planners and threads of a scene.
//
// One contact space per obstacle, or one for all (MergedObstacle with the
// bounds shell), which is preferred: a retracted point then never lies in
// another obstacle.
class ContactModel {
 public:
  // As FreeSpace; the field is the one of the Phong metric.  Its ℓ = 0 is
  // right for planning: a limited field with ℓ > 0 changes neither what is
  // solved nor the samples it takes.
  // Throws InputError for options, and if there is neither a space nor bounds.
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

  // Where samples are drawn: the bounds, or the box around all meshes (which
  // is much of what a bounds shell is made of: see SamplingRegion).
  const BoundingBox& region() const;
  // Of the region; every length below refers to it.
  double diagonal() const { return region().Diagonal(); }
  // 1e-9 · diagonal: no point made here comes closer to a contact surface.
  // Slides whose points may come within rounding of C_cont converge onto it
  // and leave paths that no other program can confirm.
  double floor() const { return 1e-9 * diagonal(); }

  // A point of a contact surface or of the bounds, with the unit normal that
  // points into the free side; zero at a facet without area.
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

  // What the motion from a to b met; `check` is what free_space().Check said
  // of it, not free, and not at its start.  Of triangles met within rounding
  // of each other the one that opposes the motion most.
  Facet FacetMet(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                 const MotionCheck& check) const;

  // The facet closest to q over all spaces and bounds; of spaces that hold q
  // the one it is deepest in.  *distance is signed: < 0 within an obstacle or
  // beyond the bounds (sign exact), > 0 iff q is free; −∞, with no facet, for q
  // not finite.
  Facet FindNearest(const Eigen::Vector3d& q, double* distance) const;

  // min(clearance, ½ · free gap) along the facet's normal: how far a point in
  // front of the facet should stand off so that it neither touches nor closes
  // the passage it is in.  Every triangle that touches the facet's point is
  // ignored (a projection often lies on an edge).  ≥ 0.
  double Standoff(const Facet& facet, double clearance) const;

  // Moves off the facet by its standoff.  Where that leaves the point close to
  // another facet (the corner of a channel) off that one too, at most four
  // times.  False if no point that keeps the floor was found; *q is then
  // untouched.  *room is the distance from *q to what is nearest.
  bool LiftOff(Facet facet, double clearance, Eigen::Vector3d* q,
               double* room) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
