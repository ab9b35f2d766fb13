// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "constraints/free_space.h"
#include "core/mesh/mesh_error.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

double LongestPiece(const Path& path) {
  double longest = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    longest = std::max(longest, (path[i] - path[i - 1]).norm());
  }
  return longest;
}

TEST(PathResampling, PinsCornersCloserThanAWaypointSpacing) {
  // The spacing is 0.05, the two corners are 0.001 apart.
  const Path corners = {
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.001, 0.0}, {0.0, 0.5, 1.0}};
  const Path path = ResampleKeepingCorners(corners, 40);
  ASSERT_EQ(path.size(), 42u);
  for (const Vector3d& corner : corners) {
    EXPECT_EQ(std::count(path.begin(), path.end(), corner), 1);
  }
  EXPECT_NEAR(PathLength(path), PathLength(corners), 1e-12);
}

TEST(PathResampling, KeepsOrderAndLongestPieceWithinTheBound) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    const int inner = static_cast<int>(random() % 12);
    Path corners;
    for (int i = 0; i < inner + 2; ++i) {
      // Some corners fall together.
      const double scale = random() % 3 == 0 ? 1e-6 : 1.0;
      const Vector3d from = corners.empty() ? Vector3d::Zero() : corners.back();
      const double x = uniform(random), y = uniform(random);
      corners.push_back(from + scale * Vector3d(x, y, uniform(random)));
    }
    const int waypoints = inner + static_cast<int>(random() % 40);
    const Path path = ResampleKeepingCorners(corners, waypoints);
    ASSERT_EQ(path.size(), static_cast<std::size_t>(waypoints) + 2);
    auto from = path.begin();
    for (const Vector3d& corner : corners) {
      from = std::find(from, path.end(), corner);
      ASSERT_NE(from, path.end());
    }
    EXPECT_LE(LongestPiece(path),
              PathLength(corners) / (waypoints + 1 - inner) + 1e-12);
  }
}

TEST(PathResampling, RefusesPointsThatAreNotFinite) {
  const Vector3d origin = Vector3d::Zero();
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(
        ResampleKeepingCorners({origin, Vector3d(bad, 0.0, 0.0), origin}, 5),
        InputError);
  }
}

// Their difference is no double, or the square of its length is none.
TEST(PathResampling, RefusesSegmentsThatAreTooLong) {
  const Vector3d origin = Vector3d::Zero();
  for (const double far : {1e155, 1e308}) {
    const Vector3d a(far, far, 0.0);
    const std::string what = testing::ErrorOf([&] {
      ResampleKeepingCorners({origin, origin, a, -a}, 9);
    });
    EXPECT_NE(what.find("after point 1 (from 0)"), std::string::npos) << what;
  }
  const Path path = ResampleKeepingCorners(
      {origin, Vector3d(1e153, 0.0, 0.0), Vector3d(-1e153, 0.0, 0.0)}, 5);
  ASSERT_EQ(path.size(), 7u);
  EXPECT_EQ(path[1].x(), 0.5e153);
}

TEST(PathResampling, RefusesMoreCornersThanWaypoints) {
  const Path corners = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};
  EXPECT_TRUE(ResampleKeepingCorners(corners, 0).empty());
  EXPECT_EQ(ResampleKeepingCorners(corners, 1), corners);
  EXPECT_TRUE(ResampleKeepingCorners({corners[0]}, 4).empty());
  EXPECT_TRUE(ResampleKeepingCorners({}, 4).empty());
  // No length at all.
  EXPECT_EQ(ResampleKeepingCorners({corners[0], corners[0]}, 3),
            Path(5, corners[0]));
}

}  // namespace
}  // namespace phongpd
