// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/branch_walk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/mesh/numbers.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

// Lengths refer to the field frame, whose diagonal is in [1, 2).
constexpr double kContraction = 0.2;    // < ¼, see the header
constexpr double kShortestMove = 1e-8;  // a cut below this is a fold
constexpr double kSnap = 1e-14;         // of λ, onto an edge or vertex
constexpr double kAtEdge = 1e-12;       // of λ, no progress is possible
constexpr int kMaxWalkSteps = 4096;
constexpr int kMaxStalls = 24;

using internal::Sign;

// J and its inverse (rows: cofactors / det) at a point of a prism.
struct Local {
  Vector3d a, b, n;
  Vector3d row1, row2, row3;
  double det = 0.0;
  Vector3d r;  // x_b − x

  Local(const OffsetPrism& prism, const NormalHit& hit, const Vector3d& x_b)
      : a(prism.e1 + hit.s * prism.d1),
        b(prism.e2 + hit.s * prism.d2),
        n(prism.Normal(hit.lambda)),
        row1(b.cross(n)),
        row2(n.cross(a)),
        row3(a.cross(b)),
        det(row3.dot(n)),
        r(x_b - prism.Point(hit.lambda) - hit.s * n) {}
};

// The longest part of the move from `local` that is surely on the sheet.
double SafeFraction(const OffsetPrism& prism, const Local& local,
                    const Vector3d& w) {
  const double scale = 1.0 / local.det;
  const double g11 = local.row1.dot(prism.d1), g12 = local.row1.dot(prism.d2);
  const double g21 = local.row2.dot(prism.d1), g22 = local.row2.dot(prism.d2);
  const double g31 = local.row3.dot(prism.d1), g32 = local.row3.dot(prism.d2);
  const double lambda_norm =
      std::sqrt(g11 * g11 + g12 * g12 + g21 * g21 + g22 * g22);
  const double s_norm = std::sqrt(g31 * g31 + g32 * g32);
  const double contraction =
      std::abs(scale) *
      std::max(std::abs(w[2]) * lambda_norm, s_norm * std::hypot(w[0], w[1]));
  return contraction > kContraction ? kContraction / contraction : 1.0;
}

double LambdaTolerance(const Local& local) {
  const double longest = std::max(local.a.squaredNorm(), local.b.squaredNorm());
  return std::clamp(1e-14 * std::sqrt(longest / local.row3.squaredNorm()),
                    1e-13, 1e-9);
}

Vector3d Clamped(const Vector3d& lambda) {
  Vector3d positive = (lambda.array() < kSnap).select(0.0, lambda);
  return positive / positive.sum();
}

// w = J⁻¹(x_b − x), by λ₁, λ₂ and s.
Vector3d WalkNewtonStep(const Local& local) {
  return Vector3d(local.r.dot(local.row1), local.r.dot(local.row2),
                  local.r.dot(local.row3)) /
         local.det;
}

// All three λ, whose sum stays, of a step by λ₁, λ₂ and s.
Vector3d WalkLambdaStep(const Vector3d& step) {
  return Vector3d(-step[0] - step[1], step[0], step[1]);
}

// Has the surely possible part of the move shrunk to nothing?
bool IsWalkAtFold(const Local& local, double fraction) {
  return !(fraction > 0.0) ||
         (fraction < 1.0 && fraction * fraction * local.r.squaredNorm() <
                                kShortestMove * kShortestMove);
}

// Moves *hit by that fraction of the way to x_b; λ may become negative.  False
// where Newton does not converge.
bool MoveWalkHit(const OffsetPrism& prism, const Local& local,
                 const Vector3d& x_b, const Vector3d& w, double fraction,
                 NormalHit* hit) {
  const Vector3d target =
      fraction < 1.0 ? Vector3d(x_b - (1.0 - fraction) * local.r) : x_b;
  const Vector3d delta = fraction * w;
  hit->lambda += WalkLambdaStep(delta);
  hit->s += delta[2];
  return RefineHit(prism, target, 8, hit);
}

// Where a move leaves the triangle.
struct WalkWall {
  int corner = 0;     // whose λ is 0 there
  double part = 2.0;  // of the move
};

// The wall met first on the way between two points' λ.
WalkWall FirstWalkWall(const Vector3d& from, const Vector3d& to,
                       double tolerance) {
  WalkWall wall;
  for (int k = 0; k < 3; ++k) {
    if (to[k] >= -tolerance) continue;
    const double t = from[k] / (from[k] - to[k]);
    if (t < wall.part) {
      wall.part = t;
      wall.corner = k;
    }
  }
  return wall;
}

// Moves *hit to the wall it meets on the way to `next`.
void MoveToWalkWall(const WalkWall& wall, const NormalHit& next,
                    NormalHit* hit) {
  hit->lambda += wall.part * (next.lambda - hit->lambda);
  hit->s += wall.part * (next.s - hit->s);
  hit->lambda[wall.corner] = 0.0;
  hit->lambda = Clamped(hit->lambda);
}

// The same point of the edge opposite `corner`, in the triangle across it;
// false where there is none.
bool CrossWalkWall(const PhongField& field, int corner, NormalHit* hit,
                   int* triangle) {
  const int across = field.neighbors[*triangle][(corner + 1) % 3];
  if (across < 0) return false;
  const Triangle& from = field.mesh.triangles[*triangle];
  const Triangle& to = field.mesh.triangles[across];
  Vector3d lambda = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i != corner && to[j] == from[i]) lambda[j] = hit->lambda[i];
    }
  }
  hit->lambda = lambda;
  *triangle = across;
  return true;
}

}  // namespace

BranchWalk::BranchWalk(const FieldProjector& projector) {
  const TriangleMesh& mesh = projector.field().mesh;
  fan_start_.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) ++fan_start_[v + 1];
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    fan_start_[v + 1] += fan_start_[v];
  }
  fan_.resize(fan_start_.back());
  std::vector<int> next(fan_start_.begin(), fan_start_.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) {
      fan_[next[v]++] = static_cast<int>(t);
    }
  }
}

// At a vertex the move enters the triangle of the fan in which both rates of
// the other two λ are positive.
bool BranchWalk::EnterFan(const FieldProjector& projector, const Vector3d& x_b,
                          int corner, double sign, NormalHit* hit,
                          int* triangle) const {
  const TriangleMesh& mesh = projector.field().mesh;
  const int vertex = mesh.triangles[*triangle][corner];
  double best_rate = -1e-9;
  int best = -1;
  for (int i = fan_start_[vertex]; i < fan_start_[vertex + 1]; ++i) {
    const Triangle& t = mesh.triangles[fan_[i]];
    const int k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    NormalHit at_vertex;
    at_vertex.lambda = Vector3d::Unit(k);
    at_vertex.s = hit->s;
    const Local local(projector.prisms()[fan_[i]], at_vertex, x_b);
    if (local.det * sign <= 0.0) continue;
    const double w1 = local.r.dot(local.row1), w2 = local.r.dot(local.row2);
    const Vector3d w = Vector3d(-w1 - w2, w1, w2) * sign;
    const double u = w[(k + 1) % 3], v = w[(k + 2) % 3];
    const double total = std::abs(u) + std::abs(v);
    const double rate = total > 0.0 ? std::min(u, v) / total : 0.0;
    if (rate > best_rate) {
      best_rate = rate;
      best = i;
    }
  }
  if (best < 0) return false;
  *triangle = fan_[best];
  const Triangle& t = mesh.triangles[*triangle];
  hit->lambda = Vector3d::Unit(t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
  return true;
}

bool BranchWalk::Follow(const FieldProjector& projector, const Vector3d& x_b,
                        NormalHit* hit, int* triangle) const noexcept {
  double sign = 0.0;
  double shorten = 1.0;  // after a cut move that met a wall at once
  int stalls = 0;
  for (int step = 0; step < kMaxWalkSteps; ++step) {
    const OffsetPrism& prism = projector.prisms()[*triangle];
    const Local local(prism, *hit, x_b);
    if (sign == 0.0) sign = Sign(local.det);
    if (!(local.det * sign > 0.0)) return false;
    const Vector3d w = WalkNewtonStep(local);
    const double fraction = shorten * SafeFraction(prism, local, w);
    if (IsWalkAtFold(local, fraction)) return false;
    NormalHit next = *hit;
    if (!MoveWalkHit(prism, local, x_b, w, fraction, &next)) return false;

    const double tolerance = LambdaTolerance(local);
    if (next.lambda.minCoeff() >= -tolerance) {
      next.lambda = Clamped(next.lambda);
      *hit = next;
      if (fraction == 1.0) return true;
      shorten = 1.0;
      stalls = 0;
      continue;
    }
    const WalkWall wall = FirstWalkWall(hit->lambda, next.lambda, tolerance);
    const bool is_stall =
        wall.part * (hit->lambda - next.lambda).cwiseAbs().maxCoeff() < kAtEdge;
    stalls = is_stall ? stalls + 1 : 0;
    if (stalls > kMaxStalls) return false;
    // A move that starts inward and bends back is too long a step.
    if (is_stall && WalkLambdaStep(w)[wall.corner] > 0.0) {
      shorten *= 0.25;
      continue;
    }
    shorten = 1.0;
    MoveToWalkWall(wall, next, hit);
    int corner = 0;
    const bool is_at_vertex = hit->lambda.maxCoeff(&corner) == 1.0;
    if (is_at_vertex
            ? !EnterFan(projector, x_b, corner, sign, hit, triangle)
            : !CrossWalkWall(projector.field(), wall.corner, hit, triangle)) {
      return false;
    }
  }
  return false;
}

}  // namespace phongpd
