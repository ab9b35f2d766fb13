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
constexpr int kMostFailures = 3;      // in a row, once a free path is known
constexpr int kStall = 10;
// An iterate is judged where rows are violated by less, units of the reach: it
// may be free by its margin.
constexpr double kNearlyFeasible = 1e-4;
// And where it is shorter by that share than what is known.
constexpr double kLeastGain = 1e-4;
// Of the way to a path that was refuted.
constexpr double kLeastShare = 0.02;

double LengthOf(const RigidPath& path, double gyration) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    length += ObjectDistance(path[i], path[i + 1], gyration);
  }
  return length;
}

class Rounds {
 public:
  Rounds(const RigidModel& model, const RigidPath& start,
         const PoseRoundsTask& task, PoseRows* rows, RigidStop* stop)
      : model_(model), task_(task), rows_(rows), stop_(stop), poses_(start) {
    const int links = static_cast<int>(poses_.size()) - 1;
    times_.assign(static_cast<std::size_t>(links), 0);
    for (int i = 0; i < links; ++i) {
      samples_.push_back({i, 0.5, task_.margin});
      if (i + 1 < links) samples_.push_back({i, 1.0, task_.margin});
    }
  }

  PoseRoundsEnd Run() {
    const double begin = stop_->Seconds();
    int failures = 0;
    if (IsFree(poses_)) Keep(poses_);
    while (end_.rounds < task_.max_rounds && !stop_->Asks()) {
      const double left = task_.time_limit - (stop_->Seconds() - begin);
      if (!(left > 0.0)) break;
      ++end_.rounds;
      const bool is_claimed = Solve(left);
      if (is_claimed && IsFree(poses_)) {
        Keep(poses_);
        end_.is_confirmed = true;
        break;
      }
      end_.was_refuted |= is_claimed;
      failures = is_claimed ? 0 : failures + 1;
      const int most = end_.path.empty() ? task_.max_failures : kMostFailures;
      if (failures >= most) break;
      AddSamples();
      if (!end_.path.empty()) poses_ = Between();
    }
    end_.samples = samples_.size();
    return end_;
  }

 private:
  // One solve; true where Ipopt calls its end, now poses_, solved.
  bool Solve(double seconds) {
    PoseProgram program(PoseChart(poses_, model_.reach, model_.gyration),
                        samples_, task_.bounds, rows_);
    IpoptSettings settings;
    settings.max_iterations = task_.max_iterations;
    settings.stall_iterations = kStall;
    settings.time_limit = seconds;
    if (IsFree(poses_)) StartFromHere(&settings);
    settings.on_iteration = [&](const IterationRecord& record,
                                const VectorXd& x) {
      if (record.violation <= kNearlyFeasible) {
        const RigidPath path = program.chart().Poses(x.data());
        const double length = LengthOf(path, model_.gyration);
        const bool is_worth_it =
            end_.path.empty() || length < (1.0 - kLeastGain) * end_.length;
        if (is_worth_it && IsFree(path)) Keep(path);
      }
      return !stop_->Asks();
    };
    const IpoptRun run =
        SolveWithIpopt(&program, VectorXd::Zero(program.variables()), settings);
    end_.status = run.status;
    end_.iterations += run.iterations;
    poses_ = program.chart().Poses(run.x.data());
    return IsClassOk(run.status);
  }

  // A start near the answer: a large mu would push it off the walls first, and
  // into others.
  static void StartFromHere(IpoptSettings* settings) {
    settings->mu_strategy = IpoptSettings::MuStrategy::kMonotone;
    for (const char* name :
         {"bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac"}) {
      settings->ipopt_options[name] = "1e-6";
    }
    settings->ipopt_options["mu_init"] = "1e-4";
  }

  RigidCheck Judge(const RobotPose& a, const RobotPose& b) {
    const RigidCheck check = model_.judge.Check(RigidMotion(a, b), kMostTests);
    ++end_.checks;
    end_.tests += check.tests;
    return check;
  }

  bool IsFree(const RigidPath& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (!Judge(path[i], path[i + 1]).IsFree()) return false;
    }
    return true;
  }

  // Of the ways from the shortest free path to what was refuted the last free
  // one that is seen, knot by knot; kept, and where the next round begins.
  RigidPath Between() {
    const RigidPath from = end_.path;
    for (double share = 0.8; share > kLeastShare; share *= 0.6) {
      RigidPath path = from;
      for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        path[i] = RigidMotion(from[i], poses_[i]).At(share);
      }
      if (!IsFree(path)) continue;
      Keep(path);
      break;
    }
    return end_.path;
  }

  void Keep(const RigidPath& path) {
    const double length = LengthOf(path, model_.gyration);
    if (!end_.path.empty() && length >= end_.length) return;
    end_.path = path;
    end_.length = length;
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

PoseRoundsEnd OptimizePoses(const RigidModel& model, const RigidPath& start,
                            const PoseRoundsTask& task, PoseRows* rows,
                            RigidStop* stop) {
  return Rounds(model, start, task, rows, stop).Run();
}

}  // namespace phongpd::internal
