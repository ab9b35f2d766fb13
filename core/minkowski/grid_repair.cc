// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/grid_repair.h"

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
#include "core/mesh/union_find.h"
#include "core/solid/self_intersection.h"
#include "core/solid/shell_orientation.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Crossings mended one by one; more of them show an operand that is too fine
// altogether.
constexpr std::size_t kMostCrossings = 64;
constexpr int kMendingRounds = 8;

using Wide = long double;

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

TriangleMesh MeshOf(const GridSolid& solid) {
  TriangleMesh mesh;
  mesh.vertices.reserve(solid.vertices.size());
  for (const GridPoint& p : solid.vertices) {
    mesh.vertices.push_back(ToDouble(p));
  }
  mesh.triangles = solid.facets;
  return mesh;
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

// 6 V of every group of facets, relative to a vertex of it: a small group's
// differences are small, so that rounding does not reach its sign.
template <typename Points>
std::vector<Wide> Volumes(const Points& vertices,
                          const std::vector<Triangle>& facets,
                          const std::vector<int>& groups, int count) {
  std::vector<Wide> volumes(count, 0);
  std::vector<int> origin(count, -1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    int& o = origin[groups[f]];
    if (o < 0) o = facets[f][0];
    Wide e[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        e[i][k] = Wide(vertices[facets[f][i]][k]) - Wide(vertices[o][k]);
      }
    }
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      volumes[groups[f]] += e[0][k] * (e[1][l] * e[2][m] - e[1][m] * e[2][l]);
    }
  }
  return volumes;
}

// Of every vertex that a triangle uses, the label of its component.
std::vector<int> ComponentsOfVertices(const TriangleMesh& mesh,
                                      const std::vector<int>& labels) {
  std::vector<int> components(mesh.vertices.size(), -1);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    for (const int v : mesh.triangles[f]) components[v] = labels[f];
  }
  return components;
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

// Which facets may not cross: those of one vertex-connected component, and a
// cavity's with those of a shell around it that it did not cross before.
class Parts {
 public:
  explicit Parts(const TriangleMesh& mesh) {
    const std::vector<int> labels = LabelComponents(mesh, &count_);
    of_vertex_ = ComponentsOfVertices(mesh, labels);
    const auto volumes = Volumes(mesh.vertices, mesh.triangles, labels, count_);
    for (const Wide& volume : volumes) is_cavity_.push_back(volume < 0);
    FindSurroundings(mesh, labels);
  }

  // Facets with equal labels are to be looked at.
  std::vector<int> Labels(const std::vector<Triangle>& facets) const {
    std::vector<int> labels;
    for (const Triangle& t : facets) labels.push_back(group_[of_vertex_[t[0]]]);
    return labels;
  }
  bool MayCross(const Triangle& s, const Triangle& t) const {
    const int a = of_vertex_[s[0]], b = of_vertex_[t[0]];
    if (a == b) return false;
    return group_[a] != group_[b] || (!is_cavity_[a] && !is_cavity_[b]);
  }

 private:
  void FindSurroundings(const TriangleMesh& mesh,
                        const std::vector<int>& labels) {
    UnionFind groups(count_);
    const auto part = [&](int c) {
      TriangleMesh one;
      one.vertices = mesh.vertices;
      for (std::size_t f = 0; f < labels.size(); ++f) {
        if (labels[f] == c) one.triangles.push_back(mesh.triangles[f]);
      }
      return one;
    };
    for (int c = 0; c < count_; ++c) {
      if (!is_cavity_[c]) continue;
      const TriangleMesh cavity = part(c);
      const BoundingBox inner = ComputeBounds(cavity);
      for (int s = 0; s < count_; ++s) {
        if (is_cavity_[s]) continue;
        const TriangleMesh shell = part(s);
        const BoundingBox outer = ComputeBounds(shell);
        if ((outer.min.array() <= inner.min.array()).all() &&
            (inner.max.array() <= outer.max.array()).all() &&
            !Intersect(cavity, shell)) {
          groups.Join(c, s);
        }
      }
    }
    for (int c = 0; c < count_; ++c) group_.push_back(groups.Find(c));
  }

  int count_ = 0;
  std::vector<int> of_vertex_;
  std::vector<char> is_cavity_;
  std::vector<int> group_;
};

// Moves vertices by a step where facets cross.
class CrossingMender {
 public:
  CrossingMender(const Parts& parts, GridSolid* solid)
      : parts_(parts), solid_(solid), mesh_(MeshOf(*solid)) {}

  // The crossings that are left; only the first few of many.
  std::vector<TrianglePair> Mend() {
    std::vector<TrianglePair> crossings = FindCrossings();
    for (int round = 0; round < kMendingRounds; ++round) {
      if (crossings.empty() || crossings.size() > kMostCrossings) break;
      bool is_better = false;
      for (const auto& [s, t] : crossings) {
        if (!Cross(s, t)) continue;  // mended with another one
        for (const std::size_t f : {s, t}) {
          for (const int v : mesh_.triangles[f]) is_better |= MoveVertex(v);
        }
      }
      if (!is_better) break;
      crossings = FindCrossings();
    }
    return crossings;
  }

 private:
  std::vector<TrianglePair> FindCrossings() const {
    std::vector<TrianglePair> pairs;
    CountSelfIntersections(mesh_, parts_.Labels(mesh_.triangles),
                           64 * kMostCrossings, &pairs);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [this](const TrianglePair& p) {
                                 return parts_.MayCross(
                                     mesh_.triangles[p.first],
                                     mesh_.triangles[p.second]);
                               }),
                pairs.end());
    return pairs;
  }

  bool IsFlat(std::size_t f) const {
    const Triangle& t = mesh_.triangles[f];
    return IsZero(
        internal::Cross(solid_->vertices[t[1]] - solid_->vertices[t[0]],
                        solid_->vertices[t[2]] - solid_->vertices[t[0]]));
  }

  bool Cross(std::size_t s, std::size_t t) const {
    return !parts_.MayCross(mesh_.triangles[s], mesh_.triangles[t]) &&
           MeetProperly(mesh_, s, t);
  }

  BoundingBox Box(std::size_t f) const {
    const Triangle& t = mesh_.triangles[f];
    const Vector3d &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]],
                   &c = mesh_.vertices[t[2]];
    return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
  }

  // Facets at `star` against all that are `near`, which holds the star.
  int CountCrossings(const std::vector<std::size_t>& star,
                     const std::vector<std::size_t>& near) const {
    int count = 0;
    for (const std::size_t s : star) {
      const BoundingBox box = Box(s);
      for (const std::size_t t : near) {
        const bool is_in_star = std::binary_search(star.begin(), star.end(), t);
        if (is_in_star && t <= s) continue;
        const BoundingBox other = Box(t);
        if ((other.min.array() <= box.max.array()).all() &&
            (box.min.array() <= other.max.array()).all()) {
          count += Cross(s, t);
        }
      }
    }
    return count;
  }

  // To the neighbouring grid point with the fewest crossings, the nearest of
  // these; stays where that is not fewer.
  bool MoveVertex(int v) {
    std::vector<std::size_t> star, near;
    BoundingBox reach = {mesh_.vertices[v], mesh_.vertices[v]};
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const Triangle& t = mesh_.triangles[f];
      if (t[0] != v && t[1] != v && t[2] != v) continue;
      star.push_back(f);
      reach.min = reach.min.cwiseMin(Box(f).min);
      reach.max = reach.max.cwiseMax(Box(f).max);
    }
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const BoundingBox box = Box(f);
      if ((box.min.array() <= reach.max.array() + 1.0).all() &&
          (reach.min.array() - 1.0 <= box.max.array()).all()) {
        near.push_back(f);
      }
    }
    const GridPoint home = solid_->vertices[v];
    const int before = CountCrossings(star, near);
    int fewest = before;
    GridPoint best = home;
    for (const GridPoint& offset : Offsets()) {
      if (fewest == 0) break;
      const GridPoint p = home + offset;
      if (ToDouble(p).lpNorm<Eigen::Infinity>() > 0x1p38) continue;
      Place(v, p);
      const bool is_proper =
          std::none_of(star.begin(), star.end(),
                       [this](std::size_t f) { return IsFlat(f); });
      if (!is_proper) continue;
      const int count = CountCrossings(star, near);
      if (count < fewest) {
        fewest = count;
        best = p;
      }
    }
    Place(v, best);
    return fewest < before;
  }

  void Place(int v, const GridPoint& p) {
    solid_->vertices[v] = p;
    mesh_.vertices[v] = ToDouble(p);
  }

  // The 26 neighbours of the origin, the nearest first.
  static std::vector<GridPoint> Offsets() {
    std::vector<GridPoint> offsets;
    for (int i = 0; i < 27; ++i) {
      if (i != 13) offsets.push_back({i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1});
    }
    std::stable_sort(offsets.begin(), offsets.end(),
                     [](const GridPoint& a, const GridPoint& b) {
                       return ToDouble(a).squaredNorm() <
                              ToDouble(b).squaredNorm();
                     });
    return offsets;
  }

  const Parts& parts_;
  GridSolid* solid_;
  TriangleMesh mesh_;  // the same in doubles, which hold grid points exactly
};

// Is what was removed within `reach` (grid steps) of the solid that is left?
class LossCheck {
 public:
  LossCheck(const GridSolid& solid, double reach)
      : reach_(reach), mesh_(MeshOf(solid)), surface_(mesh_) {
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
  const Parts parts(operand.from.mesh);
  const std::vector<TrianglePair> crossings =
      CrossingMender(parts, solid).Mend();
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
