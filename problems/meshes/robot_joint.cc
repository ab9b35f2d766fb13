// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/robot_joint.h"

#include <tinyxml2.h>

#include <map>
#include <vector>

namespace phongpd {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

std::string AttributeOf(const XMLElement* element, const char* name,
                        const char* otherwise) {
  const char* const text =
      element == nullptr ? nullptr : element->Attribute(name);
  return text == nullptr ? otherwise : text;
}

double NumberOf(const RobotFile& robot, const XMLElement* element,
                const char* name, const char* otherwise) {
  return robot.Numbers(AttributeOf(element, name, otherwise), name, 1)[0];
}

}  // namespace

Joint ReadJoint(const RobotFile& robot, const XMLElement& element) {
  Joint joint;
  joint.name = RobotFile::NameOf(element);
  const std::string type = AttributeOf(&element, "type", "");
  const std::map<std::string, Joint::Kind> kinds = {
      {"fixed", Joint::kFixed},
      {"revolute", Joint::kRevolute},
      {"continuous", Joint::kContinuous},
      {"prismatic", Joint::kPrismatic}};
  const auto kind = kinds.find(type);
  if (kind == kinds.end()) {
    RefuseJoint(robot, joint.name,
                "expected the type fixed, revolute, continuous or prismatic, "
                "found '" +
                    type.substr(0, 40) + "'; take a link by #link");
  }
  joint.kind = kind->second;
  joint.parent = AttributeOf(element.FirstChildElement("parent"), "link", "");
  joint.child = AttributeOf(element.FirstChildElement("child"), "link", "");
  joint.origin = robot.OriginOf(element);
  if (!joint.Moves()) return joint;
  const std::vector<double> axis = robot.Numbers(
      AttributeOf(element.FirstChildElement("axis"), "xyz", "1 0 0"),
      "axis xyz", 3);
  joint.axis = Vector3d(axis[0], axis[1], axis[2]).stableNormalized();
  if (!(joint.axis.norm() > 0.5)) {
    RefuseJoint(robot, joint.name,
                "expected an <axis> with a direction, found 0 0 0");
  }
  const XMLElement* const limit = element.FirstChildElement("limit");
  joint.low = NumberOf(robot, limit, "lower", "0");
  joint.high = NumberOf(robot, limit, "upper", "0");
  if (const XMLElement* mimic = element.FirstChildElement("mimic")) {
    joint.mimicked = AttributeOf(mimic, "joint", "");
    joint.multiplier = NumberOf(robot, mimic, "multiplier", "1");
    joint.offset = NumberOf(robot, mimic, "offset", "0");
  }
  return joint;
}

void RefuseJoint(const RobotFile& robot, const std::string& joint,
                 const std::string& what) {
  robot.Refuse("joint '" + joint.substr(0, 80) + "': " + what);
}

}  // namespace phongpd
