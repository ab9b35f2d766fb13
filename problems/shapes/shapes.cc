// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "problems/shapes/shape_parameters.h"

namespace phongpd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using internal::RequireCount;
using internal::RequireLength;
using internal::RequireLengthBelow;
using internal::RequireTriangles;
using internal::UnitCircle;

TriangleMesh MakeIcosahedron(double radius) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  for (const double a : {golden, -golden}) {
    for (const double b : {-1.0, 1.0}) mesh.vertices.emplace_back(b, a, 0);
  }
  for (const double a : {golden, -golden}) {
    for (const double b : {-1.0, 1.0}) mesh.vertices.emplace_back(0, b, a);
  }
  for (const double a : {golden, -golden}) {
    for (const double b : {-1.0, 1.0}) mesh.vertices.emplace_back(a, 0, b);
  }
  for (Vector3d& v : mesh.vertices) v = radius * v.normalized();
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10},
                    {0, 10, 11}, {1, 5, 9},  {5, 11, 4}, {11, 10, 2},
                    {10, 7, 6},  {7, 1, 8},  {3, 9, 4},  {3, 4, 2},
                    {3, 2, 6},   {3, 6, 8},  {3, 8, 9},  {4, 9, 5},
                    {2, 4, 11},  {6, 2, 10}, {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

void RequireTube(const char* shape, int around, int least_around, int across) {
  RequireCount(shape, "around", around, least_around);
  RequireCount(shape, "across", across, 3);
  RequireTriangles(shape, "2·around·across triangles", around, across);
}

// Two triangles for every cell of a grid that closes in both directions;
// vertex (i, j) stands at i·across + j.
std::vector<Triangle> TubeTriangles(int around, int across) {
  const auto at = [=](int i, int j) {
    return (i % around) * across + j % across;
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return triangles;
}

}  // namespace

TriangleMesh MakeIcoBall(double radius, int levels) {
  RequireLength("MakeIcoBall", "radius", radius);
  RequireCount("MakeIcoBall", "levels", levels, 0, 9);
  TriangleMesh mesh = MakeIcosahedron(radius);
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> midpoints;
    const auto midpoint = [&](int a, int b) {
      const int next = static_cast<int>(mesh.vertices.size());
      const auto [at, is_new] = midpoints.emplace(std::minmax(a, b), next);
      if (is_new) {
        const Vector3d chord = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back(radius * chord.normalized());
      }
      return at->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      finer.insert(finer.end(),
                   {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

TriangleMesh MakeUvBall(double radius, int meridians, int parallels) {
  RequireLength("MakeUvBall", "radius", radius);
  RequireCount("MakeUvBall", "meridians", meridians, 3);
  RequireCount("MakeUvBall", "parallels", parallels, 2);
  RequireTriangles("MakeUvBall", "2·meridians·(parallels - 1) triangles",
                   meridians, parallels - 1);
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, radius);
  for (int i = 1; i < parallels; ++i) {
    const Vector2d polar = radius * UnitCircle(i, 2 * parallels);
    for (int j = 0; j < meridians; ++j) {
      const Vector2d azimuth = polar.y() * UnitCircle(j, meridians);
      mesh.vertices.emplace_back(azimuth.x(), azimuth.y(), polar.x());
    }
  }
  mesh.vertices.emplace_back(0, 0, -radius);

  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [=](int i, int j) {
    return 1 + (i - 1) * meridians + j % meridians;
  };
  for (int j = 0; j < meridians; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
  }
  for (int i = 1; i < parallels - 1; ++i) {
    for (int j = 0; j < meridians; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  for (int j = 0; j < meridians; ++j) {
    mesh.triangles.push_back(
        {south, at(parallels - 1, j + 1), at(parallels - 1, j)});
  }
  return mesh;
}

TriangleMesh MakeCone(double radius, double height, int sides) {
  RequireLength("MakeCone", "radius", radius);
  RequireLength("MakeCone", "height", height);
  RequireCount("MakeCone", "sides", sides, 3);
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, height);
  for (int i = 0; i < sides; ++i) {
    const Vector2d p = radius * UnitCircle(i, sides);
    mesh.vertices.emplace_back(p.x(), p.y(), 0);
  }
  for (int i = 0; i < sides; ++i) {
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  for (int i = 1; i < sides - 1; ++i) {
    mesh.triangles.push_back({1, i + 2, i + 1});
  }
  return mesh;
}

TriangleMesh MakeTorus(double major_radius, double minor_radius, int around,
                       int across) {
  RequireLength("MakeTorus", "major_radius", major_radius);
  RequireLengthBelow("MakeTorus", "minor_radius", minor_radius, major_radius,
                     "major_radius");
  RequireTube("MakeTorus", around, 3, across);
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    const Vector2d out = UnitCircle(i, around);
    for (int j = 0; j < across; ++j) {
      const Vector2d circle = minor_radius * UnitCircle(j, across);
      const Vector2d p = (major_radius + circle.x()) * out;
      mesh.vertices.emplace_back(p.x(), p.y(), circle.y());
    }
  }
  mesh.triangles = TubeTriangles(around, across);
  return mesh;
}

TriangleMesh MakeStar(double inner_radius, double outer_radius) {
  RequireLength("MakeStar", "inner_radius", inner_radius);
  RequireLength("MakeStar", "outer_radius", outer_radius);
  TriangleMesh mesh = MakeIcosahedron(inner_radius);
  const std::vector<Triangle> faces = std::move(mesh.triangles);
  mesh.triangles.clear();
  for (const auto& [a, b, c] : faces) {
    const Vector3d sum = mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c];
    const int tip = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(outer_radius * sum.normalized());
    mesh.triangles.insert(mesh.triangles.end(),
                          {{a, b, tip}, {b, c, tip}, {c, a, tip}});
  }
  return mesh;
}

TriangleMesh MakeKnot(double size, double tube, int around, int across) {
  RequireLength("MakeKnot", "size", size);
  RequireLengthBelow("MakeKnot", "tube", tube, 0.5 * size, "size / 2");
  RequireTube("MakeKnot", around, 32, across);
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    const Vector2d t = UnitCircle(i, around);
    const Vector2d t2 = UnitCircle(2 * i % around, around);
    const Vector2d t3 = UnitCircle(3 * i % around, around);
    const Vector3d center(t.y() + 2 * t2.y(), t.x() - 2 * t2.x(), -t3.y());
    const Vector3d velocity(t.x() + 4 * t2.x(), -t.y() + 4 * t2.y(),
                            -3 * t3.x());
    // The frame comes from the direction away from the z axis, which no
    // tangent of this curve has: it closes after a turn, without a twist.
    const Vector3d tangent = velocity.normalized();
    const Vector3d out(center.x(), center.y(), 0);
    const Vector3d normal = (out - out.dot(tangent) * tangent).normalized();
    const Vector3d binormal = normal.cross(tangent);
    for (int j = 0; j < across; ++j) {
      const Vector2d circle = tube * UnitCircle(j, across);
      mesh.vertices.push_back(size * center + circle.x() * normal +
                              circle.y() * binormal);
    }
  }
  mesh.triangles = TubeTriangles(around, across);
  return mesh;
}

Eigen::Matrix3d GenericRotation() {
  return (Eigen::AngleAxisd(0.4, Vector3d::UnitX()) *
          Eigen::AngleAxisd(0.9, Vector3d::UnitY()) *
          Eigen::AngleAxisd(0.7, Vector3d::UnitZ()))
      .toRotationMatrix();
}

}  // namespace phongpd
