// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/solid/solid.h"

namespace phongpd {

// Which obstacles need a contact space in common: a partition of their
// indices, each group ascending, groups by their first, such that C_obj of
// obstacles of different groups share no point.  So their contact spaces can be
// built one by one, kept one by one, and joined (joined_contact_spaces.h).
//
// How it is told, without building anything: where the robot at one q meets two
// obstacles, these have points whose difference is one of two points of the
// robot, which is at most the robot's box in every coordinate.  On the way from
// one to the other the surfaces are that near, or one obstacle holds a part of
// the other.  So two obstacles are grouped if boxes of their triangles come
// within the robot's box (and more than rounding can matter), or if a component
// of one has a point in the other.  Groups may be larger than needed, never
// smaller.
std::vector<std::vector<int>> ObstacleGroups(
    const Solid& robot, const std::vector<Solid>& obstacles);

}  // namespace phongpd
