// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"
#include "core/contact/contact_space.h"

// Curves that hit, miss and graze a contact space.
namespace phongpd::testing {

// A cube of side 0.5 over one of 1.5 is in contact at |q|∞ = 1.  Over the
// cube at height z(s) = 1 + gap + (2s − 1)², exact where gap + 2 is.
Trajectory Arch(double gap);

// Starts free; each point is `spread` of the contact space's diagonal from the
// one before it, in the standard deviation of each coordinate: hits, misses
// and near misses.
CurvePiece RandomPiece(const FreeSpace& space, const ContactSpace& contact,
                       double spread, std::mt19937_64* random);

// Comes as near as `gap` to a random point of the surface, and leaves:
// x + gap n + u s + k s² n, s ∈ [−1, 1].
CurvePiece GrazingPiece(const ContactSpace& contact, double gap,
                        std::mt19937_64* random);

}  // namespace phongpd::testing
