// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/pose_rounds.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::VectorXd;

using RigidPath = std::vector<RobotPose>;

// Of a motion, as planners ask (rigid_links.h).
constexpr long kMostTests = 300'000;
// Of the robot's reach, object norm.
constexpr double kLeastPart = 0.02;
constexpr double kMostMargin = 64.0;  // of the first margin
constexpr int kStall = 10;
// An iterate is judged where rows are violated by less, units of the reach: it
// may be free by its margin.
constexpr double kNearlyFeasible = 1e-4;

class Rounds {
 public:
  Rounds(const RigidModel& model, const RigidPath& start,
         const PoseRoundsTask& task, PoseRows* rows, RigidStop* stop)
      : model_(model), task_(task), rows_(rows), stop_(stop), poses_(start) {
    const int links = static_cast<int>(poses_.size()) - 1;
    times_.assign(static_cast<std::size_t>(links), 0);
    samples_ = FirstSamples(links, task_.margin);
  }

  PoseRoundsEnd Run() {
    const double begin = stop_->Seconds();
    int failures = 0;
    KeepIfFree(poses_);
    while (end_.path.empty() && end_.rounds < task_.max_rounds &&
           !stop_->Asks()) {
      const double left = task_.time_limit - (stop_->Seconds() - begin);
      if (!(left > 0.0)) break;
      ++end_.rounds;
      const bool is_claimed = Solve(left);
      if (!end_.path.empty()) break;
      if (is_claimed && KeepIfFree(poses_)) break;
      end_.was_refuted |= is_claimed;
      failures = is_claimed ? 0 : failures + 1;
      if (failures >= task_.max_failures) break;
      AddSamples();
    }
    end_.samples = samples_.size();
    return end_;
  }

 private:
  // One solve, to the first iterate that is free; true where Ipopt calls its
  // end, now poses_, solved.
  bool Solve(double seconds) {
    PoseProgram program(PoseChart(poses_, model_.reach, model_.gyration),
                        samples_, task_.bounds, rows_);
    IpoptSettings settings;
    settings.max_iterations = task_.max_iterations;
    settings.stall_iterations = kStall;
    settings.time_limit = seconds;
    settings.on_iteration = [&](const IterationRecord& record,
                                const VectorXd& x) {
      const bool is_free = record.violation <= kNearlyFeasible &&
                           KeepIfFree(program.chart().Poses(x.data()));
      return !is_free && !stop_->Asks();
    };
    const IpoptRun run =
        SolveWithIpopt(&program, VectorXd::Zero(program.variables()), settings);
    end_.status = run.status;
    end_.iterations += run.iterations;
    poses_ = program.chart().Poses(run.x.data());
    return IsClassOk(run.status);
  }

  RigidCheck Judge(const RobotPose& a, const RobotPose& b) {
    const RigidCheck check = model_.judge.Check(RigidMotion(a, b), kMostTests);
    ++end_.checks;
    end_.tests += check.tests;
    return check;
  }

  bool KeepIfFree(const RigidPath& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (!Judge(path[i], path[i + 1]).IsFree()) return false;
    }
    end_.path = path;
    return true;
  }

  // Rows where parts between samples are not free.
  void AddSamples() {
    const std::size_t before = samples_.size();
    for (int link = 0; link + 1 < static_cast<int>(poses_.size()); ++link) {
      std::vector<std::size_t> own;
      for (std::size_t i = 0; i < before; ++i) {
        if (samples_[i].link == link) own.push_back(i);
      }
      std::sort(own.begin(), own.end(), [&](std::size_t a, std::size_t b) {
        return samples_[a].t < samples_[b].t;
      });
      double from = 0.0;
      for (std::size_t k = 0; k <= own.size(); ++k) {
        const double to = k < own.size() ? samples_[own[k]].t : 1.0;
        if (to > from) {
          AddBetween(link, from, to, k > 0 ? &samples_[own[k - 1]] : nullptr,
                     k < own.size() ? &samples_[own[k]] : nullptr);
        }
        from = to;
      }
    }
    std::vector<bool> is_told(times_.size(), false);
    for (const PoseSample& sample : added_) {
      is_told[static_cast<std::size_t>(sample.link)] = true;
    }
    for (std::size_t i = 0; i < times_.size(); ++i) times_[i] += is_told[i];
    samples_.insert(samples_.end(), added_.begin(), added_.end());
    end_.added_samples += added_.size();
    added_.clear();
  }

  // Doubled with each round before that added rows to the link.
  double MarginOf(int link) const {
    const auto i = static_cast<std::size_t>(link);
    return std::min(std::ldexp(task_.margin, times_[i]),
                    kMostMargin * task_.margin);
  }

  void AddBetween(int link, double from, double to, PoseSample* before,
                  PoseSample* after) {
    const auto i = static_cast<std::size_t>(link);
    const RobotPose a = PoseBetween(poses_[i], poses_[i + 1], from).pose;
    const RobotPose b = PoseBetween(poses_[i], poses_[i + 1], to).pose;
    const RigidCheck check = Judge(a, b);
    if (check.IsFree()) return;
    const bool is_short =
        ObjectDistance(a, b, model_.gyration) < kLeastPart * model_.reach;
    if (!is_short) {
      // Not at an end: there is a row already.
      const double share = std::clamp(check.time, 0.1, 0.9);
      added_.push_back({link, from + share * (to - from), MarginOf(link)});
      return;
    }
    for (PoseSample* sample : {before, after}) {
      if (sample == nullptr) continue;
      sample->margin =
          std::min(2.0 * sample->margin, kMostMargin * task_.margin);
    }
  }

  const RigidModel& model_;
  const PoseRoundsTask& task_;
  PoseRows* rows_;
  RigidStop* stop_;
  RigidPath poses_;
  std::vector<PoseSample> samples_, added_;
  std::vector<int> times_;  // rounds that added samples, of each link
  PoseRoundsEnd end_;
};

}  // namespace

std::vector<PoseSample> FirstSamples(int links, double margin) {
  std::vector<PoseSample> samples;
  for (int i = 0; i < links; ++i) {
    samples.push_back({i, 0.5, margin});
    if (i + 1 < links) samples.push_back({i, 1.0, margin});
  }
  return samples;
}

PoseRoundsEnd FreePoses(const RigidModel& model, const RigidPath& start,
                        const PoseRoundsTask& task, PoseRows* rows,
                        RigidStop* stop) {
  return Rounds(model, start, task, rows, stop).Run();
}

}  // namespace phongpd::internal
