// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/window_metric.h"

#include <cmath>
#include <mutex>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/projection/explored_surface.h"
#include "core/projection/window_reach.h"

namespace phongpd {

struct WindowMetric::Impl {
  Impl(const ConvolutionModel& the_model, double radius, SmoothedAt the_at)
      : model(the_model),
        is_smoothed(radius > 0.0),
        at(the_at),
        surface(model, radius) {}

  PenetrationResult Inside(const Eigen::Vector3d& q_o) {
    const NearestContact nearest = surface.FindNearest(q_o);
    PenetrationResult result = EuclideanAnswer(
        nearest, q_o,
        nearest.distance > 0.0 ? Location::kInside : Location::kOnSurface,
        surface.scale());
    if (!result.inside) return result;
    ++inside;
    if (!is_smoothed) return result;
    const SmoothedNormal normal =
        surface.Sum(at == SmoothedAt::kContact ? result.contact : q_o);
    if (normal.HasDirection()) {
      result.direction = normal.Direction();
    } else {
      result.status = QueryStatus::kEuclideanFallback;
    }
    return result;
  }

  std::mutex mutex;
  ConvolutionModel model;
  bool is_smoothed;
  SmoothedAt at;
  internal::ExploredSurface surface;
  std::size_t inside = 0;
};

namespace {

double RadiusOf(double smoothing_length, double diagonal) {
  if (!(diagonal > 0.0 && std::isfinite(diagonal))) {
    throw InputError(
        "window metric: diagonal: expected finite and > 0, found " +
        FormatDouble(diagonal));
  }
  return SmoothedRadius(smoothing_length, diagonal);
}

}  // namespace

WindowMetric::WindowMetric(const ConvolutionModel& model)
    : impl_(std::make_unique<Impl>(model, 0.0, SmoothedAt::kPosition)) {}
WindowMetric::WindowMetric(const ConvolutionModel& model,
                           double smoothing_length, double diagonal,
                           SmoothedAt at)
    : impl_(std::make_unique<Impl>(model, RadiusOf(smoothing_length, diagonal),
                                   at)) {}
WindowMetric::~WindowMetric() = default;
WindowMetric::WindowMetric(WindowMetric&&) noexcept = default;
WindowMetric& WindowMetric::operator=(WindowMetric&&) noexcept = default;

PenetrationResult WindowMetric::Query(const Eigen::Vector3d& q_o,
                                      const Branch& /*previous*/) const {
  if (!IsFinite(q_o)) return {};
  Impl& impl = *impl_;
  const std::lock_guard<std::mutex> lock(impl.mutex);
  return impl.model.IsFree(q_o) ? internal::AnswerOutside(impl.model, q_o)
                                : impl.Inside(q_o);
}

WindowUse WindowMetric::Use() const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  WindowUse use = impl_->surface.use();
  use.inside = impl_->inside;
  return use;
}

}  // namespace phongpd
