// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what each metric does along motions – jumps, depth ratio, time – of
// Euclidean PD, PhongPD and the tracker, on the same motions in one run.
// Writes CSV and tracker.md into a directory.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <random>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"
#include "problems/studies/paper_benchmarks.h"
#include "results/bench/program.h"
#include "results/bench/tracker_report.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Motion = std::vector<Vector3d>;

struct Options {
  std::string directory;
  int motions = 25;
  int frames = 300;
  int repeats = 3;
  std::uint64_t seed = 1;
};

struct Space {
  std::string name;
  ContactSpace contact;
};

std::vector<Space> Spaces() {
  std::vector<Space> spaces;
  const auto add = [&](const std::string& name, const TriangleMesh& robot,
                       const TriangleMesh& obstacle) {
    spaces.push_back({name, BuildContactSpace(robot, obstacle)});
  };
  for (const PaperBenchmark& paper : PaperBenchmarks()) {
    add(paper.title, paper.robot, paper.obstacle);
  }
  const Vector3d half = Vector3d::Constant(0.2);
  const TriangleMesh cube = MakeBox(-half, half);
  const TriangleMesh turned = Rotated(cube, GenericRotation());
  const TriangleMesh ball = MakeIcoBall(0.25, 2);
  add("cube + L", cube, MakeL(2.0, 0.5, 0.6));
  add("turned cube + U", turned, MakeU(2.0, 0.3, 0.6));
  add("cube + plate with hole", cube, MakePlateWithHole(3.0, 0.2, 1.0));
  add("ball + plate with round hole", ball,
      MakePlateWithRoundHole(3.0, 0.1, 0.6, 24));
  add("cube + thin plate", cube,
      MakeBox({-1.5, -1.5, -0.02}, {1.5, 1.5, 0.02}));
  add("turned cube + hollow box", turned, MakeVessel(3.0, 2.0, 0.8));
  add("ball + torus", ball, MakeTorus(1.5, 0.4, 48, 20));
  add("ball + knot", ball, MakeKnot(0.5, 0.2, 96, 12));
  add("star + organic body", MakeStar(0.2, 0.4), MakeBlob(1.5, 4, 0.35, 1));
  add("ball + scanned U", ball, MakeScan(MakeU(2.0, 0.3, 0.6), 0.15, 0.002, 3));
  return spaces;
}

// Straight ways between interior points, a bend to the side in every second.
std::vector<Motion> Motions(const ContactSpace& contact,
                            const Options& options) {
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Vector3d center = contact.bounds().Center();
  const Vector3d half = 0.5 * (contact.bounds().max - contact.bounds().min);
  const auto any = [&] { return RandomVector(&unit, &random); };
  const auto interior = [&] {
    for (;;) {
      const Vector3d q = center + half.cwiseProduct(any());
      if (contact.bvh().Locate(q) == Location::kInside) return q;
    }
  };
  std::vector<Motion> motions;
  for (int i = 0; i < options.motions; ++i) {
    const Vector3d from = interior(), to = interior();
    const Vector3d bend = i % 2 == 0 ? Vector3d::Zero()
                                     : Vector3d(0.5 * half.cwiseProduct(any()));
    Motion motion;
    for (int frame = 0; frame < options.frames; ++frame) {
      const double t = static_cast<double>(frame) / (options.frames - 1);
      motion.push_back(from + t * (to - from) + 4.0 * t * (1.0 - t) * bend);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

struct Step {
  Vector3d pd;
  bool left_elsewhere;
  bool sliding;
};
// Begins a motion: a step for every position that follows.
using Begin = std::function<std::function<Step(const Vector3d&)>()>;

Begin FollowMetric(const PenetrationMetric& metric) {
  return [&metric] {
    return [&metric, branch = Branch()](const Vector3d& q) mutable {
      const PenetrationResult result = metric.Query(q, branch);
      const bool had = branch.IsValid();
      branch = result.branch;
      return Step{
          result.PenetrationVector(q),
          had && !result.inside && result.status == QueryStatus::kBranchEnded,
          false};
    };
  };
}

Begin FollowTracker(const PenetrationTracker& tracker) {
  return [&tracker] {
    return [&tracker,
            state = PenetrationTracker::State()](const Vector3d& q) mutable {
      const TrackerResult result = tracker.Step(q, &state);
      return Step{result.pd, result.status == TrackerStatus::kLeftElsewhere,
                  result.status == TrackerStatus::kSliding};
    };
  };
}

TrackerRow Measure(const Space& space, const std::string& metric,
                   const Begin& begin, const std::vector<Motion>& motions,
                   const std::vector<std::vector<double>>& depths,
                   const Options& options) {
  using Clock = std::chrono::steady_clock;
  const double diagonal = space.contact.length();
  const double bound = PenetrationTrackerOptions().speed + 1.0;
  TrackerRow row;
  row.space = space.name;
  row.metric = metric;
  row.triangles = space.contact.mesh().triangles.size();
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const Motion& motion = motions[m];
    std::vector<double> micros(motion.size(), 1e300);
    std::vector<Step> steps(motion.size());
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      const std::function<Step(const Vector3d&)> follow = begin();
      for (std::size_t i = 0; i < motion.size(); ++i) {
        const Clock::time_point start = Clock::now();
        steps[i] = follow(motion[i]);
        const std::chrono::duration<double, std::micro> time =
            Clock::now() - start;
        micros[i] = std::min(micros[i], time.count());
      }
    }
    for (std::size_t i = 0; i < motion.size(); ++i) {
      if (depths[m][i] > 0.0) {
        ++row.frames;
        row.ratios.push_back(steps[i].pd.norm() / depths[m][i]);
        row.micros.push_back(micros[i]);
        row.sliding += steps[i].sliding ? 1 : 0;
      }
      row.exits += steps[i].left_elsewhere ? 1 : 0;
      if (i == 0) continue;
      const double change = (steps[i].pd - steps[i - 1].pd).norm();
      const double step = (motion[i] - motion[i - 1]).norm();
      row.jumps += change > 0.05 * diagonal ? 1 : 0;
      row.beyond +=
          change > bound * step + 1e-12 * diagonal && !steps[i].left_elsewhere
              ? 1
              : 0;
    }
  }
  return row;
}

std::vector<TrackerRow> MeasureSpace(const Space& space,
                                     const Options& options) {
  const std::vector<Motion> motions = Motions(space.contact, options);
  const EuclideanMetric euclidean(space.contact);
  std::vector<std::vector<double>> depths;
  for (const Motion& motion : motions) {
    depths.emplace_back();
    for (const Vector3d& q : motion) {
      const PenetrationResult result = euclidean.Query(q);
      depths.back().push_back(result.inside ? -result.signed_distance : 0.0);
    }
  }
  std::vector<TrackerRow> rows;
  const auto measure = [&](const std::string& name, const Begin& begin) {
    rows.push_back(Measure(space, name, begin, motions, depths, options));
  };
  measure("euclidean", FollowMetric(euclidean));
  for (const double length : {0.0, 0.1, 0.2}) {
    PhongMetricOptions phong;
    phong.field_options.smoothing_length = length;
    const PhongMetric metric(space.contact, phong);
    measure("phong@" + Rounded(length), FollowMetric(metric));
  }
  const PenetrationTracker tracker(space.contact);
  measure("tracker", FollowTracker(tracker));
  return rows;
}

int Run(int argc, char** argv) {
  CLI::App app("Metrics along motions: tables.");
  Options options;
  app.add_option("--output", options.directory, "Directory to write into")
      ->required();
  app.add_option("--motions", options.motions)->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::vector<TrackerRow> rows;
  for (const Space& space : Spaces()) {
    const std::vector<TrackerRow> of_space = MeasureSpace(space, options);
    rows.insert(rows.end(), of_space.begin(), of_space.end());
    std::cout << ToText(TrackerTable(of_space).table) << std::endl;
  }
  const std::vector<NamedTable> tables = {TrackerTotals(rows),
                                          TrackerTable(rows)};
  OutputDirectory out(options.directory);
  const std::string command =
      CommandLine("build/tracker_benchmark", argc, argv);
  for (const NamedTable& named : tables) {
    out.Write(named.file, ToCsv(named.table));
  }
  out.Write("tracker.md", TrackerPage(tables, rows) + "\n" +
                              Circumstances(command, options.seed) + "\n");
  out.Commit();
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("tracker_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
