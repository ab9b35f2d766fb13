// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/rigid_truth.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/segment_triangle_distance.h"

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

BoundingBox BoxOf(const TriangleMesh& mesh, const Triangle& t) {
  BoundingBox out;
  out.min = out.max = mesh.vertices[static_cast<std::size_t>(t[0])];
  for (const int k : t) {
    const Vector3d& v = mesh.vertices[static_cast<std::size_t>(k)];
    out.min = out.min.cwiseMin(v);
    out.max = out.max.cwiseMax(v);
  }
  return out;
}

// 0 where they meet, exactly so.
double BoxDistance(const BoundingBox& x, const BoundingBox& y) {
  return (x.min - y.max).cwiseMax(y.min - x.max).cwiseMax(0.0).norm();
}

}  // namespace

Eigen::Quaterniond AboutZ(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

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
  const BoundingBox whole = ComputeBounds(b);
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    const BoundingBox own = BoxOf(a, a.triangles[i]);
    if (BoxDistance(own, whole) > 0.0) continue;
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      if (!(BoxDistance(own, BoxOf(b, b.triangles[j])) > 0.0) &&
          MeetExactly(a, static_cast<int>(i), b, static_cast<int>(j))) {
        return true;
      }
    }
  }
  return false;
}

double MeshDistance(const TriangleMesh& a, const TriangleMesh& b) {
  const auto corner = [](const TriangleMesh& mesh, const Triangle& t,
                         std::size_t k) -> const Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(t[k % 3])];
  };
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const TriangleMesh& one, const Triangle& s,
                         const TriangleMesh& other, const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      least = std::min(
          least, std::sqrt(ClosestPair(corner(one, s, k), corner(one, s, k + 1),
                                       corner(other, t, 0), corner(other, t, 1),
                                       corner(other, t, 2))
                               .squared_distance));
    }
  };
  const BoundingBox whole = ComputeBounds(b);
  for (const Triangle& s : a.triangles) {
    const BoundingBox own = BoxOf(a, s);
    if (!(BoxDistance(own, whole) < least)) continue;
    for (const Triangle& t : b.triangles) {
      if (!(BoxDistance(own, BoxOf(b, t)) < least)) continue;
      offer(a, s, b, t);
      offer(b, t, a, s);
    }
  }
  return least;
}

}  // namespace phongpd::testing
