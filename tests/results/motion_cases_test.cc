// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/motion_cases.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "results/bench/model_spaces.h"
#include "tests/support/temporary_folder.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

TEST(MakeWalks, StepsAreEqualAndStayInTheBox) {
  const ContactSpace space = TakeAsContactSpace(MakeU(1.0, 0.2, 0.6));
  const std::vector<Motion> walks = MakeWalks(space, 5, 4000, 3);
  ASSERT_EQ(walks.size(), 5u);
  const double step = 0.003 * space.bounds().Diagonal();
  double farthest = 0.0;
  for (const Motion& walk : walks) {
    ASSERT_EQ(walk.size(), 4000u);
    EXPECT_EQ(space.bvh().Locate(walk[0]), Location::kInside);
    for (std::size_t i = 1; i < walk.size(); ++i) {
      EXPECT_NEAR((walk[i] - walk[i - 1]).norm(), step, 1e-12);
      EXPECT_TRUE((walk[i].array() >= space.bounds().min.array()).all());
      EXPECT_TRUE((walk[i].array() <= space.bounds().max.array()).all());
      farthest = std::max(farthest, (walk[i] - walk[0]).norm());
    }
  }
  EXPECT_GT(farthest, 50.0 * step);  // none of them treads on the spot
  EXPECT_EQ(MakeWalks(space, 5, 4000, 3), walks);
  EXPECT_NE(MakeWalks(space, 5, 4000, 4), walks);
}

using ModelSpacesTest = phongpd::testing::TemporaryFolder;

TEST_F(ModelSpacesTest, TakeWhatIsThereAndNameTheRest) {
  WriteMesh(MakeTorus(3.0, 1.0, 12, 8), At("joint.off"));
  std::vector<std::string> missing;
  const std::vector<MotionSpace> spaces =
      ModelSpaces(folder_.string(), &missing);
  ASSERT_EQ(spaces.size(), 1u);
  EXPECT_EQ(spaces[0].name, "ball + joint");
  // The robot's diagonal is a fifth of the model's, which is 1; a ball's box
  // and the torus' add up.
  EXPECT_NEAR(spaces[0].contact.bounds().Diagonal(), 1.2, 0.03);
  ASSERT_GT(missing.size(), 5u);
  EXPECT_EQ(missing[0], "dragknob.off");
  TriangleMesh open = MakeBox({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  WriteMesh(open, At("hand.off"));
  EXPECT_THROW(ModelSpaces(folder_.string(), &missing), InputError);
}

}  // namespace
}  // namespace phongpd::bench
