// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what each metric does along motions – jumps, depth ratio, time – of
// Euclidean PD, PhongPD and the tracker, on the same motions in one run.
// Writes CSV into a directory, of which tracker_report.py makes tracker.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "results/bench/motion_cases.h"
#include "results/bench/program.h"
#include "results/bench/tracker_rows.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

struct Options {
  int motions = 25;
  int frames = 300;
  int repeats = 3;
  std::uint64_t seed = 1;
};

TrackerRow Measure(const MotionSpace& space, const std::string& metric,
                   const BeginFollowing& begin,
                   const std::vector<Motion>& motions,
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
    std::vector<MotionStep> steps(motion.size());
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      const Follower follow = begin();
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
      row.jumps += change > kMotionJump * diagonal ? 1 : 0;
      row.beyond +=
          change > bound * step + 1e-12 * diagonal && !steps[i].left_elsewhere
              ? 1
              : 0;
    }
  }
  return row;
}

std::vector<TrackerRow> MeasureSpace(const MotionSpace& space,
                                     const Options& options) {
  const std::vector<Motion> motions =
      MakeMotions(space.contact, options.motions, options.frames, options.seed);
  const EuclideanMetric euclidean(space.contact);
  std::vector<std::vector<double>> depths;
  for (const Motion& motion : motions) {
    depths.push_back(EuclideanDepths(euclidean, motion));
  }
  std::vector<TrackerRow> rows;
  const auto measure = [&](const std::string& name,
                           const BeginFollowing& begin) {
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

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("Metrics along motions: rows.");
  Options options;
  app.add_option("--motions", options.motions)->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();
  std::vector<TrackerRow> rows;
  for (const MotionSpace& space : MotionSpaces()) {
    const std::vector<TrackerRow> of_space = MeasureSpace(space, options);
    rows.insert(rows.end(), of_space.begin(), of_space.end());
    std::cout << ToText(TrackerTable(of_space).table) << std::endl;
  }
  program->Write({TrackerTotals(rows), TrackerTable(rows)});
  program->Finish(options.seed, "tracker_measured.txt");
  return 0;
}

}  // namespace phongpd::bench
