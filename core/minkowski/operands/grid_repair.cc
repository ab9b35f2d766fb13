// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/grid_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/operands/crossing_mender.h"
#include "core/minkowski/operands/part_volumes.h"
#include "core/solid/shell_orientation.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

[[noreturn]] void Refuse(const RoundedOperand& operand, const std::string& what,
                         int vertex) {
  const Vector3d& p = operand.from.mesh.vertices[vertex];
  std::ostringstream text;
  text.precision(3);
  text << operand.name << ": too fine for the grid of " << operand.from.step
       << " (2^-38 of the larger operand); expected a solid after rounding, "
       << "found " << what;
  text.precision(9);
  text << " at (" << p.x() << ", " << p.y() << ", " << p.z() << "); remove "
       << "details below the grid or make the operands more alike in size";
  throw InputError(text.str());
}

// Removes pairs of facets on the same three vertices, turned against each
// other, and appends one of each to *lost.
void CancelOppositeFacets(std::vector<Triangle>* facets,
                          std::vector<Triangle>* lost) {
  std::map<Triangle, std::vector<std::size_t>> waiting;  // of one direction
  std::vector<char> is_cancelled(facets->size(), 0);
  for (std::size_t f = 0; f < facets->size(); ++f) {
    Triangle key = (*facets)[f];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()),
                key.end());
    const auto partner = waiting.find({key[0], key[2], key[1]});
    if (partner == waiting.end() || partner->second.empty()) {
      waiting[key].push_back(f);
      continue;
    }
    is_cancelled[f] = is_cancelled[partner->second.back()] = 1;
    partner->second.pop_back();
    lost->push_back(key);
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < facets->size(); ++f) {
    if (!is_cancelled[f]) (*facets)[kept++] = (*facets)[f];
  }
  facets->resize(kept);
}

// Which groups of facets rounding has turned inside out or flattened.
std::vector<char> FindTurned(const RoundedOperand& operand,
                             const GridSolid& solid,
                             const std::vector<int>& groups, int count) {
  const TriangleMesh& mesh = operand.from.mesh;
  const auto before = Volumes(mesh.vertices, mesh.triangles, groups, count);
  const auto after = Volumes(solid.vertices, mesh.triangles, groups, count);
  std::vector<char> is_turned(count);
  for (int g = 0; g < count; ++g) {
    is_turned[g] =
        Sign(before[g]) != (operand.reflect ? -1 : 1) * Sign(after[g]);
  }
  return is_turned;
}

// Removes components that were turned or flattened, which are thinner than
// the grid, and appends their facets to *lost.
void RemoveTurnedParts(const RoundedOperand& operand,
                       std::vector<Triangle>* lost, GridSolid* solid) {
  const TriangleMesh& mesh = operand.from.mesh;
  int count = 0;
  const std::vector<int> shells = LabelShells(mesh, &count);
  const std::vector<char> is_turned =
      FindTurned(operand, *solid, shells, count);
  if (std::count(is_turned.begin(), is_turned.end(), 1) == 0) return;

  const std::vector<int> parts = LabelComponents(mesh, &count);
  const std::vector<char> is_removed =
      FindTurned(operand, *solid, parts, count);
  for (std::size_t f = 0; f < shells.size(); ++f) {
    if (is_turned[shells[f]] && !is_removed[parts[f]]) {
      Refuse(operand, "a part that is thinner", mesh.triangles[f][0]);
    }
  }
  const std::vector<int> part_of = ComponentsOfVertices(mesh, parts);
  std::vector<Triangle> kept;
  for (const Triangle& t : solid->facets) {
    (is_removed[part_of[t[0]]] ? *lost : kept).push_back(t);
  }
  solid->facets = std::move(kept);
}

// Is what was removed within `reach` (grid steps) of the solid that is left?
class LossCheck {
 public:
  LossCheck(const GridSolid& solid, double reach)
      : reach_(reach), mesh_(ToMesh(solid)), surface_(mesh_) {
    for (const Triangle& t : mesh_.triangles) {
      for (int k = 0; k < 3; ++k) {
        edges_.insert(std::minmax({t[k], t[(k + 1) % 3]}));
      }
    }
  }

  // A facet without area is its three edges.  The inside of one that was
  // cancelled crosses no other: it is inside the solid, or not, as its middle.
  bool IsKept(const Triangle& t) const {
    const Vector3d &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]],
                   &c = mesh_.vertices[t[2]];
    const Vector3d middle = (a + b + c) / 3.0;
    for (int k = 0; k < 3; ++k) {
      if (!IsKept(t[k], t[(k + 1) % 3])) return false;
    }
    return (b - a).cross(c - a).isZero(0.0) || IsKept(middle, middle);
  }

 private:
  bool IsKept(int i, int j) const {
    return edges_.count(std::minmax({i, j})) > 0 ||
           IsKept(mesh_.vertices[i], mesh_.vertices[j]);
  }

  // The distance to one triangle is convex along the segment, and no surface
  // between its ends leaves both inside or both outside.
  bool IsKept(const Vector3d& a, const Vector3d& b) const {
    const Vector3d middle = 0.5 * (a + b);
    const TriangleBvh::Closest closest = surface_.FindClosest(middle);
    const double radius = 0.5 * (b - a).norm();
    if (closest.distance + radius <= reach_) return true;
    if (closest.distance > radius) return Turns(mesh_, middle) > 0.5;
    const Triangle& t = mesh_.triangles[closest.triangle];
    const auto is_near = [&](const Vector3d& p) {
      return ClosestOnTriangle(mesh_.vertices[t[0]], mesh_.vertices[t[1]],
                               mesh_.vertices[t[2]], p)
                 .squared_distance <= reach_ * reach_;
    };
    if (is_near(a) && is_near(b)) return true;
    return radius > 0.0 && IsKept(a, middle) && IsKept(middle, b);
  }

  double reach_;
  TriangleMesh mesh_;
  TriangleBvh surface_;
  std::set<std::pair<int, int>> edges_;
};

}  // namespace

void MendRounding(const RoundedOperand& operand, std::vector<Triangle> lost,
                  GridSolid* solid) {
  RemoveTurnedParts(operand, &lost, solid);
  if (solid->facets.size() < operand.from.mesh.triangles.size()) {
    CancelOppositeFacets(&solid->facets, &lost);
  }
  if (solid->facets.empty()) return;
  const std::vector<TrianglePair> crossings =
      MendCrossings(operand.from.mesh, solid);
  if (!crossings.empty()) {
    Refuse(operand,
           std::to_string(crossings.size()) +
               " pairs of triangles that cross, one",
           solid->facets[crossings[0].first][0]);
  }
  if (lost.empty()) return;
  const LossCheck check(
      *solid, 4.0 * std::max(1.0, operand.from.rounding / operand.from.step));
  for (const Triangle& t : lost) {
    if (!check.IsKept(t)) Refuse(operand, "a part that is thinner", t[0]);
  }
}

}  // namespace phongpd::internal
