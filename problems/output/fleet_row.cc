// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/fleet_row.h"

#include <nlohmann/json.hpp>

#include "problems/output/answer_row.h"
#include "problems/output/row_parts.h"
#include "problems/scenes/scene_requests.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

Json PairRow(const FleetPair& pair) {
  return {{"robots", {pair.first, pair.second}},
          {"certified", pair.is_free},
          {"clearance", pair.clearance},
          {"least", pair.least},
          {"time", pair.time},
          {"verified", pair.verification
                           ? Json(ToString(pair.verification->verdict))
                           : Json(nullptr)}};
}

}  // namespace

std::vector<FleetRobot> RobotsOf(const FleetScene& scene,
                                 const ContactSpaceCache& cache,
                                 const WorldLimits& limits) {
  std::vector<FleetRobot> robots;
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    const Scene& own = scene.robots[i];
    const std::string& name = own.workspace.robot.name();
    std::size_t same = 0;
    while (same < i &&
           !HaveSameSolids(scene.robots[same].workspace, own.workspace)) {
      ++same;
    }
    const World world = same < i
                            ? robots[same].world
                            : World(own.workspace, own.name, cache, limits);
    robots.push_back({name, world, OptimizeRequestOf(own)});
  }
  return robots;
}

Json FleetRow(const FleetScene& scene, const std::vector<FleetRobot>& robots,
              const FleetAnswer& answer) {
  Json row;
  row["scene"] = scene.name;
  row["status"] = ToString(answer.status);
  row["reason"] = answer.reason;
  row["solved"] = answer.IsSolved();
  row["certified"] = answer.IsSolved();
  row["duration"] = answer.duration;
  row["unit"] = UnitRow(scene.robots.front().workspace.unit);
  row["order"] = Json::array();
  for (const std::size_t i : answer.order) {
    row["order"].push_back(robots[i].name);
  }
  row["tries"] = answer.tries;
  row["by_order"] = answer.by_order;
  row["rounds_together"] = answer.rounds_together;
  row["pairs"] = Json::array();
  for (const FleetPair& pair : answer.pairs) {
    row["pairs"].push_back(PairRow(pair));
  }
  row["robots"] = Json::array();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Json own = {{"id", robots[i].name}};
    own.update(MotionRow(scene.robots[i], robots[i].world, robots[i].request,
                         answer.robots[i]));
    row["robots"].push_back(std::move(own));
  }
  row["seconds"] = answer.seconds;
  return row;
}

}  // namespace phongpd
