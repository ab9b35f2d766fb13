// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/projection/normal_field.h"
#include "core/projection/phong_field.h"
#include "core/projection/phong_metric.h"
#include "core/projection/tangent_plane_field.h"

namespace phongpd {

// A Phong projection: x = p(λ) + s·n on one triangle of the field mesh, n of
// the normal field not normalised, of the tangent-plane field a unit vector.
// Field frame.
struct Projection {
  int triangle = -1;
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
  double s = 0.0;
  double depth = 0.0;  // −s|n| > 0 inside

  bool IsValid() const { return triangle >= 0; }
};

// The two Phong fields behind one face: everything the searches need to know
// of a field, triangle by triangle.
class FieldProjector {
 public:
  // How far outside the surface (field frame) still counts as on it: which side
  // a point is on is known exactly, but the field frame rounds.
  static constexpr double kOnSurface = 1e-13;

  FieldProjector(PhongField field, FieldKind kind);

  const PhongField& field() const { return field_; }
  FieldKind kind() const { return kind_; }
  const std::vector<OffsetPrism>& prisms() const { return prisms_; }

  // All projections (normal field) or the one Newton finds from `start`
  // (tangent planes) of x on `triangle` with −max_depth ≤ signed depth ≤ 0.
  // Points on the surface up to rounding count as depth 0.
  int Project(int triangle, const Eigen::Vector3d& x, double max_depth,
              const Eigen::Vector3d& start,
              std::array<Projection, 3>* found) const noexcept;
  int Project(int triangle, const Eigen::Vector3d& x, double max_depth,
              std::array<Projection, 3>* found) const noexcept {
    return Project(triangle, x, max_depth, Eigen::Vector3d::Constant(1.0 / 3.0),
                   found);
  }

  // The same where all that is looked for has −s in [least, most], least ≥ 0
  // (normal field; the other takes no notice): fewer roots to be found.
  int Project(int triangle, const Eigen::Vector3d& x, double max_depth,
              double least, double most,
              std::array<Projection, 3>* found) const noexcept;

  Eigen::Vector3d Point(const Projection& p) const {
    return prisms_[p.triangle].Point(p.lambda);
  }
  // Unit normal n̂ at the projection.
  Eigen::Vector3d UnitNormal(const Projection& p) const noexcept;
  // Exact gradient of the signed depth; n̂ where it does not exist (a fold),
  // zero where n̂ does not.
  Eigen::Vector3d Gradient(const Projection& p) const noexcept;

 private:
  PhongField field_;
  FieldKind kind_;
  std::vector<OffsetPrism> prisms_;
  TangentPlaneField planes_;  // kTangentPlane only
};

}  // namespace phongpd
