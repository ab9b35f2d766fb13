// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_descent.h"

namespace phongpd::internal {

const RigidPose& MiddlePoseCache::At(const RigidPart& part) {
  if (part.level >= kKeptLevels) {
    other_ = motion_.At(part.Middle());
    return other_;
  }
  const auto index = static_cast<std::size_t>((1L << part.level) + part.k);
  if (!is_known_[index]) {
    kept_[index] = motion_.At(part.Middle());
    is_known_[index] = true;
  }
  return kept_[index];
}

PairSight RigidDescent::Look(RigidPart* part, double gap, double coarse,
                             double* bound) {
  const RigidNode& a = robot_.nodes[static_cast<std::size_t>(part->robot)];
  const RigidNode& b =
      obstacle_.nodes[static_cast<std::size_t>(part->obstacle)];
  const RigidPose& middle = poses_.At(*part);
  const double h = part->half_width;
  if (a.IsLeaf() && b.IsLeaf()) {
    return LookAtTriangles(
        motion_, middle, h, gap, coarse,
        robot_.corners[static_cast<std::size_t>(a.triangle)],
        obstacle_.corners[static_cast<std::size_t>(b.triangle)], &part->hint,
        bound);
  }
  if (LookAtBoxes(motion_, middle, h, gap, a, b, bound) == PairSight::kApart) {
    return PairSight::kApart;
  }
  // A box that goes far is not known better by its parts.
  if (GoesFar(*bound, a, b) && part->level < kMaxHalvings) {
    Halve(*part);
  } else {
    Open(*part, a, b);
  }
  return PairSight::kApart;
}

void RigidDescent::Halve(const RigidPart& part) {
  RigidPart half = part;
  half.level = part.level + 1;
  half.half_width = 0.5 * part.half_width;
  half.k = 2 * part.k + 1;
  Push(half);
  half.k = 2 * part.k;
  Push(half);
}

void RigidDescent::PushFirstHalf(const RigidPart& part) {
  RigidPart half = part;
  half.level = part.level + 1;
  half.half_width = 0.5 * part.half_width;
  half.k = 2 * part.k;
  Push(half);
}

// The larger box is replaced by its two.
void RigidDescent::Open(const RigidPart& part, const RigidNode& a,
                        const RigidNode& b) {
  const bool opens_robot = b.IsLeaf() || (!a.IsLeaf() && a.radius > b.radius);
  RigidPart child = part;
  for (int i = 0; i < 2; ++i) {
    (opens_robot ? child.robot : child.obstacle) =
        (opens_robot ? a.left : b.left) + i;
    Push(child);
  }
}

int RigidDescent::RobotTriangle(const RigidPart& part) const {
  return robot_.nodes[static_cast<std::size_t>(part.robot)].triangle;
}

int RigidDescent::ObstacleTriangle(const RigidPart& part) const {
  return obstacle_.nodes[static_cast<std::size_t>(part.obstacle)].triangle;
}

}  // namespace phongpd::internal
