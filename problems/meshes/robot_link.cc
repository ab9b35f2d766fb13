// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/robot_link.h"

#include <tinyxml2.h>

#include <algorithm>

#include "core/mesh/counted.h"
#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/files_beside.h"
#include "problems/meshes/robot_file.h"
#include "problems/meshes/robot_pose.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using tinyxml2::XMLElement;

// The link of that name; of any name if it is empty and there is one.
const XMLElement& Find(const RobotFile& robot, const std::string& link) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(robot.file() + (link.empty() ? "" : "#" + link) + ": " +
                     what);
  };
  std::vector<std::string> names;
  const XMLElement* found = nullptr;
  int count = 0;
  for (const XMLElement* const one : robot.links()) {
    names.push_back(RobotFile::NameOf(*one));
    if (!link.empty() && names.back() != link) continue;
    found = one;
    ++count;
  }
  if (count == 1) return *found;
  if (names.empty()) refuse("expected links with <collision>, found none");
  if (count > 1 && !link.empty()) {
    refuse("expected one link of this name, found " + std::to_string(count));
  }
  const std::string all = "there are: " + Shortened(Joined(names));
  if (link.empty()) {
    refuse(
        "expected FILE#link, or FILE@joint=value,... for all of them, found "
        "no link's name; " +
        all);
  }
  refuse("expected a link with <collision>, found none of this name; " + all +
         DidYouMean(link, names));
  return *found;
}

TriangleMesh ShapesOfLink(RobotFile* robot, const std::string& name,
                          std::vector<std::string>* warnings) {
  const XMLElement& link = Find(*robot, name);
  TriangleMesh mesh = robot->ShapesOf(link);
  warnings->push_back(robot->file() + ": " +
                      Counted(robot->shape_count(), "collision shape") +
                      " of link '" + RobotFile::NameOf(link) +
                      "' in its own frame, metres; no joint or link pose is "
                      "applied" +
                      robot->Roundness());
  return mesh;
}

}  // namespace

TriangleMesh ReadRobotLink(const std::string& path, const std::string& root,
                           std::vector<std::string>* warnings) {
  constexpr std::uintmax_t kMaxRobotBytes = std::uintmax_t{1} << 26;
  const std::size_t end = FilePartOf(path);
  const std::string file = path.substr(0, end);
  return ParseRobot(
      ReadMeshFile(file, root, "a URDF or SDF file", kMaxRobotBytes), file,
      path.substr(end), root, warnings);
}

TriangleMesh ParseRobot(const std::string& bytes, const std::string& file,
                        const std::string& part, const std::string& root,
                        std::vector<std::string>* warnings) {
  RobotFile robot(file, bytes, root, warnings);
  TriangleMesh mesh;
  if (part.rfind('@', 0) == 0) {
    mesh = PoseRobot(&robot, part.substr(1), warnings);
  } else {
    mesh = ShapesOfLink(&robot, part.empty() ? part : part.substr(1), warnings);
  }
  const bool is_finite =
      std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                  [](const Eigen::Vector3d& v) { return v.allFinite(); });
  if (!is_finite) {
    robot.Refuse("expected finite coordinates, found lengths that overflow");
  }
  return mesh;
}

}  // namespace phongpd
