// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/large_scene_measure.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/convolution_model.h"
#include "core/minkowski/build_stop.h"
#include "core/solid/solid.h"
#include "planners/exact/verification.h"
#include "planners/ompl/ompl_planning.h"
#include "problems/scenes/scene_requests.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "results/bench/child_process.h"
#include "results/bench/free_space_measure.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double kTaskLimit = 600.0;  // seconds of a task, far above all

// A small scanned knot that passes a larger one; both too thin for much of what
// their facets cut to be hidden in either.
Scene ScannedKnots() {
  Scene scene;
  scene.name = "scanned knots";
  scene.workspace.robot =
      MakeSolid(Rotated(MakeScan(MakeKnot(0.5, 0.06, 160, 16), 0.055, 0.002, 4),
                        GenericRotation()),
                "robot");
  scene.workspace.obstacles = {MakeSolid(
      MakeScan(MakeKnot(1.0, 0.12, 160, 16), 0.11, 0.004, 3), "knot")};
  scene.workspace.bounds = {Vector3d::Constant(-6.0), Vector3d::Constant(6.0)};
  scene.start = Vector3d::Constant(-4.0);
  scene.goal = Vector3d::Constant(4.0);
  return scene;
}

// What is found, and the exact judge's word on it.
Json Judged(const Scene& scene, const std::string& answer,
            const std::vector<Vector3d>& path, double clearance) {
  const Verification judged = Verifier(scene.workspace).VerifyPath(path);
  return {{"answer", answer},
          {"verified", ToString(judged.verdict)},
          {"points", path.size()},
          {"clearance", clearance}};
}

Json PlanKnots(PlannerId planner) {
  SilenceOmpl();
  const Scene scene = ScannedKnots();
  const World world(scene.workspace, scene.name);
  PlanRequest request = PlanRequestOf(scene);
  request.planner = planner;
  request.model = Model::kWindow;
  request.verifies = false;
  const PathAnswer found = Plan(world, request);
  Json row = Judged(scene, ToString(found.status), found.path, found.clearance);
  const auto faces = found.plan->explored_faces;
  row["facets"] = faces ? *faces : world.Convolution().facets();
  return row;
}

Json OptimizeKnots() {
  SilenceOmpl();
  const Scene scene = ScannedKnots();
  const World world(scene.workspace, scene.name);
  OptimizeRequest request = OptimizeRequestOf(scene);
  request.model = Model::kWindow;
  request.verifies = false;
  const PathAnswer found = Optimize(world, request);
  Json row = Judged(scene, ToString(found.status), found.path, found.clearance);
  row["facets"] = world.Convolution().facets();
  return row;
}

// Of the whole convolution.
Json CountFacets() {
  const Scene scene = ScannedKnots();
  const ConvolutionModel model(scene.workspace.robot,
                               scene.workspace.obstacles[0]);
  return {{"facets", model.Mesh().triangles.size()}};
}

// Refused, as it should be.
Json BuildWhole(double max_seconds) {
  const Scene scene = ScannedKnots();
  const World limited(scene.workspace, scene.name, {}, {max_seconds, 0.0});
  std::string said = "built";
  try {
    limited.Spaces(SpaceLayout::kSealed);
  } catch (const BuildRefusal& refusal) {
    const std::string what = refusal.what();
    said = what.substr(0, what.find(';'));
  }
  return {{"answer", said}};
}

struct TaskRow {
  std::string task;
  Json found;
  double wall = 0.0, mib = 0.0;
};

TaskRow MeasureTask(const std::string& task,
                    const std::function<Json()>& work) {
  TaskRow row;
  row.task = task;
  const ChildOutcome outcome = RunInChild(
      [&work] {
        Json found = work();
        found["cpu"] = CpuSeconds();
        return found.dump();
      },
      kTaskLimit);
  row.found = outcome.status == ChildStatus::kDone
                  ? Json::parse(outcome.output)
                  : Json{{"answer", "failed: " + outcome.output}, {"cpu", 0.0}};
  row.wall = outcome.seconds;
  row.mib = outcome.peak_mib;
  return row;
}

}  // namespace

NamedTable LargeSceneTable(double max_seconds) {
  std::vector<TaskRow> rows;
  rows.push_back(MeasureTask("plan, rrt-connect",
                             [] { return PlanKnots(PlannerId::kRrtConnect); }));
  rows.push_back(MeasureTask("plan, contact-surface", [] {
    return PlanKnots(PlannerId::kContactSurface);
  }));
  rows.push_back(MeasureTask("optimize", OptimizeKnots));
  rows.push_back(MeasureTask("the whole contact space", [max_seconds] {
    return BuildWhole(max_seconds);
  }));
  return {"large_scene.csv",
          MakeTable(
              {"task", "CPU s", "wall s", "peak MiB", "answer", "verified",
               "points", "clearance", "modelled"},
              rows, [](const TaskRow& row, const auto& add) {
                const Json& found = row.found;
                const bool is_path = found.contains("points");
                add(row.task, found["cpu"].get<double>(), row.wall, row.mib,
                    found["answer"].get<std::string>(),
                    is_path ? found["verified"].get<std::string>() : "–",
                    is_path ? Shown(found["points"].get<std::size_t>()) : "–",
                    is_path ? Rounded(found["clearance"].get<double>()) : "–",
                    is_path ? Shown(found["facets"].get<std::size_t>()) : "–");
              })};
}

NamedTable LargeSceneSize() {
  const Workspace workspace = ScannedKnots().workspace;
  const long facets = MeasureTask("", CountFacets).found.value("facets", 0L);
  return {"large_scene_size.csv",
          {"",
           "",
           {"robot", "obstacle", "facets"},
           {{Shown(workspace.robot.mesh().triangles.size()),
             Shown(workspace.obstacles[0].mesh().triangles.size()),
             std::to_string(facets)}}}};
}

}  // namespace phongpd::bench
