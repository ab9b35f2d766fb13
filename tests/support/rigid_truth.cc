// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/rigid_truth.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <cmath>

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using LongVector = Eigen::Matrix<long double, 3, 1>;

Vector3d Placed(const RigidMotion& motion, double t, const Vector3d& p) {
  const LongVector rest = motion.start()
                              .orientation.normalized()
                              .toRotationMatrix()
                              .cast<long double>() *
                          p.cast<long double>();
  const LongVector u = motion.axis().cast<long double>();
  const long double angle = static_cast<long double>(t) * motion.angle();
  const LongVector turned = std::cos(angle) * rest +
                            std::sin(angle) * u.cross(rest) +
                            (1.0L - std::cos(angle)) * u.dot(rest) * u;
  const LongVector q =
      (1.0L - t) * motion.start().position.cast<long double>() +
      static_cast<long double>(t) * motion.end().position.cast<long double>();
  return (turned + q).cast<double>();
}

}  // namespace

RobotPose PoseAt(const Vector3d& position,
                 const Eigen::Quaterniond& orientation) {
  RobotPose pose;
  pose.position = position;
  pose.orientation = orientation;
  return pose;
}

TriangleMesh PlacedMesh(TriangleMesh mesh, const RigidMotion& motion,
                        double t) {
  for (Vector3d& v : mesh.vertices) v = Placed(motion, t, v);
  return mesh;
}

bool MeetExactly(const TriangleMesh& a, int i, const TriangleMesh& b, int j) {
  const auto exact = [](const TriangleMesh& mesh, int triangle) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    const auto corner = [&](std::size_t k) {
      const Vector3d& v = mesh.vertices[static_cast<std::size_t>(t[k])];
      return Kernel::Point_3(v.x(), v.y(), v.z());
    };
    return Kernel::Triangle_3(corner(0), corner(1), corner(2));
  };
  const Kernel::Triangle_3 s = exact(a, i), t = exact(b, j);
  return !s.is_degenerate() && !t.is_degenerate() && CGAL::do_intersect(s, t);
}

bool MeetExactly(const TriangleMesh& a, const TriangleMesh& b) {
  const auto box = [](const TriangleMesh& mesh, const Triangle& t) {
    BoundingBox out;
    out.min = out.max = mesh.vertices[static_cast<std::size_t>(t[0])];
    for (const int k : t) {
      const Vector3d& v = mesh.vertices[static_cast<std::size_t>(k)];
      out.min = out.min.cwiseMin(v);
      out.max = out.max.cwiseMax(v);
    }
    return out;
  };
  const auto apart = [](const BoundingBox& x, const BoundingBox& y) {
    return (x.min.array() > y.max.array()).any() ||
           (y.min.array() > x.max.array()).any();
  };
  const BoundingBox whole = ComputeBounds(b);
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    const BoundingBox own = box(a, a.triangles[i]);
    if (apart(own, whole)) continue;
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      if (!apart(own, box(b, b.triangles[j])) &&
          MeetExactly(a, static_cast<int>(i), b, static_cast<int>(j))) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace phongpd::testing
