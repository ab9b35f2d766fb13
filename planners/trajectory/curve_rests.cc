// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_rests.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/stopwatch.h"

namespace phongpd::internal {

using Eigen::Vector3d;

namespace {

// There is no way between a start and a rest there, or two rests at one place.
bool IsOnePlace(const std::vector<Vector3d>& way, const CurveOptions& part) {
  return part.start.IsAtRest() && part.end.IsAtRest() &&
         std::all_of(way.begin(), way.end(),
                     [&](const Vector3d& q) { return q == way.front(); });
}

// `before`: seconds until it was begun.
void Append(const CurveSummary& one, double before, CurveSummary* all,
            std::vector<CurvePiece>* pieces) {
  const auto& found = one.trajectory.pieces();
  pieces->insert(pieces->end(), found.begin(), found.end());
  if (all->status == PathStatus::kConverged) all->status = one.status;
  all->rounds.insert(all->rounds.end(), one.rounds.begin(), one.rounds.end());
  all->stops_duration += one.stops_duration;
  all->cost += one.cost;
  all->clearance = std::min(all->clearance, one.clearance);
  all->margin = std::min(all->margin, one.margin);
  all->first_seconds = before + one.first_seconds;
}

}  // namespace

bool HasRests(const CurveOptions& options) {
  return std::any_of(options.via.begin(), options.via.end(),
                     [](const CurveVia& via) { return via.dwell > 0.0; });
}

CurveSummary OptimizeWithRests(const FreeSpace& space, double diagonal,
                               const std::vector<Vector3d>& path,
                               const CurveOptions& options) {
  const Stopwatch stopwatch;
  CurveSummary all;
  all.status = PathStatus::kConverged;
  all.clearance = std::numeric_limits<double>::infinity();
  all.margin = options.margin;
  std::vector<CurvePiece> pieces;
  CurveOptions part = options;
  part.via.clear();
  auto from = path.begin(), at = from;
  for (std::size_t i = 0; i <= options.via.size(); ++i) {
    const bool is_last = i == options.via.size();
    if (!is_last) {
      at = std::find(at, path.end(), options.via[i].point);
      if (!(options.via[i].dwell > 0.0)) {
        part.via.push_back(options.via[i]);
        continue;
      }
    }
    const std::vector<Vector3d> way(from, is_last ? path.end() : at + 1);
    part.end = is_last ? options.end : CurveEnd{};
    part.time_limit = std::max(options.time_limit - stopwatch.Seconds(),
                               std::numeric_limits<double>::min());
    if (!IsOnePlace(way, part)) {
      const double before = stopwatch.Seconds();
      const CurveSummary one = OptimizeCurve(space, diagonal, way, part);
      if (one.trajectory.empty()) return one;
      Append(one, before, &all, &pieces);
    }
    if (is_last) break;
    const CurveVia& via = options.via[i];
    pieces.emplace_back(std::vector<Vector3d>(6, via.point), via.dwell);
    all.stops_duration += via.dwell;
    all.cost += via.dwell;
    from = at;
    part.start = {};
    part.via.clear();
  }
  all.trajectory = Trajectory(std::move(pieces));
  all.duration = all.trajectory.duration();
  all.seconds = stopwatch.Seconds();
  return all;
}

}  // namespace phongpd::internal
