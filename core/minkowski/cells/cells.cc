// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/mesh/union_find.h"
#include "core/minkowski/arrangement/face_geometry.h"
#include "core/minkowski/cells/cell_probe.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Grid steps: far above the rounding of a ray's hits.
constexpr double kClearGap = 16.0;
// Rays tried to find the outside.
constexpr std::size_t kOuterRays = 64;

// A side of the unbounded cell: what a ray from far away hits first.  Rays
// against the largest faces are tried until one tells its first two hits
// clearly apart; sheets closer than rounding look alike.
int OuterSide(const FaceGeometry& geometry, const std::vector<int>& largest,
              double reach) {
  double best = -1.0;
  int side = 0;
  for (const int target : largest) {
    const Vector3d n = geometry.Normal(target);
    const Vector3d start = geometry.InteriorPoint(target) + 4.0 * reach * n;
    const std::vector<FaceGeometry::Hit> hits = geometry.AllHits(start, -n, -1);
    if (hits.empty()) continue;
    const double gap =
        hits.size() > 1 ? hits[1].distance - hits[0].distance : reach;
    if (gap <= best) continue;
    best = gap;
    const int face = hits[0].face;
    side = geometry.Normal(face).dot(n) > 0 ? PlusSide(face) : MinusSide(face);
    if (best > kClearGap) break;
  }
  return side;
}

// Parts of the arrangement that share no edge, as the vertex-disjoint sums of
// an obstacle's components do, have an outside each.  Returns the side that
// `side` of a free cell sees across the gap to the next part, kUnbounded when
// there is nothing beyond, or -1 when its cell is bounded by its own part.
constexpr int kUnbounded = -2;
int SideAcrossGap(const FaceGeometry& geometry, UnionFind* sides,
                  UnionFind* parts, int side) {
  const int face = side / 2;  // candidate cells hold + sides only
  const Vector3d n = geometry.Normal(face);
  const auto looking_back = [&](int f) {
    return geometry.Normal(f).dot(n) > 0 ? MinusSide(f) : PlusSide(f);
  };
  const std::vector<FaceGeometry::Hit> hits =
      geometry.AllHits(geometry.InteriorPoint(face), n, face);
  int exit = side;  // the last side of this part, looking along n
  int across = hits.empty() ? kUnbounded : looking_back(hits[0].face);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const int f = hits[i].face;
    if (parts->Find(f) != parts->Find(face)) continue;
    exit = OppositeSide(looking_back(f));
    across = i + 1 < hits.size() ? looking_back(hits[i + 1].face) : kUnbounded;
  }
  return sides->Find(exit) == sides->Find(side) ? across : -1;
}

// One search for the free cells, a stage after the other; each reads what those
// before it left.
class CellSearch {
 public:
  CellSearch(const Convolution& convolution, const Arrangement& arrangement,
             const RadialEdges& radial, const ExactPoints& points)
      : convolution_(convolution),
        faces_(arrangement.faces),
        face_count_(static_cast<int>(faces_.size())),
        geometry_(convolution, arrangement, points),
        sides_(JoinSides(radial, faces_.size())),
        parts_(faces_.size()) {
    for (const RadialEdge& edge : radial.edges) {
      for (int k = edge.begin + 1; k < edge.end; ++k) {
        parts_.Join(radial.spokes[k - 1].face, radial.spokes[k].face);
      }
    }
  }

  // collide(probe) → whether the operands overlap at probe(); from any thread.
  template <typename Collide>
  FreeCells FindCells(const Collide& collide) {
    MarkOccupied();
    MeasureFaces();
    FindOuter();
    CollectCandidates();
    JudgeCandidates(collide);
    JoinAcrossGaps();
    LabelSides();
    return std::move(out_);
  }

 private:
  void MarkOccupied() {
    occupied_.assign(2 * faces_.size(), 0);
    for (int f = 0; f < face_count_; ++f) {
      occupied_[sides_.Find(MinusSide(f))] = 1;
      if (faces_[f].two_sided) occupied_[sides_.Find(PlusSide(f))] = 1;
    }
  }

  void MeasureFaces() {
    area_.resize(faces_.size());
    for (int f = 0; f < face_count_; ++f) area_[f] = geometry_.Area(f);
    for (const GridPoint& p : convolution_.points) {
      reach_ = std::max(reach_, ToDouble(p).lpNorm<Eigen::Infinity>());
    }
  }

  // Those whose rays are tried, by area; equal ones by number.
  std::vector<int> LargestFaces() const {
    std::vector<int> largest(faces_.size());
    std::iota(largest.begin(), largest.end(), 0);
    const std::size_t rays = std::min(kOuterRays, largest.size());
    std::partial_sort(largest.begin(), largest.begin() + rays, largest.end(),
                      [this](int a, int b) {
                        return area_[a] != area_[b] ? area_[a] > area_[b]
                                                    : a < b;
                      });
    largest.resize(rays);
    return largest;
  }

  void FindOuter() {
    outer_ = sides_.Find(OuterSide(geometry_, LargestFaces(), reach_));
    if (occupied_[outer_]) {
      throw LeakError(
          "contact space leaks: the unbounded cell touches the inside of a "
          "facet; an operand is not a closed solid without self-intersections");
    }
  }

  void CollectCandidates() {
    for (int s = 0; s < 2 * face_count_; ++s) {
      const int cell = sides_.Find(s);
      if (cell == s) ++out_.cells;
      if (!occupied_[cell]) candidates_[cell].push_back(s);
    }
  }

  // The unbounded cell is free without a judgement.
  template <typename Collide>
  void JudgeCandidates(const Collide& collide) {
    if (candidates_.size() > 4) geometry_.BuildTree();
    std::vector<std::vector<int>*> judged;
    for (auto& [cell, members] : candidates_) {
      if (cell != outer_) judged.push_back(&members);
    }
    out_.judged = static_cast<int>(judged.size());
    std::vector<char> collides(judged.size());
    tbb::parallel_for(std::size_t{0}, judged.size(), [&](std::size_t i) {
      collides[i] = collide(
          [&] { return ProbePoint(geometry_, area_, judged[i], reach_); });
    });
    is_free_.assign(2 * faces_.size(), 0);
    is_free_[outer_] = 1;
    for (std::size_t i = 0; i < judged.size(); ++i) {
      const int side = judged[i]->front();
      if (collides[i]) continue;
      is_free_[sides_.Find(side)] = 1;
      free_sides_.push_back(side);
    }
  }

  // Only now that all are judged, so that a ray can cause no leak.  Joins come
  // last: gaps are told by the cells as they were.
  void JoinAcrossGaps() {
    std::vector<std::pair<int, int>> gaps;
    for (const int side : free_sides_) {
      const int across = SideAcrossGap(geometry_, &sides_, &parts_, side);
      const int other = across == kUnbounded ? outer_ : across;
      if (other >= 0 && is_free_[sides_.Find(other)]) {
        gaps.push_back({side, other});
      }
    }
    for (const auto& [side, other] : gaps) {
      out_.cells -= sides_.Find(side) != sides_.Find(other);
      sides_.Join(side, other);
    }
  }

  void LabelSides() {
    std::set<int> free_cells = {sides_.Find(outer_)};
    for (const int side : free_sides_) free_cells.insert(sides_.Find(side));
    for (const int cell : free_cells) is_free_[cell] = 1;
    out_.cavities = static_cast<int>(free_cells.size()) - 1;
    out_.side_is_free.resize(2 * faces_.size());
    out_.side_is_outer.resize(2 * faces_.size());
    for (int s = 0; s < 2 * face_count_; ++s) {
      const int cell = sides_.Find(s);
      out_.side_is_free[s] = is_free_[cell];
      out_.side_is_outer[s] = cell == sides_.Find(outer_);
    }
  }

  const Convolution& convolution_;
  const std::vector<ArrangementFace>& faces_;
  const int face_count_;
  FaceGeometry geometry_;
  UnionFind sides_;
  UnionFind parts_;  // faces that share an edge
  FreeCells out_;

  std::vector<char> occupied_, is_free_;        // per cell, by its lowest side
  std::vector<double> area_;                    // per face
  double reach_ = 0.0;                          // largest coordinate of all
  int outer_ = 0;                               // the unbounded cell
  std::map<int, std::vector<int>> candidates_;  // cell → its + sides
  std::vector<int> free_sides_;  // one of each free cell but the unbounded
};

}  // namespace

FreeCells FindFreeCells(const Convolution& convolution,
                        const Arrangement& arrangement,
                        const RadialEdges& radial, const ExactPoints& points,
                        const SolidCollision& judge,
                        const BuildLimits& limits) {
  return CellSearch(convolution, arrangement, radial, points)
      .FindCells([&](const auto& probe) {
        limits.Check("cells");
        return judge.Collide(probe());
      });
}

FreeCells FindCellsOfSurface(const Convolution& convolution,
                             const Arrangement& arrangement,
                             const RadialEdges& radial,
                             const ExactPoints& points) {
  return CellSearch(convolution, arrangement, radial, points)
      .FindCells([](const auto&) { return false; });
}

}  // namespace phongpd::internal
