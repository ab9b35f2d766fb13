// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bitset>
#include <cstddef>

#include "constraints/rigid/framed_motion.h"
#include "constraints/rigid/rigid_pair.h"
#include "constraints/rigid/rigid_tree.h"
#include "core/bvh/box_tree.h"

namespace phongpd::internal {

// Nodes of robot and obstacles on the part [k, k + 1] / 2^level of the way.
struct RigidPart {
  int robot = 0, obstacle = 0, level = 0;
  long k = 0;
  double half_width = 0.5;           // 2^(−level−1)
  PairHint hint = PairHint::Zero();  // of two triangles

  // Exact: levels end before k does not fit a double.
  double From() const { return half_width * static_cast<double>(2 * k); }
  double Middle() const { return half_width * static_cast<double>(2 * k + 1); }
  double To() const { return half_width * static_cast<double>(2 * k + 2); }
};

// Does the robot's box go so far from its middle, `bound` at most, that it is
// not known better by its parts, which are many, but by halves of its way? With
// the sizes themselves in place of a fourth of them, twice to four times as
// many pairs of two tubes were looked at; an eighth is no better.
inline bool GoesFar(double bound, const RigidNode& a, const RigidNode& b) {
  return bound > 0.25 * (a.radius + b.radius);
}

// Poses at the middles of the parts of the way, those of the first levels kept.
class MiddlePoseCache {
 public:
  explicit MiddlePoseCache(const FramedMotion& motion) : motion_(motion) {}

  // Holds until the next call.
  const RigidPose& At(const RigidPart& part);

 private:
  static constexpr int kKeptLevels = 8;
  static constexpr std::size_t kKept = std::size_t{1} << kKeptLevels;

  const FramedMotion& motion_;
  std::bitset<kKept> is_known_;
  RigidPose kept_[kKept];
  RigidPose other_;
};

// The walk that every question of the judge is asked by: a stack of pairs of
// nodes, each with its own part of the way; the last in is looked at first.
// Who asks says what to do with pairs of triangles that are not told apart.
class RigidDescent {
 public:
  // Halves of halves; the time of the middle is exact.
  static constexpr int kMaxHalvings = 50;

  RigidDescent(const RigidTree& robot, const RigidTree& obstacle,
               const FramedMotion& motion)
      : robot_(robot), obstacle_(obstacle), motion_(motion), poses_(motion) {}

  bool IsDone() const { return size_ == 0; }
  void Push(const RigidPart& part) { stack_[size_++] = part; }
  RigidPart Pop() { return stack_[--size_]; }
  // Those still to be looked at, i < size().
  int size() const { return size_; }
  const RigidPart& operator[](int i) const { return stack_[i]; }

  // kApart: for all of the part by more than the gap, proved; or it is replaced
  // by parts of it, or of its nodes.  Else two triangles: `bound` is how far
  // one gets from its middle, at most, and the part has its hint; of those
  // above `coarse` not all was tried, since they are halved.
  PairSight Look(RigidPart* part, double gap, double coarse, double* bound);

  // Both halves, the earlier one on top; or that one alone.
  void Halve(const RigidPart& part);
  void PushFirstHalf(const RigidPart& part);

  // The numbers of the triangles of a pair of leaves.
  int RobotTriangle(const RigidPart& part) const;
  int ObstacleTriangle(const RigidPart& part) const;

 private:
  // A step replaces a part by two, of a lower level in one of three ways.
  static constexpr int kStack = 2 * BoxTree::kMaxDepth + kMaxHalvings + 4;

  void Open(const RigidPart& part, const RigidNode& a, const RigidNode& b);

  const RigidTree &robot_, &obstacle_;
  const FramedMotion& motion_;
  MiddlePoseCache poses_;
  RigidPart stack_[kStack];
  int size_ = 0;
};

}  // namespace phongpd::internal
