// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_portfolio.h"

namespace phongpd::internal {
namespace {

// Who takes part, and the share of the work that each does, beyond what it may
// do before the others begin: worlds with much room are solved by straight
// motions in about half a second, so that is what others lose elsewhere.
struct Runner {
  TreeGrowth growth;
  const char* name;
  double share;
  long head_start;  // in tests
};
constexpr Runner kRunners[] = {
    {TreeGrowth::kStraight, "straight", 0.2, 2'000'000},
    {TreeGrowth::kSlide, "slide", 0.35, 0},
    {TreeGrowth::kTow, "tow", 0.45, 0}};

}  // namespace

RigidPortfolio::RigidPortfolio(const RigidModel& model, const TreeTask& task,
                               std::uint64_t seed, RigidStop* stop) {
  for (const Runner& runner : kRunners) {
    // To tow is to let it turn; it comes last.
    if (runner.growth == TreeGrowth::kTow && !task.turns) continue;
    searches_.push_back(
        std::make_unique<TreeSearch>(model, task, runner.growth, seed, stop));
  }
}

bool RigidPortfolio::Grow() {
  last_ = 0;
  for (std::size_t i = 1; i < searches_.size(); ++i) {
    if (Done(i) < Done(last_)) last_ = i;
  }
  return searches_[last_]->Grow();
}

bool RigidPortfolio::Search(RigidStop* stop) {
  while (!stop->Asks()) {
    if (Grow()) return true;
  }
  return false;
}

const char* RigidPortfolio::planner() const { return kRunners[last_].name; }

long RigidPortfolio::Sum(long (TreeSearch::*count)() const) const {
  long sum = 0;
  for (const auto& search : searches_) sum += (*search.*count)();
  return sum;
}

double RigidPortfolio::Done(std::size_t search) const {
  const Runner& one = kRunners[search];
  return static_cast<double>(searches_[search]->work() - one.head_start) /
         one.share;
}

}  // namespace phongpd::internal
