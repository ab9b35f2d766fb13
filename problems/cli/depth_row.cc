// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/depth_row.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "core/number_text.h"
#include "viewer/page_numbers.h"

namespace phongpd::cli {
namespace {

using internal::PointJson;
using DepthJson = nlohmann::ordered_json;

DepthJson FeatureJson(const Eigen::Vector3d& point,
                      const ContactFeature& feature) {
  const std::vector<int> vertices(feature.vertices.begin(),
                                  feature.vertices.begin() + feature.kind);
  return {{"point", PointJson(point)},
          {"feature", ToString(feature.kind)},
          {"vertices", vertices}};
}

// A row for each axis.
DepthJson AxesJson(const Eigen::Matrix3d& axes) {
  return {PointJson(axes.col(0)), PointJson(axes.col(1)),
          PointJson(axes.col(2))};
}

}  // namespace

std::string RoundedPoint(const Eigen::Vector3d& point) {
  return Rounded(point.x(), kDigits) + ',' + Rounded(point.y(), kDigits) + ',' +
         Rounded(point.z(), kDigits);
}

nlohmann::ordered_json DepthAnswerRow(const RobotPose& pose,
                                      const DepthResult& r) {
  const Eigen::Quaterniond& turn = pose.orientation;
  return {{"position", PointJson(pose.position)},
          {"orientation", {turn.w(), turn.x(), turn.y(), turn.z()}},
          {"status", ToString(r.status)},
          {"depth", r.depth},
          {"clearance", r.clearance},
          {"direction", PointJson(r.direction)},
          {"contact", PointJson(r.contact)},
          {"on_a", FeatureJson(r.on_robot, r.robot_feature)},
          {"on_b", FeatureJson(r.on_obstacle, r.obstacle_feature)},
          {"certified", r.certified},
          {"explored_radius", r.explored_radius},
          {"level", ToString(r.level)},
          {"grid_step", r.grid_step},
          {"arranged_faces", r.arranged_faces},
          {"windows", r.windows},
          {"window_reaches", r.window_reaches},
          {"window_axes", AxesJson(r.window_axes)},
          {"seconds", r.seconds}};
}

}  // namespace phongpd::cli
