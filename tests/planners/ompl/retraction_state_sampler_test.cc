// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: FCL on the original meshes, the exact free space, repetition.
#include "planners/ompl/retraction_state_sampler.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

#include <thread>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "planners/ompl/contact_space_validity.h"
#include "planners/ompl/retraction_settings.h"
#include "tests/support/passages.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;
using Eigen::Vector3d;

std::vector<Vector3d> Draw(ob::ValidStateSampler* sampler,
                           const ob::SpaceInformationPtr& si, int count) {
  std::vector<Vector3d> points;
  ob::ScopedState<> state(si);
  for (int i = 0; i < count; ++i) {
    if (sampler->sample(state.get())) points.push_back(ToPoint(state.get()));
  }
  return points;
}

TEST(RetractionStateSampler, ReturnsValidStatesOnly) {
  const testing::Passage passage = testing::MakePassage("tunnel", 1e-3);
  const CollisionOracle oracle(passage.scene.workspace.robot,
                               MergedObstacle(passage.scene.workspace));
  for (const RetractionMetric metric :
       {RetractionMetric::kPhong, RetractionMetric::kEuclidean,
        RetractionMetric::kContactPoint}) {
    for (const BranchChoice choice :
         {BranchChoice::kAll, BranchChoice::kRandom, BranchChoice::kNovelty,
          BranchChoice::kWarm, BranchChoice::kNearest}) {
      const ob::SpaceInformationPtr si = MakeSpaceInformation(passage.model);
      RetractionOptions options;
      options.metric = metric;
      options.choice = choice;
      si->setValidStateSamplerAllocator(
          RetractionStateSamplerAllocator(passage.model, options, 3));
      const ob::ValidStateSamplerPtr sampler = si->allocValidStateSampler();
      EXPECT_EQ(sampler->getName(), "retraction");
      const std::vector<Vector3d> points = Draw(sampler.get(), si, 100);
      EXPECT_GE(points.size(), 95u);
      for (const Vector3d& q : points) {
        ASSERT_TRUE(passage.model->free_space().IsFree(q));
        ASSERT_FALSE(oracle.Collides(q));
      }
    }
  }
}

TEST(RetractionStateSampler, StaysNearWhereItIsTold) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-2);
  const ob::SpaceInformationPtr si = MakeSpaceInformation(passage.model);
  RetractionStateSampler sampler(si.get(), passage.model, {}, 5);
  ob::ScopedState<> near(si), state(si);
  const auto& witness = passage.scene.witness;
  const Vector3d middle = 0.5 * (witness[1] + witness[2]);
  FromPoint(middle, near.get());
  sampler.setNrAttempts(200);
  int found = 0, in_hole = 0;
  for (int i = 0; i < 100; ++i) {
    if (!sampler.sampleNear(state.get(), near.get(), 0.1)) continue;
    ++found;
    const Vector3d q = ToPoint(state.get());
    ASSERT_LE((q - middle).norm(), 0.1);
    ASSERT_TRUE(passage.model->free_space().IsFree(q));
    in_hole += std::abs(q.x()) < 0.12;
  }
  EXPECT_GT(found, 90);
  EXPECT_GT(in_hole, 90);
}

TEST(RetractionStateSampler, DeclaresItsParametersWithRanges) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-2);
  const ob::SpaceInformationPtr si = MakeSpaceInformation(passage.model);
  RetractionStateSampler sampler(si.get(), passage.model, {}, 5);
  std::map<std::string, std::string> values;
  sampler.params().getParams(values);
  values.erase("nr_attempts");  // OMPL's own
  EXPECT_EQ(values.size(), 3u);
  EXPECT_EQ(values["metric"], "phong");
  EXPECT_EQ(values["choice"], "all");
  EXPECT_EQ(values["clearance"], "0.01");
  for (const auto& [name, value] : values) {
    EXPECT_FALSE(sampler.params()[name].getRangeSuggestion().empty()) << name;
  }
  EXPECT_TRUE(sampler.params().setParam("metric", "euclidean"));
  EXPECT_TRUE(sampler.params().setParam("choice", "random"));
  EXPECT_TRUE(sampler.params().setParam("clearance", "0.5"));
  EXPECT_EQ(sampler.options().metric, RetractionMetric::kEuclidean);
  EXPECT_EQ(sampler.options().choice, BranchChoice::kRandom);
  EXPECT_EQ(sampler.options().clearance, 0.5);
  EXPECT_THROW(sampler.params().setParam("metric", "manhattan"), InputError);
  EXPECT_THROW(sampler.params().setParam("clearance", "-1"), InputError);
  EXPECT_EQ(sampler.options().metric, RetractionMetric::kEuclidean);
  EXPECT_EQ(sampler.options().clearance, 0.5);
}

TEST(RetractionStateSampler, RefusesOtherSpacesAndNoModel) {
  auto plane = std::make_shared<ompl::base::RealVectorStateSpace>(2);
  plane->setBounds(-1.0, 1.0);
  const ompl::base::SpaceInformation flat(plane);
  const auto model = testing::BoxModel();
  EXPECT_THROW(RetractionStateSampler(&flat, model, {}, 1), InputError);
  const auto si = MakeSpaceInformation(model);
  EXPECT_NO_THROW(RetractionStateSampler(si.get(), model, {}, 1));
  EXPECT_THROW(RetractionStateSampler(si.get(), nullptr, {}, 1), InputError);
}

TEST(RetractionStateSampler, NamesReadBack) {
  for (const char* name : {"phong", "euclidean", "contact-point"}) {
    EXPECT_EQ(ToString(RetractionMetricFromString(name)), name);
  }
  for (const char* name : {"all", "random", "novelty", "warm", "nearest"}) {
    EXPECT_EQ(ToString(BranchChoiceFromString(name)), name);
  }
  EXPECT_THROW(BranchChoiceFromString("ALL"), InputError);
}

// Run under the thread sanitizer as well: one model, one sampler per thread.
TEST(RetractionStateSampler, SharesTheModelBetweenThreads) {
  const testing::Passage passage = testing::MakePassage("tunnel", 1e-2);
  const ob::SpaceInformationPtr si = MakeSpaceInformation(passage.model);
  si->setValidStateSamplerAllocator(
      RetractionStateSamplerAllocator(passage.model, {}, 3));
  constexpr int kThreads = 4;
  std::vector<std::vector<Vector3d>> parallel(kThreads), serial(kThreads);
  std::vector<ob::ValidStateSamplerPtr> samplers;
  for (int i = 0; i < kThreads; ++i) {
    samplers.push_back(si->allocValidStateSampler());
  }
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      const std::size_t k = static_cast<std::size_t>(i);
      parallel[k] = Draw(samplers[k].get(), si, 300);
      for (std::size_t j = 1; j < parallel[k].size(); ++j) {
        ob::ScopedState<> a(si), b(si);
        FromPoint(parallel[k][j - 1], a.get());
        FromPoint(parallel[k][j], b.get());
        si->checkMotion(a.get(), b.get());
        si->isValid(a.get());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(si->getMotionValidator()->getCheckedMotionCount(),
            static_cast<unsigned int>(kThreads * 299));
  // The same samplers, one after the other.
  si->setValidStateSamplerAllocator(
      RetractionStateSamplerAllocator(passage.model, {}, 3));
  for (std::vector<Vector3d>& points : serial) {
    points = Draw(si->allocValidStateSampler().get(), si, 300);
  }
  EXPECT_EQ(parallel, serial);
  EXPECT_NE(serial[0], serial[1]);
}

}  // namespace
}  // namespace phongpd
