// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/corridor.h"

#include <algorithm>
#include <cmath>

#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/corridor_program.h"

namespace phongpd {
namespace {

using Eigen::VectorXd;

constexpr int kMaxRounds = 40;
constexpr double kRestoring = 50.0;      // P, the price of missing clearance
constexpr double kSmallestTrust = 1e-3;  // of the first round's
constexpr double kLeastGain = 1e-4;  // of the merit; two smaller ones end it

// A slope of a segment against a plane that is rounding.
constexpr double kLevel = 1e-9;

// How far around a path the planes of a round are looked for, units of D: a
// waypoint moves by at most √3 τ.
double ReachOf(const TrajectoryProblem& problem, double trust) {
  return 2.0 * trust + problem.margin;
}

// Of one round.
IpoptSettings RoundSettings() {
  IpoptSettings settings;
  settings.max_iterations = 60;
  settings.stall_iterations = 0;
  // A round is convex and starts near its solution: no large mu is needed to
  // find the way, nor more digits than two rounds differ by.
  settings.mu_strategy = IpoptSettings::MuStrategy::kMonotone;
  settings.ipopt_options["mu_init"] = 1e-5;
  settings.ipopt_options["tol"] = 1e-5;
  // The path as it is touches its planes' offsets; Ipopt's default would push
  // it a hundredth of every range away first.
  for (const char* name :
       {"bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac"}) {
    settings.ipopt_options[name] = 1e-6;
  }
  return settings;
}

// Polishes one free path; a round hands on to the next one the path, the
// corridor around it and the trust.
class CorridorPolish {
 public:
  // From the summary's path on; all outlive this.
  CorridorPolish(const TrajectoryProblem& problem, const Stopwatch& stopwatch,
                 double time_limit, const PathObserver& on_path,
                 CorridorSummary* summary)
      : problem_(problem),
        stopwatch_(stopwatch),
        time_limit_(time_limit),
        on_path_(on_path),
        summary_(*summary),
        springs_(problem, PathLength(summary->path)),
        now_(springs_.ToVariables(summary->path)) {
    // The path as it is has to be one that the program's rows allow.
    for (int i = 0; i <= springs_.waypoints; ++i) {
      springs_.eta =
          std::max(springs_.eta, springs_.Step(i, now_.data()).norm());
    }
    price_ =
        kRestoring / std::max((springs_.goal - springs_.start).norm(), 1e-3);
    corridor_ = CorridorAround(summary->path);
    merit_ = MeritOf(now_, corridor_);
  }

  void Run(int max_rounds) {
    summary_.status = PathStatus::kRoundLimit;
    while (static_cast<int>(summary_.rounds.size()) < max_rounds) {
      const double gain = DoRound();
      if (HasEnded(gain)) break;
    }
    summary_.objective = PathEnergy(problem_, summary_.path);
    summary_.clearance = LeastClearance();
  }

 private:
  Corridor CorridorAround(const Path& path) const {
    return FindCorridor(problem_, springs_, path, ReachOf(problem_, trust_));
  }
  double MeritOf(const VectorXd& x, const Corridor& corridor) const {
    return springs_.Energy(x.data()) + price_ * corridor.TotalMissing();
  }
  Path ToPath(const VectorXd& x) const {
    return springs_.ToPath(problem_.start, x.data(), problem_.goal);
  }

  // What the round gains, a share of the merit; 0 where it leads into contact.
  double DoRound() {
    const IpoptRun run = SolveRound();
    summary_.iterations += run.iterations;
    CorridorRound round;
    round.trust = trust_;
    round.planes = corridor_.CountPlanes();
    round.iterations = run.iterations;
    const double gain = TryStep(run.x);
    round.is_accepted = gain > 0.0;
    round.objective = springs_.Energy(now_.data());
    round.missing = corridor_.TotalMissing();
    summary_.rounds.push_back(round);
    if (!round.is_accepted) trust_ *= 0.5;
    return gain;
  }

  // The convex program around the path as it is.
  IpoptRun SolveRound() {
    CorridorProgram program(problem_, springs_, corridor_, now_, trust_,
                            price_);
    IpoptSettings settings = RoundSettings();
    const std::function<Path(const VectorXd&)> path_of =
        [this](const VectorXd& x) { return ToPath(x); };
    TellPaths(on_path_, static_cast<int>(summary_.rounds.size()), path_of,
              &settings);
    settings.time_limit = std::max(1e-3, time_limit_ - stopwatch_.Seconds());
    return SolveWithIpopt(&program, program.Start(), settings);
  }

  // Moves the path there if the judge finds that free and the merit falls.
  double TryStep(const VectorXd& x) {
    const Path moved = ToPath(x);
    if (!CheckPath(*problem_.free_space, moved).free) return 0.0;
    Corridor around = CorridorAround(moved);
    const double there = MeritOf(x, around);
    const double gain = (merit_ - there) / merit_;
    if (gain > 0.0) {
      summary_.path = moved;
      now_ = x.head(now_.size());
      corridor_ = std::move(around);
      merit_ = there;
    }
    return gain;
  }

  // After a round that gained so much; says why.
  bool HasEnded(double gain) {
    const bool is_accepted = summary_.rounds.back().is_accepted;
    // A round that failed by far says nothing about the next one.
    const bool is_small =
        std::abs(gain) < kLeastGain && (is_accepted || gain != 0.0);
    small_gains_ = is_small ? small_gains_ + 1 : 0;
    if (small_gains_ >= 2) {
      summary_.status = PathStatus::kConverged;
    } else if (trust_ < kSmallestTrust * kFirstTrust) {
      summary_.status = PathStatus::kSmallestTrust;
    } else if (stopwatch_.Seconds() > time_limit_) {
      summary_.status = PathStatus::kTimeLimit;
    } else {
      return false;
    }
    return true;
  }

  // Of what is around the path, and at most the margin.
  double LeastClearance() const {
    double least = problem_.margin;
    for (const auto& planes : corridor_.planes) {
      for (const Corridor::Plane& plane : planes) {
        least = std::min(least, plane.distance);
      }
    }
    return least;
  }

  const TrajectoryProblem& problem_;
  const Stopwatch& stopwatch_;
  double time_limit_;
  const PathObserver& on_path_;
  CorridorSummary& summary_;
  PathSprings springs_;
  VectorXd now_;        // the waypoints as variables
  double price_ = 0.0;  // of a unit of missing clearance
  double trust_ = kFirstTrust;
  Corridor corridor_;
  double merit_ = 0.0;
  int small_gains_ = 0;
};

}  // namespace

bool CorridorSummary::HasConverged() const {
  const bool has_gained =
      std::any_of(rounds.begin(), rounds.end(),
                  [](const CorridorRound& round) { return round.is_accepted; });
  return status == PathStatus::kConverged ||
         (status == PathStatus::kSmallestTrust && has_gained);
}

CorridorSummary PolishInCorridor(const TrajectoryProblem& problem,
                                 const Path& path, double time_limit,
                                 const PathObserver& on_path) {
  return PolishRounds(problem, path, kMaxRounds, time_limit, on_path);
}

CorridorSummary PolishRounds(const TrajectoryProblem& problem, const Path& path,
                             int max_rounds, double time_limit,
                             const PathObserver& on_path) {
  const Stopwatch stopwatch;
  problem.Validate();
  CheckOption(time_limit > 0.0, "corridor", "time_limit", "> 0 seconds",
              time_limit);
  CheckStartPath(problem, path);
  CorridorSummary summary;
  summary.path = path;
  summary.objective = PathEnergy(problem, path);
  if (CheckPath(*problem.free_space, path).free) {
    CorridorPolish polish(problem, stopwatch, time_limit, on_path, &summary);
    polish.Run(max_rounds);
  }
  summary.seconds = stopwatch.Seconds();
  return summary;
}

std::vector<CorridorPlane> PlanesAround(const TrajectoryProblem& problem,
                                        const Path& path) {
  problem.Validate();
  CheckStartPath(problem, path);
  std::vector<CorridorPlane> planes;
  if (!CheckPath(*problem.free_space, path).free) return planes;
  const PathSprings springs(problem, PathLength(path));
  const Corridor corridor =
      FindCorridor(problem, springs, path, ReachOf(problem, kFirstTrust));
  for (std::size_t i = 0; i < corridor.planes.size(); ++i) {
    for (const Corridor::Plane& plane : corridor.planes[i]) {
      const Eigen::Vector3d& a = path[i];
      const Eigen::Vector3d& b = path[i + 1];
      // Halfway where both ends are as low, but for rounding.
      const double rise = plane.normal.dot(b - a);
      const bool is_level = std::abs(rise) <= kLevel * (b - a).norm();
      const Eigen::Vector3d lowest = is_level     ? Eigen::Vector3d((a + b) / 2)
                                     : rise > 0.0 ? a
                                                  : b;
      const double above =
          plane.normal.dot((lowest - springs.center) / springs.unit) -
          plane.level;
      planes.push_back({static_cast<int>(i), plane.normal,
                        lowest - above * springs.unit * plane.normal,
                        plane.distance * springs.unit});
    }
  }
  return planes;
}

double MissingClearance(const TrajectoryProblem& problem, const Path& path) {
  if (problem.margin == 0.0) return 0.0;
  const PathSprings springs(problem, PathLength(path));
  // Gaps that are wider leave room for the margin.
  const double reach = 2.1 * problem.margin;
  double most = 0.0;
  for (const double missing :
       FindCorridor(problem, springs, path, reach).missing) {
    most = std::max(most, missing / problem.margin);
  }
  return std::min(most, 1.0);
}

}  // namespace phongpd
