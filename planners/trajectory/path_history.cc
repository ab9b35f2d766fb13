// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/path_history.h"

#include <algorithm>

namespace phongpd {
namespace {

bool IsSameIteration(const PathIterate& a, const PathIterate& b) {
  return a.stage == b.stage && a.route == b.route && a.round == b.round &&
         a.record.iteration == b.record.iteration;
}

}  // namespace

void TellPaths(const PathObserver& observer, int round,
               const std::function<Path(const Eigen::VectorXd&)>& path_of,
               IpoptSettings* settings) {
  if (!observer) return;
  settings->on_iteration =
      [observer, round, &path_of, next = settings->on_iteration](
          const IterationRecord& record, const Eigen::VectorXd& x) {
        observer({"", 0, round, record, path_of(x)});
        return !next || next(record, x);
      };
}

void PathHistory::Add(const PathIterate& iterate) {
  if (count_ > 0 && IsSameIteration(iterate, last_.iterate)) {
    last_.iterate = iterate;
    if (kept_.back().number == last_.number) kept_.back() = last_;
    return;
  }
  last_ = {count_++, iterate};
  const std::size_t points = std::max<std::size_t>(iterate.path.size(), 1);
  // One place is the last one's.
  const std::size_t most =
      std::max<std::size_t>(2, std::min(kMostPaths, kMostPoints / points)) - 1;
  if (last_.number % stride_ == 0) kept_.push_back(last_);
  while (kept_.size() > most) {
    stride_ *= 2;
    kept_.erase(std::remove_if(kept_.begin(), kept_.end(),
                               [this](const Entry& entry) {
                                 return entry.number % stride_ != 0;
                               }),
                kept_.end());
  }
}

std::vector<PathHistory::Entry> PathHistory::Kept() const {
  std::vector<Entry> kept = kept_;
  if (!kept.empty() && kept.back().number != last_.number) {
    kept.push_back(last_);
  }
  return kept;
}

}  // namespace phongpd
