// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/obstacle_depths.h"

#include <nlohmann/json.hpp>

#include "problems/cli/depth_row.h"
#include "problems/cli/view_rows.h"
#include "viewer/view_entries.h"

namespace phongpd::cli {

ObstacleDepths::ObstacleDepths(const Solid& robot,
                               const std::vector<Solid>& obstacles,
                               double seconds) {
  DepthOptions options;
  options.max_seconds = seconds;
  for (const Solid& obstacle : obstacles) {
    queries_.emplace_back(obstacle.name(),
                          DepthQuery(robot, obstacle, options));
  }
}

nlohmann::ordered_json ObstacleDepths::At(const RobotPose& pose) const {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  nlohmann::ordered_json answers = nlohmann::ordered_json::array();
  for (const auto& [name, query] : queries_) {
    const Depth depth = query.At(pose);
    answers.push_back(AnswerEntry(ViewAnswerOf(pose, depth)));
    nlohmann::ordered_json row = DepthAnswerRow(pose, depth);
    row["obstacle"] = name;
    rows.push_back(std::move(row));
  }
  return {{"rows", rows}, {"answers", answers}};
}

}  // namespace phongpd::cli
