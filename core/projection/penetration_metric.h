// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/projection/query_status.h"

namespace phongpd {

struct Depth;  // core/contact/depth.h, which says what to take when

// The state of a continuous family of projections, carried by the caller from
// query to query (the engine itself keeps no state).  It names the point
// q_o = p(λ) + s·n(λ) of the offset prism of one triangle, so the
// configuration it was made for can be recovered from it.
struct Branch {
  int triangle = -1;  // of the metric's field mesh
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();  // barycentric, sums to 1
  double s = 0.0;  // < 0 inside; units of length

  bool IsValid() const { return triangle >= 0; }
};

// Answer to a query at q_o: a Depth, with what solvers and motions need.
// Lengths in the user's unit.
struct PenetrationResult {
  QueryStatus status = QueryStatus::kInvalid;
  bool inside = false;  // exact: q_o strictly inside C_obj
  // −|q_c − q_o| inside, distance outside.  Its sign is exact: < 0 strictly
  // inside C_obj, 0 on C_cont (the robot touches), > 0 in free space.
  double signed_distance = 0.0;
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  // q_c on C_cont
  // Unit vector from q_o towards q_c inside (SmoothedMetric: outward, its own),
  // outward gradient outside.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  // Exact gradient of signed_distance; one-sided on edges.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  int triangle = -1;  // of the contact-space mesh, holds q_c
  // Hand it to the next query.  Not valid (the next query is then cold)
  // outside, with kEuclideanFallback, and from metrics without branches.
  Branch branch;

  // PD(q_o) = q_c − q_o (paper, Eq. 1) inside, zero outside.
  Eigen::Vector3d PenetrationVector(const Eigen::Vector3d& q_o) const {
    return inside ? Eigen::Vector3d(contact - q_o) : Eigen::Vector3d::Zero();
  }

  // The same in the words of all depths, without witnesses.  Certified outside
  // and on C_cont, where every metric tells the distance; inside, the least
  // depth is at most this one's.
  Depth ToDepth() const;
};

// A penetration metric over one contact space.  Queries are const,
// thread-safe and do not allocate (except for exact signs of coordinates beyond
// 1e±70, exact_sign.h).  Only NaN or infinity in q_o gives kInvalid, and no
// result holds NaN or infinity.
class PenetrationMetric {
 public:
  virtual ~PenetrationMetric() = default;

  // The metric at q_o.  A metric that has branches continues a valid `previous`
  // (Euclidean PD ignores it); without one it answers cold, with the least
  // depth of all projections.
  virtual PenetrationResult Query(const Eigen::Vector3d& q_o,
                                  const Branch& previous) const = 0;
  PenetrationResult Query(const Eigen::Vector3d& q_o) const {
    return Query(q_o, Branch());
  }
};

}  // namespace phongpd
