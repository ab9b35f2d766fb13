// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/exact_answers.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace phongpd::testing {
namespace {

using Number = CGAL::Gmpq;
using Vector = std::array<Number, 3>;

Vector Difference(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {Number(a[0]) - Number(b[0]), Number(a[1]) - Number(b[1]),
          Number(a[2]) - Number(b[2])};
}
Vector Cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}
Number Dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
int Sign(const Number& x) { return (x > 0) - (x < 0); }

bool IsInBox(const std::array<Eigen::Vector3d, 3>& t,
             const Eigen::Vector3d& q) {
  return (q.array() >= t[0].cwiseMin(t[1]).cwiseMin(t[2]).array()).all() &&
         (q.array() <= t[0].cwiseMax(t[1]).cwiseMax(t[2]).array()).all();
}

// w: the corners seen from the point.
bool IsOnTriangle(const std::array<Vector, 3>& w) {
  const Vector a = Cross(w[0], w[1]), b = Cross(w[1], w[2]),
               c = Cross(w[2], w[0]);
  if (Sign(Dot(a, w[2])) != 0) return false;
  // In its plane the three normals are parallel; inside they agree.
  return Dot(a, b) >= 0 && Dot(b, c) >= 0 && Dot(c, a) >= 0;
}

enum class Crossing { kNo, kYes, kUnclear };

Crossing Crosses(const std::array<Vector, 3>& w, const Vector& d) {
  int sign[3];
  for (std::size_t k = 0; k < 3; ++k) {
    sign[k] = Sign(Dot(d, Cross(w[k], w[(k + 1) % 3])));
  }
  const bool up = sign[0] >= 0 && sign[1] >= 0 && sign[2] >= 0;
  const bool down = sign[0] <= 0 && sign[1] <= 0 && sign[2] <= 0;
  if (!up && !down) return Crossing::kNo;
  if (sign[0] * sign[1] * sign[2] == 0) return Crossing::kUnclear;
  // The line crosses the triangle; on which side of the point?
  const int side = Sign(Dot(w[0], Cross(w[1], w[2])));
  return side * sign[0] > 0 ? Crossing::kYes : Crossing::kNo;
}

}  // namespace

Location RationalLocation(const TriangleMesh& mesh, const Eigen::Vector3d& q) {
  constexpr int kDirections[4][3] = {
      {101, 211, 307}, {-401, 103, 509}, {607, -701, 107}, {809, 907, -113}};
  const auto seen = [&](const Triangle& t) {
    std::array<Vector, 3> w;
    for (std::size_t k = 0; k < 3; ++k) {
      w[k] = Difference(mesh.vertices[static_cast<std::size_t>(t[k])], q);
    }
    return w;
  };
  for (const Triangle& t : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = mesh.vertices[static_cast<std::size_t>(t[k])];
    }
    if (IsInBox(corners, q) && IsOnTriangle(seen(t))) {
      return Location::kOnSurface;
    }
  }
  for (const auto& direction : kDirections) {
    const Vector d = {Number(direction[0]), Number(direction[1]),
                      Number(direction[2])};
    bool inside = false, clear = true;
    for (const Triangle& t : mesh.triangles) {
      const Crossing crossing = Crosses(seen(t), d);
      clear = clear && crossing != Crossing::kUnclear;
      if (!clear) break;
      inside = inside != (crossing == Crossing::kYes);
    }
    if (clear) return inside ? Location::kInside : Location::kOutside;
  }
  throw std::runtime_error("rational inside test: every ray meets an edge");
}

int SignOf(Location location) {
  return location == Location::kInside ? -1 : (location == Location::kOutside);
}
int SignOf(const PenetrationResult& result) {
  const double d = result.signed_distance;
  const int sign = (d > 0.0) - (d < 0.0);
  return result.inside == (sign < 0) ? sign : 99;
}

bool IsWhole(const PenetrationResult& r) {
  return std::isfinite(r.signed_distance) && r.contact.allFinite() &&
         r.gradient.allFinite() && std::abs(r.direction.norm() - 1.0) < 1e-12 &&
         r.status != QueryStatus::kInvalid;
}

double TrueDistance(const TriangleMesh& mesh, const Eigen::Vector3d& q) {
  using Kernel = CGAL::Simple_cartesian<long double>;
  const auto point = [](const Eigen::Vector3d& v) {
    return Kernel::Point_3(v[0], v[1], v[2]);
  };
  long double least = 1e300L;
  for (const Triangle& t : mesh.triangles) {
    const Kernel::Triangle_3 triangle(point(mesh.vertices[t[0]]),
                                      point(mesh.vertices[t[1]]),
                                      point(mesh.vertices[t[2]]));
    least = std::min(least, CGAL::squared_distance(point(q), triangle));
  }
  return static_cast<double>(std::sqrt(least));
}

}  // namespace phongpd::testing
