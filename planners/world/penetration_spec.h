// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "constraints/signed_metric.h"
#include "core/projection/phong_field.h"
#include "planners/world/length.h"

namespace phongpd {

// The penetration depth that rows of an optimiser follow inside obstacles, and
// the derivative they give.  Outside all are the Euclidean distance.
struct PenetrationSpec {
  MetricKind metric = MetricKind::kPhong;
  // Of Phong only.
  FieldKind field = FieldKind::kNormal;
  JacobianKind jacobian = JacobianKind::kDirection;
  // ℓ, at most D: of Phong, 0 the paper; of the smoothed metrics, above 0.
  Length smoothing_length = Length::FromShare(kDefaultSmoothingLength);

  // As users write it: "euclidean", "phong@0.2", "phong@0.5unit/exact",
  // "phong@0/tangent-plane/exact", "smoothed@0.2", "smoothed-foot@0.2";
  // ParsePenetration reads back the same.
  std::string Name() const;
  // For people: "Euclidean PD", "PhongPD, ℓ = 0.2"; else the name.
  std::string Title() const;

  // In a world of diagonal D.  Throws InputError for an ℓ longer than D; for
  // smoothed metrics also for ℓ = 0 and for the exact Jacobian, which would be
  // Euclid's.
  SignedMetricOptions Options(double diagonal) const;
};

// Reads "euclidean", "phong", "smoothed" and "smoothed-foot" with the default
// smoothing length, or with another one as in "phong@0.5unit" (length.h). After
// "phong", "/tangent-plane" means the paper's field, "/exact" the exact
// Jacobian. Throws InputError starting with `what`.
PenetrationSpec ParsePenetration(const std::string& text,
                                 const std::string& what);

// The names of all metrics, in the order of MetricKind: phong, euclidean,
// smoothed, smoothed-foot.
const std::vector<std::string>& MetricNames();
// Does it have a smoothing length?  All but the Euclidean do.
bool HasLength(MetricKind metric);
// Which lengths it takes: Phong's may be 0.
LengthRange LengthRangeOf(MetricKind metric);

// phong, euclidean, ...; normal, tangent-plane; direction, exact: as scenes and
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
