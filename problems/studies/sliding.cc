// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/sliding.h"

namespace phongpd {

using Eigen::Vector3d;

SlidingQuery::SlidingQuery(const ContactSpace& space,
                           const PenetrationTrackerOptions& options)
    : space_(space), euclidean_(space), tracker_(space, options) {}

SlidingAnswer SlidingQuery::Next(const Vector3d& q) {
  const TrackerResult found = tracker_.Step(q, &state_);
  SlidingAnswer answer;
  answer.status = found.status;
  PenetrationResult& result = answer.result;
  if (!found.inside) {
    result = euclidean_.Query(q);
    return answer;
  }
  result.status = QueryStatus::kOk;
  result.inside = true;
  result.signed_distance = -found.magnitude;
  result.contact = found.contact;
  result.triangle = found.triangle;
  if (found.magnitude > 0.0) {
    result.direction = found.pd.stableNormalized();
  } else {
    // No depth that doubles can tell; its sign stays that of the inside.
    result.signed_distance = -found.euclidean_depth;
    result.direction =
        space_.normals()[static_cast<std::size_t>(found.triangle)];
  }
  result.gradient = result.direction;
  return answer;
}

MotionTrace TraceSliding(const ContactSpace& space,
                         const PenetrationTrackerOptions& options,
                         const StraightMotion& motion) {
  MotionTrace trace;
  trace.metric = "sliding";
  trace.label = "sliding contact";
  trace.is_sliding = true;
  SlidingQuery query(space, options);
  for (int frame = 0; frame < motion.frames; ++frame) {
    const Vector3d q = motion.At(frame);
    const SlidingAnswer answer = query.Next(q);
    trace.results.push_back(answer.result);
    trace.status.push_back(answer.status);
    trace.pd.push_back(answer.result.PenetrationVector(q));
  }
  return trace;
}

}  // namespace phongpd
