// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/depth.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/window_phong.h"

namespace phongpd {

Depth PenetrationResult::ToDepth() const {
  Depth out;
  if (status == QueryStatus::kInvalid) {
    out.status = DepthStatus::kInvalid;
    return out;
  }
  out.status = inside                  ? DepthStatus::kPenetrating
               : signed_distance > 0.0 ? DepthStatus::kSeparate
                                       : DepthStatus::kTouching;
  out.depth = inside ? -signed_distance : 0.0;
  out.clearance = inside ? 0.0 : signed_distance;
  out.direction = direction;
  out.contact = contact;
  out.certified = !inside;
  out.explored_radius = out.clearance;
  out.level = DepthLevel::kFull;
  return out;
}

Depth WindowResult::ToDepth() const {
  Depth out = answer.ToDepth();
  out.level = level;
  out.windows = windows;
  out.arranged_faces = arranged_faces;
  return out;
}

Depth TrackerResult::ToDepth() const {
  Depth out;
  if (status == QueryStatus::kInvalid) {
    out.status = DepthStatus::kInvalid;
    return out;
  }
  out.status = inside     ? DepthStatus::kPenetrating
               : touching ? DepthStatus::kTouching
                          : DepthStatus::kSeparate;
  out.depth = magnitude;
  if (magnitude > 0.0) out.direction = pd / magnitude;
  out.contact = contact;
  out.certified = touching;
  out.explored_radius = euclidean_depth;
  out.level = DepthLevel::kFull;
  return out;
}

}  // namespace phongpd
