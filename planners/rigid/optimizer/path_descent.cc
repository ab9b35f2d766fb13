// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/path_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planners/rigid/object_norm.h"
#include "planners/rigid/optimizer/feature_contacts.h"
#include "planners/rigid/optimizer/linear_step.h"

namespace phongpd::internal {
namespace {

using Eigen::VectorXd;
using RigidPath = std::vector<RobotPose>;

// Of a motion, as planners ask (rigid_links.h).
constexpr long kMostTests = 300'000;
// Steps of a knot's numbers, of the robot's reach.
constexpr double kFirstTrust = 0.1, kMostTrust = 0.3, kLeastTrust = 1e-4;
// A gain that is none, of the length, for steps as long as that at least.
constexpr double kNoGain = 1e-4, kTellingTrust = 0.02;
// Two samples of a link are as far apart, of the reach, object norm.
constexpr double kLeastPart = 2e-4;
constexpr int kSolveIterations = 60;

double LengthOf(const RigidPath& path, double gyration) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    length += ObjectDistance(path[i], path[i + 1], gyration);
  }
  return length;
}

class Descent {
 public:
  Descent(const RigidModel& model, const RigidPath& start,
          const PathDescentTask& task, RigidStop* stop)
      : model_(model),
        task_(task),
        stop_(stop),
        features_(model.robot_surface, model.obstacle_surface),
        trust_(kFirstTrust * model.reach),
        path_(start) {
    end_.path = start;
    end_.length = LengthOf(start, model.gyration);
    const int links = static_cast<int>(start.size()) - 1;
    for (int i = 0; i < links; ++i) {
      places_.push_back({i, 0.5, {}});
      if (i + 1 < links) places_.push_back({i, 1.0, {}});
    }
    cost_ = CostOf(path_);
  }

  PathDescentEnd Run() {
    while (end_.rounds < task_.max_rounds) {
      if (!FindContacts()) {
        SetStopped();
        break;
      }
      ++end_.rounds;
      if (Round()) break;
    }
    end_.samples = places_.size();
    return end_;
  }

 private:
  void SetStopped() {
    end_.status = stop_->IsInterrupted() ? SolveStatus::kCancelled
                                         : SolveStatus::kTimeLimit;
  }

  // True: the end.
  bool Round() {
    const PoseChart chart(path_, model_.reach, model_.gyration);
    LinearStep step(chart, places_, task_.bounds, task_.margin, trust_);
    const VectorXd zero = VectorXd::Zero(step.variables());
    IpoptSettings settings;
    settings.max_iterations = kSolveIterations;
    settings.stall_iterations = 0;
    settings.on_iteration = [this](const IterationRecord&, const VectorXd&) {
      return !stop_->Asks();
    };
    const IpoptRun run = SolveWithIpopt(&step, zero, settings);
    end_.iterations += run.iterations;
    const double gain =
        model_.reach * (step.Objective(zero.data()) - run.objective);
    const bool is_solved = IsClassOk(run.status);
    if (is_solved && gain < kNoGain * end_.length &&
        trust_ >= kTellingTrust * model_.reach) {
      end_.status = is_shortest_ ? SolveStatus::kConverged
                                 : SolveStatus::kStalledFeasible;
      return true;
    }
    const bool has_gained = is_solved && Take(chart, run.x);
    if (stop_->Asks()) {
      SetStopped();
      return true;
    }
    if (!has_gained) trust_ *= 0.4;
    end_.status = SolveStatus::kStalledFeasible;
    if (trust_ < kLeastTrust * model_.reach) return true;
    end_.status = SolveStatus::kIterationLimit;
    return false;
  }

  // Takes the step or a part of it; false: none, and nothing was learned.
  bool Take(const PoseChart& chart, const VectorXd& x) {
    bool has_learned = false;
    for (const double share : {1.0, 0.5, 0.25}) {
      const VectorXd part = share * x;
      const RigidPath path = chart.Poses(part.data());
      const std::vector<Hit> hits = Judge(path);
      if (stop_->Asks()) return false;
      if (hits.empty()) {
        const double cost = CostOf(path);
        if (!(cost < cost_)) continue;
        Accept(path, cost);
        const bool is_bounded =
            x.head(chart.variables()).lpNorm<Eigen::Infinity>() >
            0.9 * trust_ / model_.reach;
        if (share < 1.0) {
          if (!has_learned) trust_ *= 0.7;
        } else if (is_bounded) {
          trust_ = std::min(2.0 * trust_, kMostTrust * model_.reach);
        }
        return true;
      }
      if (share == 1.0) {
        end_.was_refuted = true;
        has_learned = AddPlaces(hits);
      }
    }
    return has_learned;
  }

  // What steps make less.  Of a free path; infinite: stopped.
  double CostOf(const RigidPath& path) {
    double lack = 0.0;
    std::vector<PoseContact> contacts;
    for (const PathContacts& place : places_) {
      if (!features_.Find(PoseAt(path, place), task_.margin, &contacts,
                          &end_.tests, stop_)) {
        return std::numeric_limits<double>::infinity();
      }
      if (!contacts.empty()) lack += task_.margin - contacts.front().gap;
    }
    return LengthOf(path, model_.gyration) + LinearStep::kPenalty * lack;
  }

  void Accept(const RigidPath& path, double cost) {
    ++end_.steps;
    path_ = path;
    cost_ = cost;
    const double length = LengthOf(path, model_.gyration);
    is_shortest_ = length < end_.length;
    if (!is_shortest_) return;
    end_.path = path;
    end_.length = length;
  }

  static RobotPose PoseAt(const RigidPath& path, const PathContacts& place) {
    const auto i = static_cast<std::size_t>(place.link);
    return RigidMotion(path[i], path[i + 1]).At(place.t);
  }

  struct Hit {
    int link;
    double time;
  };

  // Where motions of the path are not free; empty: it is, unless stopped.
  std::vector<Hit> Judge(const RigidPath& path) {
    std::vector<Hit> hits;
    for (std::size_t i = 0; i + 1 < path.size() && !stop_->Asks(); ++i) {
      const RigidCheck check =
          model_.judge.Check(RigidMotion(path[i], path[i + 1]), kMostTests);
      ++end_.checks;
      end_.tests += check.tests;
      if (!check.IsFree()) hits.push_back({static_cast<int>(i), check.time});
    }
    return hits;
  }

  // Where a step collided, and where the path is closest there; false: all of
  // these places are there already.
  bool AddPlaces(const std::vector<Hit>& hits) {
    const std::size_t before = places_.size();
    for (const Hit& hit : hits) {
      if (stop_->Asks()) break;
      AddPlace(hit.link, hit.time);
      const auto i = static_cast<std::size_t>(hit.link);
      const RigidClearance closest = model_.judge.Clearance(
          RigidMotion(path_[i], path_[i + 1]), {}, kMostTests);
      end_.tests += closest.tests;
      AddPlace(hit.link, closest.time);
    }
    end_.added_samples += places_.size() - before;
    if (places_.size() > before) cost_ = CostOf(path_);
    return places_.size() > before;
  }

  void AddPlace(int link, double t) {
    const auto i = static_cast<std::size_t>(link);
    const double length =
        ObjectDistance(path_[i], path_[i + 1], model_.gyration);
    double nearest = std::min(t, 1.0 - t);
    for (const PathContacts& place : places_) {
      if (place.link != link) continue;
      nearest = std::min(nearest, std::abs(place.t - t));
    }
    if (nearest * length < kLeastPart * model_.reach) return;
    places_.push_back({link, t, {}});
  }

  // All that a step within the trust can close; false: stopped.
  bool FindContacts() {
    const double radius =
        task_.margin +
        trust_ * std::sqrt(3.0) * (1.0 + model_.reach / model_.gyration);
    for (PathContacts& place : places_) {
      if (stop_->Asks()) return false;
      if (!features_.Find(PoseAt(path_, place), radius, &place.contacts,
                          &end_.tests, stop_)) {
        return false;
      }
    }
    return true;
  }

  const RigidModel& model_;
  const PathDescentTask& task_;
  RigidStop* stop_;
  FeatureContacts features_;
  double trust_;
  std::vector<PathContacts> places_;
  RigidPath path_;  // free
  // Is it what is answered?  Steps that give places room may make it longer.
  bool is_shortest_ = true;
  double cost_ = 0.0;
  PathDescentEnd end_;
};

}  // namespace

PathDescentEnd DescendPath(const RigidModel& model, const RigidPath& start,
                           const PathDescentTask& task, RigidStop* stop) {
  return Descent(model, start, task, stop).Run();
}

}  // namespace phongpd::internal
