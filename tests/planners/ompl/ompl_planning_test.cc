// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the exact path check, infeasible twins, the other metric.
#include "planners/ompl/ompl_planning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/mesh_error.h"
#include "tests/support/passages.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

class OmplPlanning : public ::testing::Test {
 protected:
  void SetUp() override { SilenceOmpl(); }

  static OmplPlanningResult Plan(const testing::Passage& passage,
                                 PlannerId planner,
                                 const OmplPlanningOptions& options) {
    return PlanWithOmpl(passage.model, passage.scene.start, passage.scene.goal,
                        planner, options);
  }
};

// Of OMPL and of this library for it: all but contact-surface.
std::vector<PlannerId> OmplPlanners() {
  std::vector<PlannerId> planners = AllPlanners();
  planners.erase(planners.begin());
  return planners;
}

TEST_F(OmplPlanning, SolvesWithEveryPlanner) {
  const testing::Passage passage = testing::MakePassage("gap", 0.1);
  for (const PlannerId planner : OmplPlanners()) {
    const std::string name = ToString(planner);
    OmplPlanningOptions options;
    options.time_limit = 10.0;
    const OmplPlanningResult result = Plan(passage, planner, options);
    ASSERT_TRUE(result.solved) << name << ": " << result.status;
    EXPECT_TRUE(result.collision_free) << name;
    EXPECT_EQ(result.path.front(), passage.scene.start);
    EXPECT_EQ(result.path.back(), passage.scene.goal);
    EXPECT_GT(result.clearance, 0.0);
    EXPECT_GE(result.length,
              (passage.scene.goal - passage.scene.start).norm() - 1e-12);
    EXPECT_GT(result.segment_checks, 0u) << name;
    EXPECT_GE(result.graph.points.size(), 2u) << name;
    // What it grew is free, by the exact check, and joins start and goal.
    EXPECT_GE(result.graph.edges.size(), 1u) << name;
    for (const auto& [a, b] : result.graph.edges) {
      EXPECT_TRUE(passage.model->free_space().IsFree(result.graph.points.at(a),
                                                     result.graph.points.at(b)))
          << name;
    }
    for (const Vector3d& q : {passage.scene.start, passage.scene.goal}) {
      EXPECT_EQ(
          std::count(result.graph.points.begin(), result.graph.points.end(), q),
          1)
          << name;
    }
    EXPECT_EQ(result.samples > 0, planner == PlannerId::kRetractionRrt ||
                                      planner == PlannerId::kRetractionForest);
  }
}

TEST_F(OmplPlanning, TakesTheLimitAndNeverClaimsAFalsePath) {
  for (const char* family : {"hole", "bugtrap"}) {
    const testing::Passage passage = testing::MakePassage(family, -1e-4, 1);
    for (const PlannerId planner : OmplPlanners()) {
      const std::string name = ToString(planner);
      OmplPlanningOptions options;
      options.time_limit = 0.1;
      const OmplPlanningResult result = Plan(passage, planner, options);
      EXPECT_FALSE(result.solved) << name << ' ' << family;
      EXPECT_TRUE(result.path.empty());
      EXPECT_FALSE(result.collision_free);
      EXPECT_EQ(result.clearance, 0.0);
      EXPECT_TRUE(result.is_late);
      EXPECT_TRUE(result.status == "Timeout" ||
                  result.status == "Approximate solution")
          << name << ": " << result.status;
    }
  }
}

TEST_F(OmplPlanning, RepeatsWithTheSeed) {
  const testing::Passage passage = testing::MakePassage("gap", 0.1);
  for (const PlannerId planner :
       {PlannerId::kRetractionRrt, PlannerId::kRetractionForest,
        PlannerId::kRrtConnect}) {
    const std::string name = ToString(planner);
    OmplPlanningOptions options;
    options.time_limit = 20.0;
    options.seed = 4;
    const OmplPlanningResult first = Plan(passage, planner, options);
    const OmplPlanningResult second = Plan(passage, planner, options);
    ASSERT_TRUE(first.solved && second.solved) << name;
    EXPECT_EQ(first.path, second.path) << name;
    options.seed = 5;
    EXPECT_NE(Plan(passage, planner, options).path, first.path) << name;
  }
}

// Medians of nine seeds on a hole: all Phong branches need some ten samples,
// the nearest point a hundred times as many.
TEST_F(OmplPlanning, NeedsFarFewerSamplesWithAllBranches) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-3);
  const auto median = [&](RetractionMetric metric, std::int64_t* to_passage) {
    std::vector<std::uint64_t> samples;
    std::vector<std::int64_t> first;
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      OmplPlanningOptions options;
      options.seed = seed;
      options.retraction.metric = metric;
      const OmplPlanningResult result =
          Plan(passage, PlannerId::kRetractionForest, options);
      EXPECT_TRUE(result.collision_free || !result.solved);
      samples.push_back(result.samples);
      const std::vector<Vector3d>& points = result.graph.points;
      EXPECT_EQ(result.graph.samples.size(), points.size());
      const auto in_passage = std::find_if(
          points.begin(), points.end(),
          [](const Vector3d& q) { return std::abs(q.x()) < 0.12; });
      // None in the time there was: more than were drawn.
      first.push_back(in_passage == points.end()
                          ? std::numeric_limits<std::int64_t>::max()
                          : static_cast<std::int64_t>(
                                result.graph.samples[static_cast<std::size_t>(
                                    in_passage - points.begin())]));
    }
    std::sort(samples.begin(), samples.end());
    std::sort(first.begin(), first.end());
    *to_passage = first[4];
    return samples[4];
  };
  std::int64_t phong_first = 0, euclidean_first = 0;
  const std::uint64_t phong = median(RetractionMetric::kPhong, &phong_first);
  const std::uint64_t euclidean =
      median(RetractionMetric::kEuclidean, &euclidean_first);
  EXPECT_LE(phong, 20u);
  EXPECT_GE(euclidean, 500u);
  EXPECT_GT(phong_first, 0);
  EXPECT_LE(phong_first, static_cast<std::int64_t>(phong));
  EXPECT_GE(euclidean_first / 10, phong_first);
}

TEST_F(OmplPlanning, SolvesTheNarrowestPassages) {
  for (const double delta : {1e-4, 2e-5}) {
    const testing::Passage passage = testing::MakePassage("hole", delta, 1);
    for (const PlannerId planner :
         {PlannerId::kRetractionRrt, PlannerId::kRetractionForest}) {
      const OmplPlanningResult result = Plan(passage, planner, {});
      EXPECT_TRUE(result.solved) << ToString(planner) << delta;
      EXPECT_TRUE(result.collision_free) << ToString(planner) << delta;
      EXPECT_GT(result.clearance, passage.model->floor() * 0.5);
    }
  }
}

TEST_F(OmplPlanning, ReportsInvalidEnds) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-2);
  OmplPlanningOptions options;
  options.time_limit = 0.2;
  for (const PlannerId planner : OmplPlanners()) {
    const std::string name = ToString(planner);
    const OmplPlanningResult start = PlanWithOmpl(
        passage.model, {0.0, 0.0, 0.0}, passage.scene.goal, planner, options);
    EXPECT_FALSE(start.solved);
    EXPECT_EQ(start.status, "Invalid start") << name;
    const OmplPlanningResult goal = PlanWithOmpl(
        passage.model, passage.scene.start, {0.0, 0.0, 0.0}, planner, options);
    EXPECT_FALSE(goal.solved);
    EXPECT_FALSE(goal.collision_free);
    EXPECT_EQ(goal.status, "Invalid goal") << name;
    // Nothing was tried: OMPL would wait for another goal.
    EXPECT_EQ(goal.collision_checks + goal.segment_checks, 0u) << name;
  }
}

TEST_F(OmplPlanning, RefusesBadInput) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-2);
  OmplPlanningOptions options;
  EXPECT_THROW(Plan(passage, PlannerId::kContactSurface, options), InputError);
  for (const double limit : {0.0, std::nan(""), HUGE_VAL}) {
    options.time_limit = limit;
    EXPECT_THROW(Plan(passage, PlannerId::kPrm, options), InputError) << limit;
  }
  EXPECT_THROW(PlanWithOmpl(passage.model, {std::nan(""), 0.0, 0.0},
                            passage.scene.goal, PlannerId::kPrm, {}),
               InputError);
  EXPECT_THROW(PlanWithOmpl(nullptr, passage.scene.start, passage.scene.goal,
                            PlannerId::kPrm, {}),
               InputError);
  EXPECT_THROW(OmplBenchmarkLog(passage.model, {std::nan(""), 0.0, 0.0},
                                passage.scene.goal, "test", PlannerId::kPrm, 1),
               InputError);
  EXPECT_THROW(OmplBenchmarkLog(nullptr, passage.scene.start,
                                passage.scene.goal, "test", PlannerId::kPrm, 1),
               InputError);
}

}  // namespace
}  // namespace phongpd
