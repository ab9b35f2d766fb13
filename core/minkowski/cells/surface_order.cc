// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/surface_order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace phongpd::internal {
namespace {

using Loop = std::vector<int>;

// The distinct points among `ids`, in order.
struct RankedPoints {
  std::vector<int> ids;
  std::vector<Eigen::Vector3d> positions;  // of each
};

RankedPoints RankPoints(const ExactPoints& points, std::vector<int> ids,
                        int units_per_step) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  struct Entry {
    Eigen::Vector3d position;
    int id;
  };
  std::vector<Entry> entries(ids.size());
  tbb::parallel_for(std::size_t{0}, ids.size(), [&](std::size_t i) {
    entries[i] = {NearestDoubles(points[ids[i]].definition, units_per_step),
                  ids[i]};
  });
  std::sort(entries.begin(), entries.end(),
            [&points](const Entry& a, const Entry& b) {
              for (int k = 0; k < 3; ++k) {
                if (a.position[k] != b.position[k]) {
                  return a.position[k] < b.position[k];
                }
              }
              if (a.id == b.id) return false;
              for (int k = 0; k < 3; ++k) {
                const int order =
                    CompareCoordinate(points[a.id], points[b.id], k);
                if (order != 0) return order < 0;
              }
              return false;
            });
  RankedPoints out;
  for (const Entry& entry : entries) {
    out.ids.push_back(entry.id);
    out.positions.push_back(entry.position);
  }
  return out;
}

// Sequences of the vertices' ranks compare loops.
class LoopOrder {
 public:
  explicit LoopOrder(const std::vector<int>& ranks) : ranks_(ranks) {}

  // Starts a loop where its sequence is least.
  void Rotate(Loop* loop) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < loop->size(); ++k) {
      if (StartsBefore(*loop, k, best)) best = k;
    }
    std::rotate(loop->begin(), loop->begin() + static_cast<long>(best),
                loop->end());
  }
  bool IsBefore(const Loop& a, const Loop& b) const {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(),
        [this](int v, int w) { return ranks_[v] < ranks_[w]; });
  }
  bool IsBefore(const PatchSurface::Patch& a,
                const PatchSurface::Patch& b) const {
    return std::lexicographical_compare(
        a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(),
        [this](const Loop& x, const Loop& y) { return IsBefore(x, y); });
  }

 private:
  bool StartsBefore(const Loop& loop, std::size_t i, std::size_t j) const {
    const std::size_t size = loop.size();
    for (std::size_t k = 0; k < size; ++k) {
      const int a = ranks_[loop[(i + k) % size]];
      const int b = ranks_[loop[(j + k) % size]];
      if (a != b) return a < b;
    }
    return false;
  }

  const std::vector<int>& ranks_;
};

}  // namespace

void OrderSurface(const ExactPoints& points, int units_per_step,
                  PatchSurface* surface) {
  std::vector<int> used;
  for (const PatchSurface::Patch& patch : surface->patches) {
    for (const Loop& loop : patch.loops) {
      for (const int v : loop) used.push_back(surface->vertex_points[v]);
    }
  }
  const RankedPoints ranked = RankPoints(points, used, units_per_step);
  std::vector<int> rank_of(static_cast<std::size_t>(points.size()), -1);
  for (std::size_t i = 0; i < ranked.ids.size(); ++i) {
    rank_of[ranked.ids[i]] = static_cast<int>(i);
  }
  std::vector<int> ranks;  // of the old vertices
  ranks.reserve(surface->vertex_points.size());
  for (const int id : surface->vertex_points) ranks.push_back(rank_of[id]);

  const LoopOrder order(ranks);
  for (PatchSurface::Patch& patch : surface->patches) {
    for (Loop& loop : patch.loops) order.Rotate(&loop);
    std::sort(
        patch.loops.begin(), patch.loops.end(),
        [&](const Loop& a, const Loop& b) { return order.IsBefore(a, b); });
  }
  std::sort(surface->patches.begin(), surface->patches.end(),
            [&](const PatchSurface::Patch& a, const PatchSurface::Patch& b) {
              return order.IsBefore(a, b);
            });

  const std::vector<int> old_points = std::move(surface->vertex_points);
  surface->vertex_points.clear();
  surface->vertex_ranks.clear();
  surface->positions.clear();
  std::vector<int> new_number(old_points.size(), -1);
  for (PatchSurface::Patch& patch : surface->patches) {
    for (Loop& loop : patch.loops) {
      for (int& v : loop) {
        if (new_number[v] < 0) {
          new_number[v] = static_cast<int>(surface->vertex_points.size());
          surface->vertex_points.push_back(old_points[v]);
          surface->vertex_ranks.push_back(ranks[v]);
          surface->positions.push_back(ranked.positions[ranks[v]]);
        }
        v = new_number[v];
      }
    }
  }
}

}  // namespace phongpd::internal
