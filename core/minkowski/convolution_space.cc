// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution_space.h"

#include <algorithm>
#include <limits>

#include "core/mesh/finite.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Grid points are exact in double.
TriangleMesh AsMesh(const Convolution& convolution) {
  TriangleMesh mesh;
  mesh.vertices.reserve(convolution.points.size());
  for (const GridPoint& p : convolution.points) {
    mesh.vertices.push_back(ToDouble(p));
  }
  mesh.triangles.reserve(convolution.facets.size());
  for (const ConvolutionFacet& f : convolution.facets) {
    mesh.triangles.push_back(f.corners);
  }
  return mesh;
}

// Of a radius: what rounding between the frames may take of it.
constexpr double kSlack = 1.0 + 0x1p-40;

}  // namespace

ConvolutionSpace::ConvolutionSpace(const GridPair& pair,
                                   const BuildLimits* limits)
    : pair_(pair),
      judge_(pair.obstacle, pair.reflected_robot),
      mesh_(AsMesh(
          ReducedConvolution(pair.obstacle, pair.reflected_robot, limits))) {
  bounds_ = ComputeBounds(mesh_);
  bvh_ = TriangleBvh(mesh_);
}

Vector3d ConvolutionSpace::ToGrid(const Vector3d& q) const {
  return RoundedToFractions(pair_.frame.ToGrid(q));
}

bool ConvolutionSpace::IsFree(const Vector3d& q) const {
  const Vector3d x = ToGrid(q);
  if (!IsFinite(x)) return false;
  const bool is_within = (x.array() >= bounds_.min.array()).all() &&
                         (x.array() <= bounds_.max.array()).all();
  return !is_within || !judge_.Collide(x);
}

bool ConvolutionSpace::IsFree(const Vector3d& a, const Vector3d& b) const {
  const Vector3d from = ToGrid(a), to = ToGrid(b);
  return IsFinite(to) && IsFree(a) && !bvh_.Meets(from, to);
}

double ConvolutionSpace::FirstContact(const Vector3d& a,
                                      const Vector3d& b) const {
  const Vector3d to = ToGrid(b);
  if (!IsFinite(to)) return 0.0;
  const TriangleBvh::Hit hit = bvh_.FirstHit(ToGrid(a), to);
  return hit.Found() ? hit.fraction : 2.0;
}

ConvolutionSpace::Nearest ConvolutionSpace::FindNearest(
    const Vector3d& q) const {
  const Vector3d x = ToGrid(q);
  const TriangleBvh::Closest closest = bvh_.FindClosest(x);
  Vector3d point = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    point += closest.lambda[k] *
             mesh_.vertices[mesh_.triangles[closest.triangle][k]];
  }
  return {pair_.frame.ToUser(point), closest.distance * pair_.frame.step};
}

double ConvolutionSpace::Distance(const Vector3d& a, const Vector3d& b,
                                  double limit) const {
  const double step = pair_.frame.step;
  return std::min(limit,
                  step * bvh_.Distance(ToGrid(a), ToGrid(b), limit / step));
}

std::vector<std::array<Vector3d, 3>> ConvolutionSpace::FacetsNear(
    const Vector3d& a, const Vector3d& b, double radius) const {
  std::vector<std::array<Vector3d, 3>> near;
  const Vector3d from = ToGrid(a), to = ToGrid(b);
  if (!IsFinite(from) || !IsFinite(to)) return near;
  // In grid steps the segment is rounded by less than one.
  const double reach = kSlack * radius / pair_.frame.step + 1.0;
  bvh_.ForEachDoubt(from, to, reach, [&](int triangle, double) {
    std::array<Vector3d, 3>& corners = near.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] =
          pair_.frame.ToUser(mesh_.vertices[mesh_.triangles[triangle][k]]);
    }
  });
  return near;
}

BoundingBox ConvolutionSpace::Bounds() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BoundingBox bounds{Vector3d::Constant(kInfinity),
                     Vector3d::Constant(-kInfinity)};
  for (const Vector3d& v : mesh_.vertices) {
    const Vector3d q = pair_.frame.ToUser(v);
    bounds.min = bounds.min.cwiseMin(q);
    bounds.max = bounds.max.cwiseMax(q);
  }
  return bounds;
}

TriangleMesh ConvolutionSpace::Mesh() const {
  TriangleMesh mesh = mesh_;
  for (Vector3d& v : mesh.vertices) v = pair_.frame.ToUser(v);
  return mesh;
}

}  // namespace phongpd::internal
