// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/GenericParam.h>

#include <functional>
#include <string>

#include "planners/retraction/retraction.h"

// How retraction planners are set, in words and as OMPL parameters.
namespace phongpd {

// How two configurations are joined.
enum class LocalPlanner {
  kCollideAndSlide,
  kStepRetract,
  kStraight,  // only where the straight motion is free
};

// "collide-and-slide", "step-retract", "straight".
std::string ToString(LocalPlanner planner);

// "phong", "euclidean", "euclidean-all", "contact-point", "contact-points".
std::string ToString(RetractionMetric metric);
// "all", "random", "novelty", "warm", "nearest".
std::string ToString(BranchChoice choice);
// Throw InputError for any other name, with all that there are.
LocalPlanner LocalPlannerFromString(const std::string& name);
RetractionMetric RetractionMetricFromString(const std::string& name);
BranchChoice BranchChoiceFromString(const std::string& name);

// The names of local planners, separated by commas: a range of OMPL's.
std::string LocalPlannerRange();

// Declares metric, choice and clearance on *params with their ranges.  Setting
// one calls set(changed options), which may throw InputError and then must
// leave everything as it was.
void DeclareRetractionParams(
    const std::function<RetractionOptions()>& get,
    const std::function<void(const RetractionOptions&)>& set,
    ompl::base::ParamSet* params);

}  // namespace phongpd
