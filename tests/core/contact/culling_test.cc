// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the build that arranges every facet.
#include <gtest/gtest.h>

#include <vector>

#include "core/contact/build_switches.h"
#include "core/contact/contact_space.h"
#include "tests/support/hidden_pairs.h"
#include "tests/support/same_space.h"

namespace phongpd {
namespace {

using internal::BuildSwitched;
using internal::Culling;
using internal::CullingReport;

TEST(Culling, LeavesTheSurfaceAsItIsToTheLastBit) {
  const std::vector<HiddenPair> pairs = HiddenPairs(1);
  ASSERT_GE(pairs.size(), 41u);
  std::size_t dropped = 0, all = 0;
  for (const HiddenPair& pair : pairs) {
    SCOPED_TRACE(pair.name);
    CullingReport never, always;
    const ContactSpace whole =
        BuildSwitched(pair.robot, pair.obstacle, {}, {Culling::kNever}, &never);
    const ContactSpace culled = BuildSwitched(pair.robot, pair.obstacle, {},
                                              {Culling::kAlways}, &always);
    EXPECT_EQ(never.dropped, 0u);
    EXPECT_EQ(testing::DifferenceOf(culled, whole), "");
    const ContactSpaceReport &r = culled.report(), &s = whole.report();
    // Fewer facets, fewer faces: what is left out is what is hidden.
    EXPECT_LE(r.arrangement_faces, s.arrangement_faces);
    if (pair.is_hiding) {
      EXPECT_TRUE(always.was_tried);
      EXPECT_LT(r.arrangement_faces, s.arrangement_faces);
    }
    all += s.arrangement_faces;
    dropped += s.arrangement_faces - r.arrangement_faces;
  }
  EXPECT_GT(static_cast<double>(dropped), 0.3 * static_cast<double>(all));
}

// What lies on the surface is never left out, whatever overlaps: cells of free
// space that hidden facets enclose nearly.
TEST(Culling, KeepsCavitiesAndWhatTouches) {
  const TriangleMesh cube = MakeHilbertTube(1);
  for (const int cells : {2, 5, 9, 30, 60}) {
    const TriangleMesh tube = MakeHilbertTube(cells);
    CullingReport never, always;
    const ContactSpace whole =
        BuildSwitched(cube, tube, {}, {Culling::kNever}, &never);
    const ContactSpace culled =
        BuildSwitched(cube, tube, {}, {Culling::kAlways}, &always);
    EXPECT_EQ(culled.mesh().vertices, whole.mesh().vertices) << cells;
    EXPECT_EQ(culled.mesh().triangles, whole.mesh().triangles) << cells;
    EXPECT_EQ(culled.report().cavities, whole.report().cavities) << cells;
  }
}

}  // namespace
}  // namespace phongpd
