// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/wrench_cases.h"

// What metrics say along a motion that turns, one contact space of translations
// a pose.
namespace phongpd::bench {

// At one pose; lengths in the robot's radius of gyration L, so that a wrench
// (n, r × n / L) has no unit.
struct WrenchSample {
  bool inside = false;
  bool is_bounded = false;   // of the tracker: by its speed
  bool is_fallback = false;  // Euclid's answer, for want of an own one
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  double exit = 0.0;   // length of the first way out along the normal
  double push = 0.0;   // how far a force pushes: the exit, or the tracker's own
  double depth = 0.0;  // Euclid's: the least exit
};

// A metric along one motion at one length of steps.  Changes are the largest
// between two poses in a row that are both inside, of vectors, their lengths.
struct WrenchRow {
  std::string pair, motion, metric;
  std::uint64_t seed = 0;
  int steps = 0;
  double step = 0.0;  // the longest, in L
  int inside = 0;     // poses
  double normal_change = 0.0, torque_change = 0.0;
  double push_change = 0.0;  // of push · normal
  int bounded = 0, fallbacks = 0;
  double exit_mean = 0.0, exit_worst = 0.0;  // over Euclid's
  double microseconds = 0.0;        // a pose, without the space; processor time
  double space_milliseconds = 0.0;  // a pose's contact space, with its field
};

// The largest changes and exits of samples in a row.
void Summarize(const std::vector<WrenchSample>& samples, WrenchRow* row);

// Of one pair: both motions, all metrics, `lengths` step lengths, each half of
// the one before, from `steps` on.
std::vector<WrenchRow> MeasureWrenches(const WrenchPair& pair, int steps,
                                       int lengths);

}  // namespace phongpd::bench
