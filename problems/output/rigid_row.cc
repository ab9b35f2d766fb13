// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/rigid_row.h"

#include <nlohmann/json.hpp>

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

Json PoseRow(const RobotPose& pose) {
  const Eigen::Vector3d& p = pose.position;
  const Eigen::Quaterniond& turn = pose.orientation;
  return {p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z()};
}

}  // namespace

RigidRequest RigidRequestOf(const TurningScene& scene) {
  RigidRequest request;
  request.start = scene.start;
  request.goal = scene.goal;
  request.time_limit = scene.time_limit;
  const BoundingBox& bounds = scene.bounds;
  if (!bounds.IsEmpty()) request.bounds = {bounds.min, bounds.max};
  return request;
}

RigidWorld RigidWorldOf(const TurningScene& scene) {
  std::vector<TriangleMesh> obstacles;
  for (const TurningScene::Obstacle& obstacle : scene.obstacles) {
    obstacles.push_back(obstacle.mesh);
  }
  return {{scene.robot}, obstacles};
}

std::string PlannerName(const RigidAnswer& answer) {
  return answer.planner.empty() ? "none" : answer.planner;
}

Json RigidRow(const TurningScene& scene, const RigidRequest& request,
              const RigidAnswer& answer) {
  Json row;
  row["scene"] = scene.name;
  row["planner"] = PlannerName(answer);
  row["seed"] = request.seed;
  row["threads"] = request.threads;
  row["status"] = ToString(answer.status);
  row["reason"] = answer.reason;
  row["solved"] = row["collision_free"] = HasFreePath(answer.status);
  row["unit"] = scene.unit;
  row["start"] = PoseRow(request.start);
  row["goal"] = PoseRow(request.goal);
  row["depth"] = answer.depth ? Json(*answer.depth) : Json(nullptr);
  row["seconds"] = {{"solve", answer.seconds},
                    {"search", answer.search_seconds}};
  row["checks"] = {{"motion", answer.checks}, {"pairs", answer.tests}};
  row["graph_states"] = answer.nodes;
  row["found_poses"] = answer.found_poses;
  row["path_length"] = answer.length;
  row["clearance"] = nullptr;
  if (answer.IsSolved()) {
    const RigidClearance& clearance = answer.clearance;
    row["clearance"] = {{"lower", clearance.lower},
                        {"upper", clearance.upper},
                        {"motion", clearance.motion},
                        {"time", clearance.time}};
  }
  row["path"] = Json::array();
  for (const RobotPose& pose : answer.path)
    row["path"].push_back(PoseRow(pose));
  return row;
}

Json RigidOptimumRow(const TurningScene& scene,
                     const RigidOptimizeRequest& request,
                     const RigidOptimum& found) {
  Json row = RigidRow(scene, request.task, found.answer);
  row["solver"] = ToString(found.solver);
  row["confirmed"] = found.is_confirmed;
  row["planned_length"] =
      found.planned_length > 0.0 ? Json(found.planned_length) : Json(nullptr);
  row["rounds"] = found.rounds;
  row["iterations"] = found.iterations;
  row["added_samples"] = found.added_samples;
  return row;
}

}  // namespace phongpd
