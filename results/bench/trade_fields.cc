// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "results/bench/motion_cases.h"
#include "results/bench/report.h"
#include "results/bench/trade_measure.h"

namespace phongpd::bench {
namespace {

constexpr int kRepeats = 2;  // the least time counts

struct Times {
  double warm = std::numeric_limits<double>::infinity();
  double cold = std::numeric_limits<double>::infinity();
};

// A query with the branch of the frame before, and without, on the average.
Times TimeQueries(const PhongMetric& metric,
                  const std::vector<Motion>& motions) {
  Times times;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::size_t queries = 0;
    const double warm = CpuSeconds();
    for (const Motion& motion : motions) {
      Branch branch;
      for (const Eigen::Vector3d& q : motion) {
        branch = metric.Query(q, branch).branch;
        ++queries;
      }
    }
    times.warm = std::min(times.warm,
                          (CpuSeconds() - warm) / static_cast<double>(queries));
    queries = 0;
    const double cold = CpuSeconds();
    for (const Motion& motion : motions) {
      for (std::size_t i = 0; i < motion.size(); i += 10, ++queries) {
        metric.Query(motion[i]);
      }
    }
    times.cold = std::min(times.cold,
                          (CpuSeconds() - cold) / static_cast<double>(queries));
  }
  return times;
}

std::vector<FieldSum> FieldsToCompare() {
  // Longest edges as shares of ℓ; 0: as they are.
  constexpr double kEdges[] = {0.5, 0.0, 1.0, 0.25};
  std::vector<FieldSum> sums;
  for (const double ell : {0.2, 0.1, 0.0}) {
    for (const double edge : kEdges) {
      // Without diffusion there is nothing to resolve.
      if (ell == 0.0 && edge != 0.5) continue;
      sums.emplace_back(ell, edge);
    }
  }
  return sums;
}

PhongMetricOptions OptionsOf(const FieldSum& sum) {
  PhongMetricOptions phong;
  phong.field_options.smoothing_length = sum.ell;
  phong.field_options.max_edge = sum.ell == 0.0 ? 0.0
                                 : sum.edge == 0.0
                                     ? 1.0
                                     : std::min(1.0, sum.edge * sum.ell);
  return phong;
}

double SecondsToBuild(const ContactSpace& space,
                      const PhongMetricOptions& phong) {
  double seconds = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const double begin = CpuSeconds();
    const PhongMetric built(space, phong);
    seconds = std::min(seconds, CpuSeconds() - begin);
  }
  return seconds;
}

// Counts the jumps, and notes the depth over Euclid's of each frame inside.
void FollowMotion(const PhongMetric& metric, const EuclideanMetric& euclidean,
                  const Motion& motion, double length, FieldSum* sum) {
  const std::vector<double> depths = EuclideanDepths(euclidean, motion);
  const Follower follow = FollowMetric(metric)();
  Eigen::Vector3d previous = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const MotionStep step = follow(motion[i]);
    if (i > 0 && (step.pd - previous).norm() > kMotionJump * length) {
      ++sum->jumps;
    }
    previous = step.pd;
    if (!(depths[i] > 0.0)) continue;
    sum->ratios.push_back(step.pd.norm() / depths[i]);
  }
}

}  // namespace

std::vector<FieldSum> MeasureFields(const TradeOptions& options) {
  constexpr int kMotions = 10, kFrames = 200;
  std::vector<FieldSum> sums = FieldsToCompare();
  std::vector<std::vector<double>> build(sums.size()), warm(sums.size()),
      cold(sums.size());
  for (const MotionSpace& space : MotionSpaces()) {
    // The hard case of every metric: its ratios are of another order.
    if (space.name.find("hollow") != std::string::npos) continue;
    const std::vector<Motion> motions =
        MakeMotions(space.contact, kMotions, kFrames, options.seed);
    const EuclideanMetric euclidean(space.contact);
    space.contact.normals();
    std::vector<double> base(3, 0.0);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const PhongMetricOptions phong = OptionsOf(sums[k]);
      const double seconds = SecondsToBuild(space.contact, phong);
      const PhongMetric metric(space.contact, phong);
      const Times times = TimeQueries(metric, motions);
      if (k == 0) base = {seconds, times.warm, times.cold};
      build[k].push_back(seconds / base[0]);
      warm[k].push_back(times.warm / base[1]);
      cold[k].push_back(times.cold / base[2]);
      sums[k].triangles += metric.field().mesh.triangles.size();
      for (const Motion& motion : motions) {
        FollowMotion(metric, euclidean, motion, space.contact.length(),
                     &sums[k]);
      }
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k].build = Quantile(build[k], 0.5);
    sums[k].warm = Quantile(warm[k], 0.5);
    sums[k].cold = Quantile(cold[k], 0.5);
  }
  return sums;
}

}  // namespace phongpd::bench
