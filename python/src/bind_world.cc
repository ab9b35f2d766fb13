// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "constraints/non_penetration.h"
#include "planners/exact/contact_roadmap.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/answer_check.h"
#include "problems/studies/planning_study.h"
#include "problems/studies/trajectory_study.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"

namespace phongpd::python {
namespace {

using Eigen::Vector3d;
using Point = std::array<double, 3>;

Vector3d ToVector(const Point& p) { return {p[0], p[1], p[2]}; }
Point ToPoint(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Solid AlreadyChecked(const TriangleMesh& mesh, const std::string& name) {
  Solid solid;
  solid.mesh = std::make_shared<const TriangleMesh>(mesh);
  solid.name = name;
  solid.report = ExamineMesh(mesh);
  return solid;
}

// A world and what has been prepared in it for one kind of question or the
// other.  Ipopt runs once at a time in a process, and preparing is no question
// for two threads at once: one mutex for all.
class Workshop {
 public:
  Workshop(const Scene& scene, bool cache)
      : scene_(scene),
        cache_(FolderOf(cache)),
        world_(scene.workspace, scene.name, cache_),
        trajectories_(cache_) {}

  const World& world() const { return world_; }
  const Scene& scene() const { return scene_; }

  // A row as `phongpd optimize` writes it.
  std::string Optimize(const Point& start, const Point& goal,
                       const std::string& metric, const std::string& margin,
                       int waypoints, std::uint64_t seed, double max_seconds,
                       bool is_straight) {
    const nb::gil_scoped_release release;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    Scene scene = Between(start, goal);
    if (!margin.empty()) {
      scene.trajectory.margin = ParseLength(margin, "margin");
      RequireLength(scene.trajectory.margin, LengthRange::kAboveZero,
                    world_.diagonal(), "margin");
    }
    if (waypoints > 0) scene.trajectory.waypoints = waypoints;
    PipelineOptions options = ScenePipelineOptions(scene);
    options.seed = seed;
    options.time_limit = max_seconds;
    if (is_straight) options.start = TrajectoryStart::kStraight;
    trajectories_.Enter(scene, world_);
    const TrajectoryMetric chosen =
        metric.empty() ? SceneMetric(scene)
                       : ParseTrajectoryMetric(metric, "metric");
    const PipelineResult result = trajectories_.Run(chosen, options);
    nlohmann::ordered_json row =
        TrajectoryRow(trajectories_, chosen, options, result);
    AnswerClaims claims;
    if (result.certificate.free) claims.path = result.path;
    claims.proves_separation =
        result.status == TrajectoryStatus::kInfeasibleProved;
    return Judged(scene, claims, &row);
  }

  // A row as `phongpd plan` writes it.
  std::string Plan(const Point& start, const Point& goal,
                   const std::string& planner, const std::string& retraction,
                   const std::string& clearance, double max_seconds,
                   std::uint64_t seed) {
    const nb::gil_scoped_release release;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    Scene scene = Between(start, goal);
    if (!clearance.empty()) {
      scene.planning.clearance = ParseLength(clearance, "clearance");
      RequireLength(*scene.planning.clearance, LengthRange::kAboveZero,
                    world_.diagonal(), "clearance");
    }
    PlanningStudy study(scene, world_);
    PlanningRun run;
    run.planner = planner;
    run.retraction = retraction;
    run.time_limit = max_seconds;
    run.seed = seed;
    const PlanningResult result = study.Run(run);
    nlohmann::ordered_json row = PlanningRow(study, run, result);
    AnswerClaims claims;
    if (result.solved) claims.path = result.numbers.path;
    claims.proves_separation = result.infeasible_proved;
    return Judged(scene, claims, &row);
  }

 private:
  static ContactSpaceCache FolderOf(bool cache) {
    ContactSpaceCache folder;
    if (cache) folder.directory = DefaultCacheDirectory();
    return folder;
  }

  Scene Between(const Point& start, const Point& goal) const {
    Scene scene = scene_;
    scene.start = ToVector(start);
    scene.goal = ToVector(goal);
    for (const Vector3d& q : {scene.start, scene.goal}) {
      if (q.allFinite()) continue;
      throw InputError("start and goal: expected finite numbers, found others");
    }
    scene.witness.clear();
    scene.feasible.reset();
    return scene;
  }

  std::string Judged(const Scene& scene, const AnswerClaims& claims,
                     nlohmann::ordered_json* row) const {
    AnswerCheck check(true);
    check.Judge(scene, world_, claims, row);
    check.RequireNoFailure();
    return row->dump();
  }

  Scene scene_;
  ContactSpaceCache cache_;
  World world_;
  TrajectoryStudy trajectories_;
  std::mutex one_at_a_time_;
};

Scene MakeScene(const Solid& robot,
                const std::vector<std::pair<std::string, Solid>>& obstacles,
                const std::optional<std::pair<Point, Point>>& bounds,
                const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.workspace.robot = *robot.mesh;
  for (const auto& [id, solid] : obstacles) {
    scene.workspace.obstacles.push_back({id, *solid.mesh});
  }
  if (bounds) {
    scene.workspace.bounds = {ToVector(bounds->first),
                              ToVector(bounds->second)};
  }
  return scene;
}

nb::dict DiagnosisOf(const Workshop& workshop, const Point& q) {
  const Diagnosis found = [&] {
    const nb::gil_scoped_release release;
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
  {
    const nb::gil_scoped_release release;
    const FreeSpace& space =
        *workshop.world().Spaces(SpaceLayout::kMerged).free_space;
    for (size_t i = 0; i < free.size(); ++i) {
      free[i] = space.IsFree(Row(a, i), Row(b, i));
    }
  }
  const size_t count = free.size();
  return Owned(std::move(free), {count});
}

nb::object Clearances(const Workshop& workshop, const Rows3& points) {
  std::vector<double> clearance(points.shape(0));
  {
    const nb::gil_scoped_release release;
    const FreeSpace& space =
        *workshop.world().Spaces(SpaceLayout::kMerged).free_space;
    for (size_t i = 0; i < clearance.size(); ++i) {
      clearance[i] = space.Clearance(Row(points, i));
    }
  }
  const size_t count = clearance.size();
  return Owned(std::move(clearance), {count});
}

nb::dict PlanOf(const ContactRoadmap& roadmap, const Point& start,
                const Point& goal) {
  const PlanResult result = [&] {
    const nb::gil_scoped_release release;
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

// The rows of a polyline, and the branches that the caller's solver is on.
class Rows {
 public:
  Rows(const Workshop& workshop, const std::string& metric, const Point& start,
       const Point& goal, int waypoints, int samples_per_segment, int rows)
      : length_(workshop.world().diagonal()) {
    const TrajectoryMetric chosen = ParseTrajectoryMetric(metric, "metric");
    SignedMetricOptions options = chosen.options;
    options.phong.field_options.smoothing_length =
        chosen.smoothing_length.Resolve(length_).share;
    std::vector<std::shared_ptr<const SignedMetric>> metrics;
    const nb::gil_scoped_release release;
    for (const ContactSpace& space :
         workshop.world().Spaces(SpaceLayout::kMerged).spaces) {
      metrics.push_back(std::make_shared<SignedMetric>(space, options));
    }
    NonPenetrationOptions layout;
    layout.rows = rows;
    rows_ = std::make_unique<NonPenetrationConstraint>(
        std::move(metrics), ToVector(start), ToVector(goal), waypoints,
        std::vector<int>(static_cast<size_t>(waypoints) + 1,
                         samples_per_segment),
        layout);
    row_.resize(static_cast<size_t>(rows_->nonzeros()));
    column_.resize(row_.size());
    rows_->Sparsity(row_.data(), column_.data());
  }

  size_t variables() const { return static_cast<size_t>(rows_->variables()); }
  size_t rows() const { return static_cast<size_t>(rows_->rows()); }
  double length() const { return length_; }
  nb::tuple Sparsity() const {
    return nb::make_tuple(Owned(row_, {row_.size()}),
                          Owned(column_, {column_.size()}));
  }

  // Cold branches at u.
  void Start(const Rows3& u) {
    const nb::gil_scoped_release release;
    branches_ = rows_->Start(u.data(), nullptr);
  }
  void Accept(const Rows3& u) {
    const nb::gil_scoped_release release;
    if (branches_.branches.empty()) {
      branches_ = rows_->Start(u.data(), nullptr);
    }
    rows_->Commit(u.data(), &branches_, nullptr);
  }
  // Values and entries of the pattern.
  nb::tuple Evaluate(const Rows3& u) {
    std::vector<double> values(rows()), entries(row_.size());
    {
      const nb::gil_scoped_release release;
      if (branches_.branches.empty()) {
        branches_ = rows_->Start(u.data(), nullptr);
      }
      if (!rows_->Evaluate(u.data(), branches_, values.data(), entries.data(),
                           nullptr)) {
        throw InputError("waypoints: expected finite numbers, found others");
      }
    }
    const size_t m = values.size(), e = entries.size();
    return nb::make_tuple(Owned(std::move(values), {m}),
                          Owned(std::move(entries), {e}));
  }

 private:
  std::unique_ptr<NonPenetrationConstraint> rows_;
  double length_;
  BranchSet branches_;
  std::vector<int> row_, column_;
};

void BindScene(nb::module_& module) {
  nb::class_<Scene>(module, "Scene")
      .def_static("make", &MakeScene, nb::arg("robot"), nb::arg("obstacles"),
                  nb::arg("bounds").none(), nb::arg("name"))
      .def_static(
          "load",
          [](const std::string& text, std::optional<std::uint64_t> seed) {
            const nb::gil_scoped_release release;
            return SceneSource(text).Load(seed);
          },
          nb::arg("text"), nb::arg("seed").none())
      .def_prop_ro("name", [](const Scene& scene) { return scene.name; })
      .def_prop_ro("start",
                   [](const Scene& scene) { return ToArray(scene.start); })
      .def_prop_ro("goal",
                   [](const Scene& scene) { return ToArray(scene.goal); })
      .def_prop_ro("feasible",
                   [](const Scene& scene) { return scene.feasible; })
      .def_prop_ro("warnings",
                   [](const Scene& scene) { return scene.warnings; })
      .def_prop_ro("robot",
                   [](const Scene& scene) {
                     return AlreadyChecked(scene.workspace.robot, "robot");
                   })
      .def_prop_ro("obstacles",
                   [](const Scene& scene) {
                     std::vector<Solid> solids;
                     for (const Obstacle& o : scene.workspace.obstacles) {
                       solids.push_back(AlreadyChecked(o.mesh, o.id));
                     }
                     return solids;
                   })
      .def_prop_ro("bounds", [](const Scene& scene) -> nb::object {
        const BoundingBox& box = scene.workspace.bounds;
        if (box.IsEmpty()) return nb::none();
        return ToArray(std::vector<Vector3d>{box.min, box.max});
      });
}

}  // namespace

void BindWorld(nb::module_& module) {
  BindScene(module);
  nb::class_<Workshop>(module, "World")
      .def(nb::init<const Scene&, bool>())
      .def("optimize", &Workshop::Optimize)
      .def("plan", &Workshop::Plan)
      .def("diagnose", &DiagnosisOf)
      .def("are_free", &AreFree)
      .def("clearances", &Clearances)
      .def_prop_ro("scene", &Workshop::scene)
      .def_prop_ro("length",
                   [](const Workshop& w) { return w.world().diagonal(); })
      .def("contact_spaces", [](const Workshop& w) {
        const nb::gil_scoped_release release;
        return w.world().Spaces(SpaceLayout::kMerged).spaces;
      });
  nb::class_<ContactRoadmap>(module, "Roadmap")
      .def("__init__",
           [](ContactRoadmap* self, const Workshop& workshop) {
             const nb::gil_scoped_release release;
             new (self) ContactRoadmap(workshop.world().Sealed());
           })
      .def("plan", &PlanOf)
      .def_prop_ro("nodes",
                   [](const ContactRoadmap& r) { return r.report().nodes; })
      .def_prop_ro("edges",
                   [](const ContactRoadmap& r) { return r.report().edges; });
  nb::class_<Rows>(module, "Rows")
      .def(nb::init<const Workshop&, const std::string&, const Point&,
                    const Point&, int, int, int>())
      .def("start", &Rows::Start)
      .def("accept", &Rows::Accept)
      .def("evaluate", &Rows::Evaluate)
      .def("sparsity", &Rows::Sparsity)
      .def_prop_ro("variables", &Rows::variables)
      .def_prop_ro("rows", &Rows::rows)
      .def_prop_ro("length", &Rows::length);
}

}  // namespace phongpd::python
