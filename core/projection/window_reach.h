// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"
#include "core/contact/explored_boxes.h"
#include "core/mesh/finite.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/window_phong.h"

// What metrics by windows (window_phong.h, window_smoothed.h) have in common.
namespace phongpd::internal {

// Facets of the convolution that meet a box, about.
inline constexpr std::size_t kWindowFacets = 200;
// The same where only the nearest triangle is asked for: smaller boxes hold
// less that is farther.  Chosen on meshes that no table of results/ has.
inline constexpr std::size_t kNearestFacets = 60;
// Half-width of the first window, a share of the longest side of all sums, and
// of each further one to the one before.
inline constexpr double kFirstReach = 1.0 / 64, kMoreReach = 2.0;
// What rounding may make of the two lengths that are compared.
inline constexpr double kCertainShare = 1.0 - 1e-9;

// The contact space in these boxes, behind walls but where they are all.
inline ContactSpace ExploreWindow(const std::vector<int>& part, bool is_all,
                                  ExploredBoxes* boxes) {
  for (const int box : part) boxes->Explore(box);
  ContactSpace::Parts parts =
      boxes->Surface(part, [](int, int) { return true; });
  if (is_all) DropWalls(&parts);
  return ContactSpace(std::move(parts), "window of the contact space");
}

// The answer of all of them in free space, where every metric is the distance.
inline PenetrationResult AnswerOutside(const ConvolutionModel& model,
                                       const Eigen::Vector3d& q) {
  const ConvolutionModel::Nearest nearest = model.FindNearest(q);
  PenetrationResult answer;
  answer.status = QueryStatus::kOk;
  answer.signed_distance = nearest.distance;
  answer.contact = nearest.point;
  answer.direction = answer.gradient = (q - nearest.point).normalized();
  return answer;
}

// Their answer at q: outside, or what inside(&result) finds, which writes what
// it built into the result.
template <typename Inside>
WindowResult AnswerAt(const ConvolutionModel& model, const Eigen::Vector3d& q,
                      const Inside& inside) {
  WindowResult out;
  if (!IsFinite(q)) return out;
  if (model.IsFree(q)) {
    out.answer = AnswerOutside(model, q);
    return out;
  }
  out.answer = inside(&out);
  out.answer.triangle = -1;
  out.answer.branch = {};
  return out;
}

}  // namespace phongpd::internal
