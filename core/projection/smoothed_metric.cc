// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/smoothed_metric.h"

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/projection/contact_surface.h"
#include "core/projection/smoothed_normal.h"

namespace phongpd {
namespace {

constexpr double kLeastLength = 1e-9;

}  // namespace

double SmoothedRadius(double smoothing_length, double diagonal) {
  if (!(smoothing_length >= kLeastLength && smoothing_length <= 1.0)) {
    throw InputError("smoothing_length: expected a share of D in [" +
                     FormatDouble(kLeastLength) +
                     ", 1] for a smoothed direction, found " +
                     FormatDouble(smoothing_length));
  }
  return 2.0 * smoothing_length * diagonal;
}

struct SmoothedMetric::Impl {
  Impl(const ContactSpace& space, double smoothing_length, SmoothedAt the_at)
      : surface(space),
        normals(space, SmoothedRadius(smoothing_length, space.length())),
        at(the_at) {}

  ContactSurface surface;
  SmoothedNormals normals;
  SmoothedAt at;
};

SmoothedMetric::SmoothedMetric(const ContactSpace& space,
                               double smoothing_length, SmoothedAt at)
    : impl_(std::make_unique<Impl>(space, smoothing_length, at)) {}
SmoothedMetric::~SmoothedMetric() = default;
SmoothedMetric::SmoothedMetric(SmoothedMetric&&) noexcept = default;
SmoothedMetric& SmoothedMetric::operator=(SmoothedMetric&&) noexcept = default;

PenetrationResult SmoothedMetric::Query(const Eigen::Vector3d& q_o,
                                        const Branch& /*previous*/) const {
  const Impl& impl = *impl_;
  if (!impl.surface.Accepts(q_o)) return {};
  PenetrationResult result = impl.surface.Answer(q_o, impl.surface.Locate(q_o));
  if (!result.inside) return result;
  const SmoothedNormal normal =
      impl.normals.At(impl.at == SmoothedAt::kContact ? result.contact : q_o);
  if (normal.HasDirection()) {
    result.direction = normal.Direction();
  } else {
    result.status = QueryStatus::kEuclideanFallback;
  }
  return result;
}

}  // namespace phongpd
