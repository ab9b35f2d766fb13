// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "problems/meshes/robot_file.h"

namespace phongpd {

// A joint of URDF; the child's frame is that of its joint.
struct Joint {
  enum Kind { kFixed, kRevolute, kContinuous, kPrismatic };

  std::string name, parent, child;
  Kind kind = kFixed;
  Place origin;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit
  double low = 0.0, high = 0.0;  // of revolute and prismatic ones
  std::string mimicked;          // the joint it follows; empty: none
  double multiplier = 1.0, offset = 0.0;

  bool Moves() const { return kind != kFixed; }
  bool HasLimits() const { return kind == kRevolute || kind == kPrismatic; }
};

// Reads a joint element.  Throws InputError for one of another type, without an
// axis that it needs, or with what is no number.
Joint ReadJoint(const RobotFile& robot, const tinyxml2::XMLElement& element);

// Throws InputError "FILE: joint 'NAME': what".
[[noreturn]] void RefuseJoint(const RobotFile& robot, const std::string& joint,
                              const std::string& what);

}  // namespace phongpd
