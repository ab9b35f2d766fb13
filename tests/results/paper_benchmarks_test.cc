// SPDX-License-Identifier: GPL-3.0-or-later
// The engine on the paper's three benchmarks, judged by the original meshes.
#include "results/bench/paper_benchmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "tests/support/oracle_of.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 10000;

PhongMetric MakePhong(const ContactSpace& contact, double ell) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = ell;
  return PhongMetric(contact, options);
}

// One benchmark, built once for all its tests.
struct Built {
  explicit Built(const PaperBenchmark& b)
      : benchmark(b),
        contact(BuildContactSpace(b.robot, b.obstacle)),
        box(contact.bounds()),
        oracle(testing::OracleOf<CollisionOracle>(b.robot, b.obstacle)),
        euclidean(contact),
        phong(MakePhong(contact, 0.0)),
        smoothed(MakePhong(contact, 0.1)) {}

  Vector3d RandomPoint(std::mt19937_64* random, double margin) const {
    std::uniform_real_distribution<double> uniform(-margin, 1.0 + margin);
    Vector3d q;
    for (int k = 0; k < 3; ++k) {
      q[k] = box.min[k] + uniform(*random) * (box.max[k] - box.min[k]);
    }
    return q;
  }
  std::vector<Vector3d> InteriorPoints(int count, std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    std::vector<Vector3d> points;
    while (static_cast<int>(points.size()) < count) {
      const Vector3d q = RandomPoint(&random, 0.0);
      if (phong.IsInside(q)) points.push_back(q);
    }
    return points;
  }

  PaperBenchmark benchmark;
  ContactSpace contact;
  BoundingBox box;
  CollisionOracle oracle;
  EuclideanMetric euclidean;
  PhongMetric phong;
  PhongMetric smoothed;
};

const Built& Get(std::size_t index) {
  static std::array<std::unique_ptr<Built>, 3> built;
  if (!built[index]) {
    built[index] = std::make_unique<Built>(PaperBenchmarks()[index]);
  }
  return *built[index];
}

class PaperBenchmarkTest : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PaperBenchmarkTest, InsideIsWhereTheOriginalMeshesCollide) {
  const Built& b = Get(GetParam());
  const double tolerance = 1e-9 * b.box.Diagonal();
  std::mt19937_64 random(1);
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vector3d q = b.RandomPoint(&random, 0.1);
    const PenetrationResult result = b.euclidean.Query(q);
    if (std::abs(result.signed_distance) < tolerance) continue;
    EXPECT_EQ(result.inside, b.oracle.Collides(q)) << q.transpose();
    EXPECT_EQ(result.inside, b.phong.IsInside(q)) << q.transpose();
    inside += result.inside ? 1 : 0;
  }
  EXPECT_GT(inside, kPoints / 20);
  EXPECT_LT(inside, kPoints - kPoints / 20);
}

TEST_P(PaperBenchmarkTest, MovingByPdSeparatesTheOriginalMeshes) {
  const Built& b = Get(GetParam());
  const double step = 1e-6 * b.box.Diagonal();
  for (const Vector3d& q : b.InteriorPoints(kPoints, 2)) {
    for (const PenetrationMetric* metric :
         {static_cast<const PenetrationMetric*>(&b.phong),
          static_cast<const PenetrationMetric*>(&b.smoothed),
          static_cast<const PenetrationMetric*>(&b.euclidean)}) {
      const PenetrationResult result = metric->Query(q);
      const Vector3d out = q + result.PenetrationVector(q);
      EXPECT_FALSE(b.oracle.Collides(out + step * result.direction))
          << q.transpose();
    }
  }
}

TEST_P(PaperBenchmarkTest, HasAProjectionNoShallowerThanEuclidAtEveryDepth) {
  const Built& b = Get(GetParam());
  const double tolerance = 1e-12 * b.box.Diagonal();
  const std::vector<Vector3d> points = b.InteriorPoints(kPoints, 3);
  std::vector<double> depths;
  for (const Vector3d& q : points) {
    depths.push_back(-b.euclidean.Query(q).signed_distance);
  }
  const double deepest = *std::max_element(depths.begin(), depths.end());
  for (const PhongMetric* metric : {&b.phong, &b.smoothed}) {
    std::array<int, 5> seen{};
    std::array<int, 5> missing{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const PenetrationResult result = metric->Query(points[i]);
      const auto fifth = std::min<std::size_t>(
          4, static_cast<std::size_t>(5.0 * depths[i] / deepest));
      ++seen[fifth];
      missing[fifth] += result.status == QueryStatus::kOk ? 0 : 1;
      EXPECT_GE(-result.signed_distance, depths[i] - tolerance);
    }
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_GT(seen[k], 20);
      EXPECT_LE(1000 * missing[k], seen[k]) << "fifth " << k;
    }
  }
}

// Changes of PD between frames whose status is ok, inside all along.
struct Changes {
  std::vector<double> lengths;
  int silent_jumps = 0;
};

Changes FollowMotions(const Built& b, const PhongMetric& metric, int frames) {
  const double jump = 0.05 * b.box.Diagonal();
  const std::vector<Vector3d> ends = b.InteriorPoints(200, 4);
  Changes changes;
  for (std::size_t m = 0; m < ends.size(); m += 2) {
    const StraightMotion motion = {ends[m], ends[m + 1], frames};
    const MotionTrace trace = TraceMotion(metric, motion, "phong", "");
    for (std::size_t i = 1; i < trace.pd.size(); ++i) {
      const PenetrationResult& before = trace.results[i - 1];
      const PenetrationResult& after = trace.results[i];
      if (!before.inside || !after.inside) continue;
      if (after.status != QueryStatus::kOk) continue;
      const double change = (trace.pd[i] - trace.pd[i - 1]).norm();
      changes.lengths.push_back(change);
      if (change < jump) continue;
      // Steep, or a jump?  Divide the step.
      const StraightMotion divided = {motion.At(static_cast<int>(i) - 1),
                                      motion.At(static_cast<int>(i)), 1001};
      Branch branch = before.branch;
      Vector3d last = trace.pd[i - 1];
      for (int k = 1; k < divided.frames; ++k) {
        const Vector3d q = divided.At(k);
        const PenetrationResult result = metric.Query(q, branch);
        const Vector3d pd = result.PenetrationVector(q);
        changes.silent_jumps += (pd - last).norm() > 0.1 * jump ? 1 : 0;
        branch = result.branch;
        last = pd;
      }
    }
  }
  return changes;
}

double Quantile(std::vector<double> values, double fraction) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(
                           fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

TEST_P(PaperBenchmarkTest, PdIsContinuousAlongMotionsUpToFlaggedEnds) {
  const Built& b = Get(GetParam());
  for (const PhongMetric* metric : {&b.phong, &b.smoothed}) {
    const Changes coarse = FollowMotions(b, *metric, 400);
    const Changes fine = FollowMotions(b, *metric, 799);  // step halved
    EXPECT_EQ(coarse.silent_jumps, 0);
    EXPECT_EQ(fine.silent_jumps, 0);
    for (const double fraction : {0.5, 0.9, 0.99}) {
      EXPECT_NEAR(
          Quantile(fine.lengths, fraction) / Quantile(coarse.lengths, fraction),
          0.5, 0.05)
          << fraction;
    }
  }
}

TEST_P(PaperBenchmarkTest, SwappingTheOperandsNegatesPd) {
  const Built& b = Get(GetParam());
  const TriangleMesh mirrored =
      BuildContactSpace(b.benchmark.obstacle, b.benchmark.robot).mesh();
  const EuclideanMetric euclidean(TakeAsContactSpace(mirrored));
  const double tolerance = 1e-9 * b.box.Diagonal();
  for (const Vector3d& q : b.InteriorPoints(1000, 5)) {
    EXPECT_NEAR(euclidean.Query(-q).signed_distance,
                b.euclidean.Query(q).signed_distance, tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PaperBenchmarkTest,
                         ::testing::Values(std::size_t{0}, std::size_t{1},
                                           std::size_t{2}),
                         [](const auto& test) {
                           return PaperBenchmarks()[test.param].name;
                         });

}  // namespace
}  // namespace phongpd
