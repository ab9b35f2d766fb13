// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: all pairs of corners tested by the exact judge, then the shortest way
// by relaxation (Bellman and Ford).
#include "planners/exact/path_recombination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

TriangleMesh Boxes(std::mt19937_64* random, int count) {
  std::uniform_real_distribution<double> place(0.0, 1.0);
  TriangleMesh boxes;
  for (int i = 0; i < count; ++i) {
    const Vector3d at(place(*random), place(*random), place(*random));
    boxes = Joined(boxes, MakeBox(at, at + Vector3d(0.15, 0.2, 0.25)));
  }
  return boxes;
}

double ShortestByRelaxation(const std::vector<RoutedPath>& paths,
                            const TriangleBvh& segments) {
  Path corners = {paths[0].points.front(), paths[0].points.back()};
  std::vector<double> clearance(2, 0.0);
  for (const RoutedPath& p : paths) {
    clearance[0] = clearance[1] = std::max(clearance[0], p.clearance);
    for (std::size_t k = 1; k + 1 < p.points.size(); ++k) {
      corners.push_back(p.points[k]);
      clearance.push_back(p.clearance);
    }
  }
  const auto is_given = [&](const Vector3d& a, const Vector3d& b) {
    return std::any_of(paths.begin(), paths.end(), [&](const RoutedPath& p) {
      for (std::size_t k = 0; k + 1 < p.points.size(); ++k) {
        if ((p.points[k] == a && p.points[k + 1] == b) ||
            (p.points[k] == b && p.points[k + 1] == a)) {
          return true;
        }
      }
      return false;
    });
  };
  std::vector<double> length(corners.size(),
                             std::numeric_limits<double>::infinity());
  length[0] = 0.0;
  for (std::size_t round = 0; round < corners.size(); ++round) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = 0; j < corners.size(); ++j) {
        const double way = length[i] + (corners[i] - corners[j]).norm();
        if (way >= length[j]) continue;
        if (is_given(corners[i], corners[j]) ||
            segments.Distance(corners[i], corners[j], 1.0) >=
                std::min(clearance[i], clearance[j])) {
          length[j] = way;
        }
      }
    }
  }
  return length[1];
}

TEST(RecombinePaths, IsAsShortAsAllPairsOfCornersAllow) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  int shorter = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const TriangleMesh boxes = Boxes(&random, 8);
    const TriangleBvh segments(boxes);
    const FreeSpace space({TakeAsContactSpace(boxes)});
    const Vector3d start(-0.3, 0.5, 0.5), goal(1.4, 0.5, 0.5);
    std::vector<RoutedPath> paths;
    for (int attempt = 0; attempt < 400 && paths.size() < 4; ++attempt) {
      RoutedPath path = {{start}, 0.01 * place(random)};
      for (int k = 0; k < 3; ++k) {
        path.points.emplace_back(place(random), 2.0 * place(random) - 0.5,
                                 place(random));
      }
      path.points.push_back(goal);
      if (CheckPath(space, path.points).free) paths.push_back(path);
    }
    ASSERT_GE(paths.size(), 2U);
    const Path path = RecombinePaths(paths, segments);
    EXPECT_EQ(path.front(), start);
    EXPECT_EQ(path.back(), goal);
    EXPECT_TRUE(CheckPath(space, path).free);
    EXPECT_NEAR(PathLength(path), ShortestByRelaxation(paths, segments), 1e-12);
    double given = std::numeric_limits<double>::infinity();
    for (const RoutedPath& p : paths) {
      given = std::min(given, PathLength(p.points));
    }
    EXPECT_LE(PathLength(path), given + 1e-12);
    shorter += PathLength(path) < 0.99 * given;
  }
  EXPECT_GE(shorter, 30);
}

// Two bars to pass, each under or over; the ways given cross from under one to
// over the other.  The best part of each is the same side twice.
TEST(RecombinePaths, TakesTheSameSideOfTwoBars) {
  const TriangleMesh bars = Joined(MakeBox({0.9, -5.0, -0.5}, {1.1, 5.0, 0.5}),
                                   MakeBox({2.9, -5.0, -0.5}, {3.1, 5.0, 0.5}));
  const Vector3d start(0.0, 0.0, 0.0), goal(4.0, 0.0, 0.0);
  const double z = 0.6;
  const Vector3d one(1.0, 0.0, z), two(3.0, 0.0, z);
  const Vector3d under(0.0, 0.0, -2.0 * z);
  const std::vector<RoutedPath> paths = {
      {{start, one, two + under, goal}, 0.0},
      {{start, one + under, two, goal}, 0.0}};
  const TriangleBvh segments(bars);
  ASSERT_TRUE(
      CheckPath(FreeSpace({TakeAsContactSpace(bars)}), paths[0].points).free);
  const Path path = RecombinePaths(paths, segments);
  EXPECT_NEAR(PathLength(path), 2.0 * std::hypot(1.0, z) + 2.0, 1e-12);
  // A new segment must keep the clearance of its ends, 0.1 here.
  std::vector<RoutedPath> wide = paths;
  wide[0].clearance = wide[1].clearance = 0.2;
  EXPECT_NEAR(PathLength(RecombinePaths(wide, segments)),
              PathLength(paths[0].points), 1e-12);
}

TEST(TakeSameWay, IsAboutPlacesNotAboutCorners) {
  const Path one = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {2.0, 0.0, 0.0}};
  Path finer = {{0.0, 0.0, 0.0},
                {0.5, 0.5, 0.0},
                {1.0, 1.0, 0.0},
                {1.0, 1.0, 0.0},
                {2.0, 0.0, 0.0}};
  EXPECT_TRUE(TakeSameWay(one, finer, 1e-9));
  finer[2].z() = finer[3].z() = 0.02;  // of a length of 2.83
  EXPECT_TRUE(TakeSameWay(one, finer, 0.01));
  EXPECT_FALSE(TakeSameWay(one, finer, 0.001));
  Path mirrored = one;
  mirrored[1].y() = -1.0;
  EXPECT_FALSE(TakeSameWay(one, mirrored, 0.1));
  const Path point = {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
  EXPECT_TRUE(TakeSameWay(point, point, 0.0));
}

TEST(RecombinePaths, GivesOnePathBackAndNothingForNone) {
  const TriangleBvh segments(MakeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  EXPECT_TRUE(RecombinePaths({}, segments).empty());
  const Path around = {{-2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {2.0, 0.0, 0.0}};
  EXPECT_EQ(RecombinePaths({{around, 0.1}}, segments), around);
  const Path line = {{-2.0, 2.0, 0.0}, {2.0, 2.0, 0.0}};
  EXPECT_EQ(RecombinePaths({{line, 9.0}, {line, 9.0}}, segments), line);
}

}  // namespace
}  // namespace phongpd
