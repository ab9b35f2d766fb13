// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/windows/grid_window.h"
#include "core/minkowski/windows/window_plan.h"

namespace phongpd::internal {

// Windows that fill a box: halved across the longest side until few facets of
// the convolution meet each, found when somebody first looks there.  Which
// windows there are follows from the operands and the box alone.
class BoxPartition {
 public:
  // Nobody needs to look into such a window: it is never halved.
  using IsVoid = std::function<bool(const GridWindow& window)>;

  // Keeps a reference.  A window meets `most` facets, or somewhat more: where
  // thousands share a corner no box around it would ever meet few.  `is_void`
  // is asked once of a window, before it is halved; none: nothing is.
  BoxPartition(const FeatureSums& sums, const GridWindow& whole,
               std::size_t most, IsVoid is_void = {});

  const GridWindow& window(int leaf) const { return Node(leaf).part.window; }

  // The windows that meet a closed box of grid steps, but void ones.
  std::vector<int> LeavesIn(const BoundingBox& box);

  // The walls of a window, in patches by what is `beyond`: the number of a
  // window, or −1 beyond the whole.
  std::vector<WallPatch> Walls(int leaf);

  // The facets of the convolution that meet a window: found with it, and kept
  // until they are taken, once.
  WindowConvolution Take(int leaf);

 private:
  struct Box {
    // Its facets: some of a convolution that a larger box was found with.
    PlannedWindow part;
    std::shared_ptr<const Convolution> of;  // null: not known, or handed on
    std::size_t most = 0;
    bool is_known = false;
    std::optional<bool> is_void;  // none: not asked
    int uncounted = 0;            // levels that are halved unseen, with its own
    int halves = -1;              // the first of two; −1: a leaf, if known
  };
  struct Range {  // closed, quarter steps
    GridPoint min, max;
  };

  const Box& Node(int box) const {
    return boxes_[static_cast<std::size_t>(box)];
  }
  void Know(int box);
  void Halve(int box, const std::array<GridWindow, 2>& windows, int uncounted);
  bool IsVoidBox(int box);
  void Collect(int box, const Range& range, bool with_void,
               std::vector<int>* leaves);

  const FeatureSums& sums_;
  const IsVoid is_void_;
  std::deque<Box> boxes_;
};

}  // namespace phongpd::internal
