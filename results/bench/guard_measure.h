// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/bench/report.h"

// What a build was predicted to cost against what it cost, and what limits do.
namespace phongpd::bench {

// One pair, each build in a process of its own with one thread: there
// processor time is what the prediction means, whatever else the machine does.
struct GuardRow {
  std::string robot, obstacle;
  int robot_triangles = 0, obstacle_triangles = 0;
  int facets = 0, faces = 0, triangles = 0;
  bool is_culled = false;
  double seconds = 0.0, mib = 0.0;  // processor time, growth of the process
  double predicted_meetings = 0.0, predicted_faces = 0.0;
  double predicted_seconds = 0.0, predicted_mib = 0.0;
  // Wall time and growth until a limit of half of them refused the build, over
  // the limit; 0: too small to be tried.
  double time_passed = 0.0, memory_passed = 0.0;
  std::string time_stage, memory_stage;  // where it was stopped
  // The same by boxes; nothing where the whole is too small to be tried, or
  // where boxes do not fit together.
  double boxes_seconds = 0.0, boxes_mib = 0.0, predicted_boxes_mib = 0.0;
};

// Random pairs of the project's shapes, turned and aligned, 12 to some 20,000
// triangles; must be called before any thread was started.
std::vector<GuardRow> MeasureGuard(int pairs, std::uint64_t seed);

// The rows, and what they come to.
NamedTable GuardTable(const std::vector<GuardRow>& rows);
NamedTable GuardVerdict(const std::vector<GuardRow>& rows);
// What boxes spare, and cost.
NamedTable BoxesVerdict(const std::vector<GuardRow>& rows);

}  // namespace phongpd::bench
