// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/signed_metric.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "constraints/feature_search.h"
#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/smoothed_metric.h"

namespace phongpd {

using Eigen::Vector3d;

namespace {

const double kCosSeparation = std::cos(kRowSeparation * kPi / 180.0);

bool IsSmoothed(MetricKind metric) {
  return metric == MetricKind::kSmoothed || metric == MetricKind::kSmoothedFoot;
}

}  // namespace

std::shared_ptr<const PenetrationMetric> MakePenetrationMetric(
    const ContactSpace& space, const SignedMetricOptions& options) {
  options.Validate();
  if (options.metric == MetricKind::kPhong) {
    return std::make_shared<PhongMetric>(space, options.phong);
  }
  if (IsSmoothed(options.metric)) {
    return std::make_shared<SmoothedMetric>(
        space, options.phong.field_options.smoothing_length,
        options.metric == MetricKind::kSmoothed ? SmoothedAt::kPosition
                                                : SmoothedAt::kContact);
  }
  return std::make_shared<EuclideanMetric>(space);
}

void SignedMetricOptions::Validate() const {
  if (metric == MetricKind::kPhong) phong.Validate();
  if (IsSmoothed(metric)) {
    SmoothedRadius(phong.field_options.smoothing_length, 1.0);
  }
}

SignedMetric::SignedMetric(const ContactSpace& space,
                           const SignedMetricOptions& options)
    : SignedMetric(space, MakePenetrationMetric(space, options), options) {}

SignedMetric::SignedMetric(const ContactSpace& space,
                           std::shared_ptr<const PenetrationMetric> metric,
                           const SignedMetricOptions& options)
    : SignedMetric(std::move(metric), options) {
  space_ = space;
  reach_ = kRowReach * space.length();
  features_ = std::make_shared<FeatureSearch>(space);
}

SignedMetric::SignedMetric(std::shared_ptr<const PenetrationMetric> metric,
                           const SignedMetricOptions& options)
    : options_(options), metric_(std::move(metric)) {
  options_.Validate();
  if (metric_ == nullptr) {
    throw InputError(
        "signed metric: expected a penetration metric, found null");
  }
}

MetricRow SignedMetric::Query(const Vector3d& q, const Branch& previous) const {
  const PenetrationResult result = metric_->Query(q, previous);
  MetricRow row;
  row.status = result.status;
  row.inside = result.inside;
  row.triangle = result.triangle;
  row.branch = result.branch;
  row.value = result.signed_distance;
  const bool exact = result.inside && options_.jacobian == JacobianKind::kExact;
  row.gradient = exact ? result.gradient : result.direction;
  const double length = row.gradient.stableNorm();
  if (length > kMaxRowGradient) {
    row.gradient *= kMaxRowGradient / length;
    row.is_capped = true;
  }
  return row;
}

void SignedMetric::Query(const Vector3d& q, const Branch& previous, int count,
                         MetricRow* rows) const {
  rows[0] = Query(q, previous);
  if (count == 1) return;
  std::array<Vector3d, kMaxMetricRows> taken;
  taken[0] = rows[0].gradient;
  bool has_more = features_ != nullptr && !rows[0].inside &&
                  rows[0].status != QueryStatus::kInvalid;
  for (int k = 1; k < count; ++k) {
    rows[k] = rows[0];
    FeatureSearch::Feature feature;
    has_more =
        has_more && features_->FindNext(q, taken.data(), k, kCosSeparation,
                                        reach_, &feature);
    rows[k].is_repeated = !has_more;
    if (!has_more) continue;
    rows[k].status = QueryStatus::kOk;
    rows[k].is_capped = false;
    rows[k].value = feature.distance;
    rows[k].gradient = feature.direction;
    rows[k].triangle = feature.triangle;
    taken[static_cast<std::size_t>(k)] = feature.direction;
  }
}

}  // namespace phongpd
