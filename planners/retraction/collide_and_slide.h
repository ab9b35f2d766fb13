// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "planners/retraction/contact_model.h"
#include "planners/retraction/retraction.h"

namespace phongpd {

// Local planners: from a towards b, along obstacles where they are in the way.
//
// Both return the polyline they moved along.  It is exactly free (each segment
// passed FreeSpace::IsFree), its points between a and b keep the model's floor,
// and every point of a collide-and-slide is closer to b than the one before.
// Thread-safe with a path, counters, scratch and engine per thread.

enum class SlideStatus {
  kReached,    // the path ends in b
  kStopped,    // at a place from which no slide comes closer to b
  kMoveLimit,  // a hundred moves
  kInvalid,    // a is not free, or b is not finite
};

struct SlideCounters {
  std::uint64_t slides = 0;
  std::uint64_t moves = 0;           // accepted
  std::uint64_t segment_checks = 0;  // exact tests of a segment
  std::uint64_t rays = 0;            // for gaps in front of facets
};

// Collide and slide: go straight at b; at the first contact stop in front of
// the facet by its standoff, go on without the part of the motion along the
// facet's normal, and between two facets along their crease.  Three tests a
// move, no projection.  The path is cleared first and starts with a.
// `clearance`: largest standoff from what is slid along, as a fraction of the
// region's diagonal; half the free gap where that is less.  Throws InputError
// unless it is in (0, 1].
SlideStatus CollideAndSlide(const ContactModel& model, double clearance,
                            const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            std::vector<Eigen::Vector3d>* path,
                            SlideCounters* counters);

// Step and retract: a short step towards b, retracted where it collides (to
// the point closest to the step, of those the retraction offers), tested
// exactly, until no step comes closer to b.  One retraction a step: more work
// than CollideAndSlide, and it stops at corners where that one turns.
SlideStatus StepRetract(const Retraction& retraction, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b, std::mt19937_64* random,
                        RetractionScratch* scratch,
                        std::vector<Eigen::Vector3d>* path,
                        SlideCounters* counters);

}  // namespace phongpd
