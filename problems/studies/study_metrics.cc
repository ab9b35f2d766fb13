// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/study_metrics.h"

#include <utility>

#include "core/projection/euclidean_metric.h"
#include "problems/studies/control_metrics.h"
#include "problems/studies/followed_metric.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Euclid's value, another direction.
class DirectedMetric final : public PenetrationMetric {
 public:
  DirectedMetric(const ContactSpace& space, const PhongMetricOptions& options,
                 bool fades)
      : space_(space),
        euclidean_(space),
        phong_(space, options),
        fades_(fades),
        ell_(options.field_options.smoothing_length * space.length()) {}

  using PenetrationMetric::Query;
  PenetrationResult Query(const Vector3d& q,
                          const Branch& previous) const override {
    PenetrationResult result = phong_.Query(q, previous);
    if (!result.inside) return result;
    const PenetrationResult nearest = euclidean_.Query(q);
    result.signed_distance = nearest.signed_distance;
    result.contact = nearest.contact;
    result.triangle = nearest.triangle;
    if (!fades_) return result;
    const double w = Weight(nearest);
    const Vector3d blend = w * result.direction + (1.0 - w) * nearest.direction;
    const double length = blend.norm();
    // Opposite directions leave nothing to normalise.
    constexpr double kVanishing = 1e-6;
    result.direction =
        length > kVanishing ? Vector3d(blend / length) : nearest.direction;
    result.gradient = result.direction;
    return result;
  }

 private:
  // In [0, 1]: the free way beyond the contact, in multiples of ℓ.
  double Weight(const PenetrationResult& nearest) const {
    if (!(ell_ > 0.0)) return 1.0;
    // The triangles at the contact itself are no wall.
    constexpr double kOwn = 1e-9;
    const TriangleBvh::Hit hit = space_.bvh().FirstHitBeyond(
        nearest.contact, nearest.contact + ell_ * nearest.direction,
        kOwn * space_.length());
    return hit.Found() ? hit.fraction : 1.0;
  }

  ContactSpace space_;
  EuclideanMetric euclidean_;
  PhongMetric phong_;
  bool fades_;
  double ell_;  // user's unit
};

bool TakePrefix(const std::string& prefix, std::string* text) {
  if (text->compare(0, prefix.size(), prefix) != 0) return false;
  text->erase(0, prefix.size());
  return true;
}

}  // namespace

std::shared_ptr<const PenetrationMetric> MakeFollowedMetric(
    const ContactSpace& space) {
  return std::make_shared<FollowedMetric>(space);
}

std::shared_ptr<const PenetrationMetric> MakeMixedMetric(
    const ContactSpace& space, const PhongMetricOptions& options) {
  return std::make_shared<DirectedMetric>(space, options, false);
}

std::shared_ptr<const PenetrationMetric> MakeFadedMetric(
    const ContactSpace& space, const PhongMetricOptions& options) {
  return std::make_shared<DirectedMetric>(space, options, true);
}

StudyMetric ParseStudyMetric(const std::string& text, const std::string& what) {
  StudyMetric metric;
  if (text == "followed") {
    metric.penetration.metric = MetricKind::kEuclidean;
    metric.own = OwnMetric{
        text, text, [](const ContactSpace& space, const PhongMetricOptions&) {
          return MakeFollowedMetric(space);
        }};
    return metric;
  }
  std::string rest = text;
  // Controls, of which the options' ℓ is all that they take.
  const bool is_placebo = TakePrefix("placebo@", &rest);
  if (is_placebo || TakePrefix("diffused@", &rest)) {
    metric.penetration = ParsePenetration("phong@" + rest, what);
    const auto make = is_placebo ? MakePlaceboMetric : MakeDiffusedMetric;
    metric.own = OwnMetric{
        is_placebo ? "placebo" : "diffused", text,
        [make](const ContactSpace& space, const PhongMetricOptions& options) {
          return make(space, options.field_options.smoothing_length);
        }};
    return metric;
  }
  const bool is_mixed = TakePrefix("mixed@", &rest);
  if (!is_mixed && !TakePrefix("faded@", &rest)) {
    metric.penetration = ParsePenetration(text, what);
    return metric;
  }
  metric.penetration = ParsePenetration("phong@" + rest, what);
  metric.own = OwnMetric{is_mixed ? "mixed" : "faded", text,
                         is_mixed ? MakeMixedMetric : MakeFadedMetric};
  return metric;
}

}  // namespace phongpd
