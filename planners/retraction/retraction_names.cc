// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/retraction_names.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

struct Named {
  RetractionMetric metric;
  BranchChoice choice;
};
// In the order of their names.
constexpr Named kRetractions[] = {
    {RetractionMetric::kPhong, BranchChoice::kAll},
    {RetractionMetric::kPhong, BranchChoice::kRandom},
    {RetractionMetric::kPhong, BranchChoice::kNovelty},
    {RetractionMetric::kPhong, BranchChoice::kWarm},
    {RetractionMetric::kPhong, BranchChoice::kNearest},
    {RetractionMetric::kEuclidean, BranchChoice::kAll},
    {RetractionMetric::kLocalEuclidean, BranchChoice::kAll},
    {RetractionMetric::kContactPoint, BranchChoice::kAll},
    {RetractionMetric::kContactPoints, BranchChoice::kAll}};

}  // namespace

const std::vector<std::string>& RetractionNames() {
  static const std::vector<std::string> names = {
      "phong",         "phong-random",  "phong-novelty",
      "phong-warm",    "phong-nearest", "euclidean",
      "euclidean-all", "contact-point", "contact-points"};
  return names;
}

const std::string& RetractionName(const RetractionOptions& options) {
  std::size_t i = 0;
  // Only Phong's has a choice.
  const bool has_choice = options.metric == RetractionMetric::kPhong;
  while (kRetractions[i].metric != options.metric ||
         (has_choice && kRetractions[i].choice != options.choice)) {
    ++i;
  }
  return RetractionNames()[i];
}

RetractionOptions ParseRetraction(const std::string& text,
                                  const std::string& what) {
  const std::vector<std::string>& names = RetractionNames();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw InputError(what + ": expected one of " + Joined(names) + "; found '" +
                     text + "'" + DidYouMean(text, names));
  }
  const Named& named =
      kRetractions[static_cast<std::size_t>(found - names.begin())];
  RetractionOptions options;
  options.metric = named.metric;
  options.choice = named.choice;
  return options;
}

}  // namespace phongpd
