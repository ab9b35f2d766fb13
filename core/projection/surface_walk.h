// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/bvh/triangle_corners.h"
#include "core/contact/contact_space.h"

namespace phongpd {

// A point of a mesh: Σ λ_i q_i on one triangle, λ ≥ 0, sums to 1.
struct MeshPoint {
  int triangle = -1;
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();

  bool IsValid() const { return triangle >= 0; }
};

// The point of some triangles that is closest to an x.
struct SurfaceFoot {
  MeshPoint point;
  double squared_distance = 0.0;
};

// A way on the surface: straight pieces, each inside one triangle, from where
// the one before ended (on an edge or vertex that both triangles share) to its
// own point.
using SurfaceWay = std::vector<MeshPoint>;

// The triangles of a contact space to walk over.  Lengths are in the frame of
// its box tree (triangle_bvh.h), whose diagonal is in [1, 2).
class SurfaceWalk {
 public:
  explicit SurfaceWalk(const ContactSpace& space);

  std::size_t size() const { return corners_.size(); }
  const TriangleBvh& bvh() const { return *bvh_; }
  const TriangleCorners& corners(int triangle) const {
    return corners_[triangle];
  }
  // Neighbours across edge k = (v_k, v_{k+1 mod 3}).
  const std::array<int, 3>& neighbors(int triangle) const {
    return neighbors_[triangle];
  }
  // Triangles that can be reached from each other across edges have the same.
  int component(int triangle) const { return component_[triangle]; }
  Eigen::Vector3d At(const MeshPoint& p) const;
  // A point seen from a triangle that shares the edge or vertex it lies on.
  MeshPoint SeenFrom(int triangle, const MeshPoint& p) const;

  // The point of one triangle closest to x.
  SurfaceFoot FootOn(int triangle, const Eigen::Vector3d& x) const;
  // The point of the surface closest to x, x within some 1e100; `seed` (valid
  // or not) is a foot that is known already: the closer, the faster.  With a
  // component ≥ 0 only its triangles count, and the seed must be on it.
  SurfaceFoot FindClosest(const Eigen::Vector3d& x, const SurfaceFoot& seed,
                          int component = -1) const;
  // Descends |· − x| from `from` over adjacent triangles, around a vertex over
  // all of its fan, to a local minimum, and writes the way it took.  Every
  // triangle is nearer than the one before, so it ends, and no point of the
  // way is farther from x than `from`.
  SurfaceFoot Descend(const MeshPoint& from, const Eigen::Vector3d& x,
                      SurfaceWay* way) const;
  // Moves *p along way[*next], … by at most `budget` ≥ 0, and *next to the
  // piece that *p is on then (the size: it has arrived).  Returns how far.
  double Advance(const SurfaceWay& way, double budget, std::size_t* next,
                 MeshPoint* p) const;

 private:
  void OfferFan(int triangle, int corner, const Eigen::Vector3d& x,
                SurfaceFoot* best) const;

  ContactSpace space_;
  const TriangleBvh* bvh_;  // of the space, which keeps it
  std::vector<TriangleCorners> corners_;
  std::vector<std::array<int, 3>> neighbors_;
  std::vector<int> component_;
};

}  // namespace phongpd
