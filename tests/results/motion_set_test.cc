// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the segment clipped by convex polyhedra in rational numbers.
#include "results/bench/motion_set.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"
#include "tests/support/campaign.h"

namespace phongpd::bench {
namespace {

constexpr std::uint64_t kSeed = 1;

// Both the judge and the tree under it, on a slice of the public set.
TEST(MotionSetCampaign, JudgesEveryMotionAsTheRationalTruth) {
  const std::vector<MotionScene> scenes = MotionScenes();
  std::vector<FreeSpace> free;
  std::vector<TriangleBvh> trees;
  for (const MotionScene& scene : scenes) {
    free.emplace_back(
        std::vector<ContactSpace>{TakeAsContactSpace(scene.contact)});
    trees.emplace_back(scene.contact);
  }
  const long motions = testing::CampaignCases(24000, 1000000);
  long failures = 0;
  std::vector<long> blocked_of(kMotionClasses, 0), free_of(kMotionClasses, 0);
  for (long i = 0; i < motions; ++i) {
    const GridMotion motion =
        MakeMotion(scenes, kSeed, static_cast<std::uint64_t>(i));
    const auto at = static_cast<std::size_t>(motion.scene);
    const bool meets = Meets(scenes[at], motion.a, motion.b);
    const bool starts_free = !Meets(scenes[at], motion.a, motion.a);
    const Eigen::Vector3d a = motion.From(), b = motion.To();
    const MotionCheck check = free[at].Check(a, b);
    // The tree knows the surface alone.
    const bool right = free[at].IsFree(a, b) != meets && check.free != meets &&
                       free[at].IsFree(a) == starts_free &&
                       (!starts_free || trees[at].Meets(a, b) == meets);
    if (!right) {
      ++failures;
      ADD_FAILURE() << "motion " << i << ", " << scenes[at].name << ", "
                    << Name(motion.kind) << ": truth "
                    << (meets ? "blocked" : "free");
    }
    ++(meets ? blocked_of : free_of)[static_cast<std::size_t>(motion.kind)];
  }
  EXPECT_EQ(failures, 0);
  // Every class holds both kinds, but what goes through a feature is blocked.
  for (std::size_t c = 0; c < kMotionClasses; ++c) {
    EXPECT_GT(blocked_of[c], motions / 1000) << c;
    if (c == static_cast<std::size_t>(MotionClass::kThroughEdge) ||
        c == static_cast<std::size_t>(MotionClass::kThroughVertex)) {
      EXPECT_EQ(free_of[c], 0) << c;
    } else {
      EXPECT_GT(free_of[c], motions / 1000) << c;
    }
  }
  phongpd::testing::ReportCampaign({"5 exact motion checks",
                                    "20 scenes, 6 classes of motions; rational "
                                    "truth",
                                    motions, failures, 0.0, 0.0, "", kSeed});
}

// What others have downloaded or generated stays what it was.
TEST(MotionSet, IsTheStreamOfVersionThree) {
  const std::vector<MotionScene> scenes = MotionScenes();
  ASSERT_EQ(scenes.size(), 20u);
  StreamHash hash;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const GridMotion motion = MakeMotion(scenes, kSeed, i);
    hash.Add(motion, Meets(scenes[static_cast<std::size_t>(motion.scene)],
                           motion.a, motion.b));
  }
  EXPECT_EQ(hash.value(), 54094596019564485U);
}

}  // namespace
}  // namespace phongpd::bench
