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
// Outside and on C_cont: the answer of EuclideanMetric, bit for bit (there is
// no penetration; the combination is continuous because both vanish on
// C_cont).  It has no branch, so re-entering C_obj starts cold, at depth 0,
// where the least projection is the only short one.
//
// Query without a branch is an exact search for the least depth (of equal
// depths, the contact that comes first by x, y, z).  With a branch it follows
// the branch from the branch's own configuration straight to q_o and reports
// kBranchEnded where the branch folds, leaves C_obj, or is left behind because
// q_o left C_obj elsewhere.  What is no branch of this metric by its numbers –
// no such triangle, λ not barycentric, |s| of some 1e50 diagonals – counts as
// none.
// Where no projection exists inside, the Euclidean answer without a branch
// and status kEuclideanFallback.
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
  // kTangentPlane: the hits of Newton from (⅓,⅓,⅓), which need not be all.
  void QueryAll(const Eigen::Vector3d& q_o, double depth_bound,
                std::vector<PenetrationResult>* results) const;

  // The paper's Algorithm 1 as reference: tries the triangles in the K rings
  // around the previous one (ring 1: those that share a vertex with it) and
  // takes the projection closest to the previous contact (section V.B).
  // kBranchEnded with the cold answer if there is none.  It sees positions,
  // not branches, so it may change sheet.  Allocates; use Query for speed.
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
