// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/timed_trajectory.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "constraints/curve_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
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

Json LimitsRow(const MotionLimits& limits) {
  return {{"velocity", PointRow(limits.velocity)},
          {"acceleration", PointRow(limits.acceleration)},
          {"jerk", PointRow(limits.jerk)}};
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

CurveOptions SceneCurveOptions(const Scene& scene, const World& world,
                               const MotionLimits& limits) {
  CurveOptions options;
  options.limits = limits;
  options.margin = world.Resolve(scene.trajectory.margin).unit;
  options.effort = EffortOf(scene.preset);
  return options;
}

TimedTrajectory PlanInTime(const Scene& scene, const World& world,
                           const CurveOptions& options) {
  RequireMotion({scene.start, scene.goal}, options);
  Scene planned = scene;
  planned.planning.model = scene.trajectory.model;
  planned.planning.clearance = scene.trajectory.margin;
  PlanningStudy study(planned, world);
  PlanningRun run;
  run.planner = kContactSurface;
  const PlanningResult plan = study.Run(run);
  TimedTrajectory timed;
  timed.planner = plan.planner;
  timed.model = plan.model;
  timed.status = plan.status;
  timed.reason = plan.reason;
  timed.plan_seconds = plan.numbers.seconds;
  if (plan.explored) timed.surface = plan.explored->surface;
  if (!plan.solved) return timed;
  timed.path = plan.numbers.path;
  FindCurve(plan.model == "window" ? *world.Convolution().free_space
                                   : *study.spaces().free_space,
            world.diagonal(), options, &timed);
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
  row["stops_duration"] = curve.stops_duration;
  row["length"] = curve.trajectory.ArcLength();
  row["limits"] = LimitsRow(options.limits);
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

std::string TimedCsv(const Trajectory& trajectory, double rate) {
  std::string text = "t,x,y,z,vx,vy,vz,ax,ay,az\n";
  if (trajectory.empty()) return text;
  if (trajectory.duration() * rate > kMostTimedRows) {
    throw InputError("--rate: expected at most " +
                     FormatDouble(kMostTimedRows) + " rows for the " +
                     Rounded(trajectory.duration()) +
                     " s of the motion, found " + FormatDouble(rate) + " Hz");
  }
  for (const Trajectory::Sample& sample : trajectory.Samples(rate)) {
    text += FormatDouble(sample.time) + ',' + FormatPoint(sample.position) +
            ',' + FormatPoint(sample.velocity) + ',' +
            FormatPoint(sample.acceleration) + '\n';
  }
  return text;
}

}  // namespace phongpd
