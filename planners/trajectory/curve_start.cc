// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_start.h"

#include <algorithm>
#include <cstddef>

#include "planners/trajectory/curve_ends.h"

namespace phongpd::internal {
namespace {

using Path = std::vector<Eigen::Vector3d>;

constexpr int kPieces = 3;  // of a segment of the path

// The path from place to place.
std::vector<Path> LegsOf(const Path& path, const CurveOptions& options) {
  std::vector<Path> legs;
  auto from = path.begin();
  for (const CurveVia& via : options.via) {
    const auto to = std::find(from, path.end(), via.point);
    legs.emplace_back(from, to + 1);
    from = to;
  }
  legs.emplace_back(from, path.end());
  return legs;
}

// Stops at the corners of all legs, and the knots at which they meet.
KnotCurve StopOnLegs(const FreeSpace& space, const std::vector<Path>& legs,
                     int first_knot, const CurveOptions& options,
                     std::vector<ViaKnot>* knots) {
  KnotCurve all;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    auto corners = DropCorners(space, legs[i], options.margin);
    if (corners.size() < 2) corners = legs[i];
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() > 1) {
      all = Joined(all, StopAtCorners(corners, options.limits, kPieces));
    }
    if (i < options.via.size()) {
      const CurveVia& via = options.via[i];
      knots->push_back({first_knot + all.pieces(), via.point, via.tolerance});
    }
  }
  return all;
}

// Without those that are an end of the curve: they stay where they are.
std::vector<ViaKnot> InnerKnots(std::vector<ViaKnot> via, int first_knot,
                                int pieces) {
  for (ViaKnot& one : via) one.knot -= first_knot;
  via.erase(std::remove_if(via.begin(), via.end(),
                           [&](const ViaKnot& one) {
                             return one.knot == 0 || one.knot == pieces;
                           }),
            via.end());
  return via;
}

}  // namespace

KnotCurve CurveStart::With(const KnotCurve& middle) const {
  return Joined(Joined(stop, middle), run_up);
}

std::vector<ViaKnot> CurveStart::ViaOfStops() const {
  return InnerKnots(via, stop.pieces(), stops.pieces());
}

CurveStart FindCurveStart(const FreeSpace& space, double diagonal,
                          const std::vector<Eigen::Vector3d>& path,
                          const CurveOptions& options) {
  const KnotCurve::State first = {path.front(), options.start.velocity,
                                  options.start.acceleration};
  const KnotCurve::State last = {path.back(), -options.end.velocity,
                                 options.end.acceleration};
  std::vector<Path> legs = LegsOf(path, options);
  const Stop begin =
      FindStop(space, diagonal, first, legs.front(), options.limits, false);
  legs.front() = begin.path;
  std::reverse(legs.back().begin(), legs.back().end());
  const Stop end =
      FindStop(space, diagonal, last, legs.back(), options.limits, true);
  legs.back() = end.path;
  std::reverse(legs.back().begin(), legs.back().end());

  CurveStart start;
  start.stop = begin.curve;
  start.run_up = Backwards(end.curve);
  std::vector<ViaKnot> via;
  start.stops = StopOnLegs(space, legs, begin.curve.pieces(), options, &via);
  start.via = InnerKnots(via, 0, start.With(start.stops).pieces());
  return start;
}

}  // namespace phongpd::internal
