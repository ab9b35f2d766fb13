// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "problems/studies/motion.h"
#include "problems/studies/paper_benchmarks.h"

namespace phongpd::bench {

// Fig. 8's moment as an SVG: for every metric one panel with the cut x =
// const of obstacle, contact space and robot, the robot's positions, and the
// PD vector at each.
std::string MomentFigure(const PaperBenchmark& benchmark,
                         const TriangleMesh& contact,
                         const StraightMotion& motion,
                         const std::vector<MotionTrace>& traces);

}  // namespace phongpd::bench
