// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/window_phong.h"
#include "planners/world/length.h"

namespace phongpd::cli {

// PhongPD at the poses of `phongpd depth`, where a smoothing length asks for
// it.
class DepthPhong {
 public:
  // `a` and `b` as DepthQuery takes them.  Throws InputError for a length that
  // is none.
  DepthPhong(const std::string& smoothing_length, const TriangleMesh& a,
             const TriangleMesh& b, const ContactSpaceOptions& options);

  // Poses of one orientation in a row share what is modelled.  Throws
  // InputError for a length that is too long there, BuildRefusal as
  // WindowPhong does.
  WindowPhongResult At(const RobotPose& pose);

  // The last answer for programs, in a row's cells, and for people.
  nlohmann::ordered_json AsJson(const WindowPhongResult& result) const;
  static const char* const kColumns;  // begins with a comma
  static std::string AsCells(const WindowPhongResult& result);
  std::string AsSentence(const WindowPhongResult& result) const;

 private:
  Length length_;
  TriangleMesh a_, b_;
  ContactSpaceOptions options_;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  ResolvedLength resolved_;
  std::optional<WindowPhong> phong_;  // of that orientation
};

}  // namespace phongpd::cli
