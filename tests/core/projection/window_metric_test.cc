// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: EuclideanMetric and SmoothedMetric on the whole contact space.
#include "core/projection/window_metric.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct Tally {
  int inside = 0, known = 0, same_contact = 0;
};

// `ell` 0: Euclid.
void Compare(const TriangleMesh& robot, const TriangleMesh& obstacle,
             double ell, SmoothedAt at, int points, std::mt19937_64* random,
             Tally* tally) {
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const ConvolutionModel model(robot, obstacle);
  const double diagonal = space.bounds().Diagonal();
  std::unique_ptr<PenetrationMetric> truth;
  if (ell > 0.0) {
    truth = std::make_unique<SmoothedMetric>(space, ell, at);
  } else {
    truth = std::make_unique<EuclideanMetric>(space);
  }
  const WindowMetric windows =
      ell > 0.0 ? WindowMetric(model, ell, diagonal, at) : WindowMetric(model);
  for (int i = 0; i < points; ++i) {
    const Vector3d q = testing::RandomPoint(space.bounds(), random);
    const PenetrationResult expected = truth->Query(q);
    const PenetrationResult found = windows.Query(q);
    EXPECT_EQ(found.inside, expected.inside);
    EXPECT_EQ(found.status, expected.status);
    EXPECT_EQ(found.triangle, -1);
    EXPECT_NEAR(found.signed_distance, expected.signed_distance,
                1e-12 * diagonal);
    // What was modelled for the first answer is enough for the same again.
    const WindowUse before = windows.Use();
    const PenetrationResult again = windows.Query(q);
    EXPECT_EQ(again.signed_distance, found.signed_distance);
    EXPECT_EQ(windows.Use().extensions, before.extensions);
    if (!expected.inside) continue;
    ++tally->inside;
    const bool is_same =
        (found.contact - expected.contact).norm() < 1e-9 * diagonal;
    tally->same_contact += is_same ? 1 : 0;
    if (is_same) {
      EXPECT_LT((found.gradient - expected.gradient).norm(), 1e-6);
    }
    if (!is_same && at == SmoothedAt::kContact) continue;
    if (expected.status != QueryStatus::kOk || (ell == 0.0 && !is_same)) {
      continue;
    }
    ++tally->known;
    EXPECT_LT((found.direction - expected.direction).norm(), 2e-6)
        << q.transpose();
  }
}

TEST(WindowMetric, AgreesWithTheWholeContactSpace) {
  std::mt19937_64 random(5);
  Tally tally;
  const auto& kinds = AllPairKinds();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] == PairKind::kManyBoxes) continue;  // seconds each
    SCOPED_TRACE(Name(kinds[i]));
    const SolidPair pair = MakeRandomPair(kinds[i], 2);
    const double ell = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.02 : 0.2;
    const SmoothedAt at =
        i % 2 == 0 ? SmoothedAt::kPosition : SmoothedAt::kContact;
    Compare(pair.robot, pair.obstacle, ell, at, 24, &random, &tally);
  }
  EXPECT_GT(tally.inside, 30);
  EXPECT_GT(tally.known, tally.inside / 3);
  EXPECT_GT(tally.same_contact, tally.inside * 9 / 10);
}

// Deep places: what is left out as occupied is none of C_cont.
TEST(WindowMetric, AgreesWhereMuchIsOccupied) {
  std::mt19937_64 random(7);
  Tally tally;
  Compare(MakeStar(0.5, 1.2), MakeKnot(0.5, 0.225, 32, 6), 0.02,
          SmoothedAt::kPosition, 50, &random, &tally);
  EXPECT_GT(tally.inside, 4);
}

TEST(WindowMetric, ModelsLittleForAnswersNearTheSurface) {
  const TriangleMesh ball = MakeIcoBall(0.4, 2),
                     knot = MakeKnot(1, 0.3, 96, 16);
  const ContactSpace space = BuildContactSpace(ball, knot);
  const WindowMetric windows((ConvolutionModel(ball, knot)));
  EXPECT_EQ(windows.Use().boxes, 0U);
  const Vector3d on = space.mesh().vertices[space.mesh().triangles[0][0]];
  const Vector3d q = on - 1e-3 * space.length() * space.normals()[0];
  EXPECT_TRUE(windows.Query(q).inside);
  const WindowUse use = windows.Use();
  EXPECT_GT(use.boxes, 0U);
  EXPECT_LT(use.faces, space.report().arrangement_faces / 10);
  EXPECT_EQ(use.inside, 1U);
  EXPECT_EQ(use.extensions, 1U);
}

TEST(WindowMetric, TouchesWhereTheSolidsDo) {
  const WindowMetric windows(
      ConvolutionModel(testing::Cube(1.0), testing::Cube(2.0)));
  const PenetrationResult found = windows.Query({1.5, 0.25, 0.125});
  EXPECT_FALSE(found.inside);
  EXPECT_EQ(found.signed_distance, 0.0);
  EXPECT_EQ(found.direction, Vector3d::UnitX());
}

TEST(WindowMetric, RefusesWhatIsNone) {
  const ConvolutionModel model(testing::Cube(1.0), testing::Cube(2.0));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(WindowMetric(model, 0.0, 1.0), InputError);
  EXPECT_THROW(WindowMetric(model, 0.1, 0.0), InputError);
  EXPECT_THROW(WindowMetric(model, 0.1, infinity), InputError);
  EXPECT_EQ(WindowMetric(model).Query({0, 0, infinity}).status,
            QueryStatus::kInvalid);
}

}  // namespace
}  // namespace phongpd
