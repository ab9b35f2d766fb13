// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/robot_pose.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "core/mesh/counted.h"
#include "core/nearest_name.h"
#include "problems/meshes/robot_file.h"
#include "problems/meshes/robot_joint.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxLinks = 5000;

// The joints of a robot, and what they are set to.
class JointTree {
 public:
  explicit JointTree(const RobotFile& robot) : robot_(robot) {
    const XMLElement& top = robot.robot();
    for (const XMLElement* at = top.FirstChildElement("link"); at != nullptr;
         at = at->NextSiblingElement("link")) {
      AddLink(RobotFile::NameOf(*at));
    }
    for (const XMLElement* at = top.FirstChildElement("joint"); at != nullptr;
         at = at->NextSiblingElement("joint")) {
      Add(ReadJoint(robot, *at));
    }
    CheckTree();
  }

  // "JOINT=VALUE,JOINT=VALUE"; all others are at 0.
  void Set(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      SetOne(text.substr(at, end - at));
      at = end + 1;
    }
    for (const Joint& joint : joints_) CheckLimits(joint);
  }

  // Of a link's frame in the root's.
  Place PlaceOf(const std::string& link) const {
    Place place;
    for (const Joint* joint = ParentOf(link); joint != nullptr;
         joint = ParentOf(joint->parent)) {
      place = joint->origin * MotionOf(*joint) * place;
    }
    return place;
  }

  const std::string& base() const { return base_; }

  // "shoulder = 0.5, elbow = 0".
  std::string Described() const {
    std::string text;
    for (const Joint& joint : joints_) {
      if (!joint.Moves()) continue;
      text += (text.empty() ? "" : ", ") + joint.name + " = " +
              FormatDouble(ValueOf(joint));
    }
    return text.empty() ? "without a joint that moves" : "at " + text;
  }

 private:
  [[noreturn]] void Refuse(const std::string& joint,
                           const std::string& what) const {
    RefuseJoint(robot_, joint, what);
  }

  void Add(Joint joint) {
    if (!by_name_.emplace(joint.name, joints_.size()).second) {
      Refuse(joint.name, "expected one of this name, found several");
    }
    if (!by_child_.emplace(joint.child, joints_.size()).second) {
      Refuse(joint.name, "expected one parent of the link '" + joint.child +
                             "', found several");
    }
    joints_.push_back(std::move(joint));
  }

  void AddLink(const std::string& link) {
    if (std::count(links_.begin(), links_.end(), link) > 0) {
      robot_.Refuse("expected one link '" + link + "', found several");
    }
    links_.push_back(link);
    if (links_.size() <= kMaxLinks) return;
    robot_.Refuse("expected at most " + std::to_string(kMaxLinks) +
                  " links, found more");
  }

  const Joint* ParentOf(const std::string& link) const {
    const auto found = by_child_.find(link);
    return found == by_child_.end() ? nullptr : &joints_[found->second];
  }

  void CheckTree() {
    std::vector<std::string> roots;
    for (const Joint& joint : joints_) {
      for (const std::string& link : {joint.parent, joint.child}) {
        if (std::count(links_.begin(), links_.end(), link) == 0) {
          Refuse(joint.name, "expected a parent and a child link, found '" +
                                 link.substr(0, 80) + "', which is no link");
        }
      }
      FollowMimics(joint);
    }
    for (const std::string& link : links_) {
      if (ParentOf(link) == nullptr) roots.push_back(link);
      std::size_t steps = 0;
      for (const Joint* at = ParentOf(link); at != nullptr;
           at = ParentOf(at->parent)) {
        if (++steps > joints_.size()) {
          Refuse(at->name, "expected a tree of links, found a circle");
        }
      }
    }
    if (roots.size() != 1) {
      robot_.Refuse("expected one link without a parent, found " +
                    std::to_string(roots.size()) +
                    (roots.empty() ? "" : ": " + Shortened(Joined(roots))));
    }
    base_ = roots.front();
  }

  // Down to the joint that has a value of its own.
  const Joint& FollowMimics(const Joint& joint) const {
    const Joint* at = &joint;
    for (std::size_t steps = 0; !at->mimicked.empty(); ++steps) {
      const auto found = by_name_.find(at->mimicked);
      if (found == by_name_.end()) {
        Refuse(joint.name, "expected a joint to mimic, found none named '" +
                               at->mimicked.substr(0, 80) + "'");
      }
      if (steps > joints_.size()) {
        Refuse(joint.name, "expected a joint to mimic, found a circle");
      }
      at = &joints_[found->second];
    }
    return *at;
  }

  void SetOne(const std::string& setting) {
    const std::size_t equals = setting.rfind('=');
    if (equals == std::string::npos || equals == 0) {
      robot_.Refuse("expected FILE@JOINT=VALUE,JOINT=VALUE, found '" +
                    setting.substr(0, 80) + "'");
    }
    const std::string name = setting.substr(0, equals);
    const auto found = by_name_.find(name);
    std::vector<std::string> movable;
    for (const Joint& joint : joints_) {
      if (joint.Moves() && joint.mimicked.empty()) {
        movable.push_back(joint.name);
      }
    }
    if (found == by_name_.end()) {
      Refuse(name,
             "expected a joint of the file, found none of this name; "
             "there are: " +
                 Shortened(Joined(movable)) + DidYouMean(name, movable));
    }
    const Joint& joint = joints_[found->second];
    if (!joint.Moves())
      Refuse(name, "expected one that moves, found a fixed one");
    if (!joint.mimicked.empty()) {
      Refuse(name,
             "expected one with a value of its own, found one that "
             "mimics; set '" +
                 FollowMimics(joint).name + "'");
    }
    const double value = ParseDouble(setting.substr(equals + 1),
                                     robot_.file() + ": joint '" + name + "'");
    if (!values_.emplace(name, value).second) {
      Refuse(name, "expected one value, found two");
    }
  }

  double ValueOf(const Joint& joint) const {
    if (!joint.mimicked.empty()) {
      return joint.multiplier * ValueOf(joints_[by_name_.at(joint.mimicked)]) +
             joint.offset;
    }
    const auto found = values_.find(joint.name);
    return found == values_.end() ? 0.0 : found->second;
  }

  void CheckLimits(const Joint& joint) const {
    if (!joint.HasLimits()) return;
    const double value = ValueOf(joint);
    if (value >= joint.low && value <= joint.high) return;
    const bool is_given =
        values_.count(joint.name) > 0 || !joint.mimicked.empty();
    Refuse(joint.name, "expected a value in [" + FormatDouble(joint.low) +
                           ", " + FormatDouble(joint.high) + "] " +
                           (joint.kind == Joint::kPrismatic ? "m" : "rad") +
                           ", found " + FormatDouble(value) +
                           (is_given ? "" : ", which it has unless it is set"));
  }

  Place MotionOf(const Joint& joint) const {
    Place motion;
    if (joint.kind == Joint::kPrismatic) {
      motion.position = ValueOf(joint) * joint.axis;
    } else if (joint.Moves()) {
      motion.rotation =
          Eigen::AngleAxisd(ValueOf(joint), joint.axis).toRotationMatrix();
    }
    return motion;
  }

  const RobotFile& robot_;
  std::vector<Joint> joints_;
  std::vector<std::string> links_;
  std::map<std::string, std::size_t> by_name_, by_child_;
  std::map<std::string, double> values_;
  std::string base_;
};

}  // namespace

TriangleMesh PoseRobot(RobotFile* robot, const std::string& text,
                       std::vector<std::string>* warnings) {
  if (robot->IsSdf()) {
    robot->Refuse(
        "expected URDF for a pose by its joints, found SDF; take a link by "
        "#link");
  }
  if (robot->links().empty()) {
    robot->Refuse("expected links with <collision>, found none");
  }
  JointTree joints(*robot);
  joints.Set(text);
  TriangleMesh all;
  for (const XMLElement* const link : robot->links()) {
    AppendPlaced(robot->ShapesOf(*link),
                 joints.PlaceOf(RobotFile::NameOf(*link)), &all);
  }
  warnings->push_back(robot->file() + ": " +
                      Counted(robot->shape_count(), "collision shape") +
                      " of " + Counted(robot->links().size(), "link") + " " +
                      joints.Described() + ", in the frame of '" +
                      joints.base() + "', metres" + robot->Roundness());
  return all;
}

}  // namespace phongpd
