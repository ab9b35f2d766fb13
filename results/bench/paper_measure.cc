// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/paper_measure.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "core/stopwatch.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

struct NamedMetric {
  std::string name;
  std::string label;
  std::unique_ptr<PenetrationMetric> metric;
};

std::unique_ptr<PhongMetric> MakePhong(const ContactSpace& contact,
                                       FieldKind field, double ell) {
  PhongMetricOptions options;
  options.field = field;
  options.field_options.smoothing_length = ell;
  return std::make_unique<PhongMetric>(contact, options);
}

std::vector<Eigen::Vector3d> InteriorPoints(const PhongMetric& metric,
                                            const BoundingBox& box, int count,
                                            std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Eigen::Vector3d> points;
  while (static_cast<int>(points.size()) < count) {
    Eigen::Vector3d q;
    for (int k = 0; k < 3; ++k) {
      q[k] = box.min[k] + uniform(*random) * (box.max[k] - box.min[k]);
    }
    if (metric.IsInside(q)) points.push_back(q);
  }
  return points;
}

Coverage MeasureCoverage(const std::string& method,
                         const PenetrationMetric& metric,
                         const std::vector<Eigen::Vector3d>& points,
                         const std::vector<double>& depths) {
  Coverage coverage;
  coverage.method = method;
  const double deepest = *std::max_element(depths.begin(), depths.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fifth = std::min<std::size_t>(
        4, static_cast<std::size_t>(5.0 * depths[i] / deepest));
    ++coverage.points[fifth];
    if (metric.Query(points[i]).status == QueryStatus::kEuclideanFallback) {
      ++coverage.missing[fifth];
    }
  }
  return coverage;
}

// Microseconds of each query along a motion that found its point inside.
void TimeQueries(const PenetrationMetric& metric, const StraightMotion& motion,
                 bool carry_branch, std::vector<double>* microseconds) {
  Branch branch;
  for (int frame = 0; frame < motion.frames; ++frame) {
    const Eigen::Vector3d q = motion.At(frame);
    const Stopwatch stopwatch;
    const PenetrationResult result = metric.Query(q, branch);
    const double seconds = stopwatch.Seconds();
    if (result.inside && frame > 0) microseconds->push_back(1e6 * seconds);
    if (carry_branch) branch = result.branch;
  }
}

// |PD| / Euclidean |PD|; frames on the surface are left out.
class Ratios {
 public:
  explicit Ratios(double least) : least_(least) {}

  void Add(double depth, double euclidean) {
    if (euclidean >= least_) ratios_.push_back(depth / euclidean);
  }
  double Mean() const {
    const auto count = static_cast<double>(ratios_.size());
    return std::accumulate(ratios_.begin(), ratios_.end(), 0.0) / count;
  }
  double At(double fraction) const { return Quantile(ratios_, fraction); }

 private:
  double least_;
  std::vector<double> ratios_;
};

// Largest change of PD between two frames when the step between them is
// divided by 1000 and the branch carried along.
double LargestDividedChange(const PenetrationMetric& metric,
                            const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to,
                            const PenetrationResult& start) {
  constexpr int kParts = 1000;
  Branch branch = start.branch;
  Eigen::Vector3d last = start.PenetrationVector(from);
  double largest = 0.0;
  for (int i = 1; i <= kParts; ++i) {
    const Eigen::Vector3d q = from + (to - from) * i / kParts;
    const PenetrationResult result = metric.Query(q, branch);
    const Eigen::Vector3d pd = result.PenetrationVector(q);
    largest = std::max(largest, (pd - last).norm());
    last = pd;
    branch = result.branch;
  }
  return largest;
}

void CountJump(const PenetrationMetric& metric, const StraightMotion& motion,
               const MotionTrace& trace, std::size_t frame, double jump,
               MotionTotals* totals) {
  const PenetrationResult& before = trace.results[frame - 1];
  const PenetrationResult& after = trace.results[frame];
  ++totals->jumps;
  if (after.status != QueryStatus::kOk) {
    ++totals->flagged_jumps;
  } else if (LargestDividedChange(
                 metric, motion.At(static_cast<int>(frame) - 1),
                 motion.At(static_cast<int>(frame)), before) < 0.1 * jump) {
    ++totals->steep_jumps;
  } else {
    ++totals->silent_jumps;
  }
}

MotionTotals Follow(const NamedMetric& named, const EuclideanMetric& euclidean,
                    const std::vector<StraightMotion>& motions, double diagonal,
                    double jump) {
  MotionTotals totals;
  totals.metric = named.name;
  totals.label = named.label;
  Ratios warm(1e-6 * diagonal);
  Ratios cold(1e-6 * diagonal);
  std::vector<double> warm_us;
  std::vector<double> cold_us;
  for (const StraightMotion& motion : motions) {
    const MotionTrace trace =
        TraceMotion(*named.metric, motion, named.name, named.label);
    const MotionSummary summary = Summarize(trace, jump);
    totals.frames_inside += summary.inside;
    totals.branch_ends += summary.branch_ends;
    totals.fallbacks += summary.fallbacks;
    for (std::size_t i = 0; i < trace.pd.size(); ++i) {
      if (i > 0 && (trace.pd[i] - trace.pd[i - 1]).norm() > jump) {
        CountJump(*named.metric, motion, trace, i, jump, &totals);
      }
      if (!trace.results[i].inside) continue;
      const Eigen::Vector3d q = motion.At(static_cast<int>(i));
      const double depth = -euclidean.Query(q).signed_distance;
      warm.Add(trace.pd[i].norm(), depth);
      cold.Add(-named.metric->Query(q).signed_distance, depth);
    }
    TimeQueries(*named.metric, motion, true, &warm_us);
    TimeQueries(*named.metric, motion, false, &cold_us);
  }
  totals.ratio_mean = warm.Mean();
  totals.ratio_p99 = warm.At(0.99);
  totals.ratio_max = warm.At(1.0);
  totals.cold_ratio_mean = cold.Mean();
  totals.cold_ratio_max = cold.At(1.0);
  totals.median_us = Quantile(warm_us, 0.5);
  totals.p99_us = Quantile(warm_us, 0.99);
  totals.cold_median_us = Quantile(cold_us, 0.5);
  return totals;
}

}  // namespace

PaperResult Measure(const PaperBenchmark& benchmark,
                    const PaperOptions& options) {
  PaperResult result;
  result.benchmark = benchmark;
  std::vector<double> seconds;
  for (int i = 0; i < options.builds; ++i) {
    const Stopwatch stopwatch;
    result.space = BuildContactSpace(benchmark.robot, benchmark.obstacle);
    seconds.push_back(stopwatch.Seconds());
  }
  result.build_seconds = Quantile(seconds, 0.5);
  const ContactSpace& contact = *result.space;
  const BoundingBox& box = contact.bounds();
  result.diagonal = contact.length();

  const EuclideanMetric euclidean(contact);
  auto phong = MakePhong(contact, FieldKind::kNormal, 0.0);
  auto smoothed = MakePhong(contact, FieldKind::kNormal, 0.1);
  const auto newton = MakePhong(contact, FieldKind::kTangentPlane, 0.0);
  result.field = smoothed->field().report;

  std::mt19937_64 random(options.seed);
  const std::vector<Eigen::Vector3d> points =
      InteriorPoints(*phong, box, options.points, &random);
  std::vector<double> depths;
  for (const Eigen::Vector3d& q : points) {
    depths.push_back(-euclidean.Query(q).signed_distance);
  }
  result.coverage = {
      MeasureCoverage("closed form, ℓ = 0", *phong, points, depths),
      MeasureCoverage("closed form, ℓ = 0.1", *smoothed, points, depths),
      MeasureCoverage("Newton (paper), ℓ = 0", *newton, points, depths)};

  std::vector<NamedMetric> metrics;
  metrics.push_back({"euclidean", "Euclidean PD",
                     std::make_unique<EuclideanMetric>(contact)});
  metrics.push_back({"phong@0", "PhongPD, ℓ = 0", std::move(phong)});
  metrics.push_back({"phong@0.1", "PhongPD, ℓ = 0.1", std::move(smoothed)});

  const std::vector<Eigen::Vector3d> ends =
      InteriorPoints(static_cast<const PhongMetric&>(*metrics[1].metric), box,
                     2 * options.motions, &random);
  std::vector<StraightMotion> motions;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    motions.push_back({ends[i], ends[i + 1], options.frames});
  }
  for (const NamedMetric& named : metrics) {
    result.totals.push_back(Follow(named, euclidean, motions, result.diagonal,
                                   options.jump * result.diagonal));
  }
  for (const PaperMotion& motion : benchmark.motions) {
    std::vector<MotionTrace>& traces = result.traces.emplace_back();
    for (const NamedMetric& named : metrics) {
      traces.push_back(
          TraceMotion(*named.metric, motion.motion, named.name, named.label));
    }
  }
  return result;
}

}  // namespace phongpd::bench
