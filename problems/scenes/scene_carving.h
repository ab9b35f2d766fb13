// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Obstacles with a prescribed free space.  Let the robot R be a union of
// boxes, F a union of boxes of configurations.  The obstacle
//   B = block \ (F ⊕ R)
// leaves all of F free, and of the rest only the configurations at which the
// robot fits into the space F ⊕ R that it sweeps.  For a straight channel
// narrower than the walls are thick these are no more: it is exactly as wide
// as its box in F.
namespace phongpd {

using Boxes = std::vector<BoundingBox>;

// The union of boxes as a `cells` shape.
nlohmann::ordered_json CellsShape(const Boxes& solid);

// block \ (free ⊕ robot) as a `cells` shape.  A box of `free` may have
// max < min by less than the robot's size on some axes: a channel that is too
// narrow by that.
nlohmann::ordered_json CarvedShape(const BoundingBox& block, const Boxes& free,
                                   const Boxes& robot);

// A box of `free` for every piece of an axis-aligned polyline: all points
// that differ from the piece by at most width/2 in every coordinate.
Boxes Channel(const std::vector<Eigen::Vector3d>& polyline, double width);

}  // namespace phongpd
