// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/ValidStateSampler.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "planners/retraction/retraction.h"

namespace phongpd {

// Draws valid states for OMPL's planners: uniform samples in the bounds of the
// space; those that collide are retracted to free states near contact
// (retraction.h).  With BranchChoice::kAll one retraction gives several states;
// consecutive calls return them one by one.
//
// It helps the planners of OMPL that ask a sampler for valid states: PRM,
// SPARS, EST, SBL, KPIECE and similar ones.  RRT, RRTConnect, RRT* and LazyPRM
// never ask; use RetractionRRT or RetractionForest instead.  An instance is for
// one thread; OMPL allocates one for each.
class RetractionStateSampler : public ompl::base::ValidStateSampler {
 public:
  // Throws InputError without a model, for bad options, and unless the space is
  // a RealVectorStateSpace of dimension 3.
  RetractionStateSampler(const ompl::base::SpaceInformation* si,
                         std::shared_ptr<const ContactModel> model,
                         const RetractionOptions& options, std::uint64_t seed);

  // False if no attempt gave a free state.
  bool sample(ompl::base::State* state) override;
  // The same with samples from the ball of radius `distance` around `near`; the
  // state lies in that ball, too.
  bool sampleNear(ompl::base::State* state, const ompl::base::State* near,
                  double distance) override;

  const RetractionOptions& options() const { return retraction_.options(); }
  const RetractionCounters& counters() const { return scratch_.counters; }

 private:
  Retraction retraction_;
  RetractionScratch scratch_;
  std::mt19937_64 random_;
  BoundingBox bounds_;
  std::vector<Eigen::Vector3d> pending_;  // of one retraction, last first
};

// An allocator for SpaceInformation::setValidStateSamplerAllocator.  The n-th
// sampler that it allocates gets its own seed, computed from `seed` and n.
ompl::base::ValidStateSamplerAllocator RetractionStateSamplerAllocator(
    std::shared_ptr<const ContactModel> model,
    const RetractionOptions& options = {}, std::uint64_t seed = 1);

}  // namespace phongpd
