// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// The pairs of results/lazy.
namespace phongpd::bench {

struct LazyCase {
  std::string name;
  std::function<TriangleMesh()> robot, obstacle;
};

std::vector<LazyCase> LazyCases();

}  // namespace phongpd::bench
