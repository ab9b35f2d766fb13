// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/projection/penetration_metric.h"
#include "core/projection/phong_field.h"

namespace phongpd {

// Which of the two Phong fields projects (engine: core/README.md).
enum class FieldKind {
  kNormal,        // closed form: one cubic per triangle, all projections
  kTangentPlane,  // the paper's: Newton on Eqs. 7-11 from (⅓,⅓,⅓)
};

struct PhongMetricOptions {
  FieldKind field = FieldKind::kNormal;
  PhongFieldOptions field_options;

  void Validate() const;  // throws InputError
};

// PhongPD over one contact space.
//
// Inside C_obj: −|q_c − q_o| with (q_c − q_o) × n(q_c) = 0 (paper, Eq. 3).
// Outside and on C_cont: the answer of EuclideanMetric, bit for bit.  The two
// fit together continuously, because both are 0 on C_cont.  An answer from
// outside has no branch, so a motion that enters C_obj again starts cold, at
// depth 0, where only one projection is short.
//
// A query without a branch searches exactly for the least depth (of equal
// depths, for the contact that comes first by x, y, z).  A query with a branch
// follows it from the configuration it was made for straight to q_o.  It
// reports kBranchEnded if the branch folds or leaves C_obj on the way, or if
// q_o left C_obj elsewhere than the branch leads.  A branch that cannot be of
// this metric (no such triangle, λ not barycentric, |s| above some 1e50
// diagonals) counts as none.  If no projection exists inside, the answer is
// Euclid's, without a branch, and the status is kEuclideanFallback.
class PhongMetric final : public PenetrationMetric {
 public:
  // Throws InputError for options.
  explicit PhongMetric(const ContactSpace& space,
                       const PhongMetricOptions& options = {});
  ~PhongMetric() override;
  PhongMetric(PhongMetric&&) noexcept;
  PhongMetric& operator=(PhongMetric&&) noexcept;

  using PenetrationMetric::Query;
  PenetrationResult Query(const Eigen::Vector3d& q_o,
                          const Branch& previous) const override;

  // All projections of an interior q_o with depth ≤ depth_bound (user's unit),
  // sorted by depth, written to *results (cleared first; capacity is kept, so
  // a reused vector does not allocate).  Empty outside C_obj.  A projection on
  // an edge or vertex is listed once.
  // kTangentPlane: those that Newton finds from (⅓,⅓,⅓), perhaps not all.
  void QueryAll(const Eigen::Vector3d& q_o, double depth_bound,
                std::vector<PenetrationResult>* results) const;

  // The paper's Algorithm 1 as reference: tries the triangles in the K rings
  // around the previous one (ring 1: those that share a vertex with it) and
  // takes the projection closest to the previous contact (section V.B).
  // kBranchEnded with the cold answer if there is none.  It compares positions,
  // not branches, so it may change to another branch unnoticed.  Allocates; use
  // Query for speed.
  PenetrationResult QueryRing(const Eigen::Vector3d& q_o,
                              const Branch& previous, int k) const;

  // Exact: q_o strictly inside C_obj.  False for non-finite q_o.
  bool IsInside(const Eigen::Vector3d& q_o) const;

  const PhongField& field() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
