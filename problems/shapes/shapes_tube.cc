// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "problems/shapes/shape_parameters.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using internal::RequireCount;
using internal::RequireLength;

// Of what is not parallel: sin of the angle.
constexpr double kParallel = 1e-6;

[[noreturn]] void Refuse(std::size_t part, const std::string& expected) {
  throw InputError("MakeTube: part " + std::to_string(part) + ": expected " +
                   expected);
}

// The parts' directions, of unit length.  How far a mitre reaches back along
// both of its parts is the radius times the tangent of half the bend.
std::vector<Vector3d> Directions(const std::vector<Vector3d>& path,
                                 double radius) {
  std::vector<Vector3d> directions;
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!IsFinite(path[i]) || !IsFinite(path[i + 1])) {
      Refuse(i, "finite ends, found NaN or infinity");
    }
    const Vector3d part = path[i + 1] - path[i];
    RequireLength("MakeTube", "length of a part", part.norm());
    lengths.push_back(part.norm());
    directions.push_back(part / part.norm());
  }
  double before = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    double after = 0.0;
    if (i + 1 < lengths.size()) {
      const double cosine = directions[i].dot(directions[i + 1]);
      if (!(cosine > 0.0)) {
        Refuse(i, "a bend below 90 degrees at its end, found more");
      }
      // tan(α/2) = sin α / (1 + cos α).
      after = radius * directions[i].cross(directions[i + 1]).norm() /
              (1.0 + cosine);
    }
    if (!(lengths[i] > before + after)) {
      Refuse(i, "a length above that of the mitres at its ends, " +
                    Rounded(before + after) + ", found " + Rounded(lengths[i]));
    }
    before = after;
  }
  return directions;
}

}  // namespace

TriangleMesh MakeTube(const std::vector<Vector3d>& path, double radius,
                      int sides, const Vector3d& up) {
  RequireLength("MakeTube", "radius", radius);
  RequireCount("MakeTube", "sides", sides, 3);
  RequireCount("MakeTube", "points", static_cast<int>(path.size()), 2);
  const int parts = static_cast<int>(path.size()) - 1;
  internal::RequireTriangles("MakeTube", "2·sides·points triangles", sides,
                             parts + 1);
  const std::vector<Vector3d> along = Directions(path, radius);
  const Vector3d across = up - up.dot(along[0]) * along[0];
  if (!IsFinite(up) || !(across.norm() > kParallel * up.norm())) {
    throw InputError(
        "MakeTube: expected up to be finite and not along the first part");
  }
  const Vector3d x = across.normalized(), y = along[0].cross(x);
  TriangleMesh mesh;
  for (int j = 0; j < sides; ++j) {
    const Vector2d c = radius * internal::UnitCircle(j, sides);
    mesh.vertices.push_back(path[0] + c.x() * x + c.y() * y);
  }
  for (int i = 0; i < parts; ++i) {
    // Along the part to the plane of the mitre.
    const Vector3d& d = along[i];
    const Vector3d normal = d + along[std::min(i + 1, parts - 1)];
    for (int j = 0; j < sides; ++j) {
      const Vector3d corner = mesh.vertices[i * sides + j];
      const double way = (path[i + 1] - corner).dot(normal) / d.dot(normal);
      mesh.vertices.emplace_back(corner + way * d);
    }
    for (int j = 0; j < sides; ++j) {
      const int a = i * sides + j, b = i * sides + (j + 1) % sides;
      mesh.triangles.push_back({a, b, b + sides});
      mesh.triangles.push_back({a, b + sides, a + sides});
    }
  }
  const int end = parts * sides;
  for (int j = 1; j + 1 < sides; ++j) {
    mesh.triangles.push_back({0, j + 1, j});
    mesh.triangles.push_back({end, end + j, end + j + 1});
  }
  return mesh;
}

}  // namespace phongpd
