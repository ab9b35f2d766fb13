// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/penetration_spec.h"

#include <algorithm>
#include <cstddef>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

constexpr char kExactSuffix[] = "/exact";
constexpr char kTangentPlaneSuffix[] = "/tangent-plane";

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

// What may be said of it beside the length.
bool HasField(MetricKind metric) { return metric == MetricKind::kPhong; }

// "0.2", "0.5unit/exact".
std::string LengthName(const PenetrationSpec& spec) {
  std::string name = spec.smoothing_length.Text();
  if (!HasField(spec.metric)) return name;
  if (spec.field == FieldKind::kTangentPlane) name += kTangentPlaneSuffix;
  if (spec.jacobian == JacobianKind::kExact) name += kExactSuffix;
  return name;
}

}  // namespace

std::string PenetrationSpec::Name() const {
  if (!HasLength(metric)) return ToString(metric);
  return ToString(metric) + ("@" + LengthName(*this));
}

std::string PenetrationSpec::Title() const {
  if (metric == MetricKind::kEuclidean) return "Euclidean PD";
  return metric == MetricKind::kPhong ? "PhongPD, ℓ = " + LengthName(*this)
                                      : Name();
}

SignedMetricOptions PenetrationSpec::Options(double diagonal) const {
  SignedMetricOptions options;
  options.metric = metric;
  if (!HasLength(metric)) return options;
  RequireLength(smoothing_length, LengthRangeOf(metric), diagonal,
                Name() + ": smoothing_length");
  options.phong.field_options.smoothing_length =
      smoothing_length.Resolve(diagonal).share;
  if (!HasField(metric)) {
    if (jacobian == JacobianKind::kExact) {
      throw InputError(Name() +
                       ": jacobian: expected direction, found exact, which is "
                       "that of the metric euclidean; take that one");
    }
    return options;
  }
  options.jacobian = jacobian;
  options.phong.field = field;
  return options;
}

PenetrationSpec ParsePenetration(const std::string& text,
                                 const std::string& what) {
  PenetrationSpec spec;
  const std::size_t at = text.find('@');
  const std::string name = text.substr(0, at);
  const auto& names = MetricNames();
  const auto found = std::find(names.begin(), names.end(), name);
  const bool is_known = found != names.end();
  if (is_known) spec.metric = static_cast<MetricKind>(found - names.begin());
  const bool has_length = at != std::string::npos;
  if (!is_known || (has_length && !HasLength(spec.metric))) {
    throw InputError(
        what +
        ": expected euclidean, phong[@LENGTH], phong@LENGTH/exact, "
        "phong@LENGTH/tangent-plane, smoothed[@LENGTH] or "
        "smoothed-foot[@LENGTH], found '" +
        text + "'" + (is_known ? "" : DidYouMean(name, names)));
  }
  if (!has_length) return spec;
  std::string length = text.substr(at + 1);
  if (HasField(spec.metric)) {
    if (TakeSuffix(kExactSuffix, &length)) spec.jacobian = JacobianKind::kExact;
    if (TakeSuffix(kTangentPlaneSuffix, &length)) {
      spec.field = FieldKind::kTangentPlane;
    }
  }
  const std::string place = what + ": smoothing_length";
  spec.smoothing_length = ParseLength(length, place);
  RequireLength(spec.smoothing_length, LengthRangeOf(spec.metric), 0.0, place);
  return spec;
}

const std::vector<std::string>& MetricNames() {
  static const std::vector<std::string> names = {"phong", "euclidean",
                                                 "smoothed", "smoothed-foot"};
  return names;
}

bool HasLength(MetricKind metric) { return metric != MetricKind::kEuclidean; }

LengthRange LengthRangeOf(MetricKind metric) {
  return metric == MetricKind::kPhong ? LengthRange::kFromZero
                                      : LengthRange::kAboveZero;
}

const char* ToString(MetricKind metric) {
  return MetricNames()[static_cast<std::size_t>(metric)].c_str();
}

const char* ToString(FieldKind field) {
  return field == FieldKind::kNormal ? "normal" : "tangent-plane";
}

const char* ToString(JacobianKind jacobian) {
  return jacobian == JacobianKind::kDirection ? "direction" : "exact";
}

MetricKind ParseMetricKind(const std::string& text, const std::string& what) {
  const std::vector<std::string>& names = MetricNames();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw InputError(what + ": expected one of " + Joined(names) + ", found '" +
                     text + "'" + DidYouMean(text, names));
  }
  return static_cast<MetricKind>(found - names.begin());
}

FieldKind ParseFieldKind(const std::string& text, const std::string& what) {
  return ParseKind(FieldKind::kNormal, FieldKind::kTangentPlane, text, what);
}

JacobianKind ParseJacobianKind(const std::string& text,
                               const std::string& what) {
  return ParseKind(JacobianKind::kDirection, JacobianKind::kExact, text, what);
}

}  // namespace phongpd
