// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/retraction_state_sampler.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <atomic>
#include <utility>

#include "planners/ompl/contact_space_validity.h"
#include "planners/ompl/retraction_settings.h"

namespace phongpd {

namespace ob = ompl::base;
using Eigen::Vector3d;

RetractionStateSampler::RetractionStateSampler(
    const ob::SpaceInformation* si, std::shared_ptr<const ContactModel> model,
    const RetractionOptions& options, std::uint64_t seed)
    : ValidStateSampler(si),
      retraction_(std::move(model), options),
      random_(seed) {
  name_ = "retraction";
  CheckConfigurationSpace(name_, *si->getStateSpace());
  const ob::RealVectorBounds& bounds =
      si->getStateSpace()->as<ob::RealVectorStateSpace>()->getBounds();
  for (unsigned int k = 0; k < 3; ++k) {
    bounds_.min[k] = bounds.low[k];
    bounds_.max[k] = bounds.high[k];
  }
  DeclareRetractionParams([this] { return retraction_.options(); },
                          [this](const RetractionOptions& changed) {
                            // Checks the options before anything is changed.
                            Retraction retraction =
                                retraction_.WithOptions(changed);
                            retraction_ = std::move(retraction);
                            pending_.clear();
                          },
                          &params_);
}

bool RetractionStateSampler::sample(ob::State* state) {
  for (unsigned int k = 0; pending_.empty() && k < attempts_; ++k) {
    retraction_.Retract(UniformPoint(bounds_, &random_), &random_, &scratch_);
    for (std::size_t i = scratch_.points.size(); i-- > 0;) {
      pending_.push_back(scratch_.points[i].q);
    }
  }
  if (pending_.empty()) return false;
  FromPoint(pending_.back(), state);
  pending_.pop_back();
  return true;
}

bool RetractionStateSampler::sampleNear(ob::State* state, const ob::State* near,
                                        double distance) {
  const Vector3d center = ToPoint(near);
  const BoundingBox box = {
      (center.array() - distance).matrix().cwiseMax(bounds_.min),
      (center.array() + distance).matrix().cwiseMin(bounds_.max)};
  for (unsigned int k = 0; k < attempts_; ++k) {
    const Vector3d q = UniformPoint(box, &random_);
    if ((q - center).norm() > distance) continue;
    retraction_.Retract(q, &random_, &scratch_);
    for (const RetractedPoint& point : scratch_.points) {
      if ((point.q - center).norm() > distance) continue;
      FromPoint(point.q, state);
      return true;
    }
  }
  return false;
}

ob::ValidStateSamplerAllocator RetractionStateSamplerAllocator(
    std::shared_ptr<const ContactModel> model, const RetractionOptions& options,
    std::uint64_t seed) {
  options.Validate();
  auto count = std::make_shared<std::atomic<std::uint64_t>>(0);
  return [model = std::move(model), options, seed,
          count](const ob::SpaceInformation* si) -> ob::ValidStateSamplerPtr {
    std::seed_seq sequence{seed & 0xffffffffu, seed >> 32, (*count)++};
    std::uint32_t words[2];
    sequence.generate(words, words + 2);
    const std::uint64_t own =
        static_cast<std::uint64_t>(words[0]) << 32 | words[1];
    return std::make_shared<RetractionStateSampler>(si, model, options, own);
  };
}

}  // namespace phongpd
