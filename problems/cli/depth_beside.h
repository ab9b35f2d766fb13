// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/window_phong.h"
#include "core/projection/window_smoothed.h"
#include "planners/world/penetration_spec.h"

namespace phongpd::cli {

// Another metric's answer at the poses of `phongpd depth`, beside the Euclidean
// one, where it is asked for.
class DepthBeside {
 public:
  // A metric with a smoothing length.  `a` and `b` as DepthQuery takes them.
  // Throws InputError for a length that is none.
  DepthBeside(MetricKind metric, const std::string& smoothing_length,
              const TriangleMesh& a, const TriangleMesh& b,
              const ContactSpaceOptions& options);

  // Poses of one orientation in a row share what is modelled.  Throws
  // InputError for a length that is too long there, BuildRefusal as
  // WindowPhong does.
  WindowResult At(const RobotPose& pose);

  // Of both smoothed metrics "smoothed": its key in JSON, and what its columns
  // begin with.
  const char* Key() const;
  // The last answer for programs, in a row's cells, and for people.
  nlohmann::ordered_json AsJson(const WindowResult& result) const;
  std::string Columns() const;  // begins with a comma
  static std::string AsCells(const WindowResult& result);
  std::string AsSentence(const WindowResult& result) const;

 private:
  PenetrationSpec spec_;
  TriangleMesh a_, b_;
  ContactSpaceOptions options_;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  ResolvedLength resolved_;
  // One of them, of that orientation.
  std::optional<WindowPhong> phong_;
  std::optional<WindowSmoothed> smoothed_;
};

}  // namespace phongpd::cli
