// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes made of straight walls: prisms over polygons, unions of boxes.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/polygon_triangulation.h"
#include "core/pi.h"
#include "problems/shapes/cell_solids.h"
#include "problems/shapes/shape_parameters.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using internal::RequireCount;
using internal::RequireLength;
using internal::RequireLengthBelow;
using internal::UnitCircle;

using Loop = std::vector<Vector2d>;

// The solid over a polygon between z = bottom and z = top: the first loop is
// the outline, counter-clockwise; the others are holes, clockwise.
TriangleMesh Extrude(const std::vector<Loop>& loops, double bottom,
                     double top) {
  TriangleMesh mesh;
  for (const Loop& loop : loops) {
    for (const Vector2d& p : loop) {
      mesh.vertices.emplace_back(p.x(), p.y(), bottom);
    }
  }
  const int n = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i < n; ++i) {
    mesh.vertices.emplace_back(mesh.vertices[i].x(), mesh.vertices[i].y(), top);
  }
  for (const auto& [a, b, c] : internal::TriangulatePolygon(loops)) {
    mesh.triangles.push_back({a + n, b + n, c + n});
    mesh.triangles.push_back({a, c, b});
  }
  int first = 0;
  for (const Loop& loop : loops) {
    const int size = static_cast<int>(loop.size());
    for (int i = 0; i < size; ++i) {
      const int a = first + i, b = first + (i + 1) % size;
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
    first += size;
  }
  return mesh;
}

Loop RegularPolygon(double radius, int sides) {
  Loop loop;
  for (int i = 0; i < sides; ++i) loop.push_back(radius * UnitCircle(i, sides));
  return loop;
}

Loop CenteredSquare(double side) {
  const double h = 0.5 * side;
  return {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
}

Loop Reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

// Appends `count` points of the arc from angle `from` to `to`, both included.
void AppendArc(const Vector2d& center, double radius, double from, double to,
               int count, Loop* loop) {
  for (int i = 0; i < count; ++i) {
    const double angle = from + (to - from) * i / (count - 1);
    loop->push_back(center +
                    radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
}

// `body` with a cavity in the form of the second solid.
TriangleMesh Hollow(const TriangleMesh& body, const TriangleMesh& cavity) {
  return Joined(body, Reversed(cavity));
}

}  // namespace

TriangleMesh MakeBox(const Vector3d& min, const Vector3d& max) {
  for (int axis = 0; axis < 3; ++axis) {
    RequireLength("MakeBox", "max - min", max[axis] - min[axis]);
  }
  return Extrude({{{min.x(), min.y()},
                   {max.x(), min.y()},
                   {max.x(), max.y()},
                   {min.x(), max.y()}}},
                 min.z(), max.z());
}

TriangleMesh MakeAxes(double half_length, double half_width) {
  RequireLength("MakeAxes", "half_length", half_length);
  RequireLengthBelow("MakeAxes", "half_width", half_width, half_length,
                     "half_length");
  const std::vector<double> cuts = {-half_length, -half_width, half_width,
                                    half_length};
  return internal::UniteCells({cuts, cuts, cuts}, [](int i, int j, int k) {
    return (i == 1) + (j == 1) + (k == 1) >= 2;
  });
}

TriangleMesh MakeWrench(double scale, int hole, int ring, int jaw, int throat) {
  RequireLength("MakeWrench", "scale", scale);
  RequireCount("MakeWrench", "hole", hole, 3);
  // With fewer points, chords of the ring would cut into the hole and chords
  // of the jaw into its throat.
  RequireCount("MakeWrench", "ring", ring, 6);
  RequireCount("MakeWrench", "jaw", jaw, 4);
  RequireCount("MakeWrench", "throat", throat, 3);

  constexpr double kRing = 1.0, kHole = 0.6, kHandle = 0.35, kLength = 5.0;
  constexpr double kJaw = 1.2, kGap = 0.55, kThickness = 0.5, kDepth = 0.1;
  const Vector2d ring_center(-0.5 * kLength, 0), jaw_center(0.5 * kLength, 0);
  const double at_ring = std::asin(kHandle / kRing);
  const double at_jaw = std::asin(kHandle / kJaw);
  const double at_gap = std::asin(kGap / kJaw);
  Loop outline;
  AppendArc(ring_center, kRing, at_ring, 2 * kPi - at_ring, ring, &outline);
  AppendArc(jaw_center, kJaw, at_jaw - kPi, -at_gap, jaw, &outline);
  AppendArc(jaw_center - Vector2d(kDepth, 0), kGap, -0.5 * kPi, -1.5 * kPi,
            throat, &outline);
  AppendArc(jaw_center, kJaw, at_gap, kPi - at_jaw, jaw, &outline);
  Loop bore = Reversed(RegularPolygon(kHole, hole));
  for (Vector2d& p : bore) p += ring_center;
  return Scaled(Extrude({outline, bore}, -0.5 * kThickness, 0.5 * kThickness),
                scale);
}

TriangleMesh MakeL(double size, double width, double height) {
  RequireLength("MakeL", "size", size);
  RequireLengthBelow("MakeL", "width", width, size, "size");
  RequireLength("MakeL", "height", height);
  return Extrude({{{0, 0},
                   {size, 0},
                   {size, width},
                   {width, width},
                   {width, size},
                   {0, size}}},
                 0, height);
}

TriangleMesh MakeU(double size, double wall, double height) {
  RequireLength("MakeU", "size", size);
  RequireLengthBelow("MakeU", "wall", wall, 0.5 * size, "size / 2");
  RequireLength("MakeU", "height", height);
  const double far = size - wall;
  return Extrude({{{0, 0},
                   {size, 0},
                   {size, wall},
                   {wall, wall},
                   {wall, far},
                   {size, far},
                   {size, size},
                   {0, size}}},
                 0, height);
}

TriangleMesh MakePlateWithHole(double side, double thickness, double hole) {
  RequireLength("MakePlateWithHole", "side", side);
  RequireLength("MakePlateWithHole", "thickness", thickness);
  RequireLengthBelow("MakePlateWithHole", "hole", hole, side, "side");
  return Extrude({CenteredSquare(side), Reversed(CenteredSquare(hole))},
                 -0.5 * thickness, 0.5 * thickness);
}

TriangleMesh MakePlateWithRoundHole(double side, double thickness,
                                    double radius, int sides) {
  RequireLength("MakePlateWithRoundHole", "side", side);
  RequireLength("MakePlateWithRoundHole", "thickness", thickness);
  RequireLengthBelow("MakePlateWithRoundHole", "radius", radius, 0.5 * side,
                     "side / 2");
  RequireCount("MakePlateWithRoundHole", "sides", sides, 3);
  return Extrude(
      {CenteredSquare(side), Reversed(RegularPolygon(radius, sides))},
      -0.5 * thickness, 0.5 * thickness);
}

TriangleMesh MakePrism(double radius, double height, int sides) {
  RequireLength("MakePrism", "radius", radius);
  RequireLength("MakePrism", "height", height);
  RequireCount("MakePrism", "sides", sides, 3);
  return Extrude({RegularPolygon(radius, sides)}, -0.5 * height, 0.5 * height);
}

TriangleMesh MakeBoxShell(const Vector3d& min, const Vector3d& max,
                          double thickness) {
  RequireLength("MakeBoxShell", "thickness", thickness);
  return Hollow(MakeBox(min.array() - thickness, max.array() + thickness),
                MakeBox(min, max));
}

TriangleMesh MakeCells(const std::vector<double>& x,
                       const std::vector<double>& y,
                       const std::vector<double>& z,
                       const std::vector<std::vector<std::string>>& layers) {
  const auto require = [](bool good, const std::string& expected) {
    if (!good) throw InputError("MakeCells: expected " + expected);
  };
  for (const std::vector<double>* cuts : {&x, &y, &z}) {
    require(cuts->size() >= 2 && cuts->size() <= 1000,
            "2 to 1000 cuts on every axis");
    for (std::size_t i = 1; i < cuts->size(); ++i) {
      RequireLength("MakeCells", "cut - previous cut",
                    (*cuts)[i] - (*cuts)[i - 1]);
    }
  }
  require(layers.size() == z.size() - 1, "one layer between two cuts of z");
  for (const std::vector<std::string>& rows : layers) {
    require(rows.size() == y.size() - 1, "one row between two cuts of y");
    for (const std::string& row : rows) {
      require(row.size() == x.size() - 1 &&
                  row.find_first_not_of("#.") == std::string::npos,
              "rows of one '#' (solid) or '.' between two cuts of x");
    }
  }
  return internal::WithWholeFaces(internal::UniteCells(
      {x, y, z},
      [&layers](int i, int j, int k) { return layers[k][j][i] == '#'; }));
}

TriangleMesh MakeVessel(double outer, double inner, double window) {
  RequireLength("MakeVessel", "outer", outer);
  RequireLengthBelow("MakeVessel", "inner", inner, outer, "outer");
  const double a = 0.5 * outer, b = 0.5 * inner, c = 0.5 * window;
  if (window == 0) {
    return Hollow(MakeBox(Vector3d::Constant(-a), Vector3d::Constant(a)),
                  MakeBox(Vector3d::Constant(-b), Vector3d::Constant(b)));
  }
  RequireLengthBelow("MakeVessel", "window", window, inner, "inner");
  const std::vector<double> cuts = {-a, -b, -c, c, b, a};
  return internal::UniteCells({cuts, cuts, cuts}, [](int i, int j, int k) {
    const auto within = [](int x) { return x >= 1 && x <= 3; };
    const bool cavity = within(i) && within(j) && within(k);
    const bool opening = i == 2 && j == 2 && k == 4;
    return !cavity && !opening;
  });
}

}  // namespace phongpd
