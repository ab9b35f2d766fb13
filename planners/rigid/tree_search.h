// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "planners/rigid/pose_tree.h"
#include "planners/rigid/rigid_links.h"
#include "planners/rigid/rigid_model.h"
#include "planners/rigid/rigid_slide.h"

namespace phongpd::internal {

// How a tree grows towards what was drawn.
enum class TreeGrowth { kStraight, kSlide, kTow };

struct TreeTask {
  RobotPose start, goal;  // free, within the bounds
  Eigen::AlignedBox3d bounds;
  // False: every pose is turned as the start is, and so is the goal, bit for
  // bit.
  bool turns = true;
};

// Two trees, from start and goal, that grow in turn: one towards a pose drawn
// at random, then the other towards where that one got; a path where they meet.
//
// Drawn are (shares for slide and tow; straight draws the first kind only)
//   - poses anywhere in the bounds, however turned;
//   - poses with features of robot and obstacles aligned (aligned_features.h),
//     anywhere; or where these lie on each other, the one of some that is
//     between most walls, and then on along them;
//   - poses around a node that was drawn seldom.
// What does not turn is drawn anywhere or around a node, and has no passages.
//
// Slides and tows know passages, too: from such a tight pose along its edges
// both ways, as far as slides get.  Out of a hole there are many ways, into it
// few; whichever tree reaches one end has all of the passage.
class TreeSearch {
 public:
  TreeSearch(const RigidModel& model, const TreeTask& task, TreeGrowth growth,
             std::uint64_t seed, RigidStop* stop);

  // One round; true: there is a path.
  bool Grow();
  const std::vector<RobotPose>& path() const { return path_; }

  TreeGrowth growth() const { return growth_; }
  // What it has done so far, the same on every machine.
  long work() const { return links_.tests() + kWorkOfRound * rounds_; }
  long checks() const { return links_.checks(); }
  long tests() const { return links_.tests(); }
  long nodes() const { return trees_[0].size() + trees_[1].size(); }

 private:
  // Of a round that looks at nothing, in tests.
  static constexpr long kWorkOfRound = 20;

  struct Aim {
    RobotPose pose;
    int node = -1;  // from this one; −1: from the nearest
    bool is_tow = false;
    // At the place of aligned features: as far as it is, then on along them.
    bool is_far = false;
    Eigen::Vector3d along = Eigen::Vector3d::Zero();
  };

  // From end to end, through a place between walls; every link free.
  using Passage = std::vector<RobotPose>;

  // One round of passages: makes one, or takes one of those that there are, and
  // tries to enter it from either tree; all of it belongs to that tree then.
  bool GrowPassage();
  Passage DrawPassage();
  bool Enter(int side, std::size_t passage);

  Aim Draw(int side);
  RobotPose AnyPose();
  Aim AlignedAim();
  Aim TightAim();
  // Pairs of walls that the pose is between; −1: not free.
  int CountOppositeWalls(const RobotPose& pose);
  RobotPose PoseAround(int side, int* node);
  // The pose moved by about `length` in the object norm.
  RobotPose Jittered(const RobotPose& pose, double length);

  // The node reached, perhaps `from`; *met: it is at the pose, bit for bit.
  int Extend(int side, int from, const RobotPose& to, bool is_tow, bool* met);
  int ExtendStraight(int side, int from, const RobotPose& to, bool* met);
  int ExtendSliding(int side, int from, const RobotPose& to, bool is_tow,
                    bool* met);
  void Join(int side, int mine, int its);

  bool CanAlign() const { return task_.turns && !model_.features.IsEmpty(); }
  double Uniform() { return std::uniform_real_distribution<double>()(random_); }
  RobotPose Clamped(RobotPose pose) const;

  const RigidModel& model_;
  const TreeTask task_;
  const TreeGrowth growth_;
  const double range_;
  std::mt19937_64 random_;
  RigidLinks links_;
  RigidSlide slide_;
  std::array<PoseTree, 2> trees_;
  int side_ = 0;
  long rounds_ = 0;
  std::vector<PoseContact> contacts_;
  std::vector<Passage> passages_;  // entered by none so far
  std::vector<RobotPose> slid_, path_;
};

}  // namespace phongpd::internal
