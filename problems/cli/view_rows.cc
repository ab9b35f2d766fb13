// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/view_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

Eigen::Vector3d PointOf(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(),
          json.at(2).get<double>()};
}

}  // namespace

ViewAnswer ViewAnswerOf(const RobotPose& pose, const Depth& depth) {
  ViewAnswer answer;
  answer.is_depth = true;
  answer.position = pose.position;
  answer.orientation = pose.orientation;
  answer.status = ToString(depth.status);
  answer.depth = depth.depth;
  answer.clearance = depth.clearance;
  answer.direction = depth.direction;
  answer.on_robot = depth.on_robot;
  answer.on_obstacle = depth.on_obstacle;
  answer.has_witness = depth.robot_feature.kind != ContactFeature::kNone;
  answer.window_reaches = depth.window_reaches;
  answer.window_axes = depth.window_axes;
  return answer;
}

ViewAnswer DepthAnswerOf(const Json& row) {
  ViewAnswer answer;
  answer.is_depth = true;
  answer.position = PointOf(row.at("position"));
  const Json& turn = row.at("orientation");
  answer.orientation = {turn.at(0).get<double>(), turn.at(1).get<double>(),
                        turn.at(2).get<double>(), turn.at(3).get<double>()};
  answer.status = row.at("status").get<std::string>();
  answer.depth = row.at("depth").get<double>();
  answer.clearance = row.at("clearance").get<double>();
  answer.direction = PointOf(row.at("direction"));
  answer.on_robot = PointOf(row.at("on_a").at("point"));
  answer.on_obstacle = PointOf(row.at("on_b").at("point"));
  answer.has_witness = row.at("on_a").at("feature") != "none";
  if (!row.contains("window_reaches")) return answer;
  answer.window_reaches = row.at("window_reaches").get<std::vector<double>>();
  for (int k = 0; k < 3; ++k) {
    answer.window_axes.col(k) =
        PointOf(row.at("window_axes").at(static_cast<std::size_t>(k)));
  }
  return answer;
}

// Of query: the arrow leads from the position to its contact.
ViewAnswer QueryAnswerOf(const Json& row) {
  ViewAnswer answer;
  answer.position = PointOf(row.at("position"));
  answer.status = row.at("status").get<std::string>();
  const double distance = row.at("signed_distance").get<double>();
  answer.depth = std::max(0.0, -distance);
  answer.clearance = std::max(0.0, distance);
  answer.direction = PointOf(row.at("direction"));
  answer.on_robot = answer.position;
  answer.on_obstacle = PointOf(row.at("contact"));
  answer.has_witness = answer.status != "invalid";
  return answer;
}

}  // namespace phongpd::cli
