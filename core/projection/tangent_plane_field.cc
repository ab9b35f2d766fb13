// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/tangent_plane_field.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Basis = TangentPlaneField::Basis;
using Frames = TangentPlaneField::Frames;

// Barycentric numbers, so relative to 1.
constexpr double kOutside = 1e-9;  // λ ≥ −kOutside is on the triangle
// Newton has left for good.  Leaving at 2 misses twice as many projections
// from the centroid, leaving at 1000 hardly fewer.
constexpr double kFarOutside = 10.0;
constexpr double kStep = 1e-13;    // Newton step that counts as none
constexpr double kCorner = 1e-14;  // S below: λ is the corner, use the limit
constexpr double kRootRounding = 1e-15;  // residual that no step can improve
constexpr double kRootResidual = 1e-12;  // of Ψ r, relative to diagonal + |r|
// Near a corner ∂Ψ is taken this far towards the centroid, see below.
constexpr double kNudge = 1e-6;
constexpr int kNewtonSteps = 30;
constexpr int kProcrustesSteps = 50;
constexpr double kProcrustesChange = 1e-15;
constexpr double kFold = 1e-12;  // det J relative to its columns

using internal::At;

// Ort(M): orthogonal factor of the polar decomposition, a reflection when
// det M < 0.  In two dimensions M ± cof M is a multiple of it.
Matrix2d Ort(const Matrix2d& m) {
  Matrix2d cofactor;
  cofactor << m(1, 1), -m(1, 0), -m(0, 1), m(0, 0);
  const Matrix2d sum =
      m.determinant() < 0.0 ? Matrix2d(m - cofactor) : Matrix2d(m + cofactor);
  const double norm = sum.col(0).norm();
  return norm > 0.0 ? Matrix2d(sum / norm) : Matrix2d(Matrix2d::Identity());
}

// Right-handed: T.row(0) × T.row(1) = n.  Then det(T_j T_iᵀ) = n_i·n_j.
Basis OrthonormalBasis(const Vector3d& n) {
  Eigen::Index axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  const Vector3d a = n.cross(Vector3d::Unit(axis)).normalized();
  Basis basis;
  basis.row(0) = a.transpose();
  basis.row(1) = n.cross(a).transpose();
  return basis;
}

Frames MakeFrames(const Basis& t_1, const Basis& t_2, const Basis& t_3) {
  const std::array<const Basis*, 3> t = {&t_1, &t_2, &t_3};
  Frames frames;
  for (std::size_t k = 0; k < 3; ++k) {
    const Basis& t_i = *t[k];
    const Basis& t_j = *t[(k + 1) % 3];
    frames.edge[k] = {Basis(Ort(t_j * t_i.transpose()) * t_i), t_j};
  }
  // Eq. 11: maximise Σ ⟨E_a B_a, E_b B_b⟩ over pairs of edges a ≠ b and their
  // ends, one E at a time.  The first guess carries frames around the triangle
  // so that the result does not depend on the choice of the bases T_i.
  std::array<Basis, 3> sum;
  for (std::size_t k = 0; k < 3; ++k) {
    sum[k] = frames.edge[k][0] + frames.edge[k][1];
  }
  std::array<Matrix2d, 3> e;
  e[0].setIdentity();
  e[1] = Ort(sum[0] * sum[1].transpose());
  e[2] = Ort((sum[0] + e[1] * sum[1]) * sum[2].transpose());
  for (int step = 0; step < kProcrustesSteps; ++step) {
    double change = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3;
      const std::size_t b = (k + 2) % 3;
      const Matrix2d next =
          Ort((e[a] * sum[a] + e[b] * sum[b]) * sum[k].transpose());
      change = std::max(change, (next - e[k]).cwiseAbs().maxCoeff());
      e[k] = next;
    }
    if (change <= kProcrustesChange) break;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (Basis& basis : frames.edge[k]) basis = e[k] * basis;
  }
  return frames;
}

struct Plane {
  Basis psi;                   // Ψ(λ)
  std::array<Basis, 3> slope;  // ∂Ψ/∂λ_m, λ taken as independent
};

double SymmetricSum(const Vector3d& l) {
  return l[0] * l[1] + l[1] * l[2] + l[2] * l[0];
}

// Ψ = (1/S) Σ_(ijk) λ_i λ_j [(λ_i + ½ λ_k) A_ij + (λ_j + ½ λ_k) B_ij], with S
// = λ_1 λ_2 + λ_2 λ_3 + λ_3 λ_1 and A, B the frames at the ends of the edge.
Plane Evaluate(const Frames& frames, const Vector3d& lambda) {
  const double s =
      lambda[0] * lambda[1] + lambda[1] * lambda[2] + lambda[2] * lambda[0];
  Plane plane;
  if (std::abs(s) < kCorner) {
    // Every mean of the two frames that meet at the corner spans its plane.
    Eigen::Index corner = 0;
    lambda.maxCoeff(&corner);
    const auto k = static_cast<std::size_t>(corner);
    plane.psi = 0.5 * (frames.edge[k][0] + frames.edge[(k + 2) % 3][1]);
    plane.slope.fill(Basis::Zero());
    return plane;
  }
  plane.psi.setZero();
  plane.slope.fill(Basis::Zero());
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const double li = lambda[static_cast<Eigen::Index>(i)];
    const double lj = lambda[static_cast<Eigen::Index>(j)];
    const double lk = lambda[static_cast<Eigen::Index>(k)];
    const Basis& a = frames.edge[i][0];
    const Basis& b = frames.edge[i][1];
    const double wa = li + 0.5 * lk;
    const double wb = lj + 0.5 * lk;
    plane.psi += li * lj * (wa * a + wb * b);
    plane.slope[i] += (lj * wa + li * lj) * a + lj * wb * b;
    plane.slope[j] += li * wa * a + (li * wb + li * lj) * b;
    plane.slope[k] += 0.5 * li * lj * (a + b);
  }
  plane.psi /= s;
  for (std::size_t m = 0; m < 3; ++m) {
    const double ds = lambda[static_cast<Eigen::Index>((m + 1) % 3)] +
                      lambda[static_cast<Eigen::Index>((m + 2) % 3)];
    plane.slope[m] = (plane.slope[m] - ds * plane.psi) / s;
  }
  return plane;
}

// How Newton's iterates outside the triangle see the field.  Neither changes a
// root with λ ≥ 0.
enum class Outside {
  kContinued,  // the formula as it stands; 1/S has poles through the corners
  kClamped,    // the plane of the point max(λ, 0)/Σ max(λ, 0): no poles, but
               // Newton can cycle across the edges
};

// Ψ and its derivatives along λ_2 − λ_1 and λ_3 − λ_1.
struct PlaneJet {
  Basis psi;
  std::array<Basis, 2> along;
};

PlaneJet EvaluateJet(const Frames& frames, const Vector3d& lambda,
                     Outside outside) {
  const bool clamp = outside == Outside::kClamped && lambda.minCoeff() < 0.0;
  const Vector3d positive = lambda.cwiseMax(0.0);
  const double sum = clamp ? positive.sum() : 1.0;  // ≥ 1
  const Vector3d inner = clamp ? Vector3d(positive / sum) : lambda;
  const Plane plane = Evaluate(frames, inner);
  PlaneJet jet;
  jet.psi = plane.psi;
  for (Eigen::Index k = 0; k < 2; ++k) {
    Vector3d d = Vector3d::Unit(k + 1) - Vector3d::Unit(0);
    if (clamp) {
      d = (lambda.array() < 0.0).select(0.0, d);
      d = Vector3d((d - inner * d.sum()) / sum);
    }
    jet.along[static_cast<std::size_t>(k)] =
        d[0] * plane.slope[0] + d[1] * plane.slope[1] + d[2] * plane.slope[2];
  }
  return jet;
}

Vector3d Row(const Basis& basis, Eigen::Index k) {
  return basis.row(k).transpose();
}

struct FieldCorners {
  std::array<Vector3d, 3> q;
  std::array<Vector3d, 3> n;

  FieldCorners(const PhongField& field, int triangle) {
    const Triangle& t = field.mesh.triangles[At(triangle)];
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = field.mesh.vertices[At(t[k])];
      n[k] = field.normals[At(t[k])];
    }
  }
  static Vector3d Mix(const std::array<Vector3d, 3>& v, const Vector3d& l) {
    return l[0] * v[0] + l[1] * v[1] + l[2] * v[2];
  }
};

// Unit normal of the plane and its derivatives along λ_2 − λ_1 and λ_3 − λ_1.
struct NormalJet {
  Vector3d normal;
  std::array<Vector3d, 2> slope;
};

NormalJet UnitNormal(const PlaneJet& plane, const Vector3d& linear) {
  const Vector3d r = Row(plane.psi, 0);
  const Vector3d t = Row(plane.psi, 1);
  const Vector3d cross = r.cross(t);
  const double sign = cross.dot(linear) < 0.0 ? -1.0 : 1.0;
  const double length = cross.norm();
  NormalJet jet;
  jet.normal = sign * cross / length;
  for (std::size_t k = 0; k < 2; ++k) {
    const Basis& d = plane.along[k];
    const Vector3d dc = Row(d, 0).cross(t) + r.cross(Row(d, 1));
    jet.slope[k] = sign / length *
                   (dc - (sign * jet.normal.dot(dc)) * (sign * jet.normal));
  }
  return jet;
}

// Newton on Ψ(λ)(p(λ) − x) = 0; true when it settles on λ ≥ −kOutside.
bool Newton(const FieldCorners& c, const Frames& frames, const Vector3d& x,
            Outside outside, Vector3d* solution) {
  const Vector3d e_1 = c.q[1] - c.q[0];
  const Vector3d e_2 = c.q[2] - c.q[0];
  Vector3d lambda = *solution;
  bool settled = false;
  for (int step = 0; step < kNewtonSteps && !settled; ++step) {
    const PlaneJet plane = EvaluateJet(frames, lambda, outside);
    const Vector3d r = FieldCorners::Mix(c.q, lambda) - x;
    Matrix2d jacobian;
    jacobian.col(0) = plane.psi * e_1 + plane.along[0] * r;
    jacobian.col(1) = plane.psi * e_2 + plane.along[1] * r;
    const Vector2d residual = plane.psi * r;
    const Vector2d delta = -jacobian.inverse() * residual;
    lambda += Vector3d(-delta[0] - delta[1], delta[0], delta[1]);
    // Written so that NaN, from a singular Jacobian, ends the search.
    if (!(lambda.cwiseAbs().maxCoeff() <= kFarOutside)) return false;
    settled = delta.cwiseAbs().maxCoeff() <= kStep ||
              residual.norm() <= kRootRounding * (1.0 + r.norm());
  }
  if (lambda.minCoeff() < -kOutside) return false;
  const Vector3d r = FieldCorners::Mix(c.q, lambda) - x;
  const PlaneJet plane = EvaluateJet(frames, lambda, Outside::kClamped);
  if (!((plane.psi * r).norm() <= kRootResidual * (1.0 + r.norm())))
    return false;
  *solution = lambda;
  return true;
}

// ∇s of x = p(λ) + s n̂(λ): the last row of J⁻¹, J = [e_1 + s ∂_1 n̂,
// e_2 + s ∂_2 n̂, n̂].
Vector3d DepthGradient(const FieldCorners& c, const NormalJet& jet, double s) {
  const Vector3d u = c.q[1] - c.q[0] + s * jet.slope[0];
  const Vector3d v = c.q[2] - c.q[0] + s * jet.slope[1];
  const Vector3d cross = u.cross(v);
  const double det = cross.dot(jet.normal);
  if (!(std::abs(det) > kFold * u.norm() * v.norm())) return Vector3d::Zero();
  return cross / det;
}

}  // namespace

TangentPlaneField BuildTangentPlaneField(const PhongField& field) {
  TangentPlaneField planes;
  planes.bases.reserve(field.normals.size());
  for (const Vector3d& n : field.normals) {
    planes.bases.push_back(OrthonormalBasis(n));
  }
  planes.frames.reserve(field.mesh.triangles.size());
  for (const Triangle& t : field.mesh.triangles) {
    planes.frames.push_back(MakeFrames(planes.bases[At(t[0])],
                                       planes.bases[At(t[1])],
                                       planes.bases[At(t[2])]));
  }
  return planes;
}

Vector3d TangentPlaneNormal(const PhongField& field,
                            const TangentPlaneField& planes, int triangle,
                            const Vector3d& lambda) noexcept {
  const FieldCorners c(field, triangle);
  const PlaneJet plane =
      EvaluateJet(planes.frames[At(triangle)], lambda, Outside::kClamped);
  return UnitNormal(plane, FieldCorners::Mix(c.n, lambda)).normal;
}

bool ProjectOnTangentPlanes(const PhongField& field,
                            const TangentPlaneField& planes, int triangle,
                            const Vector3d& x, const Vector3d& start_lambda,
                            TangentPlaneHit* hit) noexcept {
  const FieldCorners c(field, triangle);
  const Frames& frames = planes.frames[At(triangle)];
  Vector3d lambda = start_lambda;
  if (!Newton(c, frames, x, Outside::kContinued, &lambda) &&
      !Newton(c, frames, x, Outside::kClamped, &lambda)) {
    return false;
  }
  const PlaneJet plane = EvaluateJet(frames, lambda, Outside::kClamped);
  const Vector3d r = FieldCorners::Mix(c.q, lambda) - x;
  NormalJet jet = UnitNormal(plane, FieldCorners::Mix(c.n, lambda));
  if (SymmetricSum(lambda) < kNudge) {
    // At a corner the slope of the field depends on the direction of approach.
    const Vector3d inner =
        lambda + kNudge * (Vector3d::Constant(1.0 / 3.0) - lambda);
    jet.slope = UnitNormal(EvaluateJet(frames, inner, Outside::kClamped),
                           FieldCorners::Mix(c.n, inner))
                    .slope;
  }
  hit->lambda = lambda;
  hit->normal = jet.normal;
  hit->s = -jet.normal.dot(r);
  hit->gradient = DepthGradient(c, jet, hit->s);
  return true;
}

}  // namespace phongpd
