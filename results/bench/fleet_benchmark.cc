// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: when several robots have arrived, by order of priority and made
// faster together, beside the slowest one alone; certified or not, and what FCL
// finds at 10⁴ times.  Writes fleets.csv into a directory, of which
// fleet_report.py makes README.md.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "constraints/oracle/collision_oracle.h"
#include "core/pi.h"
#include "planners/solve/fleet.h"
#include "problems/shapes/shapes.h"
#include "results/bench/free_space_measure.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Ends = std::vector<std::pair<Vector3d, Vector3d>>;

constexpr int kTimes = 10'000;

struct Options {
  int seeds = 10;
  int large_seeds = 5;  // of sixteen robots
  // Those from 101 on were in sight when what is measured was made.
  std::uint64_t first_seed = 201;
};

// Boxes of side 1 in rooms that grow with their number.
double RoomSize(int robots) { return 2.0 + 0.4 * robots; }

// Around a circle, unevenly, to the place across it.
Ends AcrossACircle(int robots, std::mt19937_64* random) {
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  const double radius = RoomSize(robots) - 0.5;
  Ends ends;
  for (int i = 0; i < robots; ++i) {
    const double angle = 2.0 * kPi * (i + jitter(*random)) / robots;
    const Vector3d at(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    ends.emplace_back(at, -at);
  }
  return ends;
}

// From anywhere to anywhere in the room, `height` of it up and down.
Ends Anywhere(int robots, double height, std::mt19937_64* random) {
  constexpr double kApart = 1.2;
  const double size = RoomSize(robots) - 0.5;
  std::uniform_real_distribution<double> along(-size, size);
  std::uniform_real_distribution<double> up(-height, height);
  const auto draw = [&](const std::vector<Vector3d>& others) {
    for (;;) {
      const Vector3d q(along(*random), along(*random), up(*random));
      if (std::none_of(others.begin(), others.end(), [&](const Vector3d& p) {
            return (p - q).cwiseAbs().maxCoeff() < kApart;
          })) {
        return q;
      }
    }
  };
  std::vector<Vector3d> starts, goals;
  for (int i = 0; i < robots; ++i) starts.push_back(draw(starts));
  for (int i = 0; i < robots; ++i) goals.push_back(draw(goals));
  Ends ends;
  for (int i = 0; i < robots; ++i) ends.emplace_back(starts[i], goals[i]);
  return ends;
}

std::vector<FleetRobot> RobotsOf(const Ends& ends, double height) {
  const double size = RoomSize(static_cast<int>(ends.size()));
  Workspace workspace;
  workspace.robot =
      MakeSolid(MakeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), "robot");
  workspace.bounds = {{-size, -size, -height}, {size, size, height}};
  const World world(workspace);
  OptimizeRequest request;
  request.limits.emplace();
  request.limits->velocity.setConstant(1.0);
  request.limits->acceleration.setConstant(2.0);
  request.limits->jerk.setConstant(10.0);
  std::vector<FleetRobot> robots;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    request.start = ends[i].first;
    request.goal = ends[i].second;
    robots.push_back({"robot " + std::to_string(i), world, request});
  }
  return robots;
}

struct Row {
  std::string kind;
  int robots = 0;
  std::uint64_t seed = 0;
  bool is_solved = false;
  int certified = 0, pairs = 0;
  long hits = 0;
  double alone = 0.0, by_order = 0.0, duration = 0.0;
  int rounds = 0;
  double seconds = 0.0;
};

long HitsOf(const std::vector<FleetRobot>& robots, const FleetAnswer& answer) {
  const Solid& robot = robots[0].world.workspace().robot;
  const CollisionOracle oracle(robot, robot);
  long hits = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (int n = 0; n <= kTimes; ++n) {
        const double t = answer.duration * n / kTimes;
        hits += oracle.Collides(answer.robots[i].motion.At(t).position -
                                answer.robots[k].motion.At(t).position);
      }
    }
  }
  return hits;
}

Row Measure(const std::string& kind, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double height = kind == "anywhere in space" ? 2.0 : 0.05;
  const Ends ends = kind == "across a circle"
                        ? AcrossACircle(count, &random)
                        : Anywhere(count, height - 0.05, &random);
  const std::vector<FleetRobot> robots = RobotsOf(ends, height);
  Row row;
  row.kind = kind;
  row.robots = count;
  row.seed = seed;
  for (const FleetRobot& robot : robots) {
    const PathAnswer alone = Optimize(robot.world, robot.request);
    row.alone = std::max(row.alone, alone.motion.duration());
  }
  const double start = CpuSeconds();
  const FleetAnswer answer = OptimizeFleet(robots);
  row.seconds = CpuSeconds() - start;
  row.is_solved = answer.IsSolved();
  if (!row.is_solved) return row;
  row.pairs = static_cast<int>(answer.pairs.size());
  for (const FleetPair& pair : answer.pairs) {
    row.certified += pair.is_free && pair.verification &&
                     pair.verification->verdict == Verdict::kConfirmed;
  }
  row.hits = HitsOf(robots, answer);
  row.by_order = answer.by_order;
  row.duration = answer.duration;
  row.rounds = answer.rounds_together;
  return row;
}

NamedTable TableOf(const std::vector<Row>& rows) {
  return {"fleets.csv",
          MakeTable(
              {"kind", "robots", "seed", "solved", "pairs", "certified", "hits",
               "alone", "by order", "duration", "rounds together", "CPU s"},
              rows, [](const Row& r, const auto& add) {
                add(r.kind, r.robots, static_cast<std::size_t>(r.seed),
                    std::string(r.is_solved ? "yes" : "no"), r.pairs,
                    r.certified, static_cast<int>(r.hits), r.alone, r.by_order,
                    r.duration, r.rounds, r.seconds);
              })};
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput(
      "Several robots at once: when have all arrived?  A table.");
  Options options;
  app.add_option("--seeds", options.seeds)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--large-seeds", options.large_seeds, "Of sixteen robots")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  program->Parse();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                1);
  std::vector<Row> rows;
  for (const int count : {2, 4, 8, 16}) {
    const int seeds = count == 16 ? options.large_seeds : options.seeds;
    for (const std::string kind :
         {"across a circle", "anywhere in a plane", "anywhere in space"}) {
      for (int i = 0; i < seeds; ++i) {
        rows.push_back(Measure(
            kind, count, options.first_seed + static_cast<std::uint64_t>(i)));
        std::cout << ToText(TableOf({rows.back()}).table) << std::endl;
      }
    }
  }
  program->Write({TableOf(rows)});
  program->Finish(options.first_seed);
  return 0;
}

}  // namespace phongpd::bench
