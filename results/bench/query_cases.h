// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"

// What queries are timed on: contact spaces of 440 to 10⁶ triangles, points in
// them that have nothing to do with each other, and motions through them.
namespace phongpd::bench {

struct QuerySpace {
  std::string name;
  ContactSpace contact;
  std::vector<Eigen::Vector3d> points;  // inside, uniform in the box
};

// The paper's three; tori, smooth and regular; organic bodies, neither.  None
// has more than `most` triangles.
std::vector<QuerySpace> QuerySpaces(std::size_t most, std::uint64_t seed);

// Straight ways from the points of `space`, `step` (a share of D) from frame to
// frame, each as long as it is inside and at most 100 frames.
std::vector<std::vector<Eigen::Vector3d>> QueryMotions(const QuerySpace& space,
                                                       double step,
                                                       std::uint64_t seed);

}  // namespace phongpd::bench
