// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/retraction_settings.h"

#include <utility>

#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

constexpr std::pair<RetractionMetric, const char*> kMetrics[] = {
    {RetractionMetric::kPhong, "phong"},
    {RetractionMetric::kEuclidean, "euclidean"},
    {RetractionMetric::kLocalEuclidean, "euclidean-all"},
    {RetractionMetric::kContactPoint, "contact-point"},
    {RetractionMetric::kContactPoints, "contact-points"}};
constexpr std::pair<BranchChoice, const char*> kChoices[] = {
    {BranchChoice::kAll, "all"},
    {BranchChoice::kRandom, "random"},
    {BranchChoice::kNovelty, "novelty"},
    {BranchChoice::kWarm, "warm"},
    {BranchChoice::kNearest, "nearest"}};

constexpr std::pair<LocalPlanner, const char*> kLocalPlanners[] = {
    {LocalPlanner::kCollideAndSlide, "collide-and-slide"},
    {LocalPlanner::kStepRetract, "step-retract"},
    {LocalPlanner::kStraight, "straight"}};

template <typename Value, std::size_t kSize>
std::string NameOf(Value value,
                   const std::pair<Value, const char*> (&names)[kSize]) {
  for (const auto& [known, name] : names) {
    if (known == value) return name;
  }
  return "";
}

template <typename Value, std::size_t kSize>
std::string Names(const std::pair<Value, const char*> (&names)[kSize]) {
  std::string list;
  for (const auto& entry : names) {
    list += (list.empty() ? "" : ",") + std::string(entry.second);
  }
  return list;
}

template <typename Value, std::size_t kSize>
Value ValueOf(const std::string& what, const std::string& name,
              const std::pair<Value, const char*> (&names)[kSize]) {
  for (const auto& [value, known] : names) {
    if (name == known) return value;
  }
  throw InputError(what + ": expected one of " + Names(names) + ", found '" +
                   name + "'");
}

}  // namespace

std::string ToString(RetractionMetric metric) {
  return NameOf(metric, kMetrics);
}
std::string ToString(BranchChoice choice) { return NameOf(choice, kChoices); }
std::string ToString(LocalPlanner planner) {
  return NameOf(planner, kLocalPlanners);
}
RetractionMetric RetractionMetricFromString(const std::string& name) {
  return ValueOf("retraction metric", name, kMetrics);
}
BranchChoice BranchChoiceFromString(const std::string& name) {
  return ValueOf("branch choice", name, kChoices);
}
LocalPlanner LocalPlannerFromString(const std::string& name) {
  return ValueOf("local planner", name, kLocalPlanners);
}
std::string LocalPlannerRange() { return Names(kLocalPlanners); }

void DeclareRetractionParams(
    const std::function<RetractionOptions()>& get,
    const std::function<void(const RetractionOptions&)>& set,
    ompl::base::ParamSet* params) {
  // One parameter: how it changes the options and how it is read from them.
  const auto declare = [&](const std::string& name, auto write, auto read,
                           const std::string& range) {
    using Value = decltype(read(RetractionOptions()));
    params->declareParam<Value>(
        name,
        [get, set, write](Value value) {
          RetractionOptions options = get();
          write(value, &options);
          set(options);
        },
        [get, read] { return read(get()); });
    (*params)[name].setRangeSuggestion(range);
  };
  declare(
      "metric",
      [](const std::string& name, RetractionOptions* options) {
        options->metric = RetractionMetricFromString(name);
      },
      [](const RetractionOptions& options) { return ToString(options.metric); },
      Names(kMetrics));
  declare(
      "choice",
      [](const std::string& name, RetractionOptions* options) {
        options->choice = BranchChoiceFromString(name);
      },
      [](const RetractionOptions& options) { return ToString(options.choice); },
      Names(kChoices));
  declare(
      "clearance",
      [](double value, RetractionOptions* options) {
        options->clearance = value;
      },
      [](const RetractionOptions& options) { return options.clearance; },
      "0.001:0.001:0.1");
}

}  // namespace phongpd
