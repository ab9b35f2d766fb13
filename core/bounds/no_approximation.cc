// SPDX-License-Identifier: GPL-3.0-or-later
// In the place of mesh_approximation.cc, where the part is left out.
#include <string>

#include "core/bounds/mesh_approximation.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

[[noreturn]] void Refuse(const std::string& what) {
  throw InputError(what +
                   ": expected a build with approximations, found one without; "
                   "configure with -D PHONGPD_BUILD=\"core;approximations\"");
}

}  // namespace

ApproximateMesh ConvexHull(const TriangleMesh& /*solid*/) {
  Refuse("convex hull");
}

ApproximateMesh Decimate(const TriangleMesh& /*solid*/,
                         std::size_t /*target_faces*/) {
  Refuse("decimation");
}

ApproximateMesh WrapSolid(const TriangleMesh& /*solid*/, double /*alpha*/) {
  Refuse("alpha wrap");
}

ApproximateMesh WrapTriangles(const TriangleMesh& /*mesh*/, double /*alpha*/) {
  Refuse("alpha wrap");
}

}  // namespace phongpd
