// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/canonical_mesh.h"

#include <cmath>
#include <utility>

#include "core/mesh/numbers.h"
#include "core/mesh/sorted_mesh.h"

namespace phongpd {
namespace {

using internal::At;

}  // namespace

CanonicalMesh MakeCanonical(const TriangleMesh& mesh) {
  const BoundingBox box = ComputeBounds(mesh);
  const double diagonal = box.Diagonal();
  int exponent = 0;
  std::frexp(diagonal, &exponent);
  CanonicalMesh result;
  result.center = box.Center();
  result.scale = std::ldexp(1.0, 1 - exponent);
  result.diagonal = diagonal * result.scale;
  TriangleMesh scaled = mesh;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      scaled.vertices[At(v)] =
          (mesh.vertices[At(v)] - result.center) * result.scale;
    }
  }
  SortedMesh sorted = SortByCoordinates(scaled);
  result.mesh = std::move(sorted.mesh);
  result.source = std::move(sorted.source);
  return result;
}

}  // namespace phongpd
