// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/wrench_cases.h"

#include <random>
#include <utility>

#include "core/bvh/triangle_bvh.h"
#include "core/pi.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = kPi / 3.0;

TriangleMesh Centred(TriangleMesh mesh) {
  const Vector3d center = ComputeBounds(mesh).Center();
  return Translated(std::move(mesh), -center);
}

Vector3d InnerPoint(const TriangleMesh& mesh, std::mt19937_64* random) {
  const TriangleBvh bvh(mesh);
  const BoundingBox box = ComputeBounds(mesh);
  for (;;) {
    const Vector3d x = RandomPoint(box, random);
    if (bvh.WindingNumber(x) > 0) return x;
  }
}

}  // namespace

const char* ToString(WrenchMotion motion) {
  return motion == WrenchMotion::kTurn ? "turn" : "turn and move";
}

std::vector<WrenchPair> WrenchPairs(std::uint64_t first_seed) {
  const std::vector<std::pair<std::string, TriangleMesh>> robots = {
      {"bar", MakeBox({-0.6, -0.2, -0.15}, {0.6, 0.2, 0.15})},
      {"peg", MakePrism(0.25, 1.4, 6)},
      {"small L", Centred(MakeL(1.0, 0.3, 0.3))},
      {"cone", Centred(MakeCone(0.4, 1.2, 6))},
      {"cross", MakeAxes(0.6, 0.12)}};
  const std::vector<std::pair<std::string, TriangleMesh>> obstacles = {
      {"box", MakeBox({-0.9, -0.7, -0.5}, {0.9, 0.7, 0.5})},
      {"L", MakeL(2.0, 0.5, 0.6)},
      {"U", MakeU(2.0, 0.4, 0.8)},
      {"plate with hole", MakePlateWithHole(2.4, 0.3, 0.8)},
      {"axes", MakeAxes(1.0, 0.25)},
      {"torus", MakeTorus(0.9, 0.3, 10, 6)},
      {"blob", MakeBlob(1.0, 1, 0.35, 32000)}};
  // Of 35 every combination that leaves out some of each alike.
  std::vector<WrenchPair> pairs;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    for (std::size_t k = 0; k < robots.size(); ++k) {
      if (pairs.size() == 20 || (i + k) % 5 > 2) continue;
      const auto& [robot, a] = robots[k];
      const auto& [obstacle, b] = obstacles[i];
      pairs.push_back({robot + " in " + obstacle, MakeSolid(a, robot),
                       MakeSolid(b, obstacle), first_seed + pairs.size()});
    }
  }
  return pairs;
}

std::vector<RobotPose> WrenchPoses(const WrenchPair& pair, WrenchMotion motion,
                                   int steps) {
  std::mt19937_64 random(pair.seed);
  const Eigen::Quaterniond start(RandomRotation(&random));
  std::normal_distribution<double> normal;
  const Vector3d axis = RandomVector(&normal, &random).normalized();
  const Vector3d fixed = InnerPoint(pair.robot.mesh(), &random);
  const Vector3d from = InnerPoint(pair.obstacle.mesh(), &random);
  const Vector3d to = motion == WrenchMotion::kTurn
                          ? from
                          : InnerPoint(pair.obstacle.mesh(), &random);
  std::vector<RobotPose> poses;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    RobotPose pose;
    pose.orientation = Eigen::AngleAxisd(t * kTurn, axis) * start;
    pose.orientation.normalize();
    pose.position = from + t * (to - from) - pose.orientation * fixed;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace phongpd::bench
