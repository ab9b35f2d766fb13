// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/convolution/occupied_balls.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/solid_collision.h"
#include "core/minkowski/windows/box_partition.h"
#include "core/minkowski/windows/window_cells.h"

namespace phongpd::internal {

// Boxes of configuration space that are arranged one by one, and the boundary
// of rooms of some of them.
class ExploredBoxes {
 public:
  struct Box {
    std::vector<WallPatch> patches;  // of its walls, by the boxes beyond
    WindowRooms rooms;
    // Of each point asked for the rooms it is in: none where another box holds
    // it, more than one where rounding could decide.
    std::vector<std::vector<int>> rooms_of_points;
  };

  // What they are explored for.
  enum class Purpose {
    kRooms,    // to go from one to the next
    kContact,  // C_cont in each box alone: its walls are whole, and what surely
               // lies in C_obj is left out before it is arranged
  };

  // Boxes meet about `most_facets` of the convolution.  Keeps the model.
  ExploredBoxes(const ConvolutionModel& model, std::size_t most_facets,
                Purpose purpose = Purpose::kRooms);

  // The model's limits count from here, and from construction on.
  void RestartLimits();

  const GridFrame& frame() const { return pair_.frame; }
  // Of all sums, grid steps.
  const BoundingBox& bounds() const { return sums_.bounds(); }
  // Those bounds, wider by `share` of their longest side, walls odd.
  GridWindow Around(double share) const;

  // Those that meet a closed box of grid steps, but for such that surely lie
  // in C_obj.
  std::vector<int> In(const BoundingBox& box) {
    return partition_.LeavesIn(box);
  }
  const GridWindow& window(int box) const { return partition_.window(box); }

  // Arranges a box unless that was done.  `points`, grid steps, free: those
  // whose rooms are asked for, here and not later, because another arrangement
  // of the box may number its rooms otherwise.  Throws BuildRefusal at the
  // limits, and BuildCancelled.
  const Box& Explore(int box, const std::vector<Eigen::Vector3d>& points = {});
  // Null before Explore.
  const Box* Find(int box) const;
  const std::map<int, Box>& explored() const { return explored_; }
  std::size_t faces() const { return faces_; }  // in all arrangements

  // The boundary of rooms that are kept, of boxes that were explored: C_cont,
  // walls where they go on in other boxes than these, and a box around all
  // sums beyond which everything is free.  To be taken for a contact space:
  // what is free of it, and within the box, is free.  Throws std::logic_error
  // where rooms do not fit together because cells at their walls are too thin
  // to be judged.  For kContact a box alone.
  ContactSpace::Parts Surface(
      const std::vector<int>& boxes,
      const std::function<bool(int box, int room)>& is_kept) const;

  // As far as configurations need to be looked at: everything beyond is free.
  BoundingBox Reach() const;

 private:
  const ConvolutionModel model_;
  const GridPair& pair_;
  std::optional<BuildLimits> limits_;
  SolidCollision judge_;
  std::unique_ptr<const OccupiedBalls> occupied_;  // null: kRooms
  FeatureSums sums_;
  BoxPartition partition_;
  std::map<int, Box> explored_;
  std::size_t faces_ = 0;
};

// Leaves out the walls: what is left is C_cont.
void DropWalls(ContactSpace::Parts* space);

}  // namespace phongpd::internal
