// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_membership.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/bvh/triangle_bvh.h"
#include "core/solid/self_intersection.h"
#include "tests/support/solid_tools.h"

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;

// A component of `inner`, which `outer` does not cross, lies in `outer`.
bool HoldsAPart(const TriangleMesh& outer, const TriangleMesh& inner) {
  int count = 0;
  const std::vector<int> labels = LabelComponents(inner, &count);
  for (int c = 0; c < count; ++c) {
    const auto at = std::find(labels.begin(), labels.end(), c) - labels.begin();
    const Vector3d& p = inner.vertices[inner.triangles[at][0]];
    if (WindingNumber(outer, p) > 0.5) return true;
  }
  return false;
}

}  // namespace

bool Meet(const TriangleMesh& robot, const TriangleMesh& obstacle,
          const Vector3d& q) {
  const TriangleMesh moved = Translated(robot, q);
  return internal::Intersect(moved, obstacle) || HoldsAPart(moved, obstacle) ||
         HoldsAPart(obstacle, moved);
}

std::string FindWrongPoint(const TriangleMesh& robot,
                           const TriangleMesh& obstacle,
                           const ContactSpace& space, int count,
                           std::mt19937_64* random) {
  const BoundingBox box = ComputeBounds(space.mesh());
  const TriangleBvh surface(space.mesh());
  const auto vertex_of = [random](const TriangleMesh& mesh) -> Vector3d {
    const Triangle& t = mesh.triangles[(*random)() % mesh.triangles.size()];
    return mesh.vertices[t[(*random)() % 3]];
  };
  for (int i = 0; i < count; ++i) {
    const double noise =
        box.Diagonal() * std::pow(10.0, -2.0 - 2.0 * (i % 3));  // 1e-2 … 1e-6
    const Vector3d near = noise * RandomPoint({-Vector3d::Ones(),  //
                                               Vector3d::Ones()},
                                              random);
    Vector3d q = RandomPoint(box, random);
    if (i % 4 == 1) {
      q = RandomSurfacePoint(obstacle, random).position - vertex_of(robot) +
          near;
    } else if (i % 4 == 3) {
      q = vertex_of(obstacle) - RandomSurfacePoint(robot, random).position +
          near;
    }
    if (surface.FindClosest(q).distance < 8 * space.report().grid_step)
      continue;
    const bool is_inside = WindingNumber(space.mesh(), q) > 0.5;
    if (is_inside == Meet(robot, obstacle, q)) continue;
    std::ostringstream text;
    text.precision(17);
    text << "(" << q.transpose() << ") is " << (is_inside ? "in" : "not in")
         << " C_obj, "
         << surface.FindClosest(q).distance / space.report().grid_step
         << " grid steps off its surface";
    return text.str();
  }
  return {};
}

}  // namespace phongpd::testing
