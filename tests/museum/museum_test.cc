// SPDX-License-Identifier: GPL-3.0-or-later
// Depths and contacts that others got wrong.  The public thread is named with
// each; shapes are rebuilt from its description alone.  Truth: closed forms.
// Every answer is asked for twice, from windows and of the whole contact space.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"
#include "problems/shapes/shapes.h"
#include "tests/museum/depth_expectations.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::Cube;
using testing::ExpectDepth;
using testing::ExpectSeparate;
using testing::ExpectTouching;

// Turns the cube's space diagonal to the z axis.
Matrix3d OnItsCorner() {
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::Ones(), Vector3d::UnitZ())
      .toRotationMatrix();
}

// Of a cube turned and moved by q in another of the same side around the
// origin: convex solids leave along a normal of a facet of their sum, which is
// a face's of one of them or crosses an edge of each.
double DepthOfCubes(double side, const Matrix3d& turn, const Vector3d& q) {
  std::vector<Vector3d> normals;
  for (int i = 0; i < 3; ++i) {
    normals.push_back(Vector3d::Unit(i));
    normals.push_back(turn.col(i));
    for (int j = 0; j < 3; ++j)
      normals.push_back(Vector3d::Unit(i).cross(turn.col(j)));
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& n : normals) {
    if (n.norm() < 1e-9) continue;  // parallel edges
    const double width =
        side / 2 * (n.lpNorm<1>() + (turn.transpose() * n).lpNorm<1>());
    least = std::min(least, (width - std::abs(n.dot(q))) / n.norm());
  }
  return least;
}

// flexible-collision-library/fcl 545: a small cube on the diagonal of a big
// one was pushed out through the corner, √3 times as far as through a face.
TEST(MuseumOfDepths, LeavesACubeThroughAFaceNotTheCorner) {
  const Vector3d q(0.4, 0.4, 0.4);
  const DepthResult found = ExpectDepth(Cube(0.2), Cube(1), q, 0.2);
  EXPECT_NEAR(found.direction.maxCoeff(), 1.0, 1e-12);
  const Matrix3d turn = GenericRotation();
  const DepthResult turned = ExpectDepth(Rotated(Cube(0.2), turn),
                                         Rotated(Cube(1), turn), turn * q, 0.2);
  EXPECT_NEAR((turn.transpose() * turned.direction).maxCoeff(), 1.0, 1e-9);
}

// flexible-collision-library/fcl 574 (and 491): two meshes that overlap were
// given the depth 0 whatever their overlap, for meshes were but surfaces.
TEST(MuseumOfDepths, MeasuresMeshesInMeshes) {
  for (const double edge : {2.0, 0.6}) {
    const TriangleMesh cube = MakeScan(Cube(1), edge, 0, 1);
    for (const double depth : {0.001, 0.3, 0.6}) {
      const DepthResult found =
          ExpectDepth(cube, cube, {1 - depth, 0.125, 0.0625}, depth);
      EXPECT_NEAR(found.direction[0], 1.0, 1e-12);
    }
  }
}

// flexible-collision-library/fcl 492: a mesh wholly inside another had no
// contact with it and a positive distance.
TEST(MuseumOfDepths, KnowsThatASolidIsInsideAnother) {
  const DepthResult found =
      ExpectDepth(Cube(0.25), Cube(4), {0, -1, 0.5}, 2 + 0.125 - 1);
  EXPECT_NEAR(found.direction[1], -1.0, 1e-12);
  // Concave: a rod's cross in the middle bar of an L.
  ExpectDepth(Cube(0.5), MakeL(8, 2, 4), {6, 1, 2}, 1.25);
}

// flexible-collision-library/fcl 628: of a box flush with three sides of the
// one it is in, the depth was 1, and 0 once both were twice as high.
TEST(MuseumOfDepths, MeasuresABoxFlushInsideAnother) {
  for (const double high : {1.0, 2.0, 1000.0}) {
    const DepthResult found =
        ExpectDepth(MakeBox({0, 0.8, 0}, {1, 1, high}),
                    MakeBox({0, 0, 0}, {1, 1, high}), {0, 0, 0}, 0.2);
    EXPECT_NEAR(found.direction[1], 1.0, 1e-12);
  }
}

// flexible-collision-library/fcl 503: a convex block that rested on a box
// exactly edge on edge was given depths up to 1.84.
TEST(MuseumOfDepths, SeesNoDepthWhereEdgesCoincide) {
  const TriangleMesh box = MakeBox({-2, -1, 0}, {0, 1, 2});
  // A trapezium over the box's side x = 0.
  TriangleMesh block = MakeBox({0, -1, 0}, {2, 1, 2});
  for (Vector3d& v : block.vertices)
    if (v[0] > 1) v = Vector3d(2, 0.5 * v[1], 1 + 0.5 * (v[2] - 1));
  for (const Vector3d& q :
       {Vector3d(0, 0, 0), Vector3d(0, 0.5, 0), Vector3d(0, 2, 0),
        Vector3d(0, 2, 2), Vector3d(0, -1.25, 1.5)})
    ExpectTouching(block, box, q);
  const DepthResult deep = ExpectDepth(block, box, {-0.5, 0, 0}, 0.5);
  EXPECT_NEAR(deep.direction[0], 1.0, 1e-12);
}

// IfcOpenShell/IfcOpenShell 2430: walls that only abut were given their height
// as depth at one joint and 0, as is right, at the other.
TEST(MuseumOfDepths, SeesNoDepthWhereWallsAbut) {
  const TriangleMesh wall = MakeBox({0, 0, 0}, {10, 0.3, 2.5});
  const TriangleMesh across = MakeBox({0, 0.3, 0}, {0.3, 9.7, 2.5});
  // Butt joints at both ends, and one in the middle.
  for (const double x : {0.0, 9.7, 4.85}) {
    const DepthResult found = ExpectTouching(across, wall, {x, 0, 0});
    EXPECT_EQ(found.direction[2], 0.0);
  }
  const DepthResult deep = ExpectDepth(across, wall, {9.7, -0.01, 0}, 0.01);
  EXPECT_NEAR(deep.direction[1], 1.0, 1e-12);
}

// IfcOpenShell/IfcOpenShell 4594: walls of one section on one axis, 50 mm
// inside each other, were no clash; 2 mm off the axis they were.
TEST(MuseumOfDepths, MeasuresWallsOnOneAxis) {
  const TriangleMesh wall = MakeBox({0, -0.1, 0}, {4, 0.1, 3});
  for (const double off : {0.0, 0.002}) {
    const DepthResult found = ExpectDepth(wall, wall, {3.95, off, off}, 0.05);
    EXPECT_NEAR(found.direction[0], 1.0, 1e-9);
  }
}

// jrouwe/JoltPhysics 529: a shape in a mesh got no usable way out once it was
// a little deep, in a box it did.
TEST(MuseumOfDepths, RisesFromAMeshAtAnyDepth) {
  const TriangleMesh ground =
      MakeScan(MakeBox({-2, -2, -1}, {2, 2, 0}), 2.5, 0, 1);
  const TriangleMesh ball = MakeUvBall(0.5, 8, 6);
  for (const double z : {0.49, 0.4, 0.1, -0.3, -0.49}) {
    const DepthResult found = ExpectDepth(ball, ground, {0, 0, z}, 0.5 - z);
    EXPECT_NEAR(found.direction[2], 1.0, 1e-9);
  }
  const DepthResult below = ExpectDepth(ball, ground, {0, 0, -0.75}, 0.75);
  EXPECT_NEAR(below.direction[2], -1.0, 1e-9);
}

// jrouwe/JoltPhysics 940: a walker that ran into a corner of walls was thrown
// back by up to 16 metres.
TEST(MuseumOfDepths, StepsOutOfACornerByTheOverlapOnly) {
  const TriangleMesh walls = MakeL(4, 1, 3);
  const TriangleMesh walker = MakePrism(0.5, 1.5, 16);
  for (const double x : {0.01, 0.25})
    for (const double y : {0.02, 0.125}) {
      const DepthResult found =
          ExpectDepth(walker, walls, {1.5 - x, 1.5 - y, 1.5}, std::hypot(x, y));
      EXPECT_NEAR(found.direction[0] * y, found.direction[1] * x, 1e-9);
    }
  ExpectTouching(walker, walls, {1.5, 2, 1.5});
}

// No thread: a cube on an edge and one on a corner, in a slab and in a cube.
TEST(MuseumOfDepths, MeasuresCubesOnTheirDiagonals) {
  const TriangleMesh slab = MakeBox({-4, -4, -4}, {4, 4, 0});
  const Matrix3d on_edge =
      Eigen::AngleAxisd(std::acos(-1.0) / 4, Vector3d::UnitX())
          .toRotationMatrix();
  const double half_edge = std::sqrt(0.5), half_corner = std::sqrt(0.75);
  const TriangleMesh edge = Rotated(Cube(1), on_edge);
  const TriangleMesh corner = Rotated(Cube(1), OnItsCorner());
  EXPECT_NEAR(
      ExpectDepth(edge, slab, {0, 0, half_edge - 0.2}, 0.2).direction[2], 1.0,
      1e-9);
  EXPECT_NEAR(
      ExpectDepth(corner, slab, {0, 0, half_corner - 0.2}, 0.2).direction[2],
      1.0, 1e-9);
  // In one another: along the axis they share, 1; where that is long, half a
  // side and half a face's diagonal.
  ExpectDepth(edge, Cube(1), Vector3d::Zero(), 1);
  const TriangleMesh bar = MakeBox({-4, -0.5, -0.5}, {4, 0.5, 0.5});
  ExpectDepth(edge, bar, Vector3d::Zero(), 0.5 + half_edge);
  for (const Vector3d& q : {Vector3d(0, 0, 0), Vector3d(0.1, -0.2, 0.3),
                            Vector3d(0.5, 0.5, 0.5), Vector3d(0, 0.6, -0.6)})
    ExpectDepth(corner, Cube(1), q, DepthOfCubes(1, OnItsCorner(), q));
}

// google-deepmind/mujoco 3476: of two boxes of 71 mm that rest on each other
// with 0.056 mm of overlap at a corner, a contact said 71.056 mm.
TEST(MuseumOfDepths, MeasuresRestingBoxesByTheirOverlap) {
  const double side = 71, overlap = 0.056, angle = 0.001;
  const Matrix3d turn =
      Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  // The turned box reaches side/2 (cos + sin) down to its lowest edge.
  const Vector3d q(
      0, side / 2 * (1 + std::cos(angle) + std::sin(angle)) - overlap, 0);
  const double depth = DepthOfCubes(side, turn, q);
  EXPECT_LE(depth, overlap);
  EXPECT_GE(depth, 0.99 * overlap);
  const DepthResult found =
      ExpectDepth(Rotated(Cube(side), turn), Cube(side), q, depth);
  EXPECT_NEAR(found.direction[1], 1.0, 1e-6);
}

// No thread: cubes that share a face, a piece of one, an edge or a corner.
TEST(MuseumOfDepths, TouchesFlushFacesEdgesAndCorners) {
  const TriangleMesh a = Cube(0.3), b = Cube(0.7);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5})
      for (const double slide : {0.0, 0.1, 0.2, 0.5}) {
        Vector3d q = Vector3d::Constant(slide);
        q[axis] = side;
        const DepthResult found = ExpectTouching(a, b, q);
        if (slide < 0.5) {
          EXPECT_NEAR(found.direction[axis] * side, 0.5, 1e-12);
        } else {
          EXPECT_GE((found.direction.array() * q.array()).minCoeff(), 0.0);
        }
      }
}

// No thread: walls a millionth thick.
TEST(MuseumOfDepths, MeasuresWallsAMillionthThick) {
  const double thin = 1e-6;
  const TriangleMesh sheet = MakeBox({-2, -2, 0}, {2, 2, thin});
  const DepthResult up = ExpectDepth(Cube(1), sheet, {0, 0, 0.25}, 0.25 + thin);
  EXPECT_NEAR(up.direction[2], 1.0, 1e-9);
  EXPECT_NEAR(up.depth, 0.25 + thin, 1e-14);
  ExpectTouching(Cube(1), sheet, {0, 0, -0.5});
  ExpectSeparate(Cube(1), sheet, {0, 0, -0.5 - thin}, thin);
  // Two of them, crossed: the narrow way out is a millionth too.
  const TriangleMesh upright = MakeBox({-1, 0, 0}, {1, thin, 2});
  EXPECT_NEAR(ExpectDepth(upright, sheet, {0, 0, 0}, thin).depth, thin, 1e-14);
  // A closed room of such walls: one free cavity, and the way back into it.
  const TriangleMesh room = MakeBoxShell({-1, -1, -1}, {1, 1, 1}, thin);
  EXPECT_EQ(BuildContactSpace(Cube(1), room).report().cavities, 1);
  ExpectSeparate(Cube(1), room, {0.25, 0, 0}, 0.25);
  EXPECT_NEAR(ExpectDepth(Cube(1), room, {0.625, 0, 0}, 0.125).direction[0],
              -1.0, 1e-9);
}

// No thread: a peg in the hole it exactly fits.  The slot of no width is no
// part of ∂C_obj, so the way out is along the axis; a hair of play, and the
// peg is free, by half that; short of one wall it touches the other.
TEST(MuseumOfDepths, FitsAPegIntoItsHole) {
  const TriangleMesh plate = MakePlateWithHole(4, 1, 1);
  const TriangleMesh peg = MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1});
  const ContactSpaceReport fits = BuildContactSpace(peg, plate).report();
  EXPECT_EQ(fits.genus, 0);
  EXPECT_EQ(fits.components, 1);
  EXPECT_EQ(fits.triangles, 12u);
  EXPECT_EQ(fits.volume, 5 * 5 * 3);
  const DepthResult along = ExpectDepth(peg, plate, {0, 0, 0.25}, 1.25);
  EXPECT_NEAR(along.direction[2], 1.0, 1e-12);
  ExpectTouching(peg, plate, {0, 0, 1.5});

  const double hair = 1e-9;
  const TriangleMesh loose =
      MakeBox({-0.5 + hair, -0.5 + hair, -1}, {0.5 - hair, 0.5 - hair, 1});
  EXPECT_EQ(BuildContactSpace(loose, plate).report().genus, 1);
  ExpectSeparate(loose, plate, {0, 0, 0.25}, hair);
  EXPECT_NEAR(PenetrationDepth(loose, plate, {Vector3d(3 * hair, 0, 0)}).depth,
              2 * hair, 1e-14);

  const TriangleMesh narrow = MakeBox({-0.25, -0.5, -1}, {0.25, 0.5, 1});
  EXPECT_EQ(BuildContactSpace(narrow, plate).report().genus, 0);
  const TriangleMesh small = MakeBox({-0.25, -0.25, -1}, {0.25, 0.25, 1});
  for (const double x : {-0.25, 0.0, 0.25})
    for (const double y : {-0.25, 0.25})
      EXPECT_EQ(ExpectTouching(small, plate, {x, y, 0}).direction[2], 0.0);
}

// No thread: solids that are themselves two cubes sharing a corner, an edge or
// a face; a small cube sits on what is shared.
TEST(MuseumOfDepths, LeavesWhatTwoCubesShare) {
  const TriangleMesh cube = MakeBox({0, 0, 0}, {1, 1, 1});
  const double half = 0.125;
  const struct {
    Vector3d offset, q;
    double depth;
  } cases[] = {{{1, 1, 1}, {1, 1, 1}, half * std::sqrt(2)},
               {{1, 1, 0}, {1, 1, 0.5}, half * std::sqrt(2)},
               {{1, 0, 0}, {1, 0.5, 0.5}, half + 0.5}};
  for (const auto& each : cases)
    ExpectDepth(Cube(2 * half), Joined(cube, Translated(cube, each.offset)),
                each.q, each.depth);
}

}  // namespace
}  // namespace phongpd
