// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/penetration_spec.h"

#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

constexpr char kPhongPrefix[] = "phong@";
constexpr char kExactSuffix[] = "/exact";
constexpr char kTangentPlaneSuffix[] = "/tangent-plane";

bool TakePrefix(const std::string& prefix, std::string* text) {
  if (text->compare(0, prefix.size(), prefix) != 0) return false;
  text->erase(0, prefix.size());
  return true;
}

bool TakeSuffix(const std::string& suffix, std::string* text) {
  if (text->size() < suffix.size() ||
      text->compare(text->size() - suffix.size(), suffix.size(), suffix) != 0) {
    return false;
  }
  text->resize(text->size() - suffix.size());
  return true;
}

// The first of two kinds, or the second.
template <typename Kind>
Kind ParseKind(Kind first, Kind second, const std::string& text,
               const std::string& what) {
  for (const Kind kind : {first, second}) {
    if (text == ToString(kind)) return kind;
  }
  throw InputError(what + ": expected " + ToString(first) + " or " +
                   ToString(second) + ", found '" + text + "'");
}

}  // namespace

std::string PenetrationSpec::Name() const {
  if (metric == MetricKind::kEuclidean) return ToString(metric);
  std::string name = kPhongPrefix + smoothing_length.Text();
  if (field == FieldKind::kTangentPlane) name += kTangentPlaneSuffix;
  if (jacobian == JacobianKind::kExact) name += kExactSuffix;
  return name;
}

SignedMetricOptions PenetrationSpec::Options(double diagonal) const {
  SignedMetricOptions options;
  options.metric = metric;
  if (metric == MetricKind::kEuclidean) return options;
  RequireLength(smoothing_length, LengthRange::kFromZero, diagonal,
                Name() + ": smoothing_length");
  options.jacobian = jacobian;
  options.phong.field = field;
  options.phong.field_options.smoothing_length =
      smoothing_length.Resolve(diagonal).share;
  return options;
}

PenetrationSpec ParsePenetration(const std::string& text,
                                 const std::string& what) {
  PenetrationSpec spec;
  if (text == ToString(MetricKind::kEuclidean)) {
    spec.metric = MetricKind::kEuclidean;
    return spec;
  }
  if (text == ToString(MetricKind::kPhong)) return spec;
  std::string length = text;
  if (!TakePrefix(kPhongPrefix, &length)) {
    throw InputError(
        what +
        ": expected euclidean, phong, phong@LENGTH, phong@LENGTH/exact "
        "or phong@LENGTH/tangent-plane, found '" +
        text + "'");
  }
  if (TakeSuffix(kExactSuffix, &length)) spec.jacobian = JacobianKind::kExact;
  if (TakeSuffix(kTangentPlaneSuffix, &length)) {
    spec.field = FieldKind::kTangentPlane;
  }
  const std::string place = what + ": smoothing_length";
  spec.smoothing_length = ParseLength(length, place);
  RequireLength(spec.smoothing_length, LengthRange::kFromZero, 0.0, place);
  return spec;
}

const char* ToString(MetricKind metric) {
  return metric == MetricKind::kPhong ? "phong" : "euclidean";
}

const char* ToString(FieldKind field) {
  return field == FieldKind::kNormal ? "normal" : "tangent-plane";
}

const char* ToString(JacobianKind jacobian) {
  return jacobian == JacobianKind::kDirection ? "direction" : "exact";
}

MetricKind ParseMetricKind(const std::string& text, const std::string& what) {
  return ParseKind(MetricKind::kPhong, MetricKind::kEuclidean, text, what);
}

FieldKind ParseFieldKind(const std::string& text, const std::string& what) {
  return ParseKind(FieldKind::kNormal, FieldKind::kTangentPlane, text, what);
}

JacobianKind ParseJacobianKind(const std::string& text,
                               const std::string& what) {
  return ParseKind(JacobianKind::kDirection, JacobianKind::kExact, text, what);
}

}  // namespace phongpd
