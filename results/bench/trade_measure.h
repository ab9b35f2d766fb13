// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// What presets and one knob after the other buy and cost: every choice on the
// same instances, in one process, so that times can be divided by each other.
namespace phongpd::bench {

// One choice on one instance.
struct TradeTrial {
  std::string consumer;   // "optimize", "plan", ...
  std::string instance;   // scene and seed
  std::string choice;     // "routes 8"; the first of a consumer is its default
  double seconds = 0.0;   // of the processor
  bool answered = false;  // as exactly as the consumer answers at all
  // What there is too much of, ≥ 0: objective, length, depth.  Instances are
  // compared with the least that any choice found.
  double measure = 0.0;
};

struct TradeOptions {
  std::uint64_t seed = 1;
  int seeds = 3;  // a scene
};

// The trajectory pipeline: its energy.
std::vector<TradeTrial> MeasureOptimize(const TradeOptions& options);
// The contact-surface planner: the length of its path.
std::vector<TradeTrial> MeasurePlan();

// Levels of the model, contact space included: the time to a first path by
// rrt-connect, and its length; the optimiser and its energy.
std::vector<TradeTrial> MeasureModels(const TradeOptions& options);

// A consumer's choice over all instances.
struct TradeSum {
  std::string consumer, choice;
  int instances = 0, answered = 0;
  double time = 0.0;  // median over instances of time / time of the default
  double slow = 0.0;  // the same, 90 %
  double excess = 0.0, worst = 0.0;  // mean and worst, % over the least
};
std::vector<TradeSum> Sum(const std::vector<TradeTrial>& trials);

// A Phong field followed along motions, its times over those of the first.
struct FieldSum {
  double ell = 0.0;   // a share of D
  double edge = 0.0;  // longest edge over ℓ; 0: as the contact space has them
  std::size_t triangles = 0;
  double build = 0.0, warm = 0.0, cold = 0.0;  // medians over contact spaces
  int jumps = 0;
  std::vector<double> ratios;  // depth over Euclidean depth, frames inside

  FieldSum(double of_ell, double of_edge) : ell(of_ell), edge(of_edge) {}
};
std::vector<FieldSum> MeasureFields(const TradeOptions& options);

// Simpler operands of one pair of solids.
struct ApproximationRow {
  std::string pair, choice;
  std::size_t triangles = 0;
  double build = 0.0;  // processor time over that of the exact build
  double bound = 0.0;  // told by the report, % of D
  double mean = 0.0, worst = 0.0;  // error of the depth inside, % of D
  double missed = 0.0;             // % of points inside that are told free
  double false_hits = 0.0;         // % of free points that are told inside
};
std::vector<ApproximationRow> MeasureApproximations(
    const TradeOptions& options);

}  // namespace phongpd::bench
