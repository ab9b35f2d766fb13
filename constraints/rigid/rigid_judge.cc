// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_judge.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <string>
#include <utility>

#include "constraints/rigid/rigid_pair.h"
#include "constraints/rigid/rigid_tree.h"
#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_range.h"
#include "core/number_text.h"
#include "core/solid/mesh_examination.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::FramedMotion;
using internal::PairSight;
using internal::RigidFrame;
using internal::RigidNode;
using internal::RigidPose;
using internal::RigidTree;

// Of half the robot's diagonal, and of the rounding: motions below are not
// halved further.
constexpr double kResolution = 1e-7;
constexpr double kSlacks = 4.0;
constexpr double kMaxSize = 1e100;
// Halves of halves; the time of the middle is exact.
constexpr int kMaxLevel = 50;
// Poses of so many levels are kept.
constexpr int kKeptLevels = 8;
// What is undecided is looked at further, for a collision, but not forever.
constexpr long kFurtherTests = 10'000;

// Where a triangle of all comes from.
struct Origin {
  int mesh = -1, triangle = -1;
};

// Robot or obstacles: all their triangles, and what can hold or be held.
struct Side {
  RigidTree tree;
  std::vector<Origin> origins;
  std::vector<TriangleBvh> solids;  // those that are closed
  std::vector<Vector3d> seeds;      // a corner of each component
};

void RequireMeshes(const std::vector<TriangleMesh>& meshes,
                   const std::string& what) {
  if (meshes.empty()) {
    throw InputError("rigid judge: expected a mesh of the " + what +
                     ", found none");
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string name =
        "rigid judge: " + what +
        (meshes.size() == 1 ? "" : ", mesh " + std::to_string(i));
    const MeshReport report = internal::ExamineTopology(meshes[i]);
    if (report.bad_indices > 0) {
      throw InputError(name + ": expected indices of its " +
                       std::to_string(meshes[i].vertices.size()) +
                       " vertices, found " +
                       std::to_string(report.bad_indices) + " others");
    }
    if (report.non_finite_vertices > 0) {
      throw InputError(name + ": expected finite coordinates, found " +
                       std::to_string(report.non_finite_vertices) +
                       " vertices with NaN or infinity");
    }
    if (meshes[i].triangles.empty()) {
      throw InputError(name + ": expected triangles, found none");
    }
    RequireInRange(meshes[i], name);
  }
}

bool IsClosed(const TriangleMesh& mesh) {
  return internal::BadEdges(internal::ExamineTopology(mesh)) == 0;
}

BoundingBox BoundsOf(const std::vector<TriangleMesh>& meshes) {
  BoundingBox all = ComputeBounds(meshes.front());
  for (const TriangleMesh& mesh : meshes) {
    const BoundingBox box = ComputeBounds(mesh);
    all.min = all.min.cwiseMin(box.min);
    all.max = all.max.cwiseMax(box.max);
  }
  return all;
}

RigidFrame FrameOf(const std::vector<TriangleMesh>& robot,
                   const std::vector<TriangleMesh>& obstacles) {
  const BoundingBox box = BoundsOf(obstacles), own = BoundsOf(robot);
  RigidFrame frame;
  frame.center = box.Center();
  const double size =
      std::max((box.max - frame.center).maxCoeff(),
               own.min.cwiseAbs().cwiseMax(own.max.cwiseAbs()).maxCoeff());
  int exponent = 0;
  std::frexp(size, &exponent);
  // A power of two that is finite, also for the smallest numbers.
  if (size > 0.0) frame.scale = std::ldexp(1.0, -std::max(exponent, -1000));
  return frame;
}

Side MakeSide(const std::vector<TriangleMesh>& meshes, const Vector3d& center,
              double scale) {
  Side side;
  std::vector<TriangleCorners> corners;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    TriangleMesh mesh = meshes[i];
    for (Vector3d& v : mesh.vertices) v = (v - center) * scale;
    int count = 0;
    const std::vector<int> label = LabelComponents(mesh, &count);
    std::vector<bool> has_seed(static_cast<std::size_t>(count), false);
    const std::vector<TriangleCorners> own = CornersOf(mesh);
    for (std::size_t k = 0; k < own.size(); ++k) {
      side.origins.push_back({static_cast<int>(i), static_cast<int>(k)});
      const auto component = static_cast<std::size_t>(label[k]);
      if (!has_seed[component]) side.seeds.push_back(own[k][0]);
      has_seed[component] = true;
    }
    corners.insert(corners.end(), own.begin(), own.end());
    if (IsClosed(meshes[i])) side.solids.emplace_back(mesh);
  }
  side.tree = internal::MakeRigidTree(std::move(corners));
  return side;
}

bool IsInside(const Side& side, const Vector3d& x) {
  return std::any_of(
      side.solids.begin(), side.solids.end(),
      [&](const TriangleBvh& solid) { return solid.WindingNumber(x) > 0; });
}

// Poses at the middles of the parts of the way, those of the first levels kept.
class MiddlePoses {
 public:
  explicit MiddlePoses(const FramedMotion& motion) : motion_(motion) {}

  // Of part k of 2^level; holds until the next call.
  const RigidPose& At(int level, double middle, long k) {
    if (level >= kKeptLevels) {
      other_ = motion_.At(middle);
      return other_;
    }
    const auto index = static_cast<std::size_t>((1L << level) + k);
    if (!is_known_[index]) {
      kept_[index] = motion_.At(middle);
      is_known_[index] = true;
    }
    return kept_[index];
  }

 private:
  static constexpr std::size_t kKept = std::size_t{1} << kKeptLevels;

  const FramedMotion& motion_;
  std::bitset<kKept> is_known_;
  RigidPose kept_[kKept];
  RigidPose other_;
};

// One motion: a stack of pairs of nodes, each with its own part of the way.
class MotionSearch {
 public:
  MotionSearch(const Side& robot, const Side& obstacle,
               const FramedMotion& motion, long max_tests)
      : robot_(robot),
        obstacle_(obstacle),
        motion_(motion),
        max_tests_(max_tests),
        resolution_(
            std::max(kResolution * robot.tree.size, kSlacks * motion.slack())),
        poses_(motion) {}

  RigidCheck Run() {
    check_.outcome = RigidOutcome::kFree;
    Push({0, 0, 0, 0});
    while (size_ > 0 && check_.outcome != RigidOutcome::kCollides) {
      const Part part = stack_[--size_];
      if (check_.tests >= max_tests_) {
        if (check_.outcome == RigidOutcome::kFree) {
          Tell(RigidOutcome::kUndecided, part, -1, -1);
        }
        break;
      }
      ++check_.tests;
      Look(part);
    }
    if (check_.outcome == RigidOutcome::kFree) LookInside();
    return check_;
  }

 private:
  // Nodes i and j on [k, k + 1] / 2^level.
  struct Part {
    int robot, obstacle, level;
    long k;
  };
  // A step replaces a part by two, of a lower level in one of three ways.
  static constexpr int kStack = 2 * BoxTree::kMaxDepth + kMaxLevel + 2;

  void Push(const Part& part) { stack_[size_++] = part; }

  void Look(const Part& part) {
    const RigidNode& a =
        robot_.tree.nodes[static_cast<std::size_t>(part.robot)];
    const RigidNode& b =
        obstacle_.tree.nodes[static_cast<std::size_t>(part.obstacle)];
    const double h = std::ldexp(0.5, -part.level);
    const RigidPose& middle = poses_.At(part.level, MiddleOf(part), part.k);
    double bound = 0.0;
    if (!a.IsLeaf() || !b.IsLeaf()) {
      const PairSight sight =
          internal::LookAtBoxes(motion_, middle, h, a, b, &bound);
      if (sight == PairSight::kApart) return;
      // A box that goes far is not known better by its parts.
      if (bound > a.radius + b.radius && part.level < kMaxLevel) {
        Halve(part);
      } else {
        Open(part, a, b);
      }
      return;
    }
    const PairSight sight = internal::LookAtTriangles(
        motion_, middle, h,
        robot_.tree.corners[static_cast<std::size_t>(a.triangle)],
        obstacle_.tree.corners[static_cast<std::size_t>(b.triangle)], &bound);
    if (sight == PairSight::kApart) return;
    if (sight == PairSight::kMeet) {
      Tell(RigidOutcome::kCollides, part, a.triangle, b.triangle);
    } else if (bound > resolution_ && part.level < kMaxLevel) {
      Halve(part);
    } else if (check_.outcome == RigidOutcome::kFree) {
      Tell(RigidOutcome::kUndecided, part, a.triangle, b.triangle);
      max_tests_ = std::min(max_tests_, 2 * check_.tests + kFurtherTests);
    }
  }

  // The earlier half is looked at first.
  void Halve(const Part& part) {
    Push({part.robot, part.obstacle, part.level + 1, 2 * part.k + 1});
    Push({part.robot, part.obstacle, part.level + 1, 2 * part.k});
  }

  // The larger box is replaced by its two.
  void Open(const Part& part, const RigidNode& a, const RigidNode& b) {
    const bool opens_robot = b.IsLeaf() || (!a.IsLeaf() && a.radius > b.radius);
    for (int i = 0; i < 2; ++i) {
      Push({opens_robot ? a.left + i : part.robot,
            opens_robot ? part.obstacle : b.left + i, part.level, part.k});
    }
  }

  static double MiddleOf(const Part& part) {
    return std::ldexp(static_cast<double>(2 * part.k + 1), -part.level - 1);
  }

  void Tell(RigidOutcome outcome, const Part& part, int triangle, int other) {
    check_.outcome = outcome;
    check_.time = MiddleOf(part);
    check_.from = std::ldexp(static_cast<double>(part.k), -part.level);
    check_.to = std::ldexp(static_cast<double>(part.k + 1), -part.level);
    if (triangle < 0) return;
    const Origin& mine = robot_.origins[static_cast<std::size_t>(triangle)];
    const Origin& its = obstacle_.origins[static_cast<std::size_t>(other)];
    check_.robot_mesh = mine.mesh;
    check_.robot_triangle = mine.triangle;
    check_.obstacle_mesh = its.mesh;
    check_.obstacle_triangle = its.triangle;
  }

  // Surfaces that stay apart by more than rounding: who is inside of whom at
  // the start is so for good, and corners as rounded tell.
  void LookInside() {
    const RigidPose start = motion_.At(0.0);
    const auto collide = [&] {
      check_.outcome = RigidOutcome::kCollides;
      check_.time = check_.from = check_.to = 0.0;
    };
    if (!obstacle_.solids.empty()) {
      for (const Vector3d& p : robot_.seeds) {
        const Vector3d x = start.rotation * p + start.position;
        if (IsInside(obstacle_, x)) return collide();
      }
    }
    if (robot_.solids.empty()) return;
    for (const Vector3d& b : obstacle_.seeds) {
      const Vector3d p = start.rotation.transpose() * (b - start.position);
      if (p.norm() <= 2.0 * robot_.tree.reach && IsInside(robot_, p)) {
        return collide();
      }
    }
  }

  const Side &robot_, &obstacle_;
  const FramedMotion& motion_;
  long max_tests_;
  const double resolution_;
  MiddlePoses poses_;
  Part stack_[kStack];
  int size_ = 0;
  RigidCheck check_;
};

}  // namespace

struct RigidJudge::Impl {
  RigidFrame frame;
  Side robot, obstacle;
};

const char* ToString(RigidOutcome outcome) {
  switch (outcome) {
    case RigidOutcome::kFree:
      return "free";
    case RigidOutcome::kCollides:
      return "collides";
    case RigidOutcome::kUndecided:
      return "undecided";
  }
  return "unknown";
}

RigidJudge::RigidJudge(const TriangleMesh& robot, const TriangleMesh& obstacle)
    : RigidJudge(std::vector<TriangleMesh>{robot},
                 std::vector<TriangleMesh>{obstacle}) {}

RigidJudge::RigidJudge(const std::vector<TriangleMesh>& robot,
                       const std::vector<TriangleMesh>& obstacles) {
  RequireMeshes(robot, "robot");
  RequireMeshes(obstacles, "obstacle");
  auto impl = std::make_shared<Impl>();
  impl->frame = FrameOf(robot, obstacles);
  impl->robot = MakeSide(robot, Vector3d::Zero(), impl->frame.scale);
  impl->obstacle = MakeSide(obstacles, impl->frame.center, impl->frame.scale);
  impl_ = std::move(impl);
}

RigidCheck RigidJudge::Check(const RigidMotion& motion, long max_tests) const {
  const FramedMotion framed(motion, impl_->frame, impl_->robot.tree.reach,
                            impl_->obstacle.tree.reach);
  if (!(framed.size() <= kMaxSize)) {
    throw InputError(
        "rigid judge: expected a motion within 1e100 sizes of the meshes, "
        "found one to " +
        Rounded(std::max(motion.start().position.cwiseAbs().maxCoeff(),
                         motion.end().position.cwiseAbs().maxCoeff())) +
        "; are the units right?");
  }
  return MotionSearch(impl_->robot, impl_->obstacle, framed, max_tests).Run();
}

}  // namespace phongpd
