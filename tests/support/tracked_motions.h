// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"

// Contact spaces and motions for tests of what follows a motion.
namespace phongpd::testing {

struct TrackedSpace {
  std::string name;
  ContactSpace contact;
  // The way to the other side of a wall is many times the wall, or there is
  // none: no figure of the ratio is promised.
  bool is_hard = false;
};

// The first `count` of twenty.
std::vector<TrackedSpace> TrackedSpaces(std::size_t count);

Eigen::Vector3d InnerPoint(const ContactSpace& contact,
                           std::mt19937_64* random);

using Motion = std::vector<Eigen::Vector3d>;

// Straight (kind 0) and bent (1) ways between interior points, and random walks
// (2) that leave and enter as it comes, in steps of all lengths.
Motion MakeMotion(const ContactSpace& contact, int kind, int frames,
                  std::mt19937_64* random);

}  // namespace phongpd::testing
