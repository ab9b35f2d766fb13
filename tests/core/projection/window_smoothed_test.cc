// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: SmoothedMetric on the whole contact space.
#include "core/projection/window_smoothed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/smoothed_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct SmoothedTally {
  int inside = 0, windows = 0, known = 0;
};

// Random points about the contact space, all asked of both.
void CompareSmoothed(const TriangleMesh& robot, const TriangleMesh& obstacle,
                     double smoothing_length, SmoothedAt at, int points,
                     std::mt19937_64* random, SmoothedTally* tally) {
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const SmoothedMetric truth(space, smoothing_length, at);
  WindowSmoothed smoothed(ConvolutionModel(robot, obstacle), smoothing_length,
                          at);
  const double diagonal = space.bounds().Diagonal();
  for (int i = 0; i < points; ++i) {
    const Vector3d q = testing::RandomPoint(space.bounds(), random);
    const PenetrationResult expected = truth.Query(q);
    const WindowResult found = smoothed.At(q);
    const PenetrationResult& answer = found.answer;
    EXPECT_EQ(answer.inside, expected.inside);
    EXPECT_EQ(answer.status, expected.status);
    EXPECT_NEAR(answer.signed_distance, expected.signed_distance,
                1e-11 * diagonal);
    if (!expected.inside) {
      EXPECT_EQ(found.level, DepthLevel::kNone);
      continue;
    }
    ++tally->inside;
    tally->windows += found.level == DepthLevel::kWindow ? 1 : 0;
    // Euclid's direction may be that to another contact as near.
    if (expected.status != QueryStatus::kOk ||
        (at == SmoothedAt::kContact &&
         (answer.contact - expected.contact).norm() > 1e-9 * diagonal)) {
      continue;
    }
    ++tally->known;
    EXPECT_LT((answer.direction - expected.direction).norm(), 2e-6)
        << q.transpose();
  }
}

TEST(WindowSmoothed, AgreesWithTheWholeContactSpace) {
  std::mt19937_64 random(21);
  SmoothedTally tally;
  const auto& kinds = AllPairKinds();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] == PairKind::kManyBoxes) continue;  // seconds each
    SCOPED_TRACE(Name(kinds[i]));
    const SolidPair pair = MakeRandomPair(kinds[i], 1);
    for (const SmoothedAt at : {SmoothedAt::kPosition, SmoothedAt::kContact}) {
      const double ell = i % 2 == 0 ? 0.02 : 0.1;
      CompareSmoothed(pair.robot, pair.obstacle, ell, at, 24, &random, &tally);
    }
  }
  EXPECT_GT(tally.inside, 30);
  EXPECT_GT(tally.known, tally.inside / 3);
}

TEST(WindowSmoothed, TakesWindowsForShortLengthsAndTheWholeForLongOnes) {
  std::mt19937_64 random(3);
  const TriangleMesh knot = MakeKnot(1.0, 0.3, 96, 16);
  for (const double ell : {0.01, 0.5}) {
    SmoothedTally tally;
    CompareSmoothed(MakeIcoBall(0.4, 1), knot, ell, SmoothedAt::kPosition, 100,
                    &random, &tally);
    EXPECT_GT(tally.inside, 8);
    if (ell < 0.1) {
      EXPECT_GT(tally.windows, tally.inside / 2);
    } else {
      EXPECT_EQ(tally.windows, 0);
    }
  }
}

TEST(WindowSmoothed, RefusesWhatIsNone) {
  const ConvolutionModel model(testing::Cube(1.0), testing::Cube(2.0));
  EXPECT_THROW(WindowSmoothed(model, 0.0), InputError);
  WindowSmoothed smoothed(model);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(smoothed.At({infinity, 0, 0}).answer.status, QueryStatus::kInvalid);
}

}  // namespace
}  // namespace phongpd
