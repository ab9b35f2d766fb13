// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the same points in unbounded rationals, planes met by elimination.
#include "core/minkowski/operands/exact_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "tests/support/rationals.h"

namespace phongpd {
namespace {

// No namespace of a std::array finds them.
using internal::operator-;
using internal::operator+;

using internal::GridPlane;
using internal::GridPoint;
using internal::LocatedPoint;
using internal::PointDefinition;
using testing::Rational;
using testing::RationalPoint;

// Grid coordinates of sums, the largest there are: |x| < 2^39.
class RandomPoints {
 public:
  RandomPoints(std::uint64_t seed, int bits) : random_(seed), bits_(bits) {}

  GridPoint Vertex() {
    std::uniform_int_distribution<std::int64_t> x(
        -(std::int64_t{1} << bits_) + 1, (std::int64_t{1} << bits_) - 1);
    return {x(random_), x(random_), x(random_)};
  }
  GridPlane Plane() {
    while (true) {
      const GridPoint a = Vertex(), b = Vertex(), c = Vertex();
      const internal::GridNormal n = internal::Cross(b - a, c - a);
      if (!internal::IsZero(n)) return {n, internal::Dot(n, a)};
    }
  }
  // The edge from a vertex below the plane to one above it, and the plane.
  PointDefinition OnEdge() {
    while (true) {
      PointDefinition d;
      d.kind = PointDefinition::kEdge;
      d.a = Vertex();
      d.b = Vertex();
      const GridPlane plane = Plane();
      d.side_a = internal::Dot(plane.normal, d.a) - plane.offset;
      d.side_b = internal::Dot(plane.normal, d.b) - plane.offset;
      if (internal::Sign(d.side_a) * internal::Sign(d.side_b) < 0) return d;
    }
  }
  // Three planes that meet in a point among the vertices.
  PointDefinition OfPlanes() {
    while (true) {
      PointDefinition d;
      d.kind = PointDefinition::kPlanes;
      for (GridPlane& plane : d.planes) plane = Plane();
      const auto cross =
          internal::WideCross(d.planes[0].normal, d.planes[1].normal);
      testing::Rational det = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        det += testing::ToRational(cross[k]) *
               testing::ToRational(d.planes[2].normal[k]);
      }
      if (det == 0) continue;
      const Rational limit(std::int64_t{1} << bits_);
      bool inside = true;
      for (const Rational& x : testing::Solve(d.planes)) {
        inside = inside && x < limit && x + limit > 0;
      }
      if (inside) return d;
    }
  }
  PointDefinition Any() {
    const auto kind = random_() % 3;
    PointDefinition d;
    if (kind == 0) d.a = Vertex();
    return kind == 0 ? d : kind == 1 ? OnEdge() : OfPlanes();
  }

 private:
  std::mt19937_64 random_;
  int bits_;
};

int SignOf(const Rational& x) { return x.sign(); }

TEST(ExactPoints, EvaluateToTheRationalsOfTheirDefinitions) {
  RandomPoints random(1, 39);
  for (int i = 0; i < 300; ++i) {
    const PointDefinition d = random.Any();
    const RationalPoint p = testing::ToRational(d);
    const internal::Homogeneous h = internal::Evaluate(d);
    ASSERT_GT(h.w, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(testing::ToRational(h.x[k]), testing::ToRational(h.w) * p[k]);
    }
  }
}

TEST(ExactPoints, AreApproximatedAsWellAsPredicatesRelyOn) {
  RandomPoints random(2, 39);
  const Rational limit = Rational(internal::kPointError);
  for (int i = 0; i < 1000; ++i) {
    const PointDefinition d = random.Any();
    const RationalPoint p = testing::ToRational(d);
    const Eigen::Vector3d q = internal::Approximate(d);
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational error = Rational(q[static_cast<Eigen::Index>(k)]) - p[k];
      EXPECT_LE(error, limit);
      EXPECT_GE(Rational(error + limit), 0);
    }
  }
}

// Small coordinates, so that points often agree or nearly do, and all large.
TEST(ExactPoints, PredicatesHaveTheSignsOfRationals) {
  int ties = 0, same = 0;
  for (const int bits : {1, 2, 3, 12, 39}) {
    RandomPoints random(static_cast<std::uint64_t>(bits), bits);
    std::vector<LocatedPoint> points;
    std::vector<RationalPoint> truth;
    for (int i = 0; i < 60; ++i) {
      points.push_back(internal::Locate(random.Any()));
      truth.push_back(testing::ToRational(points.back().definition));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const GridPlane plane = random.Plane();
      for (std::size_t j = 0; j < points.size(); ++j) {
        for (int axis = 0; axis < 3; ++axis) {
          const auto k = static_cast<std::size_t>(axis);
          const int sign = SignOf(Rational(truth[i][k] - truth[j][k]));
          ASSERT_EQ(internal::CompareCoordinate(points[i], points[j], axis),
                    sign);
          ties += sign == 0 && i != j;
        }
        ASSERT_EQ(internal::SamePoint(points[i], points[j]),
                  truth[i] == truth[j]);
        same += i != j && truth[i] == truth[j];
        const int side = SignOf(testing::Height(plane, truth[j]));
        ASSERT_EQ(internal::SideOf(plane, points[j]), side);
        ties += side == 0;
      }
    }
  }
  EXPECT_GT(ties, 1000);
  EXPECT_GT(same, 20);
}

// A point beside a plane by 2^-41 of a grid step, far below what doubles tell
// at these coordinates: on the edge (0,0,0) to (n,n,n), at t = 1/n² or so.
TEST(ExactPoints, TellApartWhatDoublesDoNot) {
  constexpr std::int64_t n = (std::int64_t{1} << 38) - 1;
  const auto at = [](internal::Int128 above, internal::Int128 below) {
    PointDefinition d;
    d.kind = PointDefinition::kEdge;
    d.a = {n, n, n};
    d.b = {n + 1, n + 1, n};
    d.side_a = above;
    d.side_b = -below;
    return internal::Locate(d);
  };
  const internal::Int128 big = internal::Int128{1} << 41;
  const LocatedPoint half = at(big, big), next = at(big + 1, big);
  EXPECT_EQ(half.approximate, next.approximate);
  EXPECT_FALSE(internal::SamePoint(half, next));
  EXPECT_EQ(internal::CompareCoordinate(half, next, 0), -1);
  EXPECT_EQ(internal::CompareCoordinate(half, next, 2), 0);
  // x + y = 2n + 1 runs through the first.
  const GridPlane plane{{1, 1, 0}, internal::Int128{2} * n + 1};
  EXPECT_EQ(internal::SideOf(plane, half), 0);
  EXPECT_EQ(internal::SideOf(plane, next), 1);
  EXPECT_TRUE(internal::SamePoint(half, at(7, 7)));
}

// The lattice point p three ways, and points at fractions of it.
std::vector<PointDefinition> SamePointThreeWays(const GridPoint& p) {
  PointDefinition vertex, edge, planes;
  vertex.a = p;
  edge.kind = PointDefinition::kEdge;
  edge.a = p - GridPoint{2, 4, 6};
  edge.b = p + GridPoint{1, 2, 3};
  edge.side_a = -20;
  edge.side_b = 10;
  planes.kind = PointDefinition::kPlanes;
  const std::array<internal::GridNormal, 3> normals = {
      {{2, 1, 0}, {0, 3, -1}, {1, 0, 5}}};
  for (std::size_t i = 0; i < 3; ++i) {
    planes.planes[i] = {normals[i], internal::Dot(normals[i], p)};
  }
  return {vertex, edge, planes};
}

TEST(ExactPoints, HaveOneIdHoweverTheyAreDefined) {
  internal::ExactPoints ids;
  std::set<RationalPoint> distinct;
  // Multiples of 4 lie on walls between hash cells.
  for (std::int64_t x = -8; x <= 8; ++x) {
    for (const std::int64_t y : {-4, 0, 3}) {
      for (const PointDefinition& d : SamePointThreeWays({x, y, 4 * x})) {
        const LocatedPoint p = internal::Locate(d);
        const bool is_new = distinct.insert(testing::ToRational(d)).second;
        EXPECT_EQ(ids.Find(p) < 0, is_new);
        const int before = ids.size();
        const int id = ids.Add(p);
        EXPECT_EQ(ids.size(), before + (is_new ? 1 : 0));
        EXPECT_EQ(ids.Find(p), id);
        EXPECT_TRUE(internal::SamePoint(ids[id], p));
      }
    }
  }
  RandomPoints random(7, 2);
  for (int i = 0; i < 500; ++i) {
    const PointDefinition d = random.Any();
    distinct.insert(testing::ToRational(d));
    ids.Add(internal::Locate(d));
    EXPECT_EQ(ids.size(), static_cast<int>(distinct.size()));
  }
  // What was stored is what was given.
  std::set<RationalPoint> stored;
  for (int i = 0; i < ids.size(); ++i) {
    stored.insert(testing::ToRational(ids[i].definition));
  }
  EXPECT_EQ(stored, distinct);
}

TEST(NearestDoubles, DependOnThePointAlone) {
  const std::int64_t n = (std::int64_t{1} << 38) - 3;
  for (const PointDefinition& d : SamePointThreeWays({n, -n, 5})) {
    EXPECT_EQ(
        internal::NearestDoubles(d),
        Eigen::Vector3d(static_cast<double>(n), static_cast<double>(-n), 5.0));
    EXPECT_EQ(internal::NearestDoubles(d, 2),
              Eigen::Vector3d(0.5 * static_cast<double>(n),
                              -0.5 * static_cast<double>(n), 2.5));
  }
}

TEST(NearestDoubles, AreNearestWithTiesToEven) {
  // x = t on the edge from 0 to 1, t = a/(a + b).
  const auto nearest = [](internal::Int128 a, internal::Int128 b) {
    PointDefinition d;
    d.kind = PointDefinition::kEdge;
    d.b = {1, -1, 0};
    d.side_a = a;
    d.side_b = -b;
    return internal::NearestDoubles(d);
  };
  EXPECT_EQ(nearest(1, 2), Eigen::Vector3d(1.0 / 3, -1.0 / 3, 0.0));
  EXPECT_EQ(nearest(2, 1)[0], 2.0 / 3);
  EXPECT_EQ(nearest(3, 7)[0], 0.3);
  // Half way between two doubles, and a little more.
  const internal::Int128 one = internal::Int128{1} << 54;
  EXPECT_EQ(nearest(one / 2 + 1, one / 2 - 1)[0], 0.5 + 0x1p-53 - 0x1p-53);
  EXPECT_EQ(nearest(one / 2 + 3, one / 2 - 3)[0], 0.5 + 0x1p-52);
  EXPECT_EQ(nearest(2 * one + 5, 2 * one - 5)[0], 0.5 + 0x1p-53);
}

}  // namespace
}  // namespace phongpd
