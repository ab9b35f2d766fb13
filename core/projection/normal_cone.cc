// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/normal_cone.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cstddef>

namespace phongpd {
namespace {

using Eigen::Vector3d;

// All lengths below are relative to unit vectors.
constexpr double kOrigin = 1e-9;        // |v| that counts as the origin
constexpr double kImprovement = 1e-14;  // of |v|² that counts as progress
constexpr int kMaxClosestSteps = 200;   // of the closest-point iteration
constexpr int kBisections = 50;         // of the blend, in [0, 1]

// At most four affinely independent points, the support of the closest point.
struct Simplex {
  std::array<Vector3d, 4> point;
  std::size_t size = 0;
};

// Replaces the simplex by the face that holds the point of its hull closest to
// the origin and returns that point: of the affine hulls of its 15 faces, the
// closest whose foot has only positive weights.
Vector3d ClosestPoint(Simplex* simplex) {
  Vector3d closest = Vector3d::Zero();
  double best = -1.0;
  unsigned best_mask = 0;
  for (unsigned mask = 1; mask < (1u << simplex->size); ++mask) {
    std::array<Vector3d, 4> q;
    q.fill(Vector3d::Zero());
    Eigen::Index m = 0;
    for (std::size_t k = 0; k < simplex->size; ++k) {
      if ((mask >> k) & 1u)
        q[static_cast<std::size_t>(m++)] = simplex->point[k];
    }
    // Minimise |q_0 + E w|, columns of E the edges from q_0.
    Vector3d foot = q[0];
    if (m > 1) {
      Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, m - 1);
      for (Eigen::Index k = 1; k < m; ++k) {
        edges.col(k - 1) = q[static_cast<std::size_t>(k)] - q[0];
      }
      const auto qr = edges.colPivHouseholderQr();
      if (qr.rank() < m - 1) continue;
      const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> w =
          qr.solve(-q[0]);
      if (w.minCoeff() < 0.0 || w.sum() > 1.0) continue;
      foot += edges * w;
    }
    const double distance = foot.squaredNorm();
    if (best < 0.0 || distance < best) {
      best = distance;
      best_mask = mask;
      closest = foot;
    }
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < simplex->size; ++k) {
    if ((best_mask >> k) & 1u) simplex->point[kept++] = simplex->point[k];
  }
  simplex->size = kept;
  return closest;
}

}  // namespace

double MinFacetDot(const Vector3d& n, const std::vector<Vector3d>& facets) {
  double least = 1.0;
  for (const Vector3d& facet : facets) {
    if (!facet.isZero(0.0)) least = std::min(least, n.dot(facet));
  }
  return least;
}

Vector3d BestNormal(const std::vector<Vector3d>& facets) {
  Simplex simplex;
  for (const Vector3d& facet : facets) {
    if (facet.isZero(0.0)) continue;
    simplex.point[0] = facet;
    simplex.size = 1;
    break;
  }
  if (simplex.size == 0) return Vector3d::Zero();
  Vector3d v = simplex.point[0];
  for (int step = 0; step < kMaxClosestSteps; ++step) {
    const Vector3d* support = nullptr;
    for (const Vector3d& facet : facets) {
      if (facet.isZero(0.0)) continue;
      if (support == nullptr || v.dot(facet) < v.dot(*support)) {
        support = &facet;
      }
    }
    // NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker): not all are zero
    if (v.squaredNorm() - v.dot(*support) <= kImprovement) break;
    if (simplex.size == 4) break;  // the simplex holds the origin
    simplex.point[simplex.size++] = *support;
    v = ClosestPoint(&simplex);
    if (v.norm() <= kOrigin) return Vector3d::Zero();
  }
  return v.normalized();
}

Vector3d LimitNormal(const Vector3d& n, const Vector3d& base,
                     const std::vector<Vector3d>& facets, double c) {
  if (MinFacetDot(n, facets) >= c) return n;
  Vector3d good = base;
  if (MinFacetDot(base, facets) < c) return good;
  double outside = 0.0;
  double inside = 1.0;
  for (int k = 0; k < kBisections; ++k) {
    const double t = 0.5 * (outside + inside);
    const Vector3d blend = ((1.0 - t) * n + t * base).normalized();
    if (MinFacetDot(blend, facets) >= c) {
      inside = t;
      good = blend;
    } else {
      outside = t;
    }
  }
  return good;
}

}  // namespace phongpd
