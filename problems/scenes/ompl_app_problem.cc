// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/ompl_app_problem.h"

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_range.h"
#include "core/number_text.h"
#include "core/solid/solid.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/files_beside.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr char kSection[] = "[problem]";

std::string Trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// The keys of the section [problem].
class Problem {
 public:
  Problem(const std::string& text, std::string file) : file_(std::move(file)) {
    std::istringstream lines(text);
    bool is_in = false;
    for (std::string line; std::getline(lines, line);) {
      line = Trimmed(line.substr(0, line.find('#')));
      if (!line.empty() && line[0] == '[') is_in = line == kSection;
      const std::size_t equals = line.find('=');
      if (!is_in || equals == std::string::npos) continue;
      values_.emplace(Trimmed(line.substr(0, equals)),
                      Trimmed(line.substr(equals + 1)));
    }
  }

  bool Has(const std::string& key) const { return values_.count(key) > 0; }

  std::string Text(const std::string& key, const std::string& expected) const {
    const auto at = values_.find(key);
    if (at == values_.end() || at->second.empty()) {
      Fail(key, expected, "nothing");
    }
    return at->second;
  }

  double Number(const std::string& key) const {
    return ParseDouble(Text(key, "a number"), file_ + ": " + key);
  }
  Vector3d Point(const std::string& key) const {
    return {Number(key + ".x"), Number(key + ".y"), Number(key + ".z")};
  }

  RobotPose Pose(const std::string& end) const {
    RobotPose pose;
    pose.position = Point(end);
    const double angle = Number(end + ".theta");
    if (angle == 0.0) return pose;  // about whatever axis
    const Vector3d axis = Point(end + ".axis");
    if (!(axis.norm() > 0.0)) {
      Fail(end + ".axis", "a direction to turn about", "0 0 0");
    }
    pose.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
    return pose;
  }

  [[noreturn]] void Fail(const std::string& key, const std::string& expected,
                         const std::string& found) const {
    throw InputError(file_ + ": " + key + ": expected " + expected +
                     ", found " + found);
  }

  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::map<std::string, std::string> values_;
};

// The judge takes triangles as they are; what has no inside is told.
void NoteOpenSurface(const TriangleMesh& mesh, const std::string& name,
                     std::vector<std::string>* warnings) {
  try {
    MakeSolid(mesh, name);
  } catch (const InputError& error) {
    warnings->push_back(std::string(error.what()) +
                        "; its triangles are judged as they are, and have an "
                        "inside only if they are closed");
  }
}

// A mesh file beside the problem's.
OmplAppMesh MeshOf(const Problem& problem, const std::string& key,
                   const std::string& root, TurningScene* scene) {
  const std::string name = problem.Text(key, "a mesh file beside this one");
  fs::path path = fs::path(problem.file()).parent_path() / name;
  if (!root.empty()) {
    const std::optional<fs::path> below = PathBelow(path.string(), root);
    if (!below) {
      problem.Fail(key, "a mesh file below the root " + root,
                   name + ", which is not; move it there");
    }
    path = fs::path(root) / *below;
  }
  try {
    OmplAppMesh read = ReadOmplAppMesh(path.string(), &scene->warnings, root);
    RequireInRange(read.mesh, path.string());
    NoteOpenSurface(read.mesh, path.string(), &scene->warnings);
    return read;
  } catch (const InputError& error) {
    throw InputError(problem.file() + ": " + key + ": " + error.what());
  }
}

}  // namespace

bool IsOmplAppProblem(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = Trimmed(line.substr(0, line.find('#')));
    if (!line.empty() && line[0] == '[') return line == kSection;
    if (!line.empty() && line[0] != ';') return false;
  }
  return false;
}

TurningScene ParseOmplAppProblem(const std::string& text,
                                 const std::string& path,
                                 const std::string& root) {
  const Problem problem(text, path);
  if (problem.Has("control") || problem.Has("type")) {
    problem.Fail(problem.Has("control") ? "control" : "type",
                 "none of a rigid body", "one of another vehicle");
  }
  TurningScene scene;
  scene.name = fs::path(path).stem().string();
  // Numbers first: what is wrong with them is said before long work.
  scene.start = problem.Pose("start");
  scene.goal = problem.Pose("goal");
  if (problem.Has("volume.min.x")) {
    scene.bounds = {problem.Point("volume.min"), problem.Point("volume.max")};
    if (!(scene.bounds.min.array() < scene.bounds.max.array()).all()) {
      problem.Fail("volume", "min below max in each coordinate", "others");
    }
  }
  OmplAppMesh robot = MeshOf(problem, "robot", root, &scene);
  for (Vector3d& vertex : robot.mesh.vertices) vertex -= robot.center;
  scene.robot = std::move(robot.mesh);
  scene.obstacles.push_back(
      {"world", MeshOf(problem, "world", root, &scene).mesh});
  return scene;
}

}  // namespace phongpd
