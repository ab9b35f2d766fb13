// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "results/bench/child_process.h"
#include "results/bench/contact_space_cases.h"
#include "tests/support/random_pairs.h"

// The measurements of results/contact-space, each in a process of its own.
namespace phongpd::bench {

// One process.
struct Measurement {
  ChildStatus status = ChildStatus::kCrashed;
  double seconds = 0.0;  // of the work if kDone, else of the process
  double peak_mib = 0.0;
};

// Several builds of one case; `seconds` is their median.
struct BuildMeasurement : Measurement {
  int robot_triangles = 0;
  int obstacle_triangles = 0;
  int triangles = 0;
  int components = 0;
  int genus = 0;
  int cavities = 0;
  bool sound = false;  // closed and manifold
  int self_intersections = 0;
  double volume = 0.0;
  int convolution_triangles = 0;
  int arrangement_faces = 0;
  int builds = 0;
  double slowest = 0.0;
  std::vector<std::pair<std::string, double>> stages;  // medians
  std::uint64_t hash = 0;                              // of the mesh's bytes
};

// At most `builds` builds, fewer once they have taken `limit` / 4 together;
// `threads` 0: all.
BuildMeasurement MeasureBuild(const BuildCase& build, int builds, int threads,
                              double limit);

// One run of a competitor.
struct CompetitorMeasurement : Measurement {
  int triangles = 0;
  double volume = 0.0;
};
// Built in?  Else the two functions return kCrashed.
bool HasCompetitors();
CompetitorMeasurement MeasureNef(const BuildCase& build, double limit);
CompetitorMeasurement MeasureHulls(const BuildCase& build, double limit);

// All checks of one kind of random pair.
struct FuzzCount {
  PairKind kind = PairKind::kAligned;
  int pairs = 0;
  int failed = 0;  // crashed or stopped ones included
  int stopped = 0;
  int points = 0;  // judged
  int crevices = 0;
  int undecided = 0;
  int oracle_errors = 0;
  int rounded_pairs = 0;  // pairs with contacts made by rounding
  double slowest = 0.0;   // build
  int slowest_seed = 0;
  int largest = 0;  // triangles
  std::vector<std::string> failures;
};
// Seeds `first` to `first` + pairs − 1, two processes at a time, each pair in
// its own with `limit` seconds for all its builds and points.
FuzzCount CheckPairs(PairKind kind, std::uint64_t first, int pairs,
                     double limit);

}  // namespace phongpd::bench
