// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/model_spaces.h"

#include <filesystem>

#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr char kBall[] = "ball";
constexpr char kCube[] = "turned cube";
constexpr double kRobotSize = 0.2;  // diagonals, over the obstacle's

struct Pair {
  const char* robot;  // kBall, kCube or a model
  const char* obstacle;
};

constexpr Pair kPairs[] = {{kBall, "joint"}, {"dragknob", "anchor"},
                           {kCube, "rotor"}, {kBall, "pinion"},
                           {kBall, "hand"},  {"pipe", "helmet"},
                           {"u", "spool"},   {kBall, "elephant"}};

bool IsModel(const std::string& name) { return name != kBall && name != kCube; }

class Folder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}

  bool Has(const std::string& name) const {
    return !IsModel(name) || std::filesystem::exists(FileOf(name));
  }
  TriangleMesh Read(const std::string& name) const {
    if (name == kBall) return MakeIcoBall(1.0, 1);
    if (name == kCube) {
      const Vector3d half = Vector3d::Ones();
      return Rotated(MakeBox(-half, half), GenericRotation());
    }
    return ReadSolid(FileOf(name)).mesh();
  }

 private:
  std::string FileOf(const std::string& name) const {
    return path_ + "/" + name + ".off";
  }

  std::string path_;
};

TriangleMesh OfDiagonal(TriangleMesh mesh, double diagonal) {
  const BoundingBox box = ComputeBounds(mesh);
  return Scaled(Translated(std::move(mesh), -box.Center()),
                diagonal / box.Diagonal());
}

}  // namespace

std::vector<MotionSpace> ModelSpaces(const std::string& path,
                                     std::vector<std::string>* missing) {
  const Folder folder(path);
  std::vector<MotionSpace> spaces;
  for (const Pair& pair : kPairs) {
    bool is_there = true;
    for (const char* name : {pair.robot, pair.obstacle}) {
      if (folder.Has(name)) continue;
      missing->push_back(std::string(name) + ".off");
      is_there = false;
    }
    if (!is_there) continue;
    const TriangleMesh obstacle = OfDiagonal(folder.Read(pair.obstacle), 1.0);
    const TriangleMesh robot = OfDiagonal(folder.Read(pair.robot), kRobotSize);
    spaces.push_back({std::string(pair.robot) + " + " + pair.obstacle,
                      BuildContactSpace(robot, obstacle)});
  }
  return spaces;
}

}  // namespace phongpd::bench
