// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/random_pairs.h"

// Is a contact space right?  Asked by routes that share nothing with the
// builder: the collision oracle, the swapped, moved and scaled pair, counted
// volumes.
namespace phongpd {

struct CheckOptions {
  // Random points of the bounding box, and as many at each of ±1e-6 and ±1e-9
  // of the diagonal off random points of the surface.
  int points = 300;
  // Also build the pair swapped, moved by up to 100 diagonals, and scaled by
  // 1e-9 ... 1e9.
  bool variants = true;
  std::uint64_t seed = 1;
};

struct CheckResult {
  std::vector<std::string> failures;  // a sentence each; none: it is right
  std::size_t triangles = 0;
  double seconds = 0.0;  // of the slowest build
  // Pairs of triangles that meet because vertices were rounded to double: by
  // less than a few grid steps.  More is a failure.
  std::size_t rounded_contacts = 0;
  double deepest_overlap = 0.0;  // of two triangles, in grid sizes
  // Points a step off the surface that lie behind another sheet of it, and
  // points too close to the surface for doubles to tell: no statement.
  int crevices = 0;
  int undecided = 0;
  // Points where the oracle contradicts exact predicates.
  int oracle_errors = 0;
};

// Builds the pair's contact space and checks: closed, manifold, no
// self-intersection but by rounding; the pair's own expectations; volume and
// bounding box of the variants; membership of points.  Never throws: an
// exception of the builder is a failure.
CheckResult CheckContactSpace(const SolidPair& pair,
                              const CheckOptions& options = {});

}  // namespace phongpd
