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

// Valid states by retraction: uniform samples of the space's bounds, those
// that collide carried to the contact surface.  With BranchChoice::kAll the
// points of one retraction come one by one from consecutive calls.
//
// For the planners of OMPL that ask for valid states (PRM, SPARS, EST, SBL,
// KPIECE and their kin); RRT, RRTConnect, RRT* and LazyPRM never do, which is
// why RetractionRRT exists.  All state is per instance, and OMPL allocates one
// per thread.
class RetractionStateSampler : public ompl::base::ValidStateSampler {
 public:
  // Throws InputError without a model, for options, and for a space that is no
  // RealVectorStateSpace of dimension 3.
  RetractionStateSampler(const ompl::base::SpaceInformation* si,
                         std::shared_ptr<const ContactModel> model,
                         const RetractionOptions& options, std::uint64_t seed);

  // False if no attempt gave a free point.
  bool sample(ompl::base::State* state) override;
  // From samples of the ball around `near`; the retracted point lies in it
  // too.
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

// For SpaceInformation::setValidStateSamplerAllocator.  The n-th sampler it
// allocates has a seed of its own, made of `seed` and n.
ompl::base::ValidStateSamplerAllocator RetractionStateSamplerAllocator(
    std::shared_ptr<const ContactModel> model,
    const RetractionOptions& options = {}, std::uint64_t seed = 1);

}  // namespace phongpd
