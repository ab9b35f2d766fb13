// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/random_solids.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

bool Filled(const Voxels& voxels, int x, int y, int z) {
  const int n = voxels.n;
  if (x < 0 || y < 0 || z < 0 || x >= n || y >= n || z >= n) return false;
  return voxels.filled[x + n * (y + n * z)] != 0;
}

// Do two cells meet in an edge whose other two cells are empty?
bool HasEdgeContact(const Voxels& voxels) {
  const int n = voxels.n;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < n; ++i) {
      for (int j = -1; j < n; ++j) {
        for (int k = -1; k < n; ++k) {
          const auto at = [&](int dj, int dk) {
            int c[3];
            c[axis] = i;
            c[(axis + 1) % 3] = j + dj;
            c[(axis + 2) % 3] = k + dk;
            return Filled(voxels, c[0], c[1], c[2]);
          };
          const bool a = at(0, 0), b = at(1, 0), c = at(0, 1), d = at(1, 1);
          if (a == d && b == c && a != b) return true;
        }
      }
    }
  }
  return false;
}

// Calls visit(x, y, z) for every filled cell.
template <typename Visitor>
void ForEachCell(const Voxels& voxels, const Visitor& visit) {
  for (int x = 0; x < voxels.n; ++x) {
    for (int y = 0; y < voxels.n; ++y) {
      for (int z = 0; z < voxels.n; ++z) {
        if (Filled(voxels, x, y, z)) visit(x, y, z);
      }
    }
  }
}

}  // namespace

Voxels RandomVoxels(int n, double fill, EdgeContact contact,
                    std::mt19937_64* random) {
  std::bernoulli_distribution is_filled(fill);
  Voxels voxels;
  voxels.n = n;
  voxels.filled.resize(n * n * n);
  do {
    for (char& cell : voxels.filled) cell = is_filled(*random);
    voxels.filled[0] = 1;
  } while (contact == EdgeContact::kAvoided && HasEdgeContact(voxels));
  std::uniform_int_distribution<int> place(-5, 5);
  for (int k = 0; k < 3; ++k) voxels.corner[k] = place(*random);
  return voxels;
}

TriangleMesh VoxelSurface(const Voxels& voxels) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> ids;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [it, is_new] =
        ids.emplace(p, static_cast<int>(mesh.vertices.size()));
    if (is_new)
      mesh.vertices.push_back(voxels.corner + Vector3d(p[0], p[1], p[2]));
    return it->second;
  };
  ForEachCell(voxels, [&](int x, int y, int z) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> next = {x, y, z};
        next[axis] += side ? 1 : -1;
        if (Filled(voxels, next[0], next[1], next[2])) continue;
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
  });
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
  const Vector3d v = RandomVector(&normal, random);
  const Eigen::Quaterniond q(normal(*random), v.x(), v.y(), v.z());
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

}  // namespace phongpd
