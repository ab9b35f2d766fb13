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
  settings.ipopt_options["mu_init"] = "1e-5";
  settings.ipopt_options["tol"] = "1e-5";
  // The path as it is touches its planes' offsets; Ipopt's default would push
  // it a hundredth of every range away first.
  for (const char* name :
       {"bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac"}) {
    settings.ipopt_options[name] = "1e-6";
  }
  return settings;
}

}  // namespace

const char* ToString(CorridorStatus status) {
  switch (status) {
    case CorridorStatus::kConverged:
      return "converged";
    case CorridorStatus::kSmallestTrust:
      return "smallest_trust";
    case CorridorStatus::kRoundLimit:
      return "round_limit";
    case CorridorStatus::kTimeLimit:
      return "time_limit";
    case CorridorStatus::kNotFree:
      break;
  }
  return "not_free";
}

bool CorridorSummary::HasConverged() const {
  const bool has_gained =
      std::any_of(rounds.begin(), rounds.end(),
                  [](const CorridorRound& round) { return round.is_accepted; });
  return status == CorridorStatus::kConverged ||
         (status == CorridorStatus::kSmallestTrust && has_gained);
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
  if (!CheckPath(*problem.free_space, path).free) {
    summary.seconds = stopwatch.Seconds();
    return summary;
  }

  PathSprings springs(problem, PathLength(path));
  VectorXd now = springs.ToVariables(path);
  for (int i = 0; i <= springs.waypoints; ++i) {
    springs.eta = std::max(springs.eta, springs.Step(i, now.data()).norm());
  }
  const double price =
      kRestoring / std::max((springs.goal - springs.start).norm(), 1e-3);
  double trust = kFirstTrust;
  Corridor corridor =
      FindCorridor(problem, springs, path, ReachOf(problem, trust));
  double merit = springs.Energy(now.data()) + price * corridor.TotalMissing();
  const std::function<Path(const VectorXd&)> path_of = [&](const VectorXd& x) {
    return springs.ToPath(problem.start, x.data(), problem.goal);
  };
  int small_gains = 0;
  summary.status = CorridorStatus::kRoundLimit;
  while (static_cast<int>(summary.rounds.size()) < max_rounds) {
    CorridorProgram program(problem, springs, corridor, now, trust, price);
    IpoptSettings settings = RoundSettings();
    TellPaths(on_path, static_cast<int>(summary.rounds.size()), path_of,
              &settings);
    settings.time_limit = std::max(1e-3, time_limit - stopwatch.Seconds());
    const IpoptRun run = SolveWithIpopt(&program, program.Start(), settings);
    summary.iterations += run.iterations;

    CorridorRound round;
    round.trust = trust;
    round.planes = corridor.CountPlanes();
    round.iterations = run.iterations;
    const Path moved = path_of(run.x);
    double gain = 0.0;
    if (CheckPath(*problem.free_space, moved).free) {
      Corridor around =
          FindCorridor(problem, springs, moved, ReachOf(problem, trust));
      const double there =
          springs.Energy(run.x.data()) + price * around.TotalMissing();
      gain = (merit - there) / merit;
      round.is_accepted = gain > 0.0;
      if (round.is_accepted) {
        summary.path = moved;
        now = run.x.head(now.size());
        corridor = std::move(around);
        merit = there;
      }
    }
    round.objective = springs.Energy(now.data());
    round.missing = corridor.TotalMissing();
    summary.rounds.push_back(round);
    if (!round.is_accepted) trust *= 0.5;
    // A round that failed by far says nothing about the next one.
    const bool is_small =
        std::abs(gain) < kLeastGain && (round.is_accepted || gain != 0.0);
    small_gains = is_small ? small_gains + 1 : 0;
    if (small_gains >= 2) {
      summary.status = CorridorStatus::kConverged;
      break;
    }
    if (trust < kSmallestTrust * kFirstTrust) {
      summary.status = CorridorStatus::kSmallestTrust;
      break;
    }
    if (stopwatch.Seconds() > time_limit) {
      summary.status = CorridorStatus::kTimeLimit;
      break;
    }
  }
  summary.objective = PathEnergy(problem, summary.path);
  summary.clearance = problem.margin;
  for (const auto& planes : corridor.planes) {
    for (const Corridor::Plane& plane : planes) {
      summary.clearance = std::min(summary.clearance, plane.distance);
    }
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
