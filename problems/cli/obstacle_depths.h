// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/depth.h"
#include "core/solid/solid.h"

namespace phongpd::cli {

// How deep a robot is in each of its obstacles, asked again and again.
class ObstacleDepths {
 public:
  ObstacleDepths() = default;
  // Throws what DepthQuery throws.  `seconds`: of each answer.
  ObstacleDepths(const Solid& robot, const std::vector<Solid>& obstacles,
                 double seconds);

  bool empty() const { return queries_.empty(); }

  // {"rows": [...], "answers": [...]}: a row of `phongpd depth` for each
  // obstacle, with its name as "obstacle", and the page's answer of each.
  nlohmann::ordered_json At(const RobotPose& pose) const;

 private:
  std::vector<std::pair<std::string, DepthQuery>> queries_;
};

}  // namespace phongpd::cli
