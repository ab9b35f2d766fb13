// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "constraints/signed_metric.h"
#include "core/projection/phong_field.h"
#include "planners/world/length.h"

namespace phongpd {

// The penetration depth that rows of an optimiser follow inside obstacles, and
// the derivative they give.  Outside all are the Euclidean distance.
struct PenetrationSpec {
  MetricKind metric = MetricKind::kPhong;
  // Of Phong only.  ℓ: at most D; 0: the paper.
  FieldKind field = FieldKind::kNormal;
  JacobianKind jacobian = JacobianKind::kDirection;
  Length smoothing_length = Length::FromShare(kDefaultSmoothingLength);

  // As users write it: "euclidean", "phong@0.2", "phong@0.5unit/exact",
  // "phong@0/tangent-plane/exact"; ParsePenetration reads back the same.
  std::string Name() const;

  // In a world of diagonal D.  Throws InputError for an ℓ longer than that.
  SignedMetricOptions Options(double diagonal) const;
};

// Reads "euclidean", "phong" as it is by default, "phong@L" with the smoothing
// length L (length.h), with "/tangent-plane" the paper's field, with "/exact"
// the exact Jacobian.  Throws InputError starting with `what`.
PenetrationSpec ParsePenetration(const std::string& text,
                                 const std::string& what);

// phong, euclidean; normal, tangent-plane; direction, exact: as scenes and
// flags name them.
const char* ToString(MetricKind metric);
const char* ToString(FieldKind field);
const char* ToString(JacobianKind jacobian);
// Throw InputError starting with `what`.
MetricKind ParseMetricKind(const std::string& text, const std::string& what);
FieldKind ParseFieldKind(const std::string& text, const std::string& what);
JacobianKind ParseJacobianKind(const std::string& text,
                               const std::string& what);

}  // namespace phongpd
