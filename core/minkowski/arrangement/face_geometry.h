// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/minkowski/arrangement/plane_arrangement.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// The arrangement in double, to choose points that are then judged exactly.
class FaceGeometry {
 public:
  FaceGeometry(const Convolution& convolution, const Arrangement& arrangement,
               const ExactPoints& points)
      : convolution_(convolution), arrangement_(arrangement), points_(points) {}

  int FaceCount() const { return static_cast<int>(arrangement_.faces.size()); }
  double Area(int face) const;
  // Unit, of the face's facet.
  Eigen::Vector3d Normal(int face) const;
  // A point of the face well away from its border.
  Eigen::Vector3d InteriorPoint(int face) const;

  struct Hit {
    double distance = 0.0;
    int face = -1;
  };
  // Speeds up FirstHit; worth it for more than a few rays.
  void BuildTree();
  // First face other than `self` on from + t·direction, 0 < t ≤ reach; the
  // distance is `reach` and the face −1 when there is none.  All faces at an
  // edge agree on which side of it a ray passes: none slips between two.
  Hit FirstHit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
               double reach, int self) const;
  // All faces other than `self` on from + t·direction, t > 0, by t.
  std::vector<Hit> AllHits(const Eigen::Vector3d& from,
                           const Eigen::Vector3d& direction, int self) const;

 private:
  struct Ray;
  double Intersect(int face, const Ray& ray) const;
  const Eigen::Vector3d& From(int half_edge) const {
    return points_.Approximate(arrangement_.half_edges[half_edge].from);
  }
  const Eigen::Vector3d& To(int half_edge) const {
    return points_.Approximate(arrangement_.half_edges[half_edge].to);
  }

  const Convolution& convolution_;
  const Arrangement& arrangement_;
  const ExactPoints& points_;
  BoxTree tree_;
};

}  // namespace phongpd::internal
