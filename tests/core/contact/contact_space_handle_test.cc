// SPDX-License-Identifier: GPL-3.0-or-later
// The handle: what is shared, what D means, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

ContactSpace SmallSpace() {
  return BuildContactSpace(MakeCone(0.5, 1.0, 7), MakeU(3.0, 1.0, 1.0));
}

TEST(ContactSpaceHandle, IsBuiltOnceHoweverManyThreadsAskFirst) {
  const ContactSpace space = SmallSpace();
  const long before = TriangleBvh::CountBuilt();
  std::vector<std::thread> threads;
  std::vector<const TriangleBvh*> found(8);
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back([&, i] {
      const ContactSpace copy = space;
      found[i] = &copy.bvh();
      EXPECT_EQ(copy.normals().size(), space.mesh().triangles.size());
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const TriangleBvh* bvh : found) EXPECT_EQ(bvh, &space.bvh());
  EXPECT_EQ(TriangleBvh::CountBuilt() - before, 1);
}

TEST(ContactSpaceHandle, HasTheDiagonalForLengthUnlessGivenAnother) {
  const ContactSpace space = SmallSpace();
  EXPECT_EQ(space.length(), ComputeBounds(space.mesh()).Diagonal());
  const ContactSpace other = space.WithLength(12.5);
  EXPECT_EQ(other.length(), 12.5);
  EXPECT_EQ(space.length(), ComputeBounds(space.mesh()).Diagonal());
  EXPECT_TRUE(other.SharesWith(space));
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(static_cast<void>(space.WithLength(bad)), InputError);
  }
}

// ℓ is a share of D: half the share of twice the length is the same field.
TEST(ContactSpaceHandle, SharesOfTheLengthMeanTheSameLength) {
  const ContactSpace space = SmallSpace();
  PhongMetricOptions whole, half;
  whole.field_options.smoothing_length = 0.125;
  half.field_options.smoothing_length = 0.0625;
  const PhongMetric one(space, whole);
  const PhongMetric same(space.WithLength(2.0 * space.length()), half);
  ASSERT_EQ(one.field().normals.size(), same.field().normals.size());
  for (std::size_t v = 0; v < one.field().normals.size(); ++v) {
    EXPECT_EQ(one.field().normals[v], same.field().normals[v]);
  }
}

TEST(ContactSpaceHandle, TakesAnyClosedMeshAndSaysSo) {
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  const ContactSpace taken = TakeAsContactSpace(box);
  EXPECT_EQ(taken.report().method, "taken from a mesh");
  EXPECT_EQ(taken.report().components, 1);
  EXPECT_NEAR(taken.report().volume, 8.0, 1e-12);
  EXPECT_TRUE(taken.plane().empty());
  EXPECT_TRUE(taken.kind().empty());
  EXPECT_EQ(EuclideanMetric(taken).Query(Vector3d(0.5, 0, 0)).signed_distance,
            -0.5);
}

TEST(ContactSpaceHandle, RefusesByNameWhatIsNoSurface) {
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  const auto refused = [](TriangleMesh mesh, const std::string& what) {
    const std::string text = testing::ErrorOf(
        [&] { TakeAsContactSpace(std::move(mesh), "part.off"); });
    EXPECT_EQ(text.find("part.off: "), 0U) << text;
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  refused({}, "no triangle");
  TriangleMesh open = box;
  open.triangles.pop_back();
  refused(open, "half-edges without exactly one opposite");
  TriangleMesh broken = box;
  broken.triangles[0][1] = 99;
  refused(broken, "vertex indices out of range");
  broken = box;
  broken.vertices[0].x() = std::nan("");
  refused(broken, "non-finite");
  refused(Scaled(box, 0x1p-600), "diagonal");
  ContactSpace::Parts parts;
  parts.mesh = box;
  parts.plane = {1, 2, 3};
  EXPECT_THROW(ContactSpace(std::move(parts)), InputError);
}

}  // namespace
}  // namespace phongpd
