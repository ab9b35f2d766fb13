// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/shrunk_solid.h"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/unit_normal.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Simple_cartesian<double>;
using SphereTraits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
using Sphere = CGAL::Min_sphere_of_spheres_d<SphereTraits>;

// Below that a vertex would move 20 times as far as its faces do.
constexpr double kLeastCosine = 0.05;

// Towards the middle of the normals; not a unit vector.  Zero: of no faces.
Vector3d Middle(const std::vector<Vector3d>& normals) {
  if (normals.empty()) return Vector3d::Zero();
  Sphere sphere;
  for (const Vector3d& n : normals) {
    sphere.insert(Kernel::Point_3(n.x(), n.y(), n.z()));
  }
  const auto* const center = sphere.center_cartesian_begin();
  return {center[0], center[1], center[2]};
}

std::vector<std::vector<Vector3d>> NormalsAtVertices(const TriangleMesh& mesh) {
  std::vector<std::vector<Vector3d>> normals(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles) {
    const Vector3d n = UnitNormal(mesh, triangle);
    if (n.isZero(0.0)) continue;  // has no area, and no side
    for (const int v : triangle) {
      normals[static_cast<std::size_t>(v)].push_back(n);
    }
  }
  return normals;
}

// Has a face been turned over, as those of a wall are that has met itself?
bool IsAnyTurned(const TriangleMesh& before, const TriangleMesh& after) {
  for (const Triangle& triangle : before.triangles) {
    const Vector3d n = UnitNormal(before, triangle);
    if (!n.isZero(0.0) && n.dot(UnitNormal(after, triangle)) <= 0.0) {
      return true;
    }
  }
  return false;
}

}  // namespace

ShrunkSolid Shrunk(const Solid& solid, double by) {
  RequireNotEmpty(solid, "solid to shrink");
  if (!std::isfinite(by) || by <= 0.0) {
    throw InputError(solid.name() +
                     ": expected a way > 0 to shrink it by, "
                     "found " +
                     FormatDouble(by));
  }
  TriangleMesh mesh = solid.mesh();
  const auto normals = NormalsAtVertices(mesh);
  ShrunkSolid shrunk;
  shrunk.least = by;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vector3d u = Unit(Middle(normals[v]));
    double cosine = 1.0;
    for (const Vector3d& n : normals[v]) cosine = std::min(cosine, n.dot(u));
    if (cosine < kLeastCosine) {
      throw InputError(solid.name() + ": cannot shrink it: its faces at (" +
                       FormatPoint(mesh.vertices[v]) +
                       ") have no common inside");
    }
    const Vector3d way = -by / cosine * u;
    mesh.vertices[v] += way;
    shrunk.most = std::max(shrunk.most, way.norm());
  }
  std::string defect = "faces turned over";
  if (!IsAnyTurned(solid.mesh(), mesh)) {
    try {
      shrunk.solid = MakeSolid(mesh, solid.name());
      // Through itself: a cube whose faces have passed each other.
      if (shrunk.solid.report().inverted_components == 0) return shrunk;
    } catch (const InputError& error) {
      defect = error.what();
    }
  }
  throw InputError(
      solid.name() + ": expected walls and gaps that stand being shrunk by " +
      FormatDouble(by) + ", found " + defect + "; take a smaller tolerance");
}

}  // namespace phongpd
