// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/solid_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/bounds/distance_search.h"
#include "core/bvh/triangle_bvh.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::DistanceTarget;
using internal::FarthestPoint;
using internal::Piece;

// The frame all distances are taken in: coordinates of the size of one.
struct Frame {
  Vector3d center = Vector3d::Zero();
  double scale = 1.0;
  double diagonal = 0.0;  // in the frame

  Frame(const TriangleMesh& a, const TriangleMesh& b) {
    const BoundingBox p = ComputeBounds(a), q = ComputeBounds(b);
    const BoundingBox both{p.min.cwiseMin(q.min), p.max.cwiseMax(q.max)};
    center = both.Center();
    if (both.Diagonal() > 0.0) {
      scale = std::ldexp(1.0, -std::ilogb(both.Diagonal()));
    }
    diagonal = both.Diagonal() * scale;
  }
  Vector3d Inside(const Vector3d& x) const { return (x - center) * scale; }
  TriangleMesh Inside(TriangleMesh mesh) const {
    for (Vector3d& v : mesh.vertices) v = Inside(v);
    return mesh;
  }
};

DistanceBounds ToUser(DistanceBounds bounds, const Frame& frame) {
  bounds.lower /= frame.scale;
  bounds.upper /= frame.scale;
  return bounds;
}

// The six tetrahedra that share a diagonal of a box.
std::vector<Piece> BoxPieces(const BoundingBox& box) {
  std::vector<Piece> pieces;
  std::array<int, 3> axes = {0, 1, 2};
  do {
    Piece piece;
    Vector3d corner = box.min;
    piece.corners[0] = corner;
    for (int k = 0; k < 3; ++k) {
      corner[axes[k]] = box.max[axes[k]];
      piece.corners[k + 1] = corner;
    }
    pieces.push_back(piece);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return pieces;
}

std::vector<Piece> FacetPieces(const TriangleMesh& mesh) {
  std::vector<Piece> pieces;
  pieces.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    Piece piece;
    piece.count = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      piece.corners[k] = mesh.vertices[t[k]];
    }
    pieces.push_back(piece);
  }
  return pieces;
}

// Upper bound of the distance of the points of a convex hull from the solid
// it is the hull of, good where the two are nearly the same.  Let no point of
// the solid's surface be deeper in the hull than ε.  The part H_ε of the hull
// that is deeper is convex and does not meet the surface, so when one of its
// points is in the solid, all of it is.  With o ∈ H_ε of depth ρ, every
// x ∈ H has o + (1 − ε/ρ)(x − o) ∈ H_ε, at a distance ≤ (ε/ρ) · |x − o|.
double NearlyConvexBound(const TriangleMesh& hull, const TriangleMesh& solid,
                         const DistanceTarget& to) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const TriangleBvh tree(hull);
  // With what the rounding of a sliver's normal can add, times `sign`.
  const auto depth = [&hull](std::size_t facet, const Vector3d& x, int sign) {
    const Triangle& t = hull.triangles[facet];
    const Vector3d& a = hull.vertices[t[0]];
    const Vector3d e = hull.vertices[t[1]] - a, f = hull.vertices[t[2]] - a;
    const Vector3d n = e.cross(f);
    if (!(n.norm() > 0.0)) return kInfinity;
    const double aspect = (e.squaredNorm() + f.squaredNorm()) / n.norm();
    return n.dot(a - x) / n.norm() + sign * 1e-15 * aspect;
  };
  double epsilon = 0.0;
  for (const Triangle& t : solid.triangles) {
    const Vector3d middle =
        (solid.vertices[t[0]] + solid.vertices[t[1]] + solid.vertices[t[2]]) /
        3.0;
    const auto facet =
        static_cast<std::size_t>(tree.FindClosest(middle).triangle);
    for (const int v : t) {
      epsilon = std::max(epsilon, depth(facet, solid.vertices[v], 1));
    }
  }
  Vector3d o = Vector3d::Zero();
  for (const Vector3d& v : hull.vertices) o += v;
  o /= static_cast<double>(hull.vertices.size());
  double rho = kInfinity, reach = 0.0;
  for (std::size_t f = 0; f < hull.triangles.size(); ++f) {
    rho = std::min(rho, depth(f, o, -1));
  }
  for (const Vector3d& v : hull.vertices) {
    reach = std::max(reach, (v - o).norm());
  }
  if (!(rho > epsilon) || !to.Contains(o)) return kInfinity;
  return epsilon / rho * reach;
}

// sup d(·, target) over a solid: over its surface, and over its inner points
// where the distance has a local maximum.
DistanceBounds Deviation(const TriangleMesh& from, const DistanceTarget& target,
                         const DistanceSearch& search, double diagonal) {
  const DistanceBounds surface =
      FarthestPoint(FacetPieces(from), target, nullptr, search, diagonal, 0.0);
  const DistanceTarget domain(from, true);
  DistanceBounds bounds =
      FarthestPoint(BoxPieces(ComputeBounds(from)), target, &domain, search,
                    diagonal, surface.lower);
  bounds.upper = std::max(bounds.upper, surface.upper);
  bounds.pieces += surface.pieces;
  return bounds;
}

}  // namespace

DistanceBounds SolidDeviation(const TriangleMesh& from, const TriangleMesh& to,
                              const DistanceSearch& search) {
  const Frame frame(from, to);
  const DistanceTarget target(frame.Inside(to), true);
  const TriangleMesh inner = frame.Inside(from);
  return ToUser(Deviation(inner, target, search, frame.diagonal), frame);
}

DistanceBounds SurfaceDeviation(const TriangleMesh& from,
                                const TriangleMesh& to,
                                const DistanceSearch& search) {
  const Frame frame(from, to);
  const DistanceTarget target(frame.Inside(to), false);
  return ToUser(FarthestPoint(FacetPieces(frame.Inside(from)), target, nullptr,
                              search, frame.diagonal, 0.0),
                frame);
}

DistanceBounds HullDeviation(const TriangleMesh& hull, const TriangleMesh& to,
                             const DistanceSearch& search) {
  const Frame frame(hull, to);
  const TriangleMesh solid = frame.Inside(to);
  const DistanceTarget target(solid, true);
  const TriangleMesh outer = frame.Inside(hull);
  const double nearly = NearlyConvexBound(outer, solid, target);
  DistanceBounds bounds;
  if (nearly > search.absolute * frame.diagonal) {
    bounds = Deviation(outer, target, search, frame.diagonal);
    bounds.upper = std::min(bounds.upper, nearly);
  } else {
    bounds.upper = nearly;
  }
  return ToUser(bounds, frame);
}

}  // namespace phongpd
