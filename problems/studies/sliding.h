// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "problems/studies/motion.h"

// The tracker among the metrics: its answers in their words.
namespace phongpd {

struct SlidingAnswer {
  QueryStatus status = QueryStatus::kInvalid;
  // Inside: contact p, signed_distance −|p − q|, direction (p − q)/|p − q|
  // (the facet's normal where q and p are one point), and as gradient the same:
  // that of signed_distance with p held where it is, for p itself depends on
  // the way that was taken.  Outside: the answer of EuclideanMetric.  No
  // branch.
  PenetrationResult result;
};

// One motion over one contact space, position after position.
class SlidingQuery {
 public:
  // Throws InputError for options.
  explicit SlidingQuery(const ContactSpace& space,
                        const PenetrationTrackerOptions& options = {});

  SlidingAnswer Next(const Eigen::Vector3d& q);

 private:
  ContactSpace space_;
  EuclideanMetric euclidean_;
  PenetrationTracker tracker_;
  PenetrationTracker::State state_;
};

// The tracker along a straight motion, as metric "sliding".
MotionTrace TraceSliding(const ContactSpace& space,
                         const PenetrationTrackerOptions& options,
                         const StraightMotion& motion);

}  // namespace phongpd
