// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::bench {

// One pair of solids.  They are made where they are measured, so that no
// other measurement pays for their memory.
struct BuildCase {
  std::string name;
  std::function<TriangleMesh()> robot;
  std::function<TriangleMesh()> obstacle;
  // What is asked for; 0: nothing.
  double target_seconds = 0.0;
  double target_mib = 0.0;
  int target_triangles = 0;
  bool compete = false;  // also measured with the competitors
};

std::vector<BuildCase> BuildCases();

// A convex robot on a smooth obstacle of growing size.
struct GrowthSeries {
  std::string name;
  std::vector<BuildCase> cases;  // smallest first
};
std::vector<GrowthSeries> GrowthCases();

}  // namespace phongpd::bench
