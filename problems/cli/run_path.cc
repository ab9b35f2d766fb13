// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/run_path.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/output/answer_row.h"
#include "problems/output/rigid_row.h"
#include "viewer/rigid_view.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

// Paths of one metric from either start may be on one page.
std::string Title(const std::string& by, std::uint64_t seed, bool is_straight,
                  std::string status) {
  if (status == ToString(PathStatus::kInfeasibleProved)) {
    status = "proved: there is no way";
  }
  std::replace(status.begin(), status.end(), '_', ' ');
  return by + " · seed " + std::to_string(seed) +
         (is_straight ? " · straight start · " : " · ") + status;
}

// "PhongPD, ℓ = 0.2" of "phong@0.2"; what is no metric of ours stays as it is.
std::string MethodTitle(const std::string& method) {
  const std::vector<std::string>& names = MetricNames();
  const std::string metric = method.substr(0, method.find('@'));
  return std::find(names.begin(), names.end(), metric) == names.end()
             ? method
             : ParsePenetration(method, "method").Title();
}

std::vector<Eigen::Vector3d> PointsOf(const Json& path) {
  std::vector<Eigen::Vector3d> points;
  for (const Json& p : path) {
    points.emplace_back(p.at(0).get<double>(), p.at(1).get<double>(),
                        p.at(2).get<double>());
  }
  return points;
}

// Of a robot that turns: seven numbers a pose.
bool HasPoses(const Json& path) {
  return !path.empty() && path.front().size() == 7;
}

std::vector<RobotPose> PosesOf(const Json& path) {
  std::vector<RobotPose> poses;
  for (const Json& cells : path) {
    const auto x = cells.get<std::vector<double>>();
    RobotPose pose;
    pose.position = {x.at(0), x.at(1), x.at(2)};
    pose.orientation = {x.at(3), x.at(4), x.at(5), x.at(6)};
    CheckPose(pose, "path");
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

NamedPath NamedPathOf(const PlanRequest& request, const PathAnswer& answer) {
  return {Title(ToString(answer.plan->planner), request.seed, false,
                ToString(answer.status)),
          answer.path, answer.is_solved};
}

NamedPath NamedPathOf(const OptimizeRequest& request,
                      const PathAnswer& answer) {
  const PipelineOptions& options = request.options;
  return {Title(MethodTitle(request, answer), options.seed,
                options.start == TrajectoryStart::kStraight,
                ToString(answer.status)),
          answer.path, answer.is_free};
}

NamedPath NamedPathOf(const RigidRequest& request, const RigidAnswer& answer) {
  return RigidPath(
      Title(PlannerName(answer), request.seed, false, ToString(answer.status)),
      answer.path, HasFreePath(answer.status));
}

NamedPath NamedPathOf(const Json& row) {
  const bool is_plan = row.contains("planner");
  const std::string by =
      row.at(is_plan ? "planner" : "method").get<std::string>();
  const std::string title =
      Title(is_plan ? by : MethodTitle(by), row.at("seed").get<std::uint64_t>(),
            !is_plan && row.value("start", "") == "straight",
            row.at(is_plan ? "status" : "status_class").get<std::string>());
  const bool is_free =
      row.at(is_plan ? "solved" : "collision_free").get<bool>();
  const Json& path = row.at("path");
  if (HasPoses(path)) return RigidPath(title, PosesOf(path), is_free);
  return {title, PointsOf(path), is_free};
}

}  // namespace phongpd::cli
