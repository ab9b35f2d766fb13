// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/normal_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/finite.h"
#include "core/projection/cubic.h"

namespace phongpd {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Field frame: lengths are of order 1.
constexpr double kEndSlack = 1e-13;     // of s, at the interval's ends
constexpr double kHitResidual = 1e-12;  // of an accepted hit
constexpr double kMaxLambdaTolerance = 1e-9;
constexpr double kMinLambdaTolerance = 1e-13;
// Of what only saves work, beyond all of these.
constexpr double kTolerant = 1e-7;

// λ is a quotient of lengths by the altitudes of the offset triangle; this is
// its rounding error for lengths known to 1e-14.
double LambdaTolerance(const Vector3d& a, const Vector3d& b,
                       double squared_area) {
  const double longest = std::max(a.squaredNorm(), b.squaredNorm());
  return std::clamp(1e-14 * std::sqrt(longest / squared_area),
                    kMinLambdaTolerance, kMaxLambdaTolerance);
}

// Moves a slightly negative λ onto the triangle.
Vector3d OnTriangle(const Vector3d& lambda) {
  if (lambda.minCoeff() >= 0.0) return lambda;
  const Vector3d positive = lambda.cwiseMax(0.0);
  return positive / positive.sum();
}

// What Narrow needs to know of a prism.
void PrepareNarrow(OffsetPrism* prism) {
  const Vector3d& n = prism->cross_n;
  const double at1 = prism->n0_n + prism->d1.dot(n);
  const double at2 = prism->n0_n + prism->d2.dot(n);
  const double least = std::min({prism->n0_n, at1, at2});
  const double most = std::max({prism->n0_n, at1, at2});
  const double sides = prism->e1.norm() * prism->e2.norm();
  // Rounding of N and of its products is some 1e-16 of `sides`.
  if (least > 1e-9 * sides) {
    prism->over_most_n = (1.0 - kTolerant) / most;
    prism->over_least_n = (1.0 + kTolerant) / least;
    prism->plane_slack = kHitResidual + 1e-14 * sides / least;
  }
  prism->reach = std::max(
      {prism->e1.norm(), prism->e2.norm(), (prism->e2 - prism->e1).norm()});
  prism->turn = std::max(
      {prism->d1.norm(), prism->d2.norm(), (prism->d2 - prism->d1).norm()});
  const Vector3d sum = 3.0 * prism->n0 + prism->d1 + prism->d2;
  int axis = 0;
  sum.cwiseAbs().maxCoeff(&axis);
  prism->u = (axis + 1) % 3;
  prism->v = (axis + 2) % 3;
  if (sum[axis] < 0.0) std::swap(prism->u, prism->v);
}

// A quadratic in Bernstein form: its least and largest coefficient bound it.
struct Quadratic {
  double first, middle, last;

  double Least() const { return std::min({first, middle, last}); }
  double Most() const { return std::max({first, middle, last}); }
};

double Cross(const Vector2d& a, const Vector2d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// a(s) × b(s) for a, b linear in s, from their values at both ends.
Quadratic Cross(const std::array<Vector2d, 2>& a,
                const std::array<Vector2d, 2>& b) {
  return {Cross(a[0], b[0]), 0.5 * (Cross(a[0], b[1]) + Cross(a[1], b[0])),
          Cross(a[1], b[1])};
}

}  // namespace

OffsetPrism::OffsetPrism(const std::array<Vector3d, 3>& corners,
                         const std::array<Vector3d, 3>& normals)
    : q0(corners[0]),
      e1(corners[1] - corners[0]),
      e2(corners[2] - corners[0]),
      n0(normals[0]),
      d1(normals[1] - normals[0]),
      d2(normals[2] - normals[0]),
      cross_n(e1.cross(e2)),
      cross_m(d1.cross(e2) + e1.cross(d2)),
      cross_k(d1.cross(d2)),
      n0_n(n0.dot(cross_n)),
      n0_m(n0.dot(cross_m)),
      n0_k(n0.dot(cross_k)) {
  const Vector3d lambda =
      ClosestOnTriangle(normals[0], normals[1], normals[2], Vector3d::Zero())
          .lambda;
  min_norm = Normal(lambda).norm();
  PrepareNarrow(this);
}

Eigen::Matrix3d OffsetPrism::Jacobian(const NormalHit& hit) const {
  Eigen::Matrix3d j;
  j << e1 + hit.s * d1, e2 + hit.s * d2, Normal(hit.lambda);
  return j;
}

Vector3d OffsetPrism::DepthGradient(const NormalHit& hit) const {
  const Vector3d a = e1 + hit.s * d1;
  const Vector3d b = e2 + hit.s * d2;
  const Vector3d n = Normal(hit.lambda);
  const double norm = n.norm();
  if (!(norm > 0.0)) return Vector3d::Zero();
  const Vector3d unit = n / norm;
  const Vector3d ab = a.cross(b);
  const double det = ab.dot(n);
  if (det == 0.0) return unit;  // a fold
  // The rows of J⁻¹ are b×n, n×a and a×b over det J.
  const Vector3d gradient = (norm * ab + hit.s * unit.dot(d1) * b.cross(n) +
                             hit.s * unit.dot(d2) * n.cross(a)) /
                            det;
  return IsFinite(gradient) ? gradient : unit;
}

int OffsetPrism::Project(const Vector3d& x, double s_min, double s_max,
                         std::array<NormalHit, 3>* hits) const noexcept {
  const Vector3d x0 = q0 - x;
  const Cubic f = {x0.dot(cross_n), n0_n + x0.dot(cross_m),
                   n0_m + x0.dot(cross_k), n0_k};
  int count = 0;
  for (const double s : SolveCubic(f, s_min - kEndSlack, s_max + kEndSlack)) {
    const Vector3d a = e1 + s * d1;
    const Vector3d b = e2 + s * d2;
    const Vector3d r = -(x0 + s * n0);  // = λ₁a + λ₂b
    const Vector3d c = a.cross(b);
    const double squared_area = c.squaredNorm();
    NormalHit hit;
    hit.s = s;
    if (squared_area <=
        1e-24 * std::max({a.squaredNorm() * b.squaredNorm(),
                          1e-6 * e1.squaredNorm() * e2.squaredNorm()})) {
      // A fold of the whole offset triangle, e.g. the centre of a ball.
      const TrianglePoint nearest =
          ClosestOnTriangle(Vector3d::Zero(), a, b, r);
      if (nearest.squared_distance > kHitResidual * kHitResidual) continue;
      hit.lambda = nearest.lambda;
    } else {
      const double l1 = r.cross(b).dot(c) / squared_area;
      const double l2 = a.cross(r).dot(c) / squared_area;
      if (std::min({l1, l2, 1.0 - l1 - l2}) < -1e-6) continue;
      hit.lambda = {1.0 - l1 - l2, l1, l2};
      if (!RefineHit(*this, x, 2, &hit)) continue;
      if (hit.lambda.minCoeff() < -LambdaTolerance(a, b, squared_area)) {
        continue;
      }
      hit.lambda = OnTriangle(hit.lambda);
    }
    (*hits)[count++] = hit;
  }
  return count;
}

bool OffsetPrism::Narrow(const Vector3d& x, double* s_min,
                         double* s_max) const noexcept {
  const Vector3d x0 = q0 - x;
  if (over_least_n > 0.0) {
    const double height = -x0.dot(cross_n);
    const double near = height * over_most_n, far = height * over_least_n;
    *s_min = std::max(*s_min, std::min(near, far) - plane_slack);
    *s_max = std::min(*s_max, std::max(near, far) + plane_slack);
    if (*s_min > *s_max) return false;
  }
  std::array<Vector2d, 2> p0, p1, p2, a, b;
  for (std::size_t end = 0; end < 2; ++end) {
    const double s = end == 0 ? *s_min : *s_max;
    a[end] = {e1[u] + s * d1[u], e1[v] + s * d1[v]};
    b[end] = {e2[u] + s * d2[u], e2[v] + s * d2[v]};
    p0[end] = {x0[u] + s * n0[u], x0[v] + s * n0[v]};
    p1[end] = p0[end] + a[end];
    p2[end] = p0[end] + b[end];
  }
  const double steep = std::max(std::abs(*s_min), std::abs(*s_max));
  const double rounding = 1e-15 * (1.0 + steep) * (1.0 + steep) +
                          2.0 * kHitResidual * (reach + steep * turn);
  const Quadratic area = Cross(a, b);
  if (!(area.Least() > rounding)) return true;
  const double beyond = -rounding - kTolerant * area.Most();
  return Cross(p1, p2).Most() >= beyond && Cross(p2, p0).Most() >= beyond &&
         Cross(p0, p1).Most() >= beyond;
}

bool RefineHit(const OffsetPrism& prism, const Vector3d& x, int iterations,
               NormalHit* hit) noexcept {
  NormalHit best = *hit;
  double best_residual = 1e300;
  for (int i = 0;; ++i) {
    const Vector3d n = prism.Normal(hit->lambda);
    const Vector3d r = x - prism.Point(hit->lambda) - hit->s * n;
    const double residual = r.squaredNorm();
    if (!(residual < best_residual)) break;
    best_residual = residual;
    best = *hit;
    if (i == iterations || residual < 1e-32) break;
    const Vector3d a = prism.e1 + hit->s * prism.d1;
    const Vector3d b = prism.e2 + hit->s * prism.d2;
    const Vector3d bn = b.cross(n);
    const double inverse = 1.0 / a.dot(bn);
    const double l1 = hit->lambda[1] + r.dot(bn) * inverse;
    const double l2 = hit->lambda[2] + r.dot(n.cross(a)) * inverse;
    hit->lambda = {1.0 - l1 - l2, l1, l2};
    hit->s += r.dot(a.cross(b)) * inverse;
  }
  *hit = best;
  return best_residual < kHitResidual * kHitResidual;
}

std::vector<OffsetPrism> BuildOffsetPrisms(const PhongField& field) {
  std::vector<OffsetPrism> prisms;
  prisms.reserve(field.mesh.triangles.size());
  for (const Triangle& t : field.mesh.triangles) {
    std::array<Vector3d, 3> corners, normals;
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = t[k];
      corners[k] = field.mesh.vertices[v];
      normals[k] = field.normals[v];
    }
    prisms.emplace_back(corners, normals);
  }
  return prisms;
}

}  // namespace phongpd
