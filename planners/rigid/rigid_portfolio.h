// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "planners/rigid/rigid_links.h"
#include "planners/rigid/rigid_model.h"
#include "planners/rigid/tree_search.h"

namespace phongpd::internal {

// Three searches from one seed, straight, slide and, for what turns, tow, that
// take turns by the work that they have done, so that each does its share of it
// (rigid_plan.h). One thread at a time.
class RigidPortfolio {
 public:
  RigidPortfolio(const RigidModel& model, const TreeTask& task,
                 std::uint64_t seed, RigidStop* stop);

  // A round of whoever has done least of its share; true: there is a path.
  bool Grow();
  // Rounds until there is a path; false: `stop` ended them.
  bool Search(RigidStop* stop);
  const std::vector<RobotPose>& path() const {
    return searches_[last_]->path();
  }
  // Who grew last: "straight", "slide" or "tow".
  const char* planner() const;

  // Sums over the three.  Work never gets less, and is a function of the seed.
  long work() const { return Sum(&TreeSearch::work); }
  long checks() const { return Sum(&TreeSearch::checks); }
  long tests() const { return Sum(&TreeSearch::tests); }
  long nodes() const { return Sum(&TreeSearch::nodes); }

 private:
  long Sum(long (TreeSearch::*count)() const) const;
  // What the search has done, over its share.
  double Done(std::size_t search) const;

  std::vector<std::unique_ptr<TreeSearch>> searches_;
  std::size_t last_ = 0;
};

}  // namespace phongpd::internal
