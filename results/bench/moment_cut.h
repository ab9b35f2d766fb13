// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problems/studies/motion.h"
#include "results/bench/paper_benchmarks.h"
#include "results/bench/report.h"

namespace phongpd::bench {

// Fig. 8's moment where the plane x = const of the motion cuts it: segments of
// obstacle, contact space, the robot at the first and at the last frame; and
// the robot's way.
Table MomentCut(const PaperBenchmark& benchmark, const TriangleMesh& contact,
                const StraightMotion& motion);

}  // namespace phongpd::bench
