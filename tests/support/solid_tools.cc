// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/solid_tools.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;

using Cells = std::vector<char>;  // n³, x fastest

bool Filled(const Cells& cells, int n, int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0 || x >= n || y >= n || z >= n) return false;
  return cells[x + n * (y + n * z)] != 0;
}

// Do two cells meet in an edge whose other two cells are empty?
bool HasEdgeContact(const Cells& cells, int n) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < n; ++i) {
      for (int j = -1; j < n; ++j) {
        for (int k = -1; k < n; ++k) {
          const auto at = [&](int dj, int dk) {
            int c[3];
            c[axis] = i;
            c[(axis + 1) % 3] = j + dj;
            c[(axis + 2) % 3] = k + dk;
            return Filled(cells, n, c[0], c[1], c[2]);
          };
          const bool a = at(0, 0), b = at(1, 0), c = at(0, 1), d = at(1, 1);
          if (a == d && b == c && a != b) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

double WindingNumber(const TriangleMesh& mesh, const Vector3d& q) {
  using Wide = Eigen::Matrix<long double, 3, 1>;
  long double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    Wide r[3];
    for (int k = 0; k < 3; ++k) {
      r[k] = (mesh.vertices[t[k]] - q).cast<long double>();
    }
    const long double l[3] = {r[0].norm(), r[1].norm(), r[2].norm()};
    const long double volume = r[0].dot(r[1].cross(r[2]));
    const long double denominator = l[0] * l[1] * l[2] + r[0].dot(r[1]) * l[2] +
                                    r[1].dot(r[2]) * l[0] +
                                    r[2].dot(r[0]) * l[1];
    sum += 2 * std::atan2(volume, denominator);
  }
  return static_cast<double>(sum / (4 * M_PIl));
}

TriangleMesh RandomVoxelSolid(int n, double fill, std::mt19937_64* random) {
  std::bernoulli_distribution is_filled(fill);
  Cells cells(n * n * n);
  do {
    for (char& cell : cells) cell = is_filled(*random);
    cells[0] = 1;
  } while (HasEdgeContact(cells, n));

  std::uniform_int_distribution<int> place(-5, 5);
  const Vector3d corner(place(*random), place(*random), place(*random));
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> ids;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [it, is_new] =
        ids.emplace(p, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(corner + Vector3d(p[0], p[1], p[2]));
    return it->second;
  };
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) {
        if (!Filled(cells, n, x, y, z)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int side : {0, 1}) {
            std::array<int, 3> next = {x, y, z};
            next[axis] += side ? 1 : -1;
            if (Filled(cells, n, next[0], next[1], next[2])) continue;
            // The face's corners, counter-clockwise seen along +axis.
            int quad[4];
            const int steps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            for (int k = 0; k < 4; ++k) {
              std::array<int, 3> p = {x, y, z};
              p[axis] += side;
              p[(axis + 1) % 3] += steps[k][0];
              p[(axis + 2) % 3] += steps[k][1];
              quad[k] = vertex(p);
            }
            if (side == 0) std::swap(quad[1], quad[3]);
            mesh.triangles.push_back({quad[0], quad[1], quad[2]});
            mesh.triangles.push_back({quad[0], quad[2], quad[3]});
          }
        }
      }
    }
  }
  return mesh;
}

Vector3d RandomPoint(const BoundingBox& box, std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-0.1, 1.1);
  Vector3d p;
  for (int k = 0; k < 3; ++k) {
    p[k] = box.min[k] + unit(*random) * (box.max[k] - box.min[k]);
  }
  return p;
}

Eigen::Matrix3d RandomRotation(std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(*random), normal(*random), normal(*random),
                       normal(*random));
  return q.normalized().toRotationMatrix();
}

SurfacePoint RandomSurfacePoint(const TriangleMesh& mesh,
                                std::mt19937_64* random) {
  std::uniform_int_distribution<std::size_t> pick(0, mesh.triangles.size() - 1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  while (true) {
    const Triangle& t = mesh.triangles[pick(*random)];
    double u = unit(*random), v = unit(*random);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d e = mesh.vertices[t[1]] - a, f = mesh.vertices[t[2]] - a;
    const Vector3d n = e.cross(f);
    if (n.norm() <= 1e-12 * e.norm() * f.norm()) continue;  // no direction
    return {a + u * e + v * f, n.normalized()};
  }
}

}  // namespace phongpd::testing
