// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// The reduced convolution of P and Q in cells: boxes that halve the box of all
// sums until few facets meet each of them, found when somebody first looks
// there.  What nobody looks at costs nothing.
//
// A facet is in every cell that it meets, so whoever looks into all cells that
// a closed set meets finds all facets that meet the set.  Thread-safe: threads
// that are the first in one cell at once all find what is in it, and one keeps
// it.  Grid steps.
class ConvolutionCells {
 public:
  // Keeps references.  What is found is kept up to max_mib(), asked each time;
  // beyond that it is found anew for everybody who looks, and answers stay the
  // same.
  ConvolutionCells(const GridSolid& p, const GridSolid& q,
                   std::function<double()> max_mib);
  ~ConvolutionCells();

  // Facets of one cell, their corners exact: at least one.
  struct Leaf {
    TriangleMesh mesh;
    TriangleBvh bvh;
  };

  // Depth first, the nearer half first.  bound(box) → lower bound of what is in
  // it (infinity: nothing); visit(leaf) → the least value found so far.  Boxes
  // whose bound is not below `limit`, or what visit made of it, are skipped.
  template <typename Bound, typename Visit>
  void NearestFirst(double limit, const Bound& bound,
                    const Visit& visit) const {
    Search<Bound, Visit>{*this, bound, visit, limit}.In(root_, bound(root_.box),
                                                        true);
  }

  // The boxes in the order of their keys: key(box) → lower bound; needs(key,
  // box) → is what is in it to be looked at?, asked of each in its turn;
  // visit(leaf), which lives until done() has returned, which is called last.
  template <typename Key, typename Needs, typename Visit, typename Done>
  void BestFirst(const Key& key, const Needs& needs, const Visit& visit,
                 const Done& done) const {
    struct Waiting {
      double key;
      const Cell* cell;
      bool is_kept;
    };
    const auto is_later = [](const Waiting& a, const Waiting& b) {
      return a.key > b.key;
    };
    std::vector<Waiting> queue = {{key(root_.box), &root_, true}};
    std::vector<std::unique_ptr<const Content>> mine;
    while (!queue.empty()) {
      std::pop_heap(queue.begin(), queue.end(), is_later);
      const Waiting next = queue.back();
      queue.pop_back();
      if (!needs(next.key, next.cell->box)) continue;
      mine.emplace_back();
      const Content& content = Look(*next.cell, next.is_kept, &mine.back());
      const bool is_kept = mine.back() == nullptr;
      if (is_kept) mine.pop_back();
      if (content.leaf != nullptr) visit(*content.leaf);
      for (int k = 0; content.halves != nullptr && k < 2; ++k) {
        const Cell& half = content.halves[k];
        queue.push_back({key(half.box), &half, is_kept});
        std::push_heap(queue.begin(), queue.end(), is_later);
      }
    }
    done();
  }

  // Of all sums.
  const BoundingBox& bounds() const { return sums_.bounds(); }
  // Of all their coordinates.
  double largest() const { return largest_; }
  // In the cells that are kept; those in several cells count as often.
  std::size_t facets() const { return facets_.load(); }

 private:
  struct Content;
  struct Cell {
    BoxTree::Node box;
    std::size_t most = 0;  // sums that it may hold before it is halved
    mutable std::atomic<const Content*> content{nullptr};  // null: unknown

    ~Cell();
  };
  // Two halves, or facets: none where the cell is empty.
  struct Content {
    std::unique_ptr<Cell[]> halves;
    std::unique_ptr<Leaf> leaf;
  };

  template <typename Bound, typename Visit>
  struct Search {
    void In(const Cell& cell, double lower, bool is_kept) {
      if (!(lower < limit)) return;
      std::unique_ptr<const Content> mine;
      const Content& content = cells.Look(cell, is_kept, &mine);
      is_kept = mine == nullptr;
      if (content.leaf != nullptr) limit = visit(*content.leaf);
      if (content.halves == nullptr) return;
      std::pair<double, int> near(bound(content.halves[0].box), 0);
      std::pair<double, int> far(bound(content.halves[1].box), 1);
      if (far.first < near.first) std::swap(near, far);
      In(content.halves[near.second], near.first, is_kept);
      In(content.halves[far.second], far.first, is_kept);
    }

    const ConvolutionCells& cells;
    const Bound& bound;
    const Visit& visit;
    double limit;
  };

  // What is in the cell; `mine` owns it where it is not kept, as in cells that
  // are not kept themselves.
  const Content& Look(const Cell& cell, bool may_keep,
                      std::unique_ptr<const Content>* mine) const;
  std::unique_ptr<const Content> Find(const Cell& cell) const;

  FeatureSums sums_;
  double largest_;
  std::function<double()> max_mib_;
  Cell root_;
  mutable std::atomic<std::size_t> bytes_{0}, facets_{0};
};

}  // namespace phongpd::internal
