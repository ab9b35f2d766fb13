// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/euclidean_metric.h"

#include "core/projection/contact_surface.h"

namespace phongpd {

struct EuclideanMetric::Impl {
  explicit Impl(const ContactSpace& space) : surface(space) {}

  ContactSurface surface;
};

EuclideanMetric::EuclideanMetric(const ContactSpace& space)
    : impl_(std::make_unique<Impl>(space)) {}
EuclideanMetric::~EuclideanMetric() = default;
EuclideanMetric::EuclideanMetric(EuclideanMetric&&) noexcept = default;
EuclideanMetric& EuclideanMetric::operator=(EuclideanMetric&&) noexcept =
    default;

PenetrationResult EuclideanMetric::Query(const Eigen::Vector3d& q_o,
                                         const Branch& /*previous*/) const {
  const ContactSurface& surface = impl_->surface;
  if (!surface.Accepts(q_o)) return {};
  return surface.Answer(q_o, surface.Locate(q_o));
}

}  // namespace phongpd
