// SPDX-License-Identifier: GPL-3.0-or-later
// Retraction and slides allocate nothing once their scratch has grown:
// checked by counting every allocation of the process.
#include <gtest/gtest.h>

#include "planners/retraction/collide_and_slide.h"
#include "planners/retraction/retraction.h"
#include "tests/support/count_allocations.h"
#include "tests/support/passages.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TEST(RetractionCost, AllocatesNothingAfterAWarmUp) {
  const testing::Passage passage = testing::MakePassage("tunnel", 1e-2, 1);
  for (const RetractionMetric metric :
       {RetractionMetric::kPhong, RetractionMetric::kEuclidean,
        RetractionMetric::kContactPoint}) {
    for (const BranchChoice choice :
         {BranchChoice::kAll, BranchChoice::kNovelty, BranchChoice::kWarm}) {
      RetractionOptions options;
      options.metric = metric;
      options.choice = choice;
      const Retraction retraction(passage.model, options);
      RetractionScratch scratch;
      SlideCounters counters;
      std::vector<Vector3d> path;
      const auto run = [&] {
        std::mt19937_64 random(3);
        Vector3d at = passage.scene.start;
        for (int i = 0; i < 200; ++i) {
          retraction.Retract(UniformPoint(passage.model->region(), &random),
                             &random, &scratch);
          if (scratch.points.empty()) continue;
          const Vector3d to = scratch.points.back().q;
          CollideAndSlide(*passage.model, 1e-2, at, to, &path, &counters);
          at = path.back();
          StepRetract(retraction, at, to, &random, &scratch, &path, &counters);
        }
      };
      run();
      run();  // novelty goes elsewhere the second time
      path.reserve(200);
      scratch.points.reserve(256);
      const long before = allocations;
      run();
      EXPECT_EQ(allocations, before)
          << static_cast<int>(metric) << ' ' << static_cast<int>(choice);
    }
  }
}

}  // namespace
}  // namespace phongpd
