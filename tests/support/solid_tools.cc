// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/solid_tools.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/pi.h"
#include "problems/shapes/shapes.h"

namespace phongpd::testing {

using Eigen::Vector3d;

double WindingNumber(const TriangleMesh& mesh, const Vector3d& q) {
  using Wide = Eigen::Matrix<long double, 3, 1>;
  long double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    Wide r[3];
    for (int k = 0; k < 3; ++k) {
      r[k] = (mesh.vertices[t[k]] - q).cast<long double>();
    }
    const long double l[3] = {r[0].norm(), r[1].norm(), r[2].norm()};
    const long double volume = r[0].dot(r[1].cross(r[2]));
    const long double denominator = l[0] * l[1] * l[2] + r[0].dot(r[1]) * l[2] +
                                    r[1].dot(r[2]) * l[0] +
                                    r[2].dot(r[0]) * l[1];
    sum += 2 * std::atan2(volume, denominator);
  }
  return static_cast<double>(sum / (4 * M_PIl));
}

TriangleMesh Cube(double side, const Vector3d& center) {
  const Vector3d half = Vector3d::Constant(0.5 * side);
  return MakeBox(center - half, center + half);
}

TriangleMesh UnitBox() { return MakeBox({0, 0, 0}, {1, 1, 1}); }

TriangleMesh RandomVoxelSolid(int n, double fill, std::mt19937_64* random) {
  return VoxelSurface(RandomVoxels(n, fill, EdgeContact::kAvoided, random));
}

double PolygonArea(int sides, double radius) {
  return sides / 2.0 * std::sin(2 * kPi / sides) * radius * radius;
}

}  // namespace phongpd::testing
