// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/phong_field.h"
#include "problems/studies/motion.h"
#include "results/bench/paper_benchmarks.h"

// Everything results/paper says about one benchmark, as numbers.
namespace phongpd::bench {

struct PaperOptions {
  int motions = 100;   // random interior straight motions
  int frames = 400;    // of each
  int points = 10000;  // random interior points
  int builds = 5;      // of the contact space, for its time
  std::uint64_t seed = 1;
  double jump = 0.05;  // of the diagonal, between two frames
};

// Interior points without any projection, by depth: fifth k holds Euclidean
// depths in (k/5, (k+1)/5] of the deepest point met.
struct Coverage {
  std::string method;
  std::array<int, 5> points{};
  std::array<int, 5> missing{};
};

// One metric along all random motions.
struct MotionTotals {
  std::string metric;
  std::string label;
  int frames_inside = 0;
  int jumps = 0;
  // The kinds of jump: at a flagged frame; leaving C_obj on another side than
  // the branch led to; none when the step is divided; none of these.
  int flagged_jumps = 0;
  int steep_jumps = 0;
  int silent_jumps = 0;
  int branch_ends = 0;
  int fallbacks = 0;
  double ratio_mean = 0.0;  // |PD| / Euclidean |PD| over interior frames
  double ratio_p99 = 0.0;
  double ratio_max = 0.0;
  double cold_ratio_mean = 0.0;  // the same, each frame asked cold
  double cold_ratio_max = 0.0;
  double median_us = 0.0;  // per query inside, branch carried along
  double p99_us = 0.0;
  double cold_median_us = 0.0;  // without a branch
};

struct PaperResult {
  PaperBenchmark benchmark;
  std::optional<ContactSpace> space;
  double diagonal = 0.0;
  double build_seconds = 0.0;  // median of all builds
  std::vector<Coverage> coverage;
  std::vector<MotionTotals> totals;  // euclidean, phong@0, phong@0.1
  std::vector<std::vector<MotionTrace>> traces;  // per paper motion
  PhongFieldReport field;                        // at ℓ = 0.1
};

PaperResult Measure(const PaperBenchmark& benchmark,
                    const PaperOptions& options);

}  // namespace phongpd::bench
