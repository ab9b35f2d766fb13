// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the build that arranges every facet.
#include <gtest/gtest.h>

#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/culled_build.h"
#include "problems/studies/hidden_pairs.h"

namespace phongpd {
namespace {

using internal::BuildCulled;
using internal::Culling;
using internal::CullingReport;

TEST(Culling, LeavesTheSurfaceAsItIsToTheLastBit) {
  const std::vector<HiddenPair> pairs = HiddenPairs(1);
  ASSERT_GE(pairs.size(), 24u);
  std::size_t dropped = 0, all = 0;
  for (const HiddenPair& pair : pairs) {
    SCOPED_TRACE(pair.name);
    CullingReport never, always;
    const ContactSpace whole =
        BuildCulled(pair.robot, pair.obstacle, {}, Culling::kNever, &never);
    const ContactSpace culled =
        BuildCulled(pair.robot, pair.obstacle, {}, Culling::kAlways, &always);
    EXPECT_EQ(never.dropped, 0u);
    EXPECT_EQ(culled.mesh().vertices, whole.mesh().vertices);
    EXPECT_EQ(culled.mesh().triangles, whole.mesh().triangles);
    EXPECT_EQ(culled.plane(), whole.plane());
    EXPECT_EQ(culled.kind(), whole.kind());
    const ContactSpaceReport &r = culled.report(), &s = whole.report();
    EXPECT_EQ(r.cavities, s.cavities);
    EXPECT_EQ(r.components, s.components);
    EXPECT_EQ(r.genus, s.genus);
    EXPECT_EQ(r.volume, s.volume);
    EXPECT_EQ(r.convolution_triangles, s.convolution_triangles);
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
        BuildCulled(cube, tube, {}, Culling::kNever, &never);
    const ContactSpace culled =
        BuildCulled(cube, tube, {}, Culling::kAlways, &always);
    EXPECT_EQ(culled.mesh().vertices, whole.mesh().vertices) << cells;
    EXPECT_EQ(culled.mesh().triangles, whole.mesh().triangles) << cells;
    EXPECT_EQ(culled.report().cavities, whole.report().cavities) << cells;
  }
}

}  // namespace
}  // namespace phongpd
