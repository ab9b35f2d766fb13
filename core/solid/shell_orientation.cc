// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/shell_orientation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "core/solid/self_intersection.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kNoVolume = 1e-14;  // of area · diagonal

struct Shell {
  TriangleMesh mesh;  // its own vertices and triangles
  BoundingBox bounds;
  int sign = 0;                // of its volume
  std::vector<int> enclosers;  // shells around it
};

// Whether `inner` is inside `outer`, for shells that do not cross: the first
// of its corners that is not on `outer` tells.
bool IsInside(const TriangleMesh& inner, const TriangleMesh& outer) {
  for (const Triangle& triangle : inner.triangles) {
    for (const int v : triangle) {
      const double turns = std::abs(Turns(outer, inner.vertices[v]));
      if (turns < 0.01) return false;
      if (turns > 0.99) return true;
    }
  }
  return false;
}

bool Contains(const BoundingBox& outer, const BoundingBox& inner) {
  return (outer.min.array() <= inner.min.array()).all() &&
         (inner.max.array() <= outer.max.array()).all();
}

std::vector<Shell> SplitShells(const TriangleMesh& mesh,
                               const std::vector<int>& labels, int count,
                               const std::string& name) {
  std::vector<Shell> shells(count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    shells[labels[t]].mesh.triangles.push_back(mesh.triangles[t]);
  }
  int flat = 0;
  for (Shell& shell : shells) {
    // Own vertices only: the volume and the solid angles cost what the shell
    // costs.
    std::vector<int> used;
    for (const Triangle& t : shell.mesh.triangles) {
      used.insert(used.end(), t.begin(), t.end());
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const int v : used) shell.mesh.vertices.push_back(mesh.vertices[v]);
    for (Triangle& t : shell.mesh.triangles) {
      for (int& v : t) {
        v = static_cast<int>(std::lower_bound(used.begin(), used.end(), v) -
                             used.begin());
      }
    }
    shell.bounds = ComputeBounds(shell.mesh);
    const double volume = SignedVolume(shell.mesh);
    const double threshold =
        kNoVolume * SurfaceArea(shell.mesh) * shell.bounds.Diagonal();
    flat += std::abs(volume) <= threshold;
    shell.sign = volume > 0 ? 1 : -1;
  }
  if (flat > 0) {
    throw InputError(name +
                     ": zero volume; expected every part to enclose a "
                     "volume, found " +
                     std::to_string(flat) + " of " + std::to_string(count) +
                     " parts that enclose none; remove or thicken them");
  }
  return shells;
}

void FindEnclosers(std::vector<Shell>* shells) {
  const int count = static_cast<int>(shells->size());
  for (int i = 0; i < count; ++i) {
    Shell& inner = (*shells)[i];
    for (int j = 0; j < count; ++j) {
      const Shell& outer = (*shells)[j];
      if (i != j && Contains(outer.bounds, inner.bounds) &&
          !Intersect(inner.mesh, outer.mesh) &&
          IsInside(inner.mesh, outer.mesh)) {
        inner.enclosers.push_back(j);
      }
    }
  }
}

}  // namespace

double Turns(const TriangleMesh& mesh, const Vector3d& p) {
  double half_angles = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d a = mesh.vertices[i] - p;
    const Vector3d b = mesh.vertices[j] - p;
    const Vector3d c = mesh.vertices[k] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc +
                                          b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * kPi);
}

std::vector<int> LabelShells(const TriangleMesh& mesh, int* count) {
  return LabelShells(TriangleNeighbors(mesh), count);
}

std::vector<int> LabelShells(const std::vector<std::array<int, 3>>& neighbors,
                             int* count) {
  std::vector<int> labels(neighbors.size(), -1);
  std::vector<int> open;
  *count = 0;
  for (std::size_t seed = 0; seed < labels.size(); ++seed) {
    if (labels[seed] >= 0) continue;
    labels[seed] = *count;
    open.push_back(static_cast<int>(seed));
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (const int n : neighbors[t]) {
        if (n < 0 || labels[n] >= 0) continue;
        labels[n] = *count;
        open.push_back(n);
      }
    }
    ++*count;
  }
  return labels;
}

int TurnOutward(const std::string& name, TriangleMesh* mesh) {
  int count = 0;
  const std::vector<int> labels = LabelShells(*mesh, &count);
  std::vector<Shell> shells = SplitShells(*mesh, labels, count, name);
  const bool is_outward = std::all_of(
      shells.begin(), shells.end(), [](const Shell& s) { return s.sign > 0; });
  if (is_outward) return 0;  // nesting does not matter
  FindEnclosers(&shells);

  std::vector<int> sign(count);
  for (int i = 0; i < count; ++i) {
    int outermost = i;
    for (const int j : shells[i].enclosers) {
      if (shells[j].enclosers.empty()) outermost = j;
    }
    sign[i] = shells[i].sign * shells[outermost].sign;
  }
  std::vector<int> from_outside(count);
  for (int i = 0; i < count; ++i) from_outside[i] = i;
  std::stable_sort(
      from_outside.begin(), from_outside.end(), [&shells](int i, int j) {
        return shells[i].enclosers.size() < shells[j].enclosers.size();
      });
  for (const int i : from_outside) {
    int winding = 0;
    for (const int j : shells[i].enclosers) winding += sign[j];
    if (winding <= 0) sign[i] = 1;
  }
  int turned = 0;
  for (int i = 0; i < count; ++i) turned += sign[i] != shells[i].sign;
  for (std::size_t t = 0; t < labels.size(); ++t) {
    if (sign[labels[t]] == shells[labels[t]].sign) continue;
    std::swap(mesh->triangles[t][1], mesh->triangles[t][2]);
  }
  return turned;
}

}  // namespace phongpd::internal
