// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/windows/box_partition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace phongpd::internal {
namespace {

// Halves may meet more facets, by this factor.
constexpr double kBoxGrowth = 1.1;
// Sums of features of the largest boxes of which the facets are found; smaller
// ones choose of these.
constexpr std::size_t kMostSumsOfBox = 500;
// To find that a box has more takes longest: so many halvings after one are
// made unseen.
constexpr int kUncounted = 2;

}  // namespace

BoxPartition::BoxPartition(const FeatureSums& sums, const GridWindow& whole,
                           std::size_t most, IsVoid is_void)
    : sums_(sums), is_void_(std::move(is_void)) {
  boxes_.emplace_back();
  boxes_.back().part.window = whole;
  boxes_.back().most = most;
}

void BoxPartition::Know(int number) {
  Box& box = boxes_[static_cast<std::size_t>(number)];
  if (box.is_known) return;
  box.is_known = true;
  const auto halves = box.part.window.Halves();
  if (box.of == nullptr && halves && box.uncounted > 0) {
    Halve(number, *halves, box.uncounted - 1);
    return;
  }
  if (box.of == nullptr) {
    std::optional<WindowConvolution> found =
        sums_.Within(box.part.window.Box(),
                     halves ? std::max(kMostSumsOfBox, box.most)
                            : std::numeric_limits<std::size_t>::max());
    if (found) {
      box.part.facets.resize(found->convolution.facets.size());
      std::iota(box.part.facets.begin(), box.part.facets.end(), 0);
      box.of =
          std::make_shared<const Convolution>(std::move(found->convolution));
    }
  }
  const bool is_leaf =
      !halves || (box.of != nullptr && box.part.facets.size() <= box.most);
  if (!is_leaf) Halve(number, *halves, kUncounted);
}

void BoxPartition::Halve(int number, const std::array<GridWindow, 2>& windows,
                         int uncounted) {
  Box& box = boxes_[static_cast<std::size_t>(number)];
  box.halves = static_cast<int>(boxes_.size());
  for (const GridWindow& window : windows) {
    Box& half = boxes_.emplace_back();
    half.part.window = window;
    half.uncounted = uncounted;
    half.most =
        static_cast<std::size_t>(kBoxGrowth * static_cast<double>(box.most));
    if (box.of == nullptr) continue;
    half.of = box.of;
    half.part.facets =
        FacetsIn(*box.of, box.part.facets, half.part.window.Box());
  }
  box.of = nullptr;
  box.part.facets = {};
}

bool BoxPartition::IsVoidBox(int number) {
  if (!is_void_) return false;
  Box& box = boxes_[static_cast<std::size_t>(number)];
  if (!box.is_void) {
    box.is_void = box.halves < 0 && is_void_(box.part.window);
    if (*box.is_void) {
      box.of = nullptr;
      box.part.facets = {};
    }
  }
  return *box.is_void;
}

void BoxPartition::Collect(int number, const Range& range, bool with_void,
                           std::vector<int>* leaves) {
  const GridWindow& window = Node(number).part.window;
  for (int k = 0; k < 3; ++k) {
    if (range.min[k] > 2 * window.max[k] || range.max[k] < 2 * window.min[k]) {
      return;
    }
  }
  if (IsVoidBox(number)) {
    if (with_void) leaves->push_back(number);
    return;
  }
  Know(number);
  const int halves = Node(number).halves;
  if (halves < 0) {
    leaves->push_back(number);
    return;
  }
  Collect(halves, range, with_void, leaves);
  Collect(halves + 1, range, with_void, leaves);
}

std::vector<int> BoxPartition::LeavesIn(const BoundingBox& box) {
  Range range;
  for (int k = 0; k < 3; ++k) {
    range.min[k] = std::llround(std::floor(4.0 * box.min[k]));
    range.max[k] = std::llround(std::ceil(4.0 * box.max[k]));
  }
  std::vector<int> leaves;
  Collect(0, range, false, &leaves);
  return leaves;
}

std::vector<WallPatch> BoxPartition::Walls(int leaf) {
  const GridWindow window = Node(leaf).part.window, whole = Node(0).part.window;
  std::vector<WallPatch> patches;
  for (const WallPatch& wall : WholeWalls(window)) {
    const int axis = wall.axis;
    const std::int64_t at = wall.min[axis];
    if (at == (wall.is_high ? whole.max : whole.min)[axis]) {
      patches.push_back(wall);
      continue;
    }
    // What is a quarter step beyond the wall, and within its borders.
    Range range;
    for (int k = 0; k < 3; ++k) {
      range.min[k] = 2 * wall.min[k] + 1;
      range.max[k] = 2 * wall.max[k] - 1;
    }
    range.min[axis] = range.max[axis] = 2 * at + (wall.is_high ? 1 : -1);
    std::vector<int> beyond;
    Collect(0, range, true, &beyond);
    for (const int other : beyond) {
      WallPatch patch = wall;
      patch.beyond = other;
      for (int k = 0; k < 3; ++k) {
        if (k == axis) continue;
        patch.min[k] = std::max(patch.min[k], Node(other).part.window.min[k]);
        patch.max[k] = std::min(patch.max[k], Node(other).part.window.max[k]);
      }
      patches.push_back(patch);
    }
  }
  return patches;
}

WindowConvolution BoxPartition::Take(int leaf) {
  Know(leaf);
  Box& box = boxes_[static_cast<std::size_t>(leaf)];
  if (box.of == nullptr) throw std::logic_error("taken twice, or no leaf");
  WindowConvolution sums = PartOf(*box.of, box.part);
  box.of = nullptr;
  box.part.facets = {};
  return sums;
}

}  // namespace phongpd::internal
