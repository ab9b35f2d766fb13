// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/crossing_mender.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/mesh/union_find.h"
#include "core/minkowski/operands/part_volumes.h"
#include "core/solid/shell_orientation.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Crossings mended one by one; more of them show an operand that is too fine
// altogether.
constexpr std::size_t kMostCrossings = 64;
constexpr int kMendingRounds = 8;

// Which facets may not cross: those of one vertex-connected component, and a
// cavity's with those of a shell around it that it did not cross before.
class Parts {
 public:
  explicit Parts(const TriangleMesh& mesh) {
    const std::vector<int> labels = LabelComponents(mesh, &count_);
    of_vertex_ = ComponentsOfVertices(mesh, labels);
    const auto volumes = Volumes(mesh.vertices, mesh.triangles, labels, count_);
    for (const WideReal& volume : volumes) is_cavity_.push_back(volume < 0);
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
      : parts_(parts), solid_(solid), mesh_(ToMesh(*solid)) {}

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
           internal::MeetProperly(mesh_, s, t);
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

}  // namespace

std::vector<TrianglePair> MendCrossings(const TriangleMesh& original,
                                        GridSolid* solid) {
  const Parts parts(original);
  return CrossingMender(parts, solid).Mend();
}

}  // namespace phongpd::internal
