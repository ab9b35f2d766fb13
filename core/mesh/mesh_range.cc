// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_range.h"

#include <sstream>

#include "core/mesh/finite.h"

namespace phongpd {

void RequireInRange(const TriangleMesh& mesh, const std::string& name) {
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) {
      if (v < 0 || v >= size || !IsFinite(mesh.vertices[v])) continue;
      const double largest = mesh.vertices[v].cwiseAbs().maxCoeff();
      if (largest <= kMaxCoordinate) continue;
      std::ostringstream what;
      what << name << ": size out of range; expected coordinates of at most "
           << kMaxCoordinate << ", found " << largest << " at vertex " << v
           << " (from 0); use another unit";
      throw InputError(what.str());
    }
  }
}

}  // namespace phongpd
