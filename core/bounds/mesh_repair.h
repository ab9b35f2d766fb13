// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/solid/solid.h"

namespace phongpd {

// What to do about an operand that is no solid.
enum class Repair {
  kReject,  // refuse it by name and count
  kSafe,    // mend what does not change the solid, refuse the rest
  kWrap,    // mend as above, and wrap what is left (an approximation)
};

// Everything a repair did.
struct RepairReport {
  std::size_t duplicate_faces = 0;   // removed: same corners, same direction
  std::size_t mirrored_faces = 0;    // removed in pairs: opposite directions
  std::size_t degenerate_faces = 0;  // removed: no area, not needed to close
  std::size_t turned_faces = 0;      // oriented like their neighbours
  std::size_t joined_vertices = 0;   // same coordinates as another one
  bool is_wrapped = false;
  std::string wrap_reason;  // why: the defect, in MakeSolid's words
  double wrap_alpha = 0.0;  // of the diagonal
  double wrap_bound = 0.0;  // see WrapTriangles; user's unit
  // One sentence per action.
  std::vector<std::string> actions;
};

// The alpha of a repairing wrap if none is asked for, of the diagonal.
inline constexpr double kRepairAlpha = 0.02;

// Mends what does not change the solid, as far as it leaves no more open or
// non-manifold edges than there were, part by part:
//  - of faces with the same corners (by coordinates) and direction, one stays;
//    of two directions both go (an inner wall, a sheet of no thickness),
//    unless the part then is gone: then it was doubled, and one stays;
//  - faces without area go, where the surface is closed without them;
//  - vertices of equal coordinates are joined where that closes edges;
//  - faces are turned like most of their neighbours.
// Outward orientation is MakeSolid's.  A mesh with bad indices or coordinates
// that are no numbers comes back as it is.
TriangleMesh RepairSafely(const TriangleMesh& mesh, RepairReport* report);

// MakeSolid after a repair of the given kind; kReject is MakeSolid.  Throws
// InputError as MakeSolid does; kWrap still refuses a mesh without any area,
// with bad indices or without numbers.  Reports may be null.
Solid RepairSolid(const TriangleMesh& mesh, const std::string& name,
                  Repair repair, double wrap_alpha = kRepairAlpha,
                  MeshReport* mesh_report = nullptr,
                  RepairReport* repair_report = nullptr);

}  // namespace phongpd
