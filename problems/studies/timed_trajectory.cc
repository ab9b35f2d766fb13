// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/timed_trajectory.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "constraints/curve_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/world/bare_length.h"
#include "problems/studies/planning_study.h"
#include "problems/studies/row_parts.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// "a,b,,c" at the commas.
std::vector<std::string> CutAt(char separator, const std::string& text) {
  std::vector<std::string> cells(1);
  for (const char c : text) {
    if (c == separator) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

Vector3d ParseLimit(const std::string& text, const std::string& what) {
  std::vector<std::string> cells = CutAt('/', text);
  if (cells.size() == 1) cells.resize(3, cells.front());
  if (cells.size() != 3) {
    throw InputError(what +
                     ": expected one number, or three as x/y/z, found '" +
                     text + "'");
  }
  Vector3d limit;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& cell = cells[static_cast<std::size_t>(axis)];
    const std::string which = what + " of " + "xyz"[axis];
    limit[axis] = ParseDouble(cell, which);
    if (limit[axis] > 0.0) continue;
    throw InputError(which + ": expected a number above 0, found " + cell);
  }
  return limit;
}

// Of a place on the way.
std::string ViaName(std::size_t i) { return "via " + std::to_string(i); }

// What nothing needs to be built for.
void RequireMotion(const std::vector<Vector3d>& path,
                   const CurveOptions& options) {
  options.Validate();
  const bool moves =
      std::any_of(path.begin(), path.end(),
                  [&](const Vector3d& point) { return point != path.front(); });
  if (moves) return;
  throw InputError(
      "a motion in time: expected two different places at least, found " +
      (path.empty() ? std::string("none")
                    : "only (" + FormatPoint(path.front()) + ")"));
}

void FindCurve(const FreeSpace& space, double diagonal,
               const CurveOptions& options, TimedTrajectory* timed) {
  timed->curve = OptimizeCurve(space, diagonal, timed->path, options);
  timed->status = ToString(timed->curve.status);
  if (timed->curve.status == CurveStatus::kDurationTooShort) {
    timed->reason = "the fastest that was found takes " +
                    Rounded(timed->curve.duration, 6) + " s, not " +
                    Rounded(options.duration, 6);
  }
  const Trajectory& trajectory = timed->curve.trajectory;
  if (trajectory.empty()) return;
  timed->use = BoundLimitUse(trajectory, options.limits);
  timed->is_certified =
      CheckCurve(space, trajectory).IsFree() && timed->use.IsKept();
  if (timed->is_certified) return;
  timed->status = "not_certified";
  timed->reason = "the judge of curves does not confirm what was found";
}

// Where a path collides, and with what.
std::string Collision(const World& world, const std::vector<Vector3d>& path,
                      const PathCheck& check) {
  const auto i = static_cast<std::size_t>(check.segment);
  const double fraction = check.motion.fraction;
  const auto at = [&](double f) -> Vector3d {
    return path[i] + f * (path[i + 1] - path[i]);
  };
  std::string text = "the path first collides in segment " + std::to_string(i) +
                     " at fraction " + Rounded(fraction, 6);
  // There it only touches, up to rounding.
  Diagnosis diagnosis = world.Diagnose(at(fraction));
  if (diagnosis.IsFree()) {
    diagnosis = world.Diagnose(at(std::min(1.0, fraction + 1e-6)));
  }
  return text + ": " +
         (diagnosis.IsFree() ? "(" + FormatPoint(at(fraction)) + ")"
                             : diagnosis.Text("q"));
}

// The first of these places that is not free, or nothing.
std::string BlockedVia(const World& world, const std::vector<CurveVia>& via) {
  for (std::size_t i = 0; i < via.size(); ++i) {
    const Diagnosis diagnosis = world.Diagnose(via[i].point);
    if (!diagnosis.IsFree()) return diagnosis.Text(ViaName(i));
  }
  return "";
}

// "from the start to via 0"
std::string LegName(std::size_t leg, std::size_t legs) {
  return "from " + (leg == 0 ? "the start" : ViaName(leg - 1)) + " to " +
         (leg + 1 == legs ? "the goal" : ViaName(leg));
}

// The paths of contact-surface from place to place as one; false, and why,
// where one is missing.
bool FindPath(const Scene& scene, const World& world,
              const std::vector<Vector3d>& places, TimedTrajectory* timed) {
  Scene planned = scene;
  planned.planning.model = scene.trajectory.model;
  planned.planning.clearance = scene.trajectory.margin;
  PlanningRun run;
  run.planner = kContactSurface;
  const std::size_t legs = places.size() - 1;
  timed->path = {places.front()};
  for (std::size_t i = 0; i < legs; ++i) {
    planned.start = places[i];
    planned.goal = places[i + 1];
    if (planned.start == planned.goal) continue;
    PlanningStudy study(planned, world);
    const PlanningResult plan = study.Run(run);
    timed->planner = plan.planner;
    timed->model = plan.model;
    timed->plan_seconds += plan.numbers.seconds;
    if (plan.solved) {
      timed->path.insert(timed->path.end(), plan.numbers.path.begin() + 1,
                         plan.numbers.path.end());
      continue;
    }
    timed->path.clear();
    timed->status = plan.status;
    timed->reason = plan.reason;
    if (plan.infeasible_proved && legs > 1) {
      timed->status = ToString(PlanStatus::kFailed);
      timed->reason = LegName(i, legs) +
                      ": no path, proved for these places, not for places "
                      "near them";
    } else if (plan.infeasible_proved && plan.explored) {
      timed->surface = plan.explored->surface;
    }
    return false;
  }
  return true;
}

Json LimitsRow(const MotionLimits& limits) {
  return {{"velocity", PointRow(limits.velocity)},
          {"acceleration", PointRow(limits.acceleration)},
          {"jerk", PointRow(limits.jerk)}};
}

Json ViaRow(const World& world, const std::vector<CurveVia>& places) {
  Json row = Json::array();
  for (const CurveVia& via : places) {
    const Length tolerance = Length::FromUnit(via.tolerance);
    row.push_back({{"point", PointRow(via.point)},
                   {"tolerance", LengthRow(world.Resolve(tolerance))},
                   {"dwell", via.dwell}});
  }
  return row;
}

Json PiecesRow(const Trajectory& trajectory) {
  Json pieces = Json::array();
  for (const CurvePiece& piece : trajectory.pieces()) {
    Json points = Json::array();
    for (int i = 0; i <= piece.degree(); ++i) {
      points.push_back(PointRow(piece.point(i)));
    }
    pieces.push_back({{"duration", piece.duration()}, {"points", points}});
  }
  return pieces;
}

CurveEffort EffortOf(Preset preset) {
  switch (preset) {
    case Preset::kFast:
      return CurveEffort::kFast;
    case Preset::kBalanced:
      return CurveEffort::kBalanced;
    case Preset::kTight:
      break;
  }
  return CurveEffort::kTight;
}

}  // namespace

MotionLimits ParseLimits(const std::string& text, const std::string& what) {
  const std::vector<std::string> cells = CutAt(',', text);
  if (cells.size() != 3) {
    throw InputError(what +
                     ": expected V,A,J, limits of velocity, acceleration and "
                     "jerk, each a number or x/y/z, found '" +
                     text + "'");
  }
  MotionLimits limits;
  limits.velocity = ParseLimit(cells[0], what + ": velocity");
  limits.acceleration = ParseLimit(cells[1], what + ": acceleration");
  limits.jerk = ParseLimit(cells[2], what + ": jerk");
  return limits;
}

SceneVia ParseVia(const std::string& text, const std::string& what,
                  double diagonal, const std::string& unit) {
  const std::vector<std::string> cells = CutAt(',', text);
  if (cells.size() < 3 || cells.size() > 5) {
    throw InputError(what +
                     ": expected X,Y,Z[,LENGTH[,DWELL]], a place, how close to "
                     "come and seconds to rest there, found '" +
                     text + "'");
  }
  SceneVia via;
  for (int axis = 0; axis < 3; ++axis) {
    via.point[axis] = ParseDouble(cells[static_cast<std::size_t>(axis)],
                                  what + ": " + "xyz"[axis]);
  }
  if (cells.size() > 3) {
    via.tolerance = ParseClearance(cells[3], what + ": LENGTH", diagonal, unit);
  }
  if (cells.size() > 4) via.dwell = ParseDouble(cells[4], what + ": DWELL");
  return via;
}

CurveOptions SceneCurveOptions(const Scene& scene, const World& world,
                               const MotionLimits& limits) {
  CurveOptions options;
  options.limits = limits;
  options.margin = world.Resolve(scene.trajectory.margin).unit;
  options.effort = EffortOf(scene.preset);
  options.duration = scene.duration;
  for (const SceneVia& via : scene.via) {
    options.via.push_back(
        {via.point, world.Resolve(via.tolerance).unit, via.dwell});
  }
  return options;
}

TimedTrajectory PlanInTime(const Scene& scene, const World& world,
                           const CurveOptions& options) {
  std::vector<Vector3d> places = {scene.start};
  for (const CurveVia& via : options.via) places.push_back(via.point);
  places.push_back(scene.goal);
  RequireMotion(places, options);
  // Said by the planner before it builds anything.
  if (scene.start != scene.goal && !world.Diagnose(scene.goal).IsFree()) {
    places = {scene.start, scene.goal};
  }
  TimedTrajectory timed;
  timed.reason = BlockedVia(world, options.via);
  if (!timed.reason.empty()) {
    timed.status = "via_not_free";
  } else if (FindPath(scene, world, places, &timed)) {
    FindCurve(timed.model == "window"
                  ? *world.Convolution().free_space
                  : *world.Spaces(SpaceLayout::kSealed).free_space,
              world.diagonal(), options, &timed);
  }
  return timed;
}

TimedTrajectory TimePath(const World& world, const std::vector<Vector3d>& path,
                         const CurveOptions& options) {
  RequireMotion(path, options);
  const FreeSpace& space = *world.Convolution().free_space;
  TimedTrajectory timed;
  timed.model = "window";
  timed.path = path;
  const PathCheck check = CheckPath(space, path);
  if (!check.free) {
    timed.status = ToString(CurveStatus::kNotFree);
    timed.reason = Collision(world, path, check);
    return timed;
  }
  FindCurve(space, world.diagonal(), options, &timed);
  return timed;
}

Json TimedRow(const Scene& scene, const World& world,
              const CurveOptions& options, const TimedTrajectory& timed) {
  const CurveSummary& curve = timed.curve;
  const auto length = [&](double unit) {
    return LengthRow(world.Resolve(Length::FromUnit(unit)));
  };
  Json row;
  row["scene"] = scene.name;
  row["planner"] = timed.planner.empty() ? Json(nullptr) : Json(timed.planner);
  row["model"] = timed.model;
  row["preset"] = ToString(scene.preset);
  row["status"] = timed.status;
  row["reason"] = timed.reason;
  row["solved"] = timed.is_certified;
  row["certified"] = timed.is_certified;
  row["collision_free"] = timed.is_certified;
  row["duration"] = curve.trajectory.duration();
  row["asked_duration"] =
      options.duration > 0.0 ? Json(options.duration) : Json(nullptr);
  row["stops_duration"] = curve.stops_duration;
  row["length"] = curve.trajectory.ArcLength();
  row["limits"] = LimitsRow(options.limits);
  row["via"] = ViaRow(world, options.via);
  row["limits_used"] = {{"velocity", timed.use.velocity},
                        {"acceleration", timed.use.acceleration},
                        {"jerk", timed.use.jerk}};
  row["clearance"] = curve.clearance;
  row["lengths"] = {{"unit", UnitRow(scene.unit)},
                    {"D", world.diagonal()},
                    {"margin", length(options.margin)},
                    {"kept_margin", length(curve.margin)},
                    {"clearance", length(curve.clearance)}};
  row["rounds"] = curve.rounds.size();
  row["seconds"] = {{"contact_space", world.Report().seconds},
                    {"plan", timed.plan_seconds},
                    {"first", curve.first_seconds},
                    {"curve", curve.seconds}};
  row["path"] = Json::array();
  for (const Vector3d& p : timed.path) row["path"].push_back(PointRow(p));
  row["pieces"] = PiecesRow(curve.trajectory);
  row["versions"] = VersionsRow();
  return row;
}

}  // namespace phongpd
