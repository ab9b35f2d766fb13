// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/intrinsic_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

// Slack of the triangle inequalities, relative to the diagonal.
constexpr double kTriangleSlack = 1e-10;
// Cotangent sums above −kCocircular·(|cot α| + |cot β|) are cocircular up to
// rounding: flipping those could go on for ever.
constexpr double kCocircular = 1e-12;
// Cotangents of larger modulus tie two vertices so closely that the difference
// cannot be seen, while they would drown the masses in rounding.
constexpr double kMaxCotangent = 1e6;
// Flips per edge after which the rest is left as it is (never seen; the
// remaining negative weights would be clamped).
constexpr std::size_t kMaxFlipsPerEdge = 100;

// Triangles glued along edges: edge k of triangle t runs from vertex[k] to
// vertex[(k+1)%3], and is glued to edge `side` of triangle `triangle`.
struct Glue {
  int triangle;
  int side;
};
struct IntrinsicTriangle {
  std::array<int, 3> vertex;
  std::array<double, 3> length;
  std::array<Glue, 3> across;
};

int Next(int k) { return (k + 1) % 3; }
using internal::At;

// Kahan's stable area of a triangle from its edge lengths.
double Area(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double product =
      (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return 0.25 * std::sqrt(std::max(product, 0.0));
}

class IntrinsicTriangulation {
 public:
  explicit IntrinsicTriangulation(const TriangleMesh& mesh) {
    const auto neighbors = TriangleNeighbors(mesh);
    triangles_.resize(mesh.triangles.size());
    double shortfall = 0.0;
    const double slack = kTriangleSlack * ComputeBounds(mesh).Diagonal();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      IntrinsicTriangle& tri = triangles_[t];
      tri.vertex = mesh.triangles[t];
      for (int k = 0; k < 3; ++k) {
        const int i = tri.vertex[At(k)];
        const int j = tri.vertex[At(Next(k))];
        tri.length[At(k)] =
            (mesh.vertices[At(i)] - mesh.vertices[At(j)]).norm();
        const int other = neighbors[t][At(k)];
        int side = 0;
        while (mesh.triangles[At(other)][At(side)] != j ||
               mesh.triangles[At(other)][At(Next(side))] != i) {
          ++side;
        }
        tri.across[At(k)] = {other, side};
      }
      const auto& l = tri.length;
      for (int k = 0; k < 3; ++k) {
        shortfall = std::max(shortfall, slack + l[At(k)] - l[At(Next(k))] -
                                            l[At(Next(Next(k)))]);
      }
    }
    for (IntrinsicTriangle& tri : triangles_) {
      for (double& l : tri.length) l += shortfall;
    }
  }

  void MakeDelaunay() {
    std::vector<Glue> stack;
    for (int t = static_cast<int>(triangles_.size()) - 1; t >= 0; --t) {
      for (int k = 2; k >= 0; --k) stack.push_back({t, k});
    }
    std::size_t flips_left = kMaxFlipsPerEdge * stack.size();
    while (!stack.empty() && flips_left > 0) {
      const Glue edge = stack.back();
      stack.pop_back();
      if (IsDelaunay(edge)) continue;
      const Glue other = Across(edge);
      Flip(edge, other);
      --flips_left;
      // Flip leaves the diagonal as side 0 of both triangles.
      for (int k = 2; k >= 1; --k) {
        stack.push_back({edge.triangle, k});
        stack.push_back({other.triangle, k});
      }
    }
  }

  std::vector<CotangentWeight> Weights() const {
    std::vector<CotangentWeight> weights;
    weights.reserve(triangles_.size() * 3 / 2);
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Glue other = triangles_[At(t)].across[At(k)];
        if (std::make_pair(other.triangle, other.side) < std::make_pair(t, k)) {
          continue;
        }
        const double sum =
            Bounded(Cotangent({t, k})) + Bounded(Cotangent(other));
        weights.push_back({triangles_[At(t)].vertex[At(k)],
                           triangles_[At(t)].vertex[At(Next(k))],
                           std::max(0.5 * sum, 0.0)});
      }
    }
    return weights;
  }

 private:
  Glue Across(Glue e) const {
    return triangles_[At(e.triangle)].across[At(e.side)];
  }

  // Cotangent of the angle opposite the edge.
  double Cotangent(Glue e) const {
    const auto& l = triangles_[At(e.triangle)].length;
    const double c = l[At(e.side)];
    const double a = l[At(Next(e.side))];
    const double b = l[At(Next(Next(e.side)))];
    // a² + b² − c² with the cancellation in the product form.
    return ((a - c) * (a + c) + b * b) / (4.0 * Area(a, b, c));
  }

  // Coincident vertices make infinite cotangents, or 0/0.
  static double Bounded(double cotangent) {
    if (std::isnan(cotangent)) return 0.0;
    return std::clamp(cotangent, -kMaxCotangent, kMaxCotangent);
  }

  bool IsDelaunay(Glue e) const {
    const Glue other = Across(e);
    // A triangle glued to itself has an inner vertex of degree one: the angle
    // opposite is counted twice and stays below π.
    if (other.triangle == e.triangle) return true;
    const double alpha = Cotangent(e);
    const double beta = Cotangent(other);
    return !(alpha + beta < -kCocircular * (std::abs(alpha) + std::abs(beta)));
  }

  // Replaces the shared edge (i, j) of the triangles (i, j, k) and (j, i, l)
  // by the other diagonal: (k, l, j) and (l, k, i), diagonal first.
  void Flip(Glue e, Glue o) {
    const IntrinsicTriangle t = triangles_[At(e.triangle)];
    const IntrinsicTriangle u = triangles_[At(o.triangle)];
    const int e1 = Next(e.side), e2 = Next(e1);
    const int o1 = Next(o.side), o2 = Next(o1);
    const int i = t.vertex[At(e.side)], j = t.vertex[At(e1)];
    const int k = t.vertex[At(e2)], l = u.vertex[At(o2)];
    const double ij = t.length[At(e.side)];
    const double jk = t.length[At(e1)], ki = t.length[At(e2)];
    const double il = u.length[At(o1)], lj = u.length[At(o2)];
    // Both triangles laid out in the plane, i in the origin, j on the x axis.
    const double xk = 0.5 * (ij + (ki - jk) * (ki + jk) / ij);
    const double xl = 0.5 * (ij + (il - lj) * (il + lj) / ij);
    const double y = 2.0 * (Area(ij, jk, ki) + Area(ij, il, lj)) / ij;
    const double kl = std::hypot(xk - xl, y);

    const auto renamed = [&](Glue g) -> Glue {
      if (g.triangle == e.triangle && g.side == e1) return {e.triangle, 2};
      if (g.triangle == e.triangle && g.side == e2) return {o.triangle, 1};
      if (g.triangle == o.triangle && g.side == o1) return {o.triangle, 2};
      if (g.triangle == o.triangle && g.side == o2) return {e.triangle, 1};
      return g;
    };
    triangles_[At(e.triangle)] = {
        {k, l, j},
        {kl, lj, jk},
        {Glue{o.triangle, 0}, renamed(u.across[At(o2)]),
         renamed(t.across[At(e1)])}};
    triangles_[At(o.triangle)] = {
        {l, k, i},
        {kl, ki, il},
        {Glue{e.triangle, 0}, renamed(t.across[At(e2)]),
         renamed(u.across[At(o1)])}};
    for (const int side : {1, 2}) {
      for (const int tri : {e.triangle, o.triangle}) {
        const Glue g = Across({tri, side});
        triangles_[At(g.triangle)].across[At(g.side)] = {tri, side};
      }
    }
  }

  std::vector<IntrinsicTriangle> triangles_;
};

}  // namespace

std::vector<CotangentWeight> IntrinsicDelaunayWeights(
    const TriangleMesh& mesh) {
  IntrinsicTriangulation triangulation(mesh);
  triangulation.MakeDelaunay();
  return triangulation.Weights();
}

}  // namespace phongpd
