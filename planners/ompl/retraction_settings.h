// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/GenericParam.h>

#include <functional>
#include <string>

#include "planners/retraction/retraction.h"

// RetractionOptions as OMPL parameters.
namespace phongpd {

// "phong", "euclidean", "contact-point".
std::string ToString(RetractionMetric metric);
// "all", "random", "novelty", "warm", "nearest".
std::string ToString(BranchChoice choice);
// Throw InputError for any other name.
RetractionMetric RetractionMetricFromString(const std::string& name);
BranchChoice BranchChoiceFromString(const std::string& name);

// Declares metric, choice, clearance, depth_bound and max_branches on *params
// with their ranges.  Setting one calls set(changed options), which may throw
// InputError and then must leave everything as it was.
void DeclareRetractionParams(
    const std::function<RetractionOptions()>& get,
    const std::function<void(const RetractionOptions&)>& set,
    ompl::base::ParamSet* params);

}  // namespace phongpd
