// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution_space.h"

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

}  // namespace

ConvolutionSpace::ConvolutionSpace(const GridPair& pair)
    : pair_(pair),
      judge_(pair.obstacle, pair.reflected_robot),
      mesh_(AsMesh(ReducedConvolution(pair.obstacle, pair.reflected_robot))) {
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

}  // namespace phongpd::internal
