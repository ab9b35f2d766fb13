// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: PhongMetric on the whole contact space.
#include "core/projection/window_phong.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/cancelled_work.h"
#include "tests/support/random_pairs.h"
#include "tests/support/sanitizer.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

PhongMetricOptions Smoothed(double length) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = length;
  return options;
}

struct PhongTally {
  long inside = 0, windows = 0, wrong = 0;
  double worst = 0.0;  // of D
};

// Random points about the contact space, all asked of both.
void Compare(const TriangleMesh& robot, const TriangleMesh& obstacle,
             const PhongMetricOptions& options, int points,
             std::mt19937_64* random, PhongTally* tally) {
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const PhongMetric truth(space, options);
  WindowPhong phong(ConvolutionModel(robot, obstacle), options);
  const double diagonal = space.bounds().Diagonal();
  for (int i = 0; i < points; ++i) {
    const Vector3d q = testing::RandomPoint(space.bounds(), random);
    const PenetrationResult expected = truth.Query(q);
    const WindowResult found = phong.At(q);
    const PenetrationResult& answer = found.answer;
    const double error =
        std::abs(answer.signed_distance - expected.signed_distance) / diagonal;
    const bool is_right = answer.status == expected.status &&
                          answer.inside == expected.inside && error < 1e-11;
    EXPECT_EQ(answer.status, expected.status);
    EXPECT_EQ(answer.inside, expected.inside);
    EXPECT_LT(error, 1e-11)
        << ToString(found.level) << " " << q.transpose() << ": "
        << answer.signed_distance << " for " << expected.signed_distance;
    tally->wrong += is_right ? 0 : 1;
    tally->worst = std::max(tally->worst, error);
    if (!expected.inside) {
      EXPECT_EQ(found.level, DepthLevel::kNone);
      continue;
    }
    ++tally->inside;
    tally->windows += found.level == DepthLevel::kWindow ? 1 : 0;
    EXPECT_LT((answer.contact - q).norm() + answer.signed_distance,
              1e-11 * diagonal);
  }
}

TEST(WindowPhongCampaign, AgreesWithTheWholeContactSpace) {
  std::mt19937_64 random(17);
  PhongTally tally;
  const auto& kinds = AllPairKinds();
  const long cases = testing::CampaignCases(60, 1200);
  for (long i = 0; i < cases; ++i) {
    const PairKind kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const auto seed = static_cast<std::uint64_t>(i) / kinds.size();
    if (kind == PairKind::kManyBoxes && seed > 1) continue;  // seconds each
    SCOPED_TRACE(Name(kind) + ", seed " + std::to_string(seed));
    const SolidPair pair = MakeRandomPair(kind, seed);
    Compare(pair.robot, pair.obstacle, Smoothed(0.0), 10, &random, &tally);
  }
  EXPECT_GT(tally.inside, cases);
  EXPECT_GT(tally.windows, 0);
  testing::CampaignRow row;
  row.item = "phong in windows";
  row.subject = "ℓ = 0, depth of the whole contact space; " +
                std::to_string(tally.windows) + " from windows";
  row.cases = tally.inside;
  row.failures = tally.wrong;
  row.worst = tally.worst;
  row.bound = 1e-11;
  row.unit = "D";
  row.seed = 17;
  testing::ReportCampaign(row);
}

// Bodies of small faces: windows are enough for nearly all.
TEST(WindowPhong, TakesWindowsWhereFacesAreSmall) {
  std::mt19937_64 random(3);
  const TriangleMesh knot = MakeKnot(1.0, 0.3, 96, 16);
  PhongTally tally;
  Compare(MakeIcoBall(0.4, 2), knot, Smoothed(0.0), 120, &random, &tally);
  Compare(MakeBlob(0.4, 2, 0.35, 1), MakeIcoBall(2.0, 3), Smoothed(0.0), 120,
          &random, &tally);
  EXPECT_GT(tally.inside, 50);
  EXPECT_GT(tally.windows, 0.6 * static_cast<double>(tally.inside));
}

TEST(WindowPhong, BuildsTheWholeForASmoothingLength) {
  std::mt19937_64 random(4);
  PhongTally tally;
  Compare(MakeStar(0.3, 0.7), MakeKnot(0.9, 0.15, 40, 6), Smoothed(0.2), 60,
          &random, &tally);
  Compare(Cube(1.0), MakeVessel(4, 3, 0.5), Smoothed(0.05), 60, &random,
          &tally);
  EXPECT_GT(tally.inside, 20);
  EXPECT_EQ(tally.windows, 0);
}

TEST(WindowPhong, AnswersTouchingAndFarAndWhatIsNotFinite) {
  WindowPhong phong(ConvolutionModel(Cube(1.0), Cube(2.0)), Smoothed(0.0));
  const WindowResult touching = phong.At({1.5, 0.1, 0.2});
  EXPECT_EQ(touching.answer.status, QueryStatus::kOk);
  EXPECT_FALSE(touching.answer.inside);
  EXPECT_EQ(touching.answer.signed_distance, 0.0);
  const WindowResult far = phong.At({101.5, 0, 0});
  EXPECT_EQ(far.level, DepthLevel::kNone);
  EXPECT_DOUBLE_EQ(far.answer.signed_distance, 100.0);
  EXPECT_EQ(far.answer.direction, Vector3d(1, 0, 0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(phong.At({nan, 0, 0}).answer.status, QueryStatus::kInvalid);
  EXPECT_THROW(
      WindowPhong(ConvolutionModel(Cube(1.0), Cube(2.0)), Smoothed(-1.0)),
      InputError);
}

// The window of a query serves those beside it.
TEST(WindowPhong, KeepsTheLastWindow) {
  WindowPhong phong(
      ConvolutionModel(MakeIcoBall(0.4, 2), MakeKnot(1.0, 0.3, 96, 16)),
      Smoothed(0.0));
  const ContactSpace space =
      BuildContactSpace(MakeIcoBall(0.4, 2), MakeKnot(1.0, 0.3, 96, 16));
  const PhongMetric truth(space, Smoothed(0.0));
  std::mt19937_64 random(1);
  int kept = 0, inside = 0;
  while (inside < 5) {
    const Vector3d q = testing::RandomPoint(space.bounds(), &random);
    if (!truth.IsInside(q) || phong.At(q).level != DepthLevel::kWindow) {
      continue;
    }
    ++inside;
    const Vector3d beside = q + 1e-6 * Vector3d(1, 2, 3);
    const WindowResult found = phong.At(beside);
    kept += found.windows == 0 && found.arranged_faces == 0 ? 1 : 0;
    EXPECT_NEAR(found.answer.signed_distance,
                truth.Query(beside).signed_distance, 1e-11);
  }
  EXPECT_GE(kept, 4);
}

TEST(WindowPhong, StopsWhenCancelledAndAtTheModelsLimits) {
  const TriangleMesh knot = MakeKnot(1.0, 0.2, 96, 24);
  const Vector3d q(0.1, 0.2, 0.1);
  if (!testing::kIsSanitized) {  // where freed memory is kept back
    ContactSpaceOptions options;
    options.max_mib = 24.0;  // enough for the model
    WindowPhong phong(ConvolutionModel(knot, knot, options), Smoothed(0.2));
    EXPECT_THROW(phong.At(q), BuildRefusal);
  }
  WindowPhong phong(ConvolutionModel(knot, knot), Smoothed(0.2));
  EXPECT_NE(testing::WhatCancels([&] { phong.At(q); }), "");
}

TEST(WindowPhong, GivesOneAnswerToManyThreads) {
  WindowPhong phong(
      ConvolutionModel(MakeIcoBall(0.4, 2), MakeKnot(1.0, 0.3, 96, 16)),
      Smoothed(0.0));
  const Vector3d q(0.9, 0.4, 0.2);
  const double expected = phong.At(q).answer.signed_distance;
  std::vector<double> found(4);
  std::vector<std::thread> threads;
  for (double& one : found) {
    threads.emplace_back([&] { one = phong.At(q).answer.signed_distance; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double one : found) EXPECT_EQ(one, expected);
}

}  // namespace
}  // namespace phongpd
