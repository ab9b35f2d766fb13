// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: volumes by Cavalieri (a mitred part is as long as its axis), and
// prisms made another way.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::PolygonArea;

TEST(Tube, IsASolidAsLongAsItsPolyline) {
  const std::vector<Vector3d> path = {
      {0, 0, 0}, {2, 0, 0}, {3, 1, 0.5}, {3, 3, 2}, {3, 3, 5}};
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i] - path[i - 1]).norm();
  }
  for (const int sides : {3, 4, 12}) {
    MeshReport report;
    MakeSolid(MakeTube(path, 0.3, sides), "tube", &report);
    EXPECT_EQ(report.triangles, 2u * sides * path.size() - 4);
    EXPECT_EQ(report.inverted_components, 0);
    EXPECT_EQ(report.components, 1);
    // A polygon whose middle is its corners' mean: mitres cut off as much as
    // they add.
    EXPECT_NEAR(report.volume / (length * PolygonArea(sides, 0.3)), 1, 1e-12);
  }
}

TEST(Tube, IsThePrismOverThePolygonWhereItIsStraight) {
  const TriangleMesh tube =
      MakeTube({{0, 0, -1}, {0, 0, 1}}, 0.5, 6, Vector3d(3, 0, 7));
  const TriangleMesh prism = MakePrism(0.5, 2, 6);
  ASSERT_EQ(tube.vertices.size(), prism.vertices.size());
  for (std::size_t i = 0; i < tube.vertices.size(); ++i) {
    EXPECT_LT((tube.vertices[i] - prism.vertices[i]).norm(), 1e-15) << i;
  }
}

// In a plane a tube keeps its first corner where it was, whatever the bends.
TEST(Tube, IsNotTwistedByBendsInAPlane) {
  std::vector<Vector3d> path = {{-1, 0, 0}};
  for (int i = 0; i <= 12; ++i) {
    const double a = 1.5 * kPi * i / 12;
    path.emplace_back(3 * std::sin(a), 3 - 3 * std::cos(a), 0);
  }
  const int sides = 8;
  const TriangleMesh tube = MakeTube(path, 0.4, sides);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(tube.vertices[i * sides].z(), 0.4, 1e-14);
    EXPECT_NEAR(tube.vertices[i * sides + sides / 2].z(), -0.4, 1e-14);
  }
}

TEST(Tube, RefusesWhatGivesNoTubeByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector3d> line = {{0, 0, 0}, {1, 0, 0}};
  const std::vector<std::pair<std::string, std::function<void()>>> refused = {
      {"MakeTube: radius must be", [&] { MakeTube(line, 0, 6); }},
      {"MakeTube: sides must be", [&] { MakeTube(line, 1, 2); }},
      {"MakeTube: points must be",
       [&] {
         MakeTube({{0, 0, 0}}, 1, 6);
       }},
      {"MakeTube: length of a part must be",
       [&] {
         MakeTube({{0, 0, 0}, {0, 0, 0}}, 1, 6);
       }},
      {"MakeTube: part 0: expected finite ends",
       [&] {
         MakeTube({{0, 0, 0}, {0, 0, nan}}, 1, 6);
       }},
      {"MakeTube: part 0: expected a bend below 90 degrees",
       [&] {
         MakeTube({{0, 0, 0}, {1, 0, 0}, {0.9, 1, 0}}, 0.1, 6);
       }},
      {"MakeTube: part 1: expected a length above that of the mitres",
       [&] {
         MakeTube({{0, 0, 0}, {1, 0, 0}, {1.1, 0.1, 0}, {1.1, 3, 0}}, 0.5, 6);
       }},
      {"MakeTube: expected up to be finite and not along the first part",
       [&] { MakeTube(line, 0.1, 6, Vector3d::UnitX()); }},
      {"MakeTube: expected up to be finite and not along the first part",
       [&] { MakeTube(line, 0.1, 6, Vector3d::Zero()); }}};
  for (const auto& [expected, make] : refused) {
    try {
      make();
      ADD_FAILURE() << "accepted; expected: " << expected;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(expected, 0), 0u)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace phongpd
