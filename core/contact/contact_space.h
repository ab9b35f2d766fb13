// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/contact_space_options.h"
#include "core/minkowski/contact_space_report.h"
#include "core/solid/solid.h"

namespace phongpd {

// C_cont = ∂C_obj with C_obj = B ⊕ (−A): the boundary of the set of robot
// positions q at which A + q and B overlap.  It is closed and points outward.
// Bounded free cavities are part of it, as shells that point inward.  Topology
// is exact; coordinates are the exact vertices, rounded to double.
//
// An immutable handle: copies are cheap, share everything, and may be used by
// any number of threads.  The indexes in which metrics, judges and planners
// search are built once, on first use, and shared by all of them.
class ContactSpace {
 public:
  // What a contact space is made of, as plain data.
  struct Parts {
    TriangleMesh mesh;
    // Supporting plane of each triangle: triangles with equal id lie exactly
    // in one oriented plane.  Empty: not known.
    std::vector<int> plane;
    std::vector<ContactKind> kind;  // of each triangle; empty: not known
    ContactSpaceReport report;
  };

  // Throws InputError, which begins with `name`, unless the mesh is closed and
  // edge-manifold, with triangles, valid indices, finite coordinates and a
  // diagonal in [1e-150, 1e150]; also if `plane` or `kind` is neither empty nor
  // as long as the list of triangles.
  explicit ContactSpace(Parts parts, const std::string& name = "contact space");

  const Parts& parts() const { return data_->parts; }
  const TriangleMesh& mesh() const { return data_->parts.mesh; }
  const std::vector<int>& plane() const { return data_->parts.plane; }
  const std::vector<ContactKind>& kind() const { return data_->parts.kind; }
  const ContactSpaceReport& report() const { return data_->parts.report; }
  const BoundingBox& bounds() const { return data_->bounds; }

  // D, user's unit: the length that every share (smoothing length, reach,
  // margin) refers to.  It is the diagonal of the bounding box unless
  // WithLength gave another one.  All contact spaces of a world have the
  // world's D.
  double length() const {
    return HasOwnLength() ? length_ : bounds().Diagonal();
  }
  // Was D given by WithLength?
  bool HasOwnLength() const { return length_ > 0.0; }
  // The same space with a D of its own, > 0 and finite; throws InputError
  // otherwise.
  ContactSpace WithLength(double length) const;

  // The one index: distances, segments, inside.
  const TriangleBvh& bvh() const;
  // Unit normals of the triangles, outward; zero where there is no area.
  const std::vector<Eigen::Vector3d>& normals() const;

  // Do both share mesh and indexes?
  bool SharesWith(const ContactSpace& other) const {
    return data_ == other.data_;
  }

 private:
  struct Indexes;
  struct Data {
    Parts parts;
    BoundingBox bounds;
    std::unique_ptr<Indexes> indexes;

    Data();
    ~Data();
  };

  ContactSpace() = default;  // to be given its data
  friend ContactSpace TakeAsContactSpace(TriangleMesh mesh,
                                         const std::string& name);
  // Checked.
  static std::shared_ptr<Data> MakeData(Parts parts, const std::string& name);

  std::shared_ptr<const Data> data_;
  double length_ = 0.0;  // 0: the diagonal
};

// Builds the contact space of a translating `robot` (A) and a fixed
// `obstacle` (B) by reduced convolution on an integer grid, exact arrangement
// per supporting plane, and one collision judgement per candidate cell
// (design and references: core/README.md).  Operands may have any genus and
// several, even overlapping, components.
//
// Throws InputError, naming the operand, if no solid is left of it on the grid,
// and BuildRefusal if a limit is passed.  Throws std::logic_error if the
// arrangement leaks (the unbounded cell turns out to be occupied), which no
// valid input should cause.
ContactSpace BuildContactSpace(const Solid& robot, const Solid& obstacle,
                               const ContactSpaceOptions& options = {});

// The same for meshes, which go through RepairSolid first, under the names in
// the options.  Components that are inside out are turned, and the report says
// so; a mesh that cannot be used throws InputError.  With the default options
// nothing else is changed.
ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options = {});

// The same spaces with one D: the one that all of them were given
// (WithLength), or else the diagonal of the bounding box around all of them.
// A share of D is then the same length for every obstacle.
std::vector<ContactSpace> WithCommonLength(std::vector<ContactSpace> spaces);

// Takes any closed mesh as a contact space: one that was saved, or a boundary
// of forbidden positions that was found in another way.  Nobody checks that it
// is a Minkowski sum: given a bracket's own mesh, every answer is that for a
// robot that is a single point.  Planes and kinds are not known; the report is
// that of the mesh alone, with method "taken from a mesh".  Throws as
// ContactSpace does.
ContactSpace TakeAsContactSpace(TriangleMesh mesh,
                                const std::string& name = "contact mesh");

}  // namespace phongpd
