// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "constraints/moving_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"
#include "planners/exact/contact_roadmap.h"
#include "planners/retraction/retraction_names.h"
#include "problems/scenes/scene_source.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/curve_arrays.h"
#include "python/src/interruptible.h"
#include "python/src/json_objects.h"
#include "python/src/words.h"
#include "python/src/workshop.h"

namespace phongpd::python {
namespace {

using Eigen::Vector3d;

Scene MakeScene(const Solid& robot,
                const std::vector<std::pair<std::string, Solid>>& obstacles,
                const std::optional<std::pair<Point, Point>>& bounds,
                const std::string& name, const std::string& unit) {
  if (!unit.empty() && UnitNamedIn(unit) != unit) {
    throw InputError("unit: expected one of " + Joined(UnitNames()) +
                     " or \"\", found '" + unit + "'" +
                     DidYouMean(unit, UnitNames()));
  }
  Scene scene;
  scene.name = name;
  scene.workspace.unit = unit;
  scene.workspace.robot = robot;
  for (const auto& [id, solid] : obstacles) {
    scene.workspace.obstacles.push_back(solid.Named(id));
  }
  if (bounds) {
    scene.workspace.bounds = {ToVector(bounds->first),
                              ToVector(bounds->second)};
  }
  return scene;
}

nb::dict DiagnosisOf(const Workshop& workshop, const Point& q) {
  const Diagnosis found = [&] {
    const Computing computing;
    return workshop.world().Diagnose(ToVector(q));
  }();
  nb::list contacts, excesses;
  for (const Diagnosis::Contact& contact : found.contacts) {
    nb::dict one;
    one["obstacle"] = contact.name;
    one["depth_at_most"] = contact.depth_at_most;
    one["direction"] = ToArray(contact.direction);
    contacts.append(one);
  }
  for (const Diagnosis::Excess& excess : found.excesses) {
    nb::dict one;
    one["axis"] = excess.axis;
    one["is_maximum"] = excess.is_maximum;
    one["bound"] = excess.bound;
    one["by"] = excess.by;
    excesses.append(one);
  }
  nb::dict out;
  out["free"] = found.IsFree();
  out["contacts"] = contacts;
  out["excesses"] = excesses;
  return out;
}

nb::object AreFree(const Workshop& workshop, const Rows3& a, const Rows3& b) {
  std::vector<unsigned char> free(a.shape(0));
  const FreeSpace& space = *workshop.Spaces().free_space;
  {
    const Computing computing;
    for (size_t i = 0; i < free.size(); ++i) {
      free[i] = space.IsFree(Row(a, i), Row(b, i));
    }
  }
  const size_t count = free.size();
  return Owned(std::move(free), {count});
}

nb::object Clearances(const Workshop& workshop, const Rows3& points) {
  std::vector<double> clearance(points.shape(0));
  const FreeSpace& space = *workshop.Spaces().free_space;
  {
    const Computing computing;
    for (size_t i = 0; i < clearance.size(); ++i) {
      clearance[i] = space.Clearance(Row(points, i));
    }
  }
  const size_t count = clearance.size();
  return Owned(std::move(clearance), {count});
}

// Among the scene's moving obstacles if none are given.
nb::tuple CheckCurveIn(const Workshop& workshop, const Seconds& durations,
                       const Rows3& points, double blur,
                       const std::optional<std::array<Point, 3>>& limits,
                       bool by_norm, const std::vector<Moving>& given) {
  double moved = 0.0, others_moved = 0.0;
  const Trajectory curve = JoinedCurve(durations, points, &moved);
  std::vector<MovingObstacle> moving = MovingObstaclesOf(given, &others_moved);
  if (given.empty()) moving = workshop.scene().moving;
  nb::dict used;
  if (limits) {
    MotionLimits of;
    of.velocity = ToVector((*limits)[0]);
    of.acceleration = ToVector((*limits)[1]);
    of.jerk = ToVector((*limits)[2]);
    of.by_norm = by_norm;
    of.Validate();
    const LimitUse use = BoundLimitUse(curve, of);
    used["velocity"] = use.velocity;
    used["acceleration"] = use.acceleration;
    used["jerk"] = use.jerk;
  }
  const FreeSpace& space = *workshop.Spaces().free_space;
  const MovingCheck check = [&] {
    const Computing computing;
    return CheckCurveAmong(space, MovingBodies(workshop.world(), moving), curve,
                           blur + moved + others_moved);
  }();
  const bool is_free = check.IsFree();
  const int last = static_cast<int>(curve.pieces().size()) - 1;
  const int piece = static_cast<int>(curve.PiecesBefore(check.time));
  return nb::make_tuple(
      ToString(check.verdict), check.free_until, is_free ? 0.0 : check.time,
      is_free ? -1 : std::min(piece, last), ToArray(check.configuration), used,
      nb::make_tuple(curve.JointGap(1), curve.JointGap(2)), check.tests,
      is_free || check.body == MovingCheck::kFixed
          ? std::string()
          : moving[check.body].solid.name());
}

// Empty texts and 0: the scene's own.
AnswerAndRow OptimizeWith(Workshop& workshop, const Point& start,
                          const Point& goal, const std::string& metric,
                          const std::string& margin, int waypoints,
                          std::uint64_t seed, double max_seconds,
                          bool is_straight, const std::string& preset,
                          const std::string& model, bool is_required,
                          int routes, double budget) {
  OptimizeRequest request = workshop.OptimizeBetween(start, goal);
  if (budget > 0.0) {
    ApplyBudget(budget, workshop.scene().workspace, &request);
  }
  if (!preset.empty()) ApplyPreset(ParsePreset(preset, "preset"), &request);
  if (!margin.empty()) request.margin = workshop.Clearance(margin, "margin");
  if (waypoints > 0) request.waypoints = waypoints;
  // Whoever names a metric is told that it cannot be followed.
  if (!model.empty()) {
    request.model = ParseModel(model, "model");
  } else if (request.model == Model::kAuto) {
    request.model = Model::kFull;
  }
  if (!metric.empty()) {
    if (metric == ToString(MetricKind::kPhong)) {
      // By the smoothing length that holds, as the flag of this value does.
      request.penetration.metric = MetricKind::kPhong;
    } else {
      request.penetration = ParsePenetration(metric, "metric");
    }
    if (request.model == Model::kWindow &&
        request.penetration.metric == MetricKind::kPhong) {
      throw InputError(
          "metric: expected euclidean or smoothed with model window, which "
          "follows no other, found " +
          metric);
    }
  }
  request.requires_margin = is_required;
  if (routes > 0) request.options.routes = routes;
  request.options.seed = seed;
  request.options.time_limit = max_seconds;
  if (is_straight) request.options.start = TrajectoryStart::kStraight;
  return workshop.Optimize(request);
}

AnswerAndRow PlanWith(Workshop& workshop, const Point& start, const Point& goal,
                      const std::string& planner, const std::string& retraction,
                      const std::string& clearance, double max_seconds,
                      std::uint64_t seed, const std::string& preset,
                      const std::string& model, bool is_required,
                      double budget) {
  PlanRequest request = workshop.PlanBetween(start, goal);
  request.planner = PlannerId::kContactSurface;
  if (budget > 0.0) {
    ApplyBudget(budget, workshop.scene().workspace, &request);
  }
  if (!planner.empty()) request.planner = ParsePlanner(planner, "planner");
  request.retraction = ParseRetraction(retraction, "retraction");
  if (!clearance.empty()) {
    RequireSeeksClearance(request.planner, "clearance");
    request.clearance = workshop.Clearance(clearance, "clearance");
  }
  if (!preset.empty()) {
    if (request.planner != PlannerId::kContactSurface) {
      throw InputError(std::string("preset: expected with planner ") +
                       ToString(PlannerId::kContactSurface) + ", found with " +
                       ToString(request.planner));
    }
    request.preset = ParsePreset(preset, "preset");
  }
  if (!model.empty()) request.model = ParseModel(model, "model");
  request.requires_clearance = is_required;
  request.time_limit = max_seconds;
  request.seed = seed;
  return workshop.Plan(request);
}

nb::dict PlanOf(const ContactRoadmap& roadmap, const Point& start,
                const Point& goal) {
  const PlanResult result = [&] {
    const Computing computing;
    return roadmap.Plan(ToVector(start), ToVector(goal));
  }();
  nb::dict out;
  out["status"] = ToString(result.status);
  out["reason"] = result.reason;
  out["path"] = ToArray(result.path);
  out["length"] = result.length;
  out["clearance"] = result.clearance;
  out["seconds"] = result.seconds;
  return out;
}

std::array<Point, 2> EndOf(const CurveEnd& end) {
  const auto point = [](const Vector3d& v) -> Point {
    return {v.x(), v.y(), v.z()};
  };
  return {point(end.velocity), point(end.acceleration)};
}

void BindScene(nb::module_& module) {
  nb::class_<Scene>(module, "Scene")
      .def_static("make", &MakeScene, nb::arg("robot"), nb::arg("obstacles"),
                  nb::arg("bounds").none(), nb::arg("name"), nb::arg("unit"))
      .def_static(
          "load",
          [](const std::string& text, std::optional<std::uint64_t> seed) {
            const Computing computing;
            return SceneSource(text).Load(seed);
          },
          nb::arg("text"), nb::arg("seed").none())
      .def_prop_ro("name", [](const Scene& scene) { return scene.name; })
      .def_prop_ro("unit",
                   [](const Scene& scene) { return scene.workspace.unit; })
      .def_prop_ro("start",
                   [](const Scene& scene) { return ToArray(scene.start); })
      .def_prop_ro("goal",
                   [](const Scene& scene) { return ToArray(scene.goal); })
      .def_prop_ro("limits",
                   [](const Scene& scene) -> nb::object {
                     if (!scene.limits) return nb::none();
                     const MotionLimits& l = *scene.limits;
                     return ToArray(std::vector<Vector3d>{
                         l.velocity, l.acceleration, l.jerk});
                   })
      .def_prop_ro("limits_by_norm",
                   [](const Scene& scene) {
                     return scene.limits && scene.limits->by_norm;
                   })
      .def_prop_ro("via",
                   [](const Scene& scene) {
                     std::vector<std::tuple<Point, std::string, double>> all;
                     for (const Via& via : scene.via) {
                       all.emplace_back(
                           Point{via.point.x(), via.point.y(), via.point.z()},
                           via.tolerance.Text(scene.workspace.unit), via.dwell);
                     }
                     return all;
                   })
      .def_prop_ro("duration",
                   [](const Scene& scene) { return scene.duration; })
      .def_prop_ro("departure",
                   [](const Scene& scene) { return EndOf(scene.departure); })
      .def_prop_ro("arrival",
                   [](const Scene& scene) { return EndOf(scene.arrival); })
      .def_prop_ro("warnings",
                   [](const Scene& scene) { return Lines(scene.warnings); })
      .def_prop_ro("robot",
                   [](const Scene& scene) { return scene.workspace.robot; })
      .def_prop_ro("obstacles",
                   [](const Scene& scene) { return scene.workspace.obstacles; })
      .def_prop_ro("bounds", [](const Scene& scene) -> nb::object {
        const BoundingBox& box = scene.workspace.bounds;
        if (box.IsEmpty()) return nb::none();
        return ToArray(std::vector<Vector3d>{box.min, box.max});
      });
}

void BindWishes(nb::module_& module) {
  nb::class_<MotionWishes>(module, "MotionWishes")
      .def("__init__",
           [](MotionWishes* self, const std::array<Point, 3>& limits,
              const std::vector<std::tuple<Point, std::string, double>>& via,
              double duration, const std::string& margin,
              const std::string& preset, double max_seconds, bool is_required,
              int routes, bool by_norm, const std::array<Point, 2>& departure,
              const std::array<Point, 2>& arrival) {
             new (self) MotionWishes{limits,  via,         duration,    margin,
                                     preset,  max_seconds, is_required, routes,
                                     by_norm, departure,   arrival};
           });
}

std::vector<double> DurationsOf(const Trajectory& motion) {
  std::vector<double> durations;
  for (const CurvePiece& piece : motion.pieces()) {
    durations.push_back(piece.duration());
  }
  return durations;
}

std::vector<Vector3d> BezierPointsOf(const Trajectory& motion) {
  std::vector<Vector3d> points;
  for (const CurvePiece& piece : motion.pieces()) {
    for (int i = 0; i <= piece.degree(); ++i) points.push_back(piece.point(i));
  }
  return points;
}

// What is only of a path without time, or only of a motion, is 0 of others.
void BindAnswer(nb::module_& module) {
  using Both = AnswerAndRow;
  nb::class_<Both>(module, "PathAnswer")
      .def_prop_ro(
          "status",
          [](const Both& both) { return ToString(both.answer.status); })
      .def_prop_ro("reason",
                   [](const Both& both) { return both.answer.reason; })
      .def_prop_ro("path",
                   [](const Both& both) { return ToArray(both.answer.path); })
      .def_prop_ro("is_free",
                   [](const Both& both) { return both.answer.is_free; })
      .def_prop_ro("is_solved",
                   [](const Both& both) { return both.answer.is_solved; })
      .def_prop_ro("is_infeasible",
                   [](const Both& both) { return both.answer.IsInfeasible(); })
      .def_prop_ro("length",
                   [](const Both& both) { return both.answer.length; })
      .def_prop_ro("clearance",
                   [](const Both& both) {
                     const PathAnswer& answer = both.answer;
                     return answer.curve ? answer.curve->clearance
                                         : answer.clearance;
                   })
      .def_prop_ro("seconds",
                   [](const Both& both) { return both.answer.seconds; })
      .def_prop_ro("objective",
                   [](const Both& both) {
                     const auto& pipeline = both.answer.pipeline;
                     return pipeline ? pipeline->objective : 0.0;
                   })
      .def_prop_ro("iterations",
                   [](const Both& both) {
                     const auto& pipeline = both.answer.pipeline;
                     return pipeline ? pipeline->iterations : 0;
                   })
      .def_prop_ro(
          "duration",
          [](const Both& both) { return both.answer.motion.duration(); })
      .def_prop_ro("durations",
                   [](const Both& both) {
                     std::vector<double> all = DurationsOf(both.answer.motion);
                     const size_t count = all.size();
                     return Owned(std::move(all), {count});
                   })
      .def_prop_ro("points",
                   [](const Both& both) {
                     return ToArray(BezierPointsOf(both.answer.motion));
                   })
      .def_prop_ro("row", [](const Both& both) { return ToObject(both.row); });
}

void BindRoadmap(nb::module_& module) {
  nb::class_<ContactRoadmap>(module, "Roadmap")
      .def("__init__",
           [](ContactRoadmap* self, const Workshop& workshop) {
             new (self) ContactRoadmap(Interruptible(
                 [&] { return ContactRoadmap(workshop.world().Sealed()); }));
           })
      .def("plan", &PlanOf)
      .def_prop_ro("nodes",
                   [](const ContactRoadmap& r) { return r.report().nodes; })
      .def_prop_ro("edges",
                   [](const ContactRoadmap& r) { return r.report().edges; });
}

}  // namespace

void BindWorld(nb::module_& module) {
  BindScene(module);
  BindWishes(module);
  BindAnswer(module);
  BindRoadmap(module);
  nb::class_<Workshop>(module, "World")
      .def(nb::init<const Scene&, bool, double>())
      .def("optimize", &OptimizeWith, nb::arg("start"), nb::arg("goal"),
           nb::kw_only(), nb::arg("metric"), nb::arg("margin"),
           nb::arg("waypoints"), nb::arg("seed"), nb::arg("max_seconds"),
           nb::arg("straight"), nb::arg("preset"), nb::arg("model"),
           nb::arg("require"), nb::arg("routes"), nb::arg("budget") = 0.0)
      .def("optimize_in_time",
           [](Workshop& workshop, const Point& start, const Point& goal,
              const std::string& model, const MotionWishes& wishes,
              const std::vector<Moving>& moving) {
             OptimizeRequest request =
                 workshop.MotionBetween(start, goal, wishes);
             AddMoving(moving, &request);
             if (!model.empty()) request.model = ParseModel(model, "model");
             return workshop.Optimize(request);
           })
      .def("retime",
           [](Workshop& workshop, const std::vector<Point>& path,
              const MotionWishes& wishes) {
             return workshop.Retime(
                 path,
                 workshop.MotionBetween(path.front(), path.back(), wishes));
           })
      .def("plan", &PlanWith, nb::arg("start"), nb::arg("goal"), nb::kw_only(),
           nb::arg("planner"), nb::arg("retraction"), nb::arg("clearance"),
           nb::arg("max_seconds"), nb::arg("seed"), nb::arg("preset"),
           nb::arg("model"), nb::arg("require"), nb::arg("budget") = 0.0)
      .def("diagnose", &DiagnosisOf)
      .def("are_free", &AreFree)
      .def("clearances", &Clearances)
      .def("check_curve", &CheckCurveIn, nb::arg("durations"),
           nb::arg("points"), nb::arg("blur"), nb::arg("limits").none(),
           nb::arg("by_norm"), nb::arg("moving"))
      .def_prop_ro("scene", &Workshop::scene)
      .def_prop_ro("length",
                   [](const Workshop& w) { return w.world().diagonal(); })
      .def("contact_spaces",
           [](const Workshop& w) { return w.Spaces().spaces; });
}

}  // namespace phongpd::python
