// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planners/solve/fleet.h"
#include "problems/output/fleet_row.h"
#include "problems/scenes/scene_source.h"
#include "python/src/bindings.h"
#include "python/src/interruptible.h"
#include "python/src/json_objects.h"
#include "python/src/workshop.h"

namespace phongpd::python {
namespace {

// A name, a world, start and goal, and what the motion is to do.
using Task =
    std::tuple<std::string, const Workshop*, Point, Point, MotionWishes>;

// Equal worlds are one: what is built in it is built once.
World Shared(const World& world, const std::vector<FleetRobot>& before) {
  for (const FleetRobot& robot : before) {
    if (HaveSameSolids(robot.world.workspace(), world.workspace())) {
      return robot.world;
    }
  }
  return world;
}

struct FleetAnswerAndRow {
  FleetAnswer answer;
  nlohmann::ordered_json row;
};

FleetAnswerAndRow OptimizeRobots(const std::string& name,
                                 const std::vector<Task>& tasks,
                                 const std::vector<Moving>& moving) {
  FleetScene scene;
  scene.name = name;
  std::vector<FleetRobot> robots;
  for (const auto& [id, workshop, start, goal, wishes] : tasks) {
    OptimizeRequest request = workshop->MotionBetween(start, goal, wishes);
    AddMoving(moving, &request);
    robots.push_back({id, Shared(workshop->world(), robots), request});
    Scene own = workshop->scene();
    own.name = name;
    scene.robots.push_back(std::move(own));
  }
  return Interruptible([&](const std::atomic<bool>& is_asked) {
    for (FleetRobot& robot : robots) {
      robot.request.is_interrupted = [&is_asked] { return is_asked.load(); };
    }
    FleetAnswerAndRow both{OptimizeFleet(robots), {}};
    if (both.answer.status == PathStatus::kVerificationFailed) {
      throw std::runtime_error(both.answer.reason);
    }
    both.row = FleetRow(scene, robots, both.answer);
    return both;
  });
}

// The name of a file of several robots, and the scene of each.
std::pair<std::string, std::vector<std::pair<std::string, Scene>>> LoadRobots(
    const std::string& path) {
  const SceneSource source(path);
  const FleetScene fleet = source.LoadFleet();
  std::vector<std::pair<std::string, Scene>> robots;
  for (const Scene& scene : fleet.robots) {
    robots.emplace_back(scene.workspace.robot.name(), scene);
  }
  return {fleet.name, std::move(robots)};
}

// With their own rows.
std::vector<AnswerAndRow> AnswersOf(const FleetAnswerAndRow& fleet) {
  std::vector<AnswerAndRow> robots;
  for (const PathAnswer& answer : fleet.answer.robots) {
    robots.push_back({answer, fleet.row.at("robots").at(robots.size())});
  }
  return robots;
}

void BindFleetAnswer(nb::module_& module) {
  using Both = FleetAnswerAndRow;
  nb::class_<Both>(module, "FleetAnswer")
      .def_prop_ro(
          "status",
          [](const Both& both) { return ToString(both.answer.status); })
      .def_prop_ro("reason",
                   [](const Both& both) { return both.answer.reason; })
      .def_prop_ro("is_solved",
                   [](const Both& both) { return both.answer.IsSolved(); })
      .def_prop_ro("duration",
                   [](const Both& both) { return both.answer.duration; })
      .def_prop_ro("robots", &AnswersOf)
      .def_prop_ro("row", [](const Both& both) { return ToObject(both.row); });
}

}  // namespace

void BindFleet(nb::module_& module) {
  BindFleetAnswer(module);
  module.def("load_robots", &LoadRobots);
  module.def("optimize_fleet", &OptimizeRobots);
}

}  // namespace phongpd::python
