// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/projection/penetration_metric.h"

// A metric followed along a straight motion: the paper's Figs. 5-8.
namespace phongpd {

// q(t) = from + t (to − from), seen at `frames` equal steps of t in [0, 1].
struct StraightMotion {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  int frames = 400;

  // Configuration of frame 0 … frames − 1; both ends are met exactly.
  Eigen::Vector3d At(int frame) const;
};

// One metric along one motion.
struct MotionTrace {
  std::string metric;  // as in the CSV: euclidean, phong, phong@0.1, sliding
  std::string label;   // for people
  std::vector<PenetrationResult> results;  // per frame
  std::vector<QueryStatus> status;
  std::vector<Eigen::Vector3d> pd;  // PD(q) = q_c − q, 0 outside
  bool is_sliding = false;          // by the tracker
};

// Queries `metric` at every frame, handing each frame's branch to the next.
MotionTrace TraceMotion(const PenetrationMetric& metric,
                        const StraightMotion& motion, std::string name,
                        std::string label);

// What a trace amounts to.  Lengths in the user's unit.
struct MotionSummary {
  int inside = 0;             // frames in penetration
  double max_magnitude = 0;   // largest |PD|
  double largest_change = 0;  // largest |PD(i) − PD(i−1)|
  int jumps = 0;              // changes larger than jump_length
  int branch_ends = 0;        // frames with status branch_ended
  int fallbacks = 0;          // frames with status euclidean_fallback
  int sliding = 0;            // frames with status sliding
  int left_elsewhere = 0;     // frames with status left_elsewhere
};
MotionSummary Summarize(const MotionTrace& trace, double jump_length);

// frame,metric,status,pd_x,pd_y,pd_z,magnitude: one row a frame and metric.
std::string MotionCsv(const std::vector<MotionTrace>& traces);

// The same, and the position of every frame: an object a line.
std::string MotionJson(const StraightMotion& motion,
                       const std::vector<MotionTrace>& traces);

// x, y, z and magnitude of every metric over the frames, on one SVG page.
std::string MotionPage(const std::vector<MotionTrace>& traces,
                       const std::string& title);

}  // namespace phongpd
