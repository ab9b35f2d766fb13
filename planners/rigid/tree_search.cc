// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/tree_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planners/rigid/object_norm.h"

namespace phongpd::internal {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Of the bounds' diagonal: how far a tree grows at once.
constexpr double kRange = 0.2;
// Shares of what slides and tows draw; the rest is anywhere.
constexpr double kAlignedShare = 0.3, kLocalShare = 0.3;
// Of what tows draw, what they tow to; they slide to the rest.  Tows lead out
// of where slides end, but get less far: by halves they took twice as much work
// to part two bent tubes.
constexpr double kTowShare = 0.3;
// Of aligned poses those at the place of the features.  From there it goes on
// along the edge, by so many reaches: holes are gone through along theirs.
constexpr double kPlacedShare = 0.5, kAhead = 3.0;
// Rounds of passages, and how many are kept that no tree has entered.
constexpr double kPassageShare = 0.1;
constexpr std::size_t kMostPassages = 30;
// Of so many the one between most pairs of opposite walls: directions, told
// apart by the cosine, in which an obstacle is nearer than that share of the
// reach.
constexpr int kTightCandidates = 200;
constexpr int kTightDraws = 2000;  // most may be out of bounds
// How far features are off each other, at most, as above.
constexpr double kNearestOff = 1.0;
constexpr std::size_t kMaxWalls = 12;
constexpr double kWallDistance = 0.1, kSameWall = 0.9;
// How far from a node, at least: the reach times 10 to the power of minus that.
constexpr double kDecades = 1.5;
// Of so many nodes the one that was drawn least.
constexpr int kCandidates = 5;

Quaterniond AnyOrientation(std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  Eigen::Vector4d q;
  do {
    for (int k = 0; k < 4; ++k) q[k] = normal(*random);
  } while (!(q.norm() > 1e-3));
  q.normalize();
  return Quaterniond(q[0], q[1], q[2], q[3]);
}

}  // namespace

TreeSearch::TreeSearch(const RigidModel& model, const TreeTask& task,
                       TreeGrowth growth, std::uint64_t seed, RigidStop* stop)
    : model_(model),
      task_(task),
      growth_(growth),
      range_(growth == TreeGrowth::kStraight
                 ? model.reach
                 : kRange * task.bounds.diagonal().norm()),
      random_(seed),
      links_(model.judge, stop),
      slide_(model, task.turns, &links_),
      trees_{PoseTree(task.start, model.gyration),
             PoseTree(task.goal, model.gyration)} {}

bool TreeSearch::Grow() {
  ++rounds_;
  if (growth_ != TreeGrowth::kStraight && CanAlign() &&
      Uniform() < kPassageShare) {
    return GrowPassage();
  }
  const int mine = side_, its = 1 - side_;
  side_ = its;
  PoseTree& tree = trees_[static_cast<std::size_t>(mine)];
  Aim aim = Draw(mine);
  const int from = aim.node >= 0 ? aim.node : tree.Nearest(aim.pose);
  const Vector6 far = Difference(tree.pose(from), aim.pose, model_.gyration);
  if (!aim.is_far && far.norm() > range_) {
    aim.pose =
        Moved(tree.pose(from), far * (range_ / far.norm()), model_.gyration);
  }
  bool met = false;
  int reached = Extend(mine, from, aim.pose, aim.is_tow, &met);
  if (aim.is_far) {
    RobotPose ahead = tree.pose(reached);
    ahead.position += kAhead * model_.reach * aim.along;
    reached = Extend(mine, reached, Clamped(ahead), false, &met);
  }
  if (reached == from) return false;
  const RobotPose at = tree.pose(reached);
  PoseTree& other = trees_[static_cast<std::size_t>(its)];
  const int meeting = Extend(its, other.Nearest(at), at, false, &met);
  if (met) Join(mine, reached, meeting);
  return met;
}

bool TreeSearch::GrowPassage() {
  std::size_t chosen = passages_.size();
  if (chosen < kMostPassages && (chosen == 0 || Uniform() < 0.5)) {
    Passage passage = DrawPassage();
    if (passage.size() < 2) return false;
    passages_.push_back(std::move(passage));
  } else {
    chosen = random_() % chosen;
  }
  const int first = Uniform() < 0.5 ? 0 : 1;
  return Enter(first, chosen) ||
         (chosen < passages_.size() && Enter(1 - first, chosen));
}

TreeSearch::Passage TreeSearch::DrawPassage() {
  const Aim aim = TightAim();
  if (!aim.is_far || !links_.IsFree(aim.pose, aim.pose)) return {};
  Passage passage;
  for (const double sign : {-1.0, 1.0}) {
    SlidePull pull;
    pull.to = aim.pose;
    pull.to.position += sign * kAhead * model_.reach * aim.along;
    pull.to = Clamped(pull.to);
    slide_.Slide(aim.pose, pull, &slid_);
    std::reverse(passage.begin(), passage.end());
    for (std::size_t i = passage.empty() ? 0 : 1; i < slid_.size(); ++i) {
      if (!task_.bounds.contains(slid_[i].position)) break;
      passage.push_back(slid_[i]);
    }
  }
  return passage;
}

bool TreeSearch::Enter(int side, std::size_t chosen) {
  PoseTree& tree = trees_[static_cast<std::size_t>(side)];
  PoseTree& other = trees_[static_cast<std::size_t>(1 - side)];
  Passage& passage = passages_[chosen];
  for (int end = 0; end < 2; ++end) {
    std::reverse(passage.begin(), passage.end());
    bool met = false;
    const RobotPose mouth = passage.front();
    int last = Extend(side, tree.Nearest(mouth), mouth, false, &met);
    if (!met) continue;
    for (std::size_t i = 1; i < passage.size(); ++i) {
      last = tree.Add(passage[i], last);
    }
    passages_.erase(passages_.begin() + static_cast<std::ptrdiff_t>(chosen));
    const RobotPose at = tree.pose(last);
    const int meeting = Extend(1 - side, other.Nearest(at), at, false, &met);
    if (met) Join(side, last, meeting);
    return met;
  }
  return false;
}

TreeSearch::Aim TreeSearch::Draw(int side) {
  Aim aim;
  const double kind = growth_ == TreeGrowth::kStraight ? 1.0 : Uniform();
  if (kind < kAlignedShare && CanAlign()) {
    aim = AlignedAim();
  } else if (kind < kAlignedShare + kLocalShare) {
    aim.pose = PoseAround(side, &aim.node);
  } else {
    aim.pose = AnyPose();
  }
  aim.is_tow = growth_ == TreeGrowth::kTow && Uniform() < kTowShare;
  return aim;
}

RobotPose TreeSearch::AnyPose() {
  RobotPose pose;
  const Vector3d size = task_.bounds.sizes();
  for (int k = 0; k < 3; ++k) {
    pose.position[k] = task_.bounds.min()[k] + Uniform() * size[k];
  }
  pose.orientation =
      task_.turns ? AnyOrientation(&random_) : task_.start.orientation;
  return Clamped(pose);
}

TreeSearch::Aim TreeSearch::AlignedAim() {
  if (Uniform() < kPlacedShare) return TightAim();
  Aim aim;
  aim.pose = model_.features.Draw(&random_, &aim.along);
  aim.pose.position = AnyPose().position;
  return aim;
}

TreeSearch::Aim TreeSearch::TightAim() {
  Aim best;
  int most = -1;
  int candidates = 0;
  for (int i = 0; i < kTightDraws && candidates < kTightCandidates; ++i) {
    Aim aim;
    aim.is_far = true;
    aim.pose = model_.features.Draw(&random_, &aim.along);
    const Vector3d any = AnyOrientation(&random_) * Vector3d::UnitX();
    const double off = std::pow(10.0, -kNearestOff - kDecades * Uniform());
    aim.pose.position +=
        model_.reach * ((2.0 * Uniform() - 1.0) * aim.along +
                        off * (any - any.dot(aim.along) * aim.along));
    if (!task_.bounds.contains(aim.pose.position)) continue;
    ++candidates;
    const int walls = CountOppositeWalls(aim.pose);
    if (walls <= most) continue;
    most = walls;
    best = aim;
  }
  if (most < 0) best.pose = AnyPose();
  if (Uniform() < 0.5) best.along = -best.along;
  return best;
}

int TreeSearch::CountOppositeWalls(const RobotPose& pose) {
  if (!links_.IsFree(pose, pose)) return -1;
  long tests = 0;
  FindContacts(model_.robot_surface, model_.obstacle_surface, pose,
               kWallDistance * model_.reach, &contacts_, &tests);
  links_.AddTests(tests);
  std::array<Vector3d, kMaxWalls> walls;
  std::size_t count = 0;
  for (const PoseContact& contact : contacts_) {
    if (count == walls.size()) break;
    const bool is_known = std::any_of(
        walls.begin(), walls.begin() + static_cast<std::ptrdiff_t>(count),
        [&](const Vector3d& wall) {
          return wall.dot(contact.normal) > kSameWall;
        });
    if (!is_known) walls[count++] = contact.normal;
  }
  int opposite = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (walls[i].dot(walls[j]) < -kSameWall) ++opposite;
    }
  }
  return opposite;
}

RobotPose TreeSearch::PoseAround(int side, int* node) {
  PoseTree& tree = trees_[static_cast<std::size_t>(side)];
  *node = -1;
  for (int i = 0; i < kCandidates; ++i) {
    const int other =
        static_cast<int>(random_() % static_cast<std::uint64_t>(tree.size()));
    if (*node < 0 || tree.tries(other) < tree.tries(*node)) *node = other;
  }
  ++tree.tries(*node);
  return Jittered(tree.pose(*node),
                  2.0 * model_.reach * std::pow(10.0, -kDecades * Uniform()));
}

RobotPose TreeSearch::Jittered(const RobotPose& pose, double length) {
  std::normal_distribution<double> normal;
  Vector6 move;
  do {
    for (int k = 0; k < 6; ++k) move[k] = normal(random_);
    if (!task_.turns) move.tail<3>().setZero();
  } while (!(move.norm() > 1e-3));
  return Clamped(Moved(pose, move * (length / move.norm()), model_.gyration));
}

RobotPose TreeSearch::Clamped(RobotPose pose) const {
  pose.position =
      pose.position.cwiseMax(task_.bounds.min()).cwiseMin(task_.bounds.max());
  return pose;
}

int TreeSearch::Extend(int side, int from, const RobotPose& to, bool is_tow,
                       bool* met) {
  return growth_ == TreeGrowth::kStraight
             ? ExtendStraight(side, from, to, met)
             : ExtendSliding(side, from, to, is_tow, met);
}

// By steps of the reach, the first of which that is not free ends it: a long
// motion that collides costs more than the steps before it does.
int TreeSearch::ExtendStraight(int side, int from, const RobotPose& to,
                               bool* met) {
  PoseTree& tree = trees_[static_cast<std::size_t>(side)];
  *met = false;
  const RigidMotion motion(tree.pose(from), to);
  const double length =
      Difference(motion.start(), motion.end(), model_.gyration).norm();
  const double steps = std::max(1.0, std::ceil(length / model_.reach));
  int last = from;
  for (double k = 1.0; k <= steps; ++k) {
    // The end bit for bit.
    const RobotPose next = k < steps ? motion.At(k / steps) : to;
    if (!links_.IsFree(tree.pose(last), next)) return last;
    last = tree.Add(next, last);
  }
  *met = true;
  return last;
}

int TreeSearch::ExtendSliding(int side, int from, const RobotPose& to,
                              bool is_tow, bool* met) {
  PoseTree& tree = trees_[static_cast<std::size_t>(side)];
  SlidePull pull;
  pull.to = to;
  pull.is_tow = is_tow;
  if (is_tow) {
    const auto& corners = model_.robot_surface.corners;
    const std::uint64_t drawn = random_() % (3 * corners.size());
    pull.grip = corners[drawn / 3][drawn % 3];
    pull.place = to.orientation * pull.grip + to.position;
  }
  *met = slide_.Slide(tree.pose(from), pull, &slid_) && !is_tow;
  int last = from;
  for (std::size_t i = 1; i < slid_.size(); ++i) {
    if (!task_.bounds.contains(slid_[i].position)) {
      *met = false;
      break;
    }
    last = tree.Add(slid_[i], last);
  }
  return last;
}

void TreeSearch::Join(int side, int mine, int its) {
  const auto my_side = static_cast<std::size_t>(side);
  std::vector<RobotPose> from = trees_[my_side].WayToRoot(mine);
  std::vector<RobotPose> to = trees_[1 - my_side].WayToRoot(its);
  if (side == 1) std::swap(from, to);
  path_.assign(from.rbegin(), from.rend());
  // Both end in the same pose.
  path_.insert(path_.end(), to.begin() + 1, to.end());
}

}  // namespace phongpd::internal
