// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/contact_points.h"

#include <Eigen/Geometry>

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Edge = std::array<Vector3d, 2>;

// Every edge once: a closed mesh has it both ways.
std::vector<Edge> Edges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (a < b) {
        edges.push_back({mesh.vertices[static_cast<std::size_t>(a)],
                         mesh.vertices[static_cast<std::size_t>(b)]});
      }
    }
  }
  return edges;
}

bool BoxesMeet(const Edge& a, const Edge& b, double within) {
  const auto low = [](const Edge& e) { return e[0].cwiseMin(e[1]); };
  const auto high = [](const Edge& e) { return e[0].cwiseMax(e[1]); };
  return ((low(a) - high(b)).array() <= within).all() &&
         ((low(b) - high(a)).array() <= within).all();
}

// Where two edges cross, inner points of both; parallel ones do not.
bool Cross(const Edge& a, const Edge& b, double within, Vector3d* x) {
  const Vector3d u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0];
  const Vector3d n = u.cross(v);
  const double squared = n.squaredNorm();
  if (squared <= 1e-16 * u.squaredNorm() * v.squaredNorm()) return false;
  const double s = w.cross(v).dot(n) / squared;
  const double t = w.cross(u).dot(n) / squared;
  if (s <= 0.0 || s >= 1.0 || t <= 0.0 || t >= 1.0) return false;
  *x = b[0] + t * v;
  return (a[0] + s * u - *x).norm() <= within;
}

}  // namespace

ContactPoints::ContactPoints(const TriangleMesh& obstacle)
    : obstacle_(obstacle), bvh_(obstacle), edges_(Edges(obstacle)) {}

bool ContactPoints::Mean(const TriangleMesh& robot, double within,
                         Vector3d* mean) const {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  const auto add = [&](const Vector3d& x) {
    sum += x;
    ++count;
  };
  const TriangleBvh bvh(robot);
  for (const Vector3d& x : robot.vertices) {
    if (bvh_.FindClosest(x).distance <= within) add(x);
  }
  for (const Vector3d& x : obstacle_.vertices) {
    if (bvh.FindClosest(x).distance <= within) add(x);
  }
  for (const Edge& a : Edges(robot)) {
    for (const Edge& b : edges_) {
      Vector3d x;
      if (BoxesMeet(a, b, within) && Cross(a, b, within, &x)) add(x);
    }
  }
  if (count == 0) return false;
  *mean = sum / count;
  return true;
}

}  // namespace phongpd::bench
