// SPDX-License-Identifier: GPL-3.0-or-later
// Which coordinates are integers of some unit, and what the grid makes of it.
#include "core/minkowski/operands/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_io.h"
#include "core/minkowski/operands/grid_frame.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Decimals as a text file gives them: digits after the point, then read.
double Decimal(long count, int digits) {
  const std::string text =
      std::to_string(count) + "e" + std::to_string(-digits);
  return std::stod(text);
}

TEST(ExactUnit, IsFoundForDecimalsAndGivesThemBack) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<long> count(-1000000000, 1000000000);
  for (int digits = -9; digits <= 15; ++digits) {
    std::vector<double> decimals;
    for (int i = 0; i < 50; ++i) {
      decimals.push_back(Decimal(count(random), digits));
    }
    const auto unit = FindExactUnit(decimals);
    ASSERT_TRUE(unit) << digits << " digits";
    for (const double x : decimals) {
      const double n = std::nearbyint(unit->Count(x));
      EXPECT_EQ(unit->Length(n), x);
      EXPECT_LT(std::abs(n), std::ldexp(1.0, kLatticeBits));
    }
  }
}

TEST(ExactUnit, ScalesByPowersOfTwo) {
  std::vector<double> decimals = {0.1, -0.7, 1.3, 2.4};
  const auto unit = FindExactUnit(decimals);
  ASSERT_TRUE(unit);
  for (const int k : {-300, -1, 5, 300}) {
    std::vector<double> scaled;
    for (const double x : decimals) scaled.push_back(std::ldexp(x, k));
    const auto other = FindExactUnit(scaled);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->scale, unit->scale);
    EXPECT_EQ(other->exponent, unit->exponent + k);
  }
}

TEST(ExactUnit, IsNotFoundByAccident) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    found += FindExactUnit({uniform(random), uniform(random), uniform(random)})
                 .has_value();
  }
  EXPECT_EQ(found, 0);
}

TEST(CommonUnit, IsFoundBelowNoise) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const long most : {3L, 50L, 1000L, 30000L}) {
    std::uniform_int_distribution<long> count(0, most);
    for (const double noise : {0.0, 0x1p-50, 0x1p-44}) {
      const double u = 1.0 + uniform(random) / 2;
      const double room = noise * static_cast<double>(most) * u;
      std::vector<double> lengths = {u, static_cast<double>(most) * u};
      for (int i = 0; i < 100; ++i) {
        const double exact = static_cast<double>(count(random)) * u;
        lengths.push_back(std::abs(exact + room * uniform(random)));
      }
      const auto unit =
          FindCommonUnit(lengths, std::max(room, 0x1p-52 * lengths[1]));
      ASSERT_TRUE(unit) << most << " units, noise " << noise;
      EXPECT_NEAR(*unit, u, 4 * (noise + 0x1p-52) * u);
    }
  }
}

TEST(CommonUnit, IsNotFoundByAccident) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<double> lengths;
    for (int k = 0; k < 6; ++k) lengths.push_back(uniform(random));
    found += FindCommonUnit(lengths, 0x1p-50).has_value();
  }
  EXPECT_EQ(found, 0);
}

TriangleMesh Divided(TriangleMesh mesh, double divisor) {
  for (Vector3d& v : mesh.vertices) v /= divisor;
  return mesh;
}

TEST(GridFrame, IsTheSameForDecimalsOfAnyScaleAndPlace) {
  std::mt19937_64 random(5);
  const TriangleMesh a = testing::RandomVoxelSolid(3, 0.5, &random);
  const TriangleMesh b = testing::RandomVoxelSolid(3, 0.5, &random);
  const GridFrame frame = PlaceOnGrid(a, b);
  EXPECT_EQ(frame.rounding, 0.0);
  EXPECT_FALSE(frame.is_turned);
  const auto expect_same = [&](const TriangleMesh& robot,
                               const TriangleMesh& obstacle) {
    const GridFrame other = PlaceOnGrid(robot, obstacle);
    EXPECT_EQ(other.rounding, 0.0);
    EXPECT_EQ(other.robot, frame.robot);
    EXPECT_EQ(other.obstacle, frame.obstacle);
    // A difference of two vertices is that of their coordinates.
    const Vector3d x = ToDouble(other.obstacle[1]) - ToDouble(other.robot[2]);
    const Vector3d q = obstacle.vertices[1] - robot.vertices[2];
    EXPECT_LE((other.ToUser(x) - q).norm(), 0x1p-52 * q.norm());
  };
  for (const double factor : {1e1, 1e3, 1e9, 1024.0, 2e5}) {
    expect_same(Divided(a, factor), Divided(b, factor));
    expect_same(Scaled(a, factor), Scaled(b, factor));
  }
  expect_same(Translated(a, {1e6, -3e6, 7e5}), Translated(b, {99, 0, -12345}));
  expect_same(Divided(Translated(a, {1e6, -3e6, 7e5}), 10.0), Divided(b, 10.0));
}

TEST(GridFrame, FindsALatticeThatWasMovedTurnedOrScaledByAnything) {
  std::mt19937_64 random(6);
  const TriangleMesh a = testing::RandomVoxelSolid(3, 0.5, &random);
  const TriangleMesh b = testing::RandomVoxelSolid(3, 0.5, &random);
  const GridFrame frame = PlaceOnGrid(a, b);
  const auto expect_same = [&](const TriangleMesh& robot,
                               const TriangleMesh& obstacle, double bound) {
    const GridFrame other = PlaceOnGrid(robot, obstacle);
    EXPECT_EQ(other.robot, frame.robot);
    EXPECT_EQ(other.obstacle, frame.obstacle);
    EXPECT_GT(other.rounding, 0.0);
    EXPECT_LT(other.rounding, bound);
  };
  const double third = 1.0 / 3.0;
  expect_same(Scaled(a, third), Scaled(b, third), 1e-13);
  expect_same(Translated(a, {third, 1e3 * third, -1e5 * third}),
              Translated(b, {third, 0, 0}), 1e-9);
}

TEST(GridFrame, RoundsWhatIsOnNoLattice) {
  const TriangleMesh a = MakeCone(0.8, 1.6, 20), b = MakeTorus(2, 0.6, 12, 8);
  const GridFrame frame = PlaceOnGrid(a, b);
  EXPECT_EQ(frame.rounding, frame.step);
  EXPECT_LT(frame.step, 1e-10);
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    for (std::size_t j = 0; j < b.vertices.size(); ++j) {
      const Vector3d q =
          frame.ToUser(ToDouble(frame.obstacle[j]) - ToDouble(frame.robot[i]));
      EXPECT_LE((q - (b.vertices[j] - a.vertices[i])).lpNorm<Eigen::Infinity>(),
                1.01 * frame.step);
    }
  }
}

// The canonical frame turned these off their lattice: false cavities, a false
// genus, self-intersections, and another result after every move.
TEST(Faults, ShearedVoxelsStayOnTheirLattice) {
  const std::string folder = PHONGPD_TEST_DATA "/faults/";
  const TriangleMesh robot = ReadMesh(folder + "sheared_robot.off");
  const TriangleMesh obstacle = ReadMesh(folder + "sheared_obstacle.off");
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const auto expect_right = [](const ContactSpace& found) {
    EXPECT_EQ(found.report().volume, 3525.0);
    EXPECT_EQ(found.report().cavities, 0);
    EXPECT_EQ(found.report().genus, 0);
    EXPECT_EQ(found.report().self_intersections, 0u);
    EXPECT_EQ(found.report().grid_step, 0.0);
    EXPECT_LE(found.report().triangles, 200u);
    for (const Vector3d& v : found.mesh().vertices) {
      EXPECT_EQ(v, Vector3d(v.array().round()));
    }
  };
  expect_right(space);
  const Vector3d a(-12345678, 99, 1e6), b(1e6, -3e6, 7e5);
  const ContactSpace moved =
      BuildContactSpace(Translated(robot, a), Translated(obstacle, b));
  expect_right(moved);
  EXPECT_EQ(moved.mesh().triangles, space.mesh().triangles);
  EXPECT_EQ(moved.mesh().vertices, Translated(space.mesh(), b - a).vertices);
}

// Exact fits of decimals: rounded to binary fractions the peg was a grid step
// too thick or too thin.
TEST(Faults, DecimalPegsFitExactly) {
  for (const double unit : {0.1, 1e-3, 0.7}) {
    for (const double x : {0.0, 0.3, 1234.7}) {
      const auto peg = [&](double half) {
        return Divided(MakeBox({-half, -half, -9}, {half, half, 9}), 10.0);
      };
      const TriangleMesh plate = Divided(
          Translated(MakePlateWithHole(40, 10, 14), {10 * x, 0, 0}), 10.0);
      const auto in_units = [unit](TriangleMesh mesh) {
        return Scaled(std::move(mesh), unit);
      };
      EXPECT_EQ(
          BuildContactSpace(in_units(peg(7)), in_units(plate)).report().genus,
          0)
          << unit << ' ' << x;
      EXPECT_EQ(
          BuildContactSpace(in_units(peg(6)), in_units(plate)).report().genus,
          1)
          << unit << ' ' << x;
    }
  }
}

TEST(ContactSpace, WarnsWhereCoordinatesLeaveLittleOfAnOperand) {
  const TriangleMesh cone = MakeCone(0.8, 1.6, 20);
  const auto warnings = [&](double offset) {
    return BuildContactSpace(Translated(cone, {0, offset, 0}), MakeAxes(2, 0.2))
        .report()
        .warnings.size();
  };
  EXPECT_EQ(warnings(1e9), 0u);
  EXPECT_EQ(warnings(1e10), 1u);
}

}  // namespace
}  // namespace phongpd::internal
