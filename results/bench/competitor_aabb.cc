// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/competitor_aabb.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <vector>

namespace phongpd::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Triangles ToCgal(const TriangleMesh& mesh) {
  const auto point = [&](int v) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  Triangles triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.emplace_back(point(a), point(b), point(c));
  }
  return triangles;
}

}  // namespace

struct CgalClosestPoint::Impl {
  explicit Impl(const TriangleMesh& mesh)
      : triangles(ToCgal(mesh)), tree(triangles.begin(), triangles.end()) {
    tree.build();
    tree.accelerate_distance_queries();
  }

  Triangles triangles;
  Tree tree;
};

CgalClosestPoint::CgalClosestPoint(const TriangleMesh& mesh)
    : impl_(std::make_unique<Impl>(mesh)) {}
CgalClosestPoint::~CgalClosestPoint() = default;

double CgalClosestPoint::Distance(const Eigen::Vector3d& q) const {
  const auto closest =
      impl_->tree.closest_point_and_primitive({q.x(), q.y(), q.z()});
  const Kernel::Point_3& p = closest.first;
  return (Eigen::Vector3d(p.x(), p.y(), p.z()) - q).norm();
}

}  // namespace phongpd::bench
