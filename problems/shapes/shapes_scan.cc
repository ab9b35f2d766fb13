// SPDX-License-Identifier: GPL-3.0-or-later
// A solid as a scanner sees it.
#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>

#include "problems/shapes/shape_parameters.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The middles of the edges longer than `edge`, by their ends.
class Middles {
 public:
  Middles(TriangleMesh* mesh, double edge) : mesh_(mesh), edge_(edge) {}

  // −1: not split.
  int Of(int a, int b) {
    const auto key = std::minmax(a, b);
    const auto known = index_.find(key);
    if (known != index_.end()) return known->second;
    const Vector3d p = mesh_->vertices[key.first];
    const Vector3d q = mesh_->vertices[key.second];
    if ((q - p).norm() <= edge_) return -1;
    mesh_->vertices.push_back(0.5 * (p + q));
    return index_[key] = static_cast<int>(mesh_->vertices.size()) - 1;
  }

 private:
  TriangleMesh* mesh_;
  double edge_;
  std::map<std::pair<int, int>, int> index_;
};

// True if there was anything to split.
bool SplitOnce(TriangleMesh* mesh, double edge) {
  Middles middles(mesh, edge);
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh->triangles) {
    std::array<int, 3> middle;
    int split = 0, first = 0;  // the first split edge after one that is not
    for (int k = 0; k < 3; ++k) {
      middle[k] = middles.Of(t[k], t[(k + 1) % 3]);
      split += middle[k] >= 0;
    }
    while (split > 0 && split < 3 &&
           !(middle[first] >= 0 && middle[(first + 2) % 3] < 0)) {
      ++first;
    }
    const int a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    const int ab = middle[first], bc = middle[(first + 1) % 3],
              ca = middle[(first + 2) % 3];
    if (split == 0) {
      triangles.push_back(t);
    } else if (split == 1) {
      triangles.push_back({a, ab, c});
      triangles.push_back({ab, b, c});
    } else if (split == 2) {
      triangles.push_back({ab, b, bc});
      triangles.push_back({a, ab, bc});
      triangles.push_back({a, bc, c});
    } else {
      triangles.push_back({a, ab, ca});
      triangles.push_back({ab, b, bc});
      triangles.push_back({ca, bc, c});
      triangles.push_back({ab, bc, ca});
    }
  }
  const bool has_split = triangles.size() > mesh->triangles.size();
  mesh->triangles = std::move(triangles);
  return has_split;
}

}  // namespace

TriangleMesh MakeScan(TriangleMesh solid, double edge, double noise,
                      std::uint64_t seed) {
  internal::RequireLength("scan", "edge", edge);
  if (noise != 0.0) {
    internal::RequireLengthBelow("scan", "noise", noise, 0.1 * edge,
                                 "a tenth of edge");
  }
  const BoundingBox box = ComputeBounds(solid);
  internal::RequireCount("scan", "diagonal per edge",
                         static_cast<int>(std::min(1e9, box.Diagonal() / edge)),
                         0, 1000);
  while (SplitOnce(&solid, edge)) {
  }
  std::mt19937_64 random(seed);
  for (Vector3d& v : solid.vertices) {
    for (double& x : v)
      x += noise * (2.0 * internal::UnitRandom(&random) - 1.0);
  }
  return solid;
}

}  // namespace phongpd
