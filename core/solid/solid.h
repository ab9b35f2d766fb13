// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/solid/mesh_check.h"

namespace phongpd {

// A mesh that bounds a solid, and its name in messages.  The mesh was checked
// once, when the solid was made (MakeSolid, RepairSolid): a function that takes
// a Solid need not check it again.
//
//   const Solid part = MakeSolid(ReadMesh("part.stl"), "part.stl");
//
// The solid is { p : w(p) > 0 }, with w(p) the number of bodies around p less
// the number of cavities around it.  Components may overlap: their union is
// meant.
//
// An immutable handle: copies are cheap, share the mesh and may be used by any
// number of threads.
class Solid {
 public:
  // No solid yet: no triangles, no name.  Functions that take a solid refuse it
  // (RequireNotEmpty).
  Solid();

  // Closed, edge-manifold, outward; user's unit.
  const TriangleMesh& mesh() const { return data_->mesh; }
  // A solid can be used wherever a mesh can.
  operator const TriangleMesh&() const { return mesh(); }  // NOLINT
  bool IsEmpty() const { return mesh().triangles.empty(); }

  const std::string& name() const { return name_; }
  // The same under another name.
  Solid Named(std::string name) const;

  // What the check found and did.
  const MeshReport& report() const { return data_->report; }

  // Do both have the same vertices and triangles, in the same order?
  bool HasSameMesh(const Solid& other) const;

 private:
  struct Data {
    TriangleMesh mesh;
    MeshReport report;
  };

  Solid(Data data, std::string name);
  friend Solid MakeSolid(const TriangleMesh& mesh, const std::string& name,
                         MeshReport* report);
  friend Solid JoinedSolids(const std::vector<Solid>& solids,
                            const std::string& name);

  std::shared_ptr<const Data> data_;
  std::string name_;
};

// The mesh as a solid: finite, valid indices, lengths in range (mesh_range.h),
// closed, edge-manifold, consistently oriented, no self-intersection within a
// component, every shell enclosing a volume and facing the right way.  What it
// does by itself:
//  - Vertices with exactly equal coordinates are joined when that leaves
//    fewer bad edges than before, as in files that repeat a vertex for every
//    face or seam.  A mesh that is closed as it is keeps its duplicates.
//  - Triangles that use a vertex twice and unused vertices are left out.
//    Other zero-area triangles stay, because the surface needs them.
//  - Shells (edge-connected parts) that face the wrong way are turned.  A
//    shell faces outward when its volume is positive, or negative while it is
//    a cavity of positive ones.  An outermost shell is turned together with
//    what it encloses: a mirrored file gives the same solid.
// Each is counted in the report and said in its warnings.
//
// Throws InputError, one line naming `name`, the defect and its count.
// `report` may be null; otherwise it is filled before a throw too.
Solid MakeSolid(const TriangleMesh& mesh, const std::string& name,
                MeshReport* report = nullptr);

// The mesh file as a solid, called by its path.  Throws as ReadMesh and
// MakeSolid do.
Solid ReadSolid(const std::string& path);

// Throws InputError by the solid's name, or `what` where it has none.
void RequireNotEmpty(const Solid& solid, const std::string& what);

// Several solids as one, their union.  Each component stays as it is, so
// nothing needs to be checked.  Triangles and vertices come in the order of the
// solids; the report has the sums of their counts.
Solid JoinedSolids(const std::vector<Solid>& solids, const std::string& name);

}  // namespace phongpd
