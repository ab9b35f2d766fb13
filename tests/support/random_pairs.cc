// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/pi.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/lattice_boxes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Random = std::mt19937_64;

// Perturbations relative to the size: 1e-12, and up to 1e-8 to go on from the
// grid to what it tells apart.
constexpr double kTiny = 1e-12;
constexpr int kDecades = 5;

int Uniform(int min, int max, Random* random) {
  return std::uniform_int_distribution<int>(min, max)(*random);
}

TriangleMesh Jittered(TriangleMesh mesh, double relative, Random* random) {
  const double size = relative * ComputeBounds(mesh).Diagonal();
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) v[k] += size * unit(*random);
  }
  return mesh;
}

void ForgetTopology(SolidPair* pair) {
  pair->components.reset();
  pair->genus.reset();
  pair->cavities.reset();
}

// Turns an aligned pair into the pose; what rounding may change is no longer
// expected of it.
void Pose(PairKind pose, Random* random, SolidPair* pair) {
  if (pose == PairKind::kAligned) return;
  pair->is_exact = false;
  const Eigen::Matrix3d turn = RandomRotation(random);
  pair->obstacle = Rotated(pair->obstacle, turn);
  if (pose == PairKind::kTurnedApart) {
    pair->robot = Rotated(pair->robot, RandomRotation(random));
    pair->volume.reset();
    ForgetTopology(pair);
    return;
  }
  pair->robot = Rotated(pair->robot, turn);
  if (pose != PairKind::kTilted && pose != PairKind::kJittered) return;
  // Every other pair by the least.
  const int decade = std::max(0, Uniform(1 - kDecades, kDecades - 1, random));
  pair->perturbation = kTiny * std::pow(10.0, decade);
  if (pose == PairKind::kTilted) {
    const Vector3d axis = RandomRotation(random).col(0);
    pair->robot =
        Rotated(pair->robot,
                Eigen::AngleAxisd(pair->perturbation, axis).toRotationMatrix());
  } else {
    pair->robot = Jittered(pair->robot, pair->perturbation, random);
    pair->obstacle = Jittered(pair->obstacle, pair->perturbation, random);
  }
}

SolidPair Exact(TriangleMesh robot, TriangleMesh obstacle) {
  SolidPair pair;
  pair.robot = std::move(robot);
  pair.obstacle = std::move(obstacle);
  pair.is_exact = true;
  return pair;
}

SolidPair VoxelPair(Random* random) {
  const Voxels robot = RandomVoxels(Uniform(0, 9, random) == 0 ? 3 : 2, 0.5,
                                    EdgeContact::kAvoided, random);
  const Voxels obstacle = RandomVoxels(3, 0.5, EdgeContact::kAvoided, random);
  SolidPair pair = Exact(VoxelSurface(robot), VoxelSurface(obstacle));
  pair.volume = LatticeSumVolume(LatticeBoxes(robot), LatticeBoxes(obstacle));
  return pair;
}

SolidPair FromBoxes(const std::vector<LatticeBox>& robot,
                    const std::vector<LatticeBox>& obstacle) {
  SolidPair pair = Exact(BoxesMesh(robot), BoxesMesh(obstacle));
  pair.volume = LatticeSumVolume(robot, obstacle);
  return pair;
}

LatticeBox RandomBox(int largest, Random* random) {
  LatticeBox box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = Uniform(-8, 8, random);
    box.max[k] = box.min[k] + Uniform(1, largest, random);
  }
  return box;
}

// Two boxes apart by exactly the robot along `axes` of the axes.
SolidPair TouchingPair(int axes, Random* random) {
  const LatticeBox robot = RandomBox(6, random), first = RandomBox(8, random);
  LatticeBox second = RandomBox(8, random);
  const int free_axis = Uniform(0, 2, random);
  for (int k = 0; k < 3; ++k) {
    const int length = second.max[k] - second.min[k];
    const int width = robot.max[k] - robot.min[k];
    if (axes == 2 && k == free_axis) {
      second.min[k] = first.min[k] + Uniform(-1, 1, random);
    } else if (Uniform(0, 1, random) == 0) {
      second.min[k] = first.max[k] + width;
    } else {
      second.min[k] = first.min[k] - width - length;
    }
    second.max[k] = second.min[k] + length;
  }
  SolidPair pair = FromBoxes({robot}, {first, second});
  pair.components = 2;
  pair.genus = 0;
  pair.cavities = 0;
  return pair;
}

// The six walls of a hollow box as overlapping lattice boxes.
std::vector<LatticeBox> Walls(const LatticeBox& inner, int thickness) {
  std::vector<LatticeBox> walls;
  for (int k = 0; k < 3; ++k) {
    for (const bool upper : {false, true}) {
      LatticeBox wall = inner;
      for (int j = 0; j < 3; ++j) {
        wall.min[j] -= thickness;
        wall.max[j] += thickness;
      }
      (upper ? wall.min : wall.max)[k] = (upper ? inner.max : inner.min)[k];
      walls.push_back(wall);
    }
  }
  return walls;
}

// A hollow box as one solid: outer surface and cavity.
TriangleMesh Shell(const LatticeBox& inner, int thickness) {
  LatticeBox outer = inner;
  for (int k = 0; k < 3; ++k) {
    outer.min[k] -= thickness;
    outer.max[k] += thickness;
  }
  return Joined(BoxesMesh({outer}), Reversed(BoxesMesh({inner})));
}

SolidPair CavityPair(Random* random) {
  const Voxels robot = RandomVoxels(2, 0.5, EdgeContact::kAvoided, random);
  const LatticeBox inner = {
      {0, 0, 0},
      {Uniform(9, 16, random), Uniform(9, 16, random), Uniform(9, 16, random)}};
  const int thickness = Uniform(1, 4, random);
  SolidPair pair = Exact(VoxelSurface(robot), Shell(inner, thickness));
  pair.volume = LatticeSumVolume(LatticeBoxes(robot), Walls(inner, thickness));
  pair.cavities = 1;  // the robot is smaller than the hollow
  return pair;
}

SolidPair ManyBoxesPair(Random* random) {
  const int n = Uniform(3, 6, random);
  const Voxels world = RandomVoxels(n, std::min(0.5, 100.0 / (n * n * n)),
                                    EdgeContact::kAllowed, random);
  std::vector<LatticeBox> boxes = LatticeBoxes(world);
  if (boxes.size() > 100) boxes.resize(100);
  LatticeBox bounds;
  const int gap = 2 * Uniform(0, 2, random);  // 0: the world touches the shell
  for (int k = 0; k < 3; ++k) {
    bounds.min[k] = 4 * static_cast<int>(world.corner[k]) - gap;
    bounds.max[k] = bounds.min[k] + 4 * n + 2 * gap;
  }
  const LatticeBox robot = RandomBox(5, random);
  SolidPair pair =
      Exact(BoxesMesh({robot}), Joined(BoxesMesh(boxes), Shell(bounds, 2)));
  const std::vector<LatticeBox> walls = Walls(bounds, 2);
  boxes.insert(boxes.end(), walls.begin(), walls.end());
  pair.volume = LatticeSumVolume({robot}, boxes);
  return pair;
}

// A peg that fits a plate's hole up to a relative clearance.
SolidPair PegPair(Random* random) {
  const int exponent = Uniform(2, 9, random);  // 2: an exact fit
  const double clearance = exponent == 2 ? 0.0 : std::pow(10.0, -exponent);
  const double side = 0.25 * Uniform(12, 20, random);
  const double thickness = 0.25 * Uniform(1, 8, random);
  const double hole = 0.25 * Uniform(2, 8, random);
  const double peg = hole * (1.0 - clearance);
  const double length = 0.25 * Uniform(1, 12, random);
  const double height = thickness + length;
  SolidPair pair;
  if (Uniform(0, 1, random) == 0) {
    const Vector3d half(peg / 2, peg / 2, length / 2);
    pair.robot = MakeBox(-half, half);
    pair.obstacle = MakePlateWithHole(side, thickness, hole);
    pair.volume =
        height * ((side + peg) * (side + peg) - (hole - peg) * (hole - peg));
    pair.is_exact = clearance == 0.0;
  } else {
    const int sides = 4 * Uniform(1, 6, random);
    pair.robot = MakePrism(peg / 2, length, sides);
    pair.obstacle = MakePlateWithRoundHole(side, thickness, hole / 2, sides);
    const double unit = 0.5 * sides * std::sin(2 * kPi / sides);
    const double slot = (hole - peg) / 2;
    pair.volume = height * (side * side + 2 * side * peg +
                            unit * (peg * peg / 4 - slot * slot));
  }
  if (clearance > 0.0) {
    pair.genus = 1;
    pair.components = 1;
    pair.cavities = 0;
  } else if (pair.is_exact) {
    pair.genus = 0;
    pair.components = 1;
  }
  return pair;
}

SolidPair MakeAligned(PairKind kind, Random* random) {
  switch (kind) {
    case PairKind::kPeg:
      return PegPair(random);
    case PairKind::kEdgeTouch:
      return TouchingPair(2, random);
    case PairKind::kVertexTouch:
      return TouchingPair(3, random);
    case PairKind::kCavity:
      return CavityPair(random);
    case PairKind::kManyBoxes:
      return ManyBoxesPair(random);
    default:
      return VoxelPair(random);
  }
}

}  // namespace

const std::vector<PairKind>& AllPairKinds() {
  static const std::vector<PairKind> kinds = {
      PairKind::kAligned,   PairKind::kTurnedAlike, PairKind::kTurnedApart,
      PairKind::kTilted,    PairKind::kJittered,    PairKind::kPeg,
      PairKind::kEdgeTouch, PairKind::kVertexTouch, PairKind::kCavity,
      PairKind::kManyBoxes};
  return kinds;
}

std::string Name(PairKind kind) {
  switch (kind) {
    case PairKind::kAligned:
      return "voxels, aligned";
    case PairKind::kTurnedAlike:
      return "voxels, turned alike";
    case PairKind::kTurnedApart:
      return "voxels, turned apart";
    case PairKind::kTilted:
      return "voxels, alike and tilted";
    case PairKind::kJittered:
      return "voxels, alike and jittered";
    case PairKind::kPeg:
      return "pegs in their holes";
    case PairKind::kEdgeTouch:
      return "touching along an edge";
    case PairKind::kVertexTouch:
      return "touching in a vertex";
    case PairKind::kCavity:
      return "inside a cavity";
    case PairKind::kManyBoxes:
      return "worlds of many boxes";
  }
  return "";
}

SolidPair MakeRandomPair(PairKind kind, std::uint64_t seed) {
  Random random(seed);
  SolidPair pair = MakeAligned(kind, &random);
  const bool is_voxels = kind <= PairKind::kJittered;
  const PairKind pose =
      is_voxels ? kind : AllPairKinds()[static_cast<std::size_t>(seed % 5)];
  Pose(pose, &random, &pair);
  const bool touches =
      kind == PairKind::kEdgeTouch || kind == PairKind::kVertexTouch;
  const bool may_open = touches || pair.perturbation > kTiny;
  if (may_open && pose != PairKind::kAligned) ForgetTopology(&pair);
  return pair;
}

}  // namespace phongpd
