// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "core/contact/contact_space.h"
#include "tests/support/campaign.h"

// Pairs whose operands are scaled, moved and turned, and the judge of what
// becomes of their contact space.
namespace phongpd::testing {

struct MovedPair {
  TriangleMesh robot, obstacle;
};

// Of determinant ±1 if asked for; entries in −2 … 2.
Eigen::Matrix3d RandomIntegerMap(bool is_unimodular, std::mt19937_64* random);

// x ↦ map·x + offset; turned over when the map mirrors.
TriangleMesh Mapped(TriangleMesh mesh, const Eigen::Matrix3d& map,
                    const Eigen::Vector3d& offset = Eigen::Vector3d::Zero());

MovedPair LatticePair(std::mt19937_64* random);

// The shapes of the campaign in turn.
MovedPair MakeMovedPair(std::uint64_t seed);

ContactSpace SpaceOf(const MovedPair& pair);

// Counts contact spaces that are not as they should be, and keeps the worst
// displacement: of corners where nothing was rounded, else of the surface (a
// facet that rounding broke has corners along the break, wherever others cross
// it).  Reports both when it goes.
class MovedSpaceJudge {
 public:
  // Bounds over L, of pairs on lattices and of such as are rounded.
  MovedSpaceJudge(const std::string& subject, double exact_bound,
                  double rounded_bound);
  ~MovedSpaceJudge();

  // `moved` must be `space` with its points mapped; `length` is L after that.
  void Compare(
      const ContactSpace& space, const ContactSpace& moved,
      const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map,
      double length, const std::string& what);

 private:
  CampaignRow exact_, rounded_;
};

}  // namespace phongpd::testing
