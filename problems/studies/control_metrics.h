// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/contact/contact_space.h"
#include "core/projection/penetration_metric.h"

// Controls of the study of directions (results/study/protocol.md): Euclid's
// depth and contact, bit for bit, with another direction inside C_obj, which is
// the `gradient`, too.  Outside they are EuclideanMetric.
namespace phongpd {

// The vertex normals of a Phong field of that ℓ, a share of D in (0, 1],
// interpolated at Euclid's contact: the direction of PhongPD without its
// projection.  Where a contact space has no such normal it is Euclid's own.
std::shared_ptr<const PenetrationMetric> MakeDiffusedMetric(
    const ContactSpace& space, double smoothing_length);

// A direction as far from Euclid's, by its angle, as that of SmoothedMetric
// with that ℓ, but to a side that q alone decides, as if by lot (64 bits of its
// coordinates, mixed): what a solver gains by it, it gains from any direction
// that is not Euclid's.
std::shared_ptr<const PenetrationMetric> MakePlaceboMetric(
    const ContactSpace& space, double smoothing_length);

}  // namespace phongpd
