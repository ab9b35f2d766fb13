// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "planners/retraction/contact_model.h"
#include "planners/retraction/retraction.h"

namespace phongpd {

// Two local planners for sampling-based planners: they move from a towards b,
// and along obstacles that are in the way.
//
// Both return the polyline they moved along.  It is free, exactly: each segment
// passed FreeSpace::IsFree.  Its points between a and b keep the distance
// ContactModel::floor() from contact.  Each point of CollideAndSlide is closer
// to b than the one before.  Thread-safe if each thread has its own path,
// counters, scratch and random engine.

enum class SlideStatus {
  kReached,    // the path ends in b
  kStopped,    // the path ends where no slide comes closer to b
  kMoveLimit,  // the path ends after a hundred moves
  kInvalid,    // a is not free, or b is not finite
};

struct SlideCounters {
  std::uint64_t slides = 0;
  std::uint64_t moves = 0;           // accepted
  std::uint64_t segment_checks = 0;  // exact tests of a segment
  std::uint64_t rays = 0;            // to measure the gap in front of a facet
};

// Collide and slide.  Moves straight towards b, stops at the standoff in front
// of the first facet in the way, and goes on with the motion projected onto the
// facet's plane; between two facets, along the line in which their planes
// intersect.  A move takes three tests of segments and no projection onto
// C_cont.  The path is cleared first and starts with a.
//
// `clearance` is the largest standoff, as a fraction in (0, 1] of the region's
// diagonal; the standoff is half the free gap where that is less.  Throws
// InputError for another clearance.
SlideStatus CollideAndSlide(const ContactModel& model, double clearance,
                            const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            std::vector<Eigen::Vector3d>* path,
                            SlideCounters* counters);

// Step and retract.  Takes short steps towards b.  Where a step's end collides,
// it is retracted, to the one of the retracted points that is closest to it.
// Each step is tested exactly; stops when no step comes closer to b.  Takes one
// retraction a step, so it is slower than CollideAndSlide, and it stops in
// corners where CollideAndSlide goes on.  A baseline: prefer CollideAndSlide.
SlideStatus StepRetract(const Retraction& retraction, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b, std::mt19937_64* random,
                        RetractionScratch* scratch,
                        std::vector<Eigen::Vector3d>* path,
                        SlideCounters* counters);

}  // namespace phongpd
