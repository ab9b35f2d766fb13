// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the build that arranges all facets at once.
#include "core/contact/build_by_boxes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/contact/build_switches.h"
#include "core/contact/contact_space.h"
#include "core/minkowski/build_stop.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/random_pairs.h"
#include "tests/support/same_space.h"
#include "tests/support/sanitizer.h"

namespace phongpd {
namespace {

using internal::Boxes;
using internal::BuildSwitched;
using internal::BuildSwitches;
using internal::Culling;
using testing::DifferenceOf;

constexpr char kTooThin[] = "expected boxes that fit together";

bool IsByBoxes(const ContactSpace& space) {
  return space.report().method.find(" boxes") != std::string::npos;
}

// "" or what differs; a refusal's words where cells are too thin to be judged.
std::string Compare(const SolidPair& pair, const ContactSpaceOptions& options,
                    const BuildSwitches& switches) {
  const ContactSpace whole =
      BuildContactSpace(pair.robot, pair.obstacle, options);
  EXPECT_FALSE(IsByBoxes(whole));
  try {
    const ContactSpace boxes =
        BuildSwitched(pair.robot, pair.obstacle, options, switches);
    EXPECT_TRUE(IsByBoxes(boxes));
    return DifferenceOf(boxes, whole);
  } catch (const BuildRefusal& refusal) {
    return refusal.what();
  }
}

TEST(BuildByBoxesCampaign, GivesTheSurfaceOfOneArrangementOfRandomPairs) {
  const long cases = testing::CampaignCases(80, 2000);
  testing::CampaignRow row;
  row.item = "boxes";
  long refused = 0;
  for (long i = 0; i < cases; ++i) {
    const std::vector<PairKind>& kinds = AllPairKinds();
    const PairKind kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    if (kind == PairKind::kManyBoxes) continue;  // seconds each
    const auto seed = 1000 + static_cast<std::uint64_t>(i) / kinds.size();
    ContactSpaceOptions options;
    options.outer_shell_only = i % 3 == 0;
    const std::string difference = Compare(
        MakeRandomPair(kind, seed), options,
        {i % 2 == 0 ? Culling::kAlways : Culling::kNever, Boxes::kAlways, 40});
    ++row.cases;
    if (difference.find(kTooThin) != std::string::npos) {
      ++refused;
      continue;
    }
    EXPECT_EQ(difference, "") << Name(kind) << ", seed " << seed;
    row.failures += difference.empty() ? 0 : 1;
  }
  EXPECT_LE(refused, std::max(1L, cases / 100));
  row.subject = "built by boxes against in one, bit for bit; " +
                std::to_string(refused) + " refused by name";
  testing::ReportCampaign(row);
}

// The real switch: a limit of memory that one arrangement would pass.
TEST(BuildByBoxes, IsWhatALimitOfMemoryLeads) {
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     torus = MakeTorus(2, 0.6, 64, 32);
  const ContactSpace whole = BuildContactSpace(star, torus);
  ASSERT_GT(whole.report().predicted.mib, 0.0);
  ContactSpaceOptions options;
  options.max_mib = 0.98 * whole.report().predicted.mib;
  if (testing::kKeepsFreedMemory) {  // which passes the limit in the end
    EXPECT_THROW(BuildContactSpace(star, torus, options), BuildRefusal);
  } else {
    const ContactSpace boxes = BuildContactSpace(star, torus, options);
    EXPECT_TRUE(IsByBoxes(boxes)) << boxes.report().method;
    EXPECT_EQ(DifferenceOf(boxes, whole), "");
    EXPECT_LT(boxes.report().predicted.mib, options.max_mib);
  }
  // What boxes would pass, too, is refused at once and with the figure.
  options.max_mib = 4.0;
  EXPECT_THROW(BuildContactSpace(star, torus, options), BuildRefusal);
}

// Triangles that are not merged are no planes to join by: built in one, or not
// at all.
TEST(BuildByBoxes, IsNotForUnmergedTriangles) {
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     torus = MakeTorus(2, 0.6, 24, 12);
  ContactSpaceOptions options;
  options.merge_coplanar = false;
  options.max_mib = 0.9 * BuildContactSpace(star, torus).report().predicted.mib;
  EXPECT_THROW(BuildContactSpace(star, torus, options), BuildRefusal);
}

}  // namespace
}  // namespace phongpd
