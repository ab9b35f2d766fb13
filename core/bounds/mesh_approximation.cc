// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/mesh_approximation.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/bounds/alpha_wrap.h"
#include "core/bounds/convex_hull.h"
#include "core/bounds/edge_collapse.h"
#include "core/bounds/solid_distance.h"
#include "core/bvh/triangle_bvh.h"
#include "core/solid/solid.h"

namespace phongpd {
namespace {

constexpr double kOffset = 0.1;  // of alpha

// Decimation moves little: search for a sharp bound whatever its size.
DistanceSearch SharpSearch() {
  DistanceSearch search;
  search.relative = 0.25;
  search.absolute = 1e-9;
  return search;
}

bool IsSolid(TriangleMesh* mesh) {
  try {
    *mesh = MakeSolid(*mesh, "approximation");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TriangleMesh Wrap(const TriangleMesh& mesh, double alpha) {
  // Both false for NaN.
  if (!(std::isgreaterequal(alpha, kMinWrapAlpha) &&
        std::islessequal(alpha, kMaxWrapAlpha))) {
    std::ostringstream what;
    what << "wrap alpha: expected a fraction of the diagonal between "
         << kMinWrapAlpha << " and " << kMaxWrapAlpha << ", found " << alpha;
    throw InputError(what.str());
  }
  const double length = alpha * ComputeBounds(mesh).Diagonal();
  TriangleMesh wrap = MakeSolid(
      internal::WrapTriangles(mesh, length, kOffset * length), "alpha wrap");
  // What makes it conservative is checked, not believed.
  const TriangleBvh inside(wrap);
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      if (inside.Locate(mesh.vertices[v]) != Location::kInside) {
        throw std::logic_error("alpha wrap: does not enclose its input");
      }
    }
  }
  return wrap;
}

// The shortest prefix of the sequence with at most `target` triangles, or all
// of it.
TriangleMesh Shortened(const internal::CollapseSequence& sequence,
                       std::size_t target) {
  std::size_t low = 0, high = sequence.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (sequence.After(middle).triangles.size() > target) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return sequence.After(low);
}

}  // namespace

ApproximateMesh ConvexHull(const TriangleMesh& solid) {
  ApproximateMesh out;
  out.mesh = MakeSolid(internal::HullOfVertices(solid), "convex hull");
  const DistanceBounds bounds = HullDeviation(out.mesh, solid);
  out.bound = bounds.upper;
  out.lower_bound = bounds.lower;
  return out;
}

ApproximateMesh Decimate(const TriangleMesh& solid, std::size_t target_faces) {
  if (target_faces < 4) {
    throw InputError("target faces: expected at least 4, found " +
                     std::to_string(target_faces));
  }
  ApproximateMesh out;
  out.mesh = solid;
  if (solid.triangles.size() <= target_faces) return out;
  const internal::CollapseSequence sequence(solid, target_faces);
  // Fewer and fewer collapses until the mesh is a solid.
  TriangleMesh best;
  const std::size_t faces = solid.triangles.size();
  constexpr std::size_t kTries = 8;
  bool found = false;
  for (std::size_t i = 0; i < kTries && !found && sequence.size() > 0; ++i) {
    const std::size_t target =
        target_faces + (faces - target_faces) * i * i / (kTries * kTries);
    best = Shortened(sequence, target);
    found = IsSolid(&best);
  }
  if (!found) {
    out.note = "not decimated: every collapse made the surface cross itself";
    return out;
  }
  const DistanceSearch search = SharpSearch();
  const DistanceBounds removed = SolidDeviation(solid, best, search);
  const DistanceBounds added = SolidDeviation(best, solid, search);
  out.mesh = std::move(best);
  out.bound = std::max(removed.upper, added.upper);
  out.lower_bound = std::max(removed.lower, added.lower);
  out.is_conservative = false;
  if (out.mesh.triangles.size() > target_faces) {
    out.note = "decimated to " + std::to_string(out.mesh.triangles.size()) +
               " instead of " + std::to_string(target_faces) +
               " triangles: fewer would change its topology or cross";
  }
  return out;
}

ApproximateMesh WrapSolid(const TriangleMesh& solid, double alpha) {
  ApproximateMesh out;
  out.mesh = Wrap(solid, alpha);
  const DistanceBounds bounds = SolidDeviation(out.mesh, solid);
  out.bound = bounds.upper;
  out.lower_bound = bounds.lower;
  return out;
}

ApproximateMesh WrapTriangles(const TriangleMesh& mesh, double alpha) {
  ApproximateMesh out;
  out.mesh = Wrap(mesh, alpha);
  const DistanceBounds bounds = SurfaceDeviation(out.mesh, mesh);
  out.bound = bounds.upper;
  out.lower_bound = bounds.lower;
  out.note =
      "the bound is of the surface: what the input was meant to enclose is "
      "not known";
  return out;
}

}  // namespace phongpd
