// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "results/bench/report.h"

// What flags give within how many seconds, from a world in which nothing is
// built.
namespace phongpd::bench {

// A pair of solids whose triangles are about `decade`, those of both together.
struct BudgetCase {
  std::string family;
  std::size_t decade = 0;  // 1000, 10000, 100000 or 1000000
  std::function<TriangleMesh()> robot, obstacle;
};
std::vector<BudgetCase> BudgetCases();

// One set of flags on one problem.
struct BudgetRow {
  std::string use;  // "optimize" or "plan"
  std::string family, flags, status;
  std::size_t decade = 0, triangles = 0;
  std::uint64_t seed = 0;
  // Processor seconds, of free space, or of the contact space, whose build is
  // measured once for each case.
  double build = 0.0;
  double answer = 0.0;   // the same, of all that came after
  bool is_free = false;  // by the exact judge, and all the way to the goal
  double length = 0.0, clearance = 0.0;  // of the path, shares of D
};

struct BudgetOptions {
  std::uint64_t seed = 1;
  int seeds = 2;      // problems of each case
  std::string cache;  // a folder for contact spaces, empty at first
};

// What takes more than this is measured no further: status "over".  A model
// that was refused or over for one problem of a case is so for all of them,
// whatever the preset: it builds the same.
inline constexpr double kMostSeconds = 10.0;

// All flags on all problems of the case; both uses on the same problems.
std::vector<BudgetRow> MeasureBudget(const BudgetCase& pair,
                                     const BudgetOptions& options);

NamedTable BudgetTable(const std::vector<BudgetRow>& rows);

}  // namespace phongpd::bench
